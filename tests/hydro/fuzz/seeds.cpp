// Writes the seeds of the fuzzers: fuzz_seeds FOLDER makes FOLDER/READER/…, from the plain writers of the tests and the
// examples. One small file of each format and variant is enough: libFuzzer makes the rest.
#include <fmt/format.h>

#include <filesystem>
#include <string>

#include "container.hpp"
#include "hydro/io/atomic_file.hpp"
#include "hydro/potential/aqwa_text.hpp"
#include "hydro/potential/coefficients.hpp"
#include "hydro/potential/formats/writers.hpp"
#include "hydro/potential/hdb_text.hpp"
#include "hydro/potential/nemoh_text.hpp"
#include "hydro/potential/veres_text.hpp"
#include "hydro/potential/wamit_text.hpp"
#include "support/source_dir.hpp"

namespace {

namespace fs = std::filesystem;

class Corpora {
 public:
  explicit Corpora(fs::path folder) : folder_(std::move(folder)) {}
  void add(const std::string& reader, const std::string& name, std::string_view bytes) const {
    fs::create_directories(folder_ / reader);
    hydro::io::write_atomically(folder_ / reader / name, bytes);
  }
  /// Every file below a folder of the repository with this ending that is not too long to be mutated often.
  void add_files(const std::string& reader, const fs::path& from, const std::string& ending,
                 const std::string& before = "") const {
    constexpr std::uintmax_t longest = 40'000;
    for (const auto& entry : fs::recursive_directory_iterator(from))
      if (entry.is_regular_file() && entry.path().extension() == ending && entry.file_size() < longest)
        add(reader, entry.path().filename().string(), before + hydro::io::read_text(entry.path()));
  }

 private:
  fs::path folder_;
};

void add_units(const Corpora& to) {
  int number = 0;
  for (const char* text : {"29.3 kN/m", "22.5 deg", "1.05e-6 m^2/s", "0.376 N m s/rad", "(±5.2, ±5.2, 0) m",
                           "2 s .. 8 s, 61 values", "10 kN·m", "3 m³", "+1e-3 1/s", "(1, 0, 1)", "0.13 Hz", "5 %"})
    to.add("units", fmt::format("{}", number++), text);
}

void add_meshes(const Corpora& to, const fs::path& source) {
  to.add("mesh", "tetrahedron.stl",
         std::string(1, '\0') +
             "solid t\nfacet normal 0 0 1\nouter loop\nvertex 0 0 -1\nvertex 1 0 -1\nvertex 0 1 -1\n"
             "endloop\nendfacet\nendsolid t\n");
  to.add("mesh", "tetrahedron.obj", "\1v 0 0 -1\nv 1 0 -1\nv 0 1 -1\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
  to.add("mesh", "panel.gdf", "\2panel\n1 9.81\n0 0\n1\n0 0 -1 1 0 -1 1 1 -1 0 1 -1\n");
  to.add_files("mesh", source / "examples", ".obj", "\1");
}

void add_text_formats(const Corpora& to) {
  const std::vector<double> omega = {0.4, 0.9}, heading = {0, 90};
  froude_test::WamitText wamit;
  wamit.omega = omega, wamit.heading_deg = heading;
  std::string input;
  froude_fuzz::pack(input, "x.1", wamit.radiation());
  froude_fuzz::pack(input, "x.3", wamit.excitation());
  froude_fuzz::pack(input, "x.hst", wamit.restoring());
  to.add("wamit", "set", input);
  for (const bool capytaine : {false, true}) {
    froude_test::NemohText nemoh;
    nemoh.omega = omega, nemoh.heading_deg = heading, nemoh.by_capytaine = capytaine;
    input.clear();
    froude_fuzz::pack(input, "Nemoh.cal", nemoh.cal());
    froude_fuzz::pack(input, "Results/RadiationCoefficients.tec", nemoh.radiation());
    froude_fuzz::pack(input, "Results/ExcitationForce.tec", nemoh.force());
    to.add("nemoh", capytaine ? "by_capytaine" : "plain", input);
  }
  for (const bool recent : {false, true}) {
    froude_test::AqwaText aqwa;
    aqwa.omega = omega, aqwa.heading_deg = heading, aqwa.is_recent = recent;
    input.clear();
    froude_fuzz::pack(input, "x.AH1", aqwa.all());
    to.add("aqwa", recent ? "recent" : "old", input);
  }
  for (const bool version2 : {false, true}) {
    froude_test::VeresText veres;
    veres.omega = omega, veres.heading_deg = heading, veres.version2 = version2;
    input.clear();
    froude_fuzz::pack(input, "s.re7", veres.re7());
    froude_fuzz::pack(input, "s.re8", veres.transfer("WAVE EXCITATION FORCE TRANSFER FUNCTIONS"));
    to.add("veres", version2 ? "version2" : "version1", input);
  }
  froude_test::HdbText hdb;
  hdb.period = {4, 8};
  input.clear();
  froude_fuzz::pack(input, "x.hdb", hdb.text());
  to.add("hdb", "one", input);
}

void add_binary_formats(const Corpora& to) {
  const froude_test::SmoothBody body;
  const auto c = body.coefficients({1025, 9.8, hydro::WaterDepth::from_metres(12)}, {0.4, 0.9}, {0.0, 1.0});
  const fs::path folder = fs::temp_directory_path() / "froude_fuzz_seeds";
  fs::create_directories(folder);
  const auto add = [&](const std::string& name) {
    std::string input;
    froude_fuzz::pack(input, name, hydro::io::read_text(folder / name));
    to.add("hdf5", name, input);
  };
  hydro::potential::write_froude(c, folder / "froude.h5");
  hydro::potential::write_bemio(c, folder / "bemio.h5");
  hydro::potential::write_capytaine(c, folder / "capytaine.nc");
  for (const char* name : {"froude.h5", "bemio.h5", "capytaine.nc"}) add(name);
  fs::remove_all(folder);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: fuzz_seeds FOLDER\n");
    return 2;
  }
  const Corpora to(argv[1]);
  const fs::path source = froude_test::source_dir();
  to.add_files("scene", source / "examples", ".toml");
  to.add_files("csv", source / "examples", ".csv");
  add_units(to);
  add_meshes(to, source);
  add_text_formats(to);
  add_binary_formats(to);
  return 0;
}
