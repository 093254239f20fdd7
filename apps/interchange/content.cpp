#include "interchange/content.hpp"

#include <fmt/format.h>
#include <hdf5_hl.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "hydro/base/error.hpp"
#include "hydro/io/csv.hpp"
#include "hydro/io/hdf5.hpp"
#include "hydro/io/trial.hpp"
#include "view/hdf5_handle.hpp"

namespace froude::interchange {
namespace {

namespace fs = std::filesystem;
using hydro::InputError;
using hydro::io::Hdf5Reader;

constexpr const char* parts_of_complex = "complex";  // an axis of two: real and imaginary part

/// "/branch1/point" as the name "branch1/point".
std::string name_of(const std::string& dataset) { return dataset.substr(1); }

/// The axes of a dataset by the dimension scales that stand on them; one that is a scale is its own axis.
std::vector<std::string> axes_of(hid_t file, const std::string& dataset, std::size_t rank, const fs::path& path) {
  const Hdf5Handle data(H5Dopen2(file, dataset.c_str(), H5P_DEFAULT), &H5Dclose);
  if (rank == 1 && H5DSis_scale(data.get()) > 0) return {name_of(dataset)};
  std::vector<std::string> out;
  const auto take = [](hid_t, unsigned, hid_t scale, void* to) -> herr_t {
    std::string name(static_cast<std::size_t>(std::max<ssize_t>(H5Iget_name(scale, nullptr, 0), 0)), '\0');
    H5Iget_name(scale, name.data(), name.size() + 1);
    static_cast<std::vector<std::string>*>(to)->push_back(name_of(name));
    return 1;  // the first one is enough
  };
  for (std::size_t axis = 0; axis < rank; ++axis)
    H5DSiterate_scales(data.get(), static_cast<unsigned>(axis), nullptr, take, &out);
  if (out.size() != rank)
    throw InputError(fmt::format("{} does not say what it stands along", name_of(dataset)), {.file = path.string()},
                     "write the result again with this version of froude");
  return out;
}

std::string text_or_none(const Hdf5Reader& file, const std::string& object, const std::string& attribute) {
  return file.has_attribute(object, attribute) ? file.text_attribute(object, attribute) : "";
}

/// Pairs of numbers along the last axis are complex numbers.
void join_parts(Array& array) {
  if (array.along.empty() || array.along.back() != parts_of_complex) return;
  array.along.pop_back(), array.shape.pop_back();
  for (std::size_t i = 0; i + 1 < array.values.size(); i += 2)
    array.amplitudes.emplace_back(array.values[i], array.values[i + 1]);
  array.values.clear();
}

class ResultFile {
 public:
  explicit ResultFile(const fs::path& path)
      : path_(path), file_(path), raw_(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), &H5Fclose) {}

  Content content() {
    Content out{.kind = text_or_none(file_, "/", "kind"), .facts = {}, .arrays = {}};
    if (out.kind.empty() || raw_.get() < 0)
      throw InputError("this is no result of froude", {.file = path_.string()},
                       "give a result of `froude run`, `rao`, `modes`, `stability`, `waves make` or `psd`");
    for (const char* fact : {"froude_version", "scene_file", "phase"})
      if (const std::string text = text_or_none(file_, "/", fact); !text.empty()) out.facts.emplace_back(fact, text);
    for (const char* fact : {"confidence", "degrees_of_freedom"})
      if (file_.has_attribute("/", fact))
        out.facts.emplace_back(fact, fmt::format("{:.6g}", file_.number_attribute("/", fact)));
    if (file_.has("/provenance/scene")) out.facts.emplace_back("scene", file_.text("/provenance/scene"));
    add_group("/", out);
    return out;
  }

 private:
  void add_group(const std::string& group, Content& out) {
    for (const std::string& name : file_.children(group)) {
      const std::string dataset = group + name;
      if (dataset == "/provenance" || name == parts_of_complex) continue;
      if (!file_.children(dataset).empty())
        add_group(dataset + "/", out);
      else
        out.arrays.push_back(array_at(dataset));
    }
  }
  Array array_at(const std::string& dataset) {
    Array out{.name = name_of(dataset),
              .unit = text_or_none(file_, dataset, "units"),
              .meaning = text_or_none(file_, dataset, "long_name"),
              .along = {},
              .shape = {},
              .values = {},
              .amplitudes = {},
              .texts = {}};
    if (out.unit == "1") out.unit.clear();
    if (file_.is_text(dataset)) {
      out.texts = file_.texts(dataset);
      out.shape = {out.texts.size()};
    } else {
      auto numbers = file_.numbers(dataset);
      out.shape = std::move(numbers.shape), out.values = std::move(numbers.values);
    }
    out.along = axes_of(raw_.get(), dataset, out.shape.size(), path_);
    join_parts(out);
    return out;
  }

