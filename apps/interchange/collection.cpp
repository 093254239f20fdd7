#include "interchange/collection.hpp"

#include <fmt/format.h>

#include "answers/plot.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"

namespace froude::interchange {

namespace fs = std::filesystem;

fs::path folder_of_instants(const fs::path& collection) {
  return collection.parent_path() / (collection.stem().string() + "_vtk");
}

VtkFiles write_collection(const fs::path& collection, const std::vector<const Part*>& parts,
                          const std::vector<double>& time) {
  const fs::path folder = folder_of_instants(collection);
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed)
    throw hydro::InputError(fmt::format("cannot make the folder \"{}\": {}", folder.string(), failed.message()), {},
                            "choose a folder that you may write to");
  VtkFiles out;
  const auto write = [&out](const fs::path& path, const std::string& text) {
    hydro::io::write_atomically(path, text);
    ++out.files, out.megabytes += static_cast<double>(text.size()) / 1e6;
  };
  std::string instants, names = "part,number,name\n";
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const Part& part = *parts[p];
    const std::vector<std::string> of_part = part.names();
    for (std::size_t i = 0; i < of_part.size(); ++i) names += fmt::format("{},{},{}\n", part.name(), i + 1, of_part[i]);
    for (std::size_t f = 0; f < time.size(); ++f) {
      const std::string name = fmt::format("{}_{:06}.vtu", part.name(), f);
      write(folder / name, vtu_of(part.at(f), time[f]));
      instants += fmt::format("<DataSet timestep=\"{}\" part=\"{}\" name=\"{}\" file=\"{}/{}\"/>\n", time[f], p,
                              part.name(), plot::escaped(folder.filename().string()), name);
    }
  }
  write(folder / "names.csv", names);
  write(collection,
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
        "<Collection>\n" +
            instants + "</Collection>\n</VTKFile>\n");
  return out;
}

}  // namespace froude::interchange
