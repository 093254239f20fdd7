#include "hydro/io/netcdf.hpp"

#include <netcdf.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <numeric>
#include <optional>

#include "hydro/base/error.hpp"

namespace hydro::io {

struct NetcdfReader::Impl {
  std::filesystem::path path;
  int file = -1;

  ~Impl() {
    if (file >= 0) nc_close(file);
  }
  [[noreturn]] void fail(const std::string& variable, const std::string& why) const {
    throw InputError(fmt::format("variable \"{}\" {}", variable, why), {.file = path.string()});
  }
  void check(int status, const std::string& variable) const {
    if (status != NC_NOERR) fail(variable, fmt::format("cannot be read: {}", nc_strerror(status)));
  }
  int id(const std::string& variable) const {
    int v = -1;
    if (nc_inq_varid(file, variable.c_str(), &v) != NC_NOERR) fail(variable, "is missing");
    return v;
  }
  /// Axes of values that are about to be read: refused where the file cannot hold so many.
  std::vector<Axis> held_axes(const std::string& variable) const;
  /// The number that stands for values that are missing, if the variable has one of the kind that is read.
  std::optional<double> fill_value(int v) const {
    nc_type t = NC_NAT;
    std::size_t length = 0;
    double fill = 0;
    // An attribute of another length would be written over what stands behind `fill`.
    if (nc_inq_att(file, v, "_FillValue", &t, &length) != NC_NOERR || length != 1 || t == NC_CHAR || t > NC_UINT64 ||
        nc_get_att_double(file, v, "_FillValue", &fill) != NC_NOERR)
      return std::nullopt;
    return fill;
  }
  nc_type type(const std::string& variable) const {
    nc_type t = NC_NAT;
    check(nc_inq_vartype(file, id(variable), &t), variable);
    return t;
  }
  std::vector<Axis> axes(const std::string& variable) const {
    int rank = 0;
    check(nc_inq_varndims(file, id(variable), &rank), variable);
    std::vector<int> dimension(static_cast<std::size_t>(rank));
    check(nc_inq_vardimid(file, id(variable), dimension.data()), variable);
    std::vector<Axis> out;
    for (const int d : dimension) {
      char name[NC_MAX_NAME + 1] = {};
      std::size_t length = 0;
      check(nc_inq_dim(file, d, name, &length), variable);
      out.push_back({name, length});
    }
    return out;
  }
};

namespace {

void require_whole_classic_file(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  char magic[3] = {};
  in.read(magic, 3);
  if (!in || std::string_view(magic, 3) != "CDF") return;
  const std::size_t promised = classic_netcdf_size(path), found = std::filesystem::file_size(path);
  if (found < promised)
    throw InputError(fmt::format("the file is cut short: its header promises {} bytes, it has {}", promised, found),
                     {.file = path.string()}, "write it again or fetch it once more");
}

/// More than a file of so many bytes can hold: deflate packs 1032 bytes into one at best (zlib's technical details).
bool is_beyond(const std::vector<Axis>& axes, std::size_t value_bytes, const std::filesystem::path& path) {
  constexpr double best_packing = 1032;
  double bytes = static_cast<double>(value_bytes);
  for (const Axis& a : axes) bytes *= static_cast<double>(a.length);
  std::error_code unknown;
  return bytes > best_packing * static_cast<double>(std::filesystem::file_size(path, unknown));
}

std::size_t product(const std::vector<Axis>& axes) {
  return std::accumulate(axes.begin(), axes.end(), std::size_t{1},
                         [](std::size_t n, const Axis& a) { return n * a.length; });
}

}  // namespace

std::vector<Axis> NetcdfReader::Impl::held_axes(const std::string& variable) const {
  std::vector<Axis> out = axes(variable);
  std::size_t bytes = 0;
  check(nc_inq_type(file, type(variable), nullptr, &bytes), variable);
  if (is_beyond(out, bytes, path)) fail(variable, "promises more numbers than the file can hold");
  return out;
}

NetcdfReader::NetcdfReader(const std::filesystem::path& path) : impl_(std::make_unique<Impl>()) {
  impl_->path = path;
  if (!std::filesystem::exists(path))
    throw InputError(fmt::format("cannot read \"{}\": no such file", path.string()), {}, "check the path");
  require_whole_classic_file(path);
  if (const int status = nc_open(path.c_str(), NC_NOWRITE, &impl_->file); status != NC_NOERR) {
    impl_->file = -1;
    throw InputError(fmt::format("not a netCDF file, or cut short: {}", nc_strerror(status)), {.file = path.string()},
                     "write it again or fetch it once more");
  }
}
NetcdfReader::~NetcdfReader() = default;

bool NetcdfReader::has(const std::string& variable) const {
  int v = -1;
  return nc_inq_varid(impl_->file, variable.c_str(), &v) == NC_NOERR;
}

bool NetcdfReader::is_text(const std::string& variable) const {
  const nc_type t = impl_->type(variable);
  return t == NC_CHAR || t == NC_STRING;
}

std::vector<std::string> NetcdfReader::axes(const std::string& variable) const {
  std::vector<std::string> names;
  for (const Axis& a : impl_->axes(variable)) names.push_back(a.name);
  if (impl_->type(variable) == NC_CHAR && !names.empty()) names.pop_back();
  return names;
}

LabelledArray NetcdfReader::numbers(const std::string& variable) const {
  if (is_text(variable)) impl_->fail(variable, "holds text; numbers are needed");
  LabelledArray out;
  const auto axes = impl_->held_axes(variable);
  for (const Axis& a : axes) {
    out.axes.push_back(a.name);
    out.shape.push_back(a.length);
  }
  out.values.resize(product(axes));
  const int v = impl_->id(variable);
  if (!out.values.empty()) impl_->check(nc_get_var_double(impl_->file, v, out.values.data()), variable);
  if (const auto fill = impl_->fill_value(v))
    std::replace(out.values.begin(), out.values.end(), *fill, std::numeric_limits<double>::quiet_NaN());
  return out;
}

std::vector<double> NetcdfReader::arranged(const std::string& variable, const std::vector<Axis>& order) const {
  const LabelledArray in = numbers(variable);
  std::vector<std::size_t> stride(in.shape.size(), 1);
  for (std::size_t i = in.shape.size(); i-- > 1;) stride[i - 1] = stride[i] * in.shape[i];
  for (std::size_t i = 0; i < in.axes.size(); ++i) {
    const auto named = [&](const Axis& a) { return a.name == in.axes[i]; };
    if (in.shape[i] != 1 && std::none_of(order.begin(), order.end(), named))
      impl_->fail(variable, fmt::format("runs over {} values of \"{}\"; select one of them and write the file again",
                                        in.shape[i], in.axes[i]));
  }
  std::vector<std::size_t> step;
  for (const Axis& wanted : order) {
    const auto at = std::find(in.axes.begin(), in.axes.end(), wanted.name);
    const std::size_t i = static_cast<std::size_t>(at - in.axes.begin());
    const std::size_t length = at == in.axes.end() ? 1 : in.shape[i];
    if (length != wanted.length)
      impl_->fail(variable,
                  fmt::format("has {} values along \"{}\"; {} are needed", length, wanted.name, wanted.length));
    step.push_back(at == in.axes.end() ? 0 : stride[i]);
  }
  std::vector<double> out(product(order));
  std::vector<std::size_t> index(order.size(), 0);
  for (double& value : out) {
    value = in.values[std::inner_product(index.begin(), index.end(), step.begin(), std::size_t{0})];
    for (std::size_t i = order.size(); i-- > 0;) {  // an odometer: the last axis turns fastest
      if (++index[i] < order[i].length) break;
      index[i] = 0;
    }
  }
  return out;
}

double NetcdfReader::scalar(const std::string& variable) const {
  const auto values = numbers(variable).values;
  if (values.size() != 1) impl_->fail(variable, fmt::format("holds {} numbers; one is needed", values.size()));
  return values.front();
}

std::vector<std::string> NetcdfReader::texts(const std::string& variable) const {
  if (!is_text(variable)) impl_->fail(variable, "holds numbers; text is needed");
  const auto axes = impl_->held_axes(variable);
  const int v = impl_->id(variable);
  std::vector<std::string> out;
  if (product(axes) == 0) return out;
  if (impl_->type(variable) == NC_STRING) {
    std::vector<char*> raw(product(axes), nullptr);
    impl_->check(nc_get_var_string(impl_->file, v, raw.data()), variable);
    for (const char* text : raw) out.emplace_back(text == nullptr ? "" : text);
    nc_free_string(raw.size(), raw.data());
    return out;
  }
  std::string characters(product(axes), '\0');
  impl_->check(nc_get_var_text(impl_->file, v, characters.data()), variable);
  const std::size_t width = axes.empty() ? 1 : axes.back().length;
  for (std::size_t i = 0; i < characters.size(); i += width) {
    std::string text = characters.substr(i, width);
    text.resize(std::min(text.size(), text.find('\0')));
    text.resize(text.find_last_not_of(' ') + 1);
    out.push_back(text);
  }
  return out;
}

std::string NetcdfReader::text_attribute(const std::string& name) const {
  nc_type type = NC_NAT;
  std::size_t length = 0;
  if (nc_inq_att(impl_->file, NC_GLOBAL, name.c_str(), &type, &length) != NC_NOERR) return {};
  if (type == NC_STRING && length == 1) {
    char* raw = nullptr;
    if (nc_get_att_string(impl_->file, NC_GLOBAL, name.c_str(), &raw) != NC_NOERR || raw == nullptr) return {};
    const std::string text(raw);
    nc_free_string(1, &raw);
    return text;
  }
  std::string text(length, '\0');
  if (type != NC_CHAR || nc_get_att_text(impl_->file, NC_GLOBAL, name.c_str(), text.data()) != NC_NOERR) return {};
  return text;
}

}  // namespace hydro::io