  fs::path path_;
  Hdf5Reader file_;
  Hdf5Handle raw_;
};

/// The first column is the axis along which the others stand.
Content table_at(const fs::path& path) {
  const auto table = hydro::io::CsvTable::read(path);
  Content out;
  const std::string axis = table.names().front();
  for (const std::string& name : table.names()) {
    Array one{.name = name,
              .unit = "",
              .meaning = "",
              .along = {axis},
              .shape = {table.rows()},
              .values = {},
              .amplitudes = {},
              .texts = {}};
    if (table.is_text(name))
      one.texts = table.text_column(name);
    else
      one.values = table.values(name),
      one.unit = table.has_known_unit(name) ? table.dimension(name).si() : table.unit_text(name);
    out.arrays.push_back(std::move(one));
  }
  return out;
}

/// The values of an array at the samples kept of one of its axes.
template <class T>
void keep_of(std::vector<T>& values, const std::vector<std::size_t>& shape, std::size_t axis,
             const std::vector<std::size_t>& samples) {
  if (values.empty()) return;
  std::size_t before = 1, after = 1;
  for (std::size_t i = 0; i < axis; ++i) before *= shape[i];
  for (std::size_t i = axis + 1; i < shape.size(); ++i) after *= shape[i];
  std::vector<T> out;
  out.reserve(before * samples.size() * after);
  for (std::size_t b = 0; b < before; ++b)
    for (const std::size_t sample : samples)
      for (std::size_t a = 0; a < after; ++a) out.push_back(values[(b * shape[axis] + sample) * after + a]);
  values = std::move(out);
}

}  // namespace

const Array& Content::array(const std::string& name) const {
  const auto at = std::find_if(arrays.begin(), arrays.end(), [&](const Array& a) { return a.name == name; });
  if (at == arrays.end()) throw std::out_of_range("no array " + name);
  return *at;
}

Content read_content(const fs::path& path) {
  const std::string ending = path.extension().string();
  if (ending == ".csv") return table_at(path);
  if (ending == ".h5" || ending == ".nc")
    return hydro::io::read_tried(path, [&] { return ResultFile(path).content(); });
  throw InputError(fmt::format("\"{}\" ends like no result of froude", path.filename().string()),
                   {.file = path.string()}, "give a .h5 of `froude run`, `rao` or another command, or a table in .csv");
}

Content content_of(const Responses& r) {
  const bool several = r.heading.size() > 1;
  const std::vector<std::string> along =
      several ? std::vector<std::string>{"heading", "omega"} : std::vector<std::string>{"omega"};
  const auto axis = [](const char* name, const char* unit, const std::vector<double>& values) {
    return Array{.name = name,
                 .unit = unit,
                 .meaning = "",
                 .along = {name},
                 .shape = {values.size()},
                 .values = values,
                 .amplitudes = {},
                 .texts = {}};
  };
  Content out{.kind = "froude rao",
              .facts = {},
              .arrays = {axis("heading", "rad", r.heading), axis("omega", "rad/s", r.omega)}};
  if (!several) out.arrays.front().along.clear(), out.arrays.front().shape.clear();
  for (const ComplexSignal& s : r.signals)
    out.arrays.push_back(
        {.name = s.name,
         .unit = s.units,
         .meaning = s.long_name,
         .along = along,
         .shape = several ? std::vector{r.heading.size(), r.omega.size()} : std::vector{r.omega.size()},
         .values = {},
         .amplitudes = s.values,
         .texts = {}});
  return out;
}

void keep(Content& content, const std::string& axis, const std::vector<std::size_t>& samples) {
  for (Array& array : content.arrays) {
    const auto at = std::find(array.along.begin(), array.along.end(), axis);
    if (at == array.along.end()) continue;
    const auto number = static_cast<std::size_t>(at - array.along.begin());
    keep_of(array.values, array.shape, number, samples);
    keep_of(array.amplitudes, array.shape, number, samples);
    keep_of(array.texts, array.shape, number, samples);
    array.shape[number] = samples.size();
  }
}

void keep_named(Content& content, const std::function<bool(const std::string&)>& passes) {
  std::set<std::string> needed;
  for (const Array& a : content.arrays)
    if (!a.is_axis() && passes(a.name)) needed.insert(a.along.begin(), a.along.end());
  std::erase_if(content.arrays, [&](const Array& a) { return !passes(a.name) && !needed.contains(a.name); });
}

}  // namespace froude::interchange
