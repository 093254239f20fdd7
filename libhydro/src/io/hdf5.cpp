#include "hydro/io/hdf5.hpp"

#include <hdf5.h>
#include <hdf5_hl.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <numeric>
#include <utility>

#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"

namespace hydro::io {
namespace {

/// Owns one HDF5 identifier of any class.
class Handle {
 public:
  Handle() = default;
  explicit Handle(hid_t id) : id_(id) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  ~Handle() {
    if (id_ >= 0 && H5Iis_valid(id_) > 0) H5Idec_ref(id_);
  }
  hid_t get() const { return id_; }
  bool good() const { return id_ >= 0; }

 private:
  hid_t id_ = -1;
};

/// HDF5 prints its error stack by itself; ours is the only voice.
void silence() {
  static const bool done = H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr) >= 0;
  (void)done;
}

std::string joined(const std::vector<std::size_t>& shape) { return fmt::format("({})", fmt::join(shape, ", ")); }

std::size_t values_in(const std::vector<std::size_t>& shape) {
  return std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
}

}  // namespace

struct Hdf5Reader::Impl {
  std::filesystem::path path;
  Handle file;

  [[noreturn]] void fail(const std::string& object, const std::string& why) const {
    throw InputError(fmt::format("{}: {}", object, why), {.file = path.string()});
  }
  Handle dataset(const std::string& name) const {
    Handle d(H5Dopen2(file.get(), name.c_str(), H5P_DEFAULT));
    if (!d.good()) fail(name, "there is no such dataset");
    return d;
  }
  /// \throws InputError for more values than a file of this size can hold: deflate packs 1032 bytes into one at best
  void require_held(const std::string& name, const Handle& space, std::size_t value_bytes) const {
    constexpr double best_packing = 1032;
    std::error_code unknown;
    const auto bytes = static_cast<double>(std::filesystem::file_size(path, unknown));
    const auto count = H5Sget_simple_extent_npoints(space.get());
    if (count < 0 || static_cast<double>(count) * static_cast<double>(value_bytes) > best_packing * bytes)
      fail(name, "promises more values than the file can hold; it is damaged");
  }
  Handle attribute(const std::string& object, const std::string& name) const {
    Handle a(H5Aopen_by_name(file.get(), object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT));
    if (!a.good()) fail(object, "there is no attribute \"" + name + "\"");
    return a;
  }
};

Hdf5Reader::Hdf5Reader(const std::filesystem::path& path) : impl_(std::make_unique<Impl>()) {
  silence();
  impl_->path = path;
  if (!std::filesystem::exists(path))
    throw InputError(fmt::format("cannot read \"{}\": no such file", path.string()), {},
                     "check the path; paths in a scene are relative to the scene file");
  impl_->file = Handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT));
  if (!impl_->file.good())
    throw InputError("not an HDF5 file, or cut short", {.file = path.string()}, "write it again or fetch it once more");
}
Hdf5Reader::~Hdf5Reader() = default;

bool Hdf5Reader::has(const std::string& dataset) const {
  // H5Lexists fails, rather than answers no, when a group on the way is missing: ask step by step.
  for (std::size_t slash = dataset.find('/', 1); slash != std::string::npos; slash = dataset.find('/', slash + 1))
    if (H5Lexists(impl_->file.get(), dataset.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) return false;
  return H5Lexists(impl_->file.get(), dataset.c_str(), H5P_DEFAULT) > 0;
}

bool Hdf5Reader::is_text(const std::string& dataset) const {
  const Handle d = impl_->dataset(dataset);
  const Handle type(H5Dget_type(d.get()));
  return H5Tget_class(type.get()) == H5T_STRING;
}

std::vector<std::string> Hdf5Reader::children(const std::string& group) const {
  std::vector<std::string> names;
  if (group != "/" && !has(group)) return names;
  const Handle g(H5Gopen2(impl_->file.get(), group.c_str(), H5P_DEFAULT));
  if (!g.good()) return names;
  const auto collect = [](hid_t, const char* name, const H5L_info_t*, void* out) -> herr_t {
    static_cast<std::vector<std::string>*>(out)->emplace_back(name);
    return 0;
  };
  H5Literate(g.get(), H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names);
  return names;
}

Array Hdf5Reader::numbers(const std::string& dataset) const {
  const Handle d = impl_->dataset(dataset);
  const Handle type(H5Dget_type(d.get()));
  const auto type_class = H5Tget_class(type.get());
  if (type_class != H5T_FLOAT && type_class != H5T_INTEGER) impl_->fail(dataset, "holds no numbers");
  const Handle space(H5Dget_space(d.get()));
  const int rank = H5Sget_simple_extent_ndims(space.get());
  std::vector<hsize_t> extent(static_cast<std::size_t>(std::max(rank, 0)));
  H5Sget_simple_extent_dims(space.get(), extent.data(), nullptr);
  Array out;
  out.shape.assign(extent.begin(), extent.end());
  impl_->require_held(dataset, space, H5Tget_size(type.get()));
  out.values.resize(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space.get())));
  if (!out.values.empty() && H5Dread(d.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, out.values.data()) < 0)
    impl_->fail(dataset, "cannot be read; the file may be cut short");
  return out;
}

double Hdf5Reader::scalar(const std::string& dataset) const {
  const Array a = numbers(dataset);
  if (a.values.size() != 1) impl_->fail(dataset, "has shape " + joined(a.shape) + "; one number is needed");
  return a.values.front();
}

namespace {
/// Reads one string through `read(memory_type, buffer)`, whether it is stored with fixed or variable length.
template <class Read>
std::string read_string(hid_t type, const Read& read) {
  if (H5Tis_variable_str(type) > 0) {
    const Handle memory(H5Tcopy(H5T_C_S1));
    H5Tset_size(memory.get(), H5T_VARIABLE);
    H5Tset_cset(memory.get(), H5Tget_cset(type));
    char* raw = nullptr;
    if (read(memory.get(), &raw) < 0 || raw == nullptr) return {};
    std::string text(raw);
    H5free_memory(raw);
    return text;
  }
  std::string text(H5Tget_size(type), '\0');
  if (read(type, text.data()) < 0) return {};
  text.resize(std::min(text.size(), text.find('\0')));
  return text;
}
}  // namespace

std::string Hdf5Reader::text(const std::string& dataset) const {
  const Handle d = impl_->dataset(dataset);
  const Handle type(H5Dget_type(d.get()));
  if (H5Tget_class(type.get()) != H5T_STRING) impl_->fail(dataset, "holds no text");
  const Handle space(H5Dget_space(d.get()));
  if (H5Sget_simple_extent_npoints(space.get()) != 1) impl_->fail(dataset, "holds several strings; one is needed");
  return read_string(type.get(), [&](hid_t memory, void* buffer) {
    return H5Dread(d.get(), memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, buffer);
  });
}

std::vector<std::string> Hdf5Reader::texts(const std::string& dataset) const {
  const Handle d = impl_->dataset(dataset);
  const Handle type(H5Dget_type(d.get()));
  if (H5Tis_variable_str(type.get()) <= 0) impl_->fail(dataset, "holds no strings of variable length");
  const Handle space(H5Dget_space(d.get()));
  impl_->require_held(dataset, space, 1);
  std::vector<char*> raw(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space.get())), nullptr);
  if (!raw.empty() && H5Dread(d.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, raw.data()) < 0)
    impl_->fail(dataset, "cannot be read; the file may be cut short");
  std::vector<std::string> out;
  for (char* text : raw) {
    out.emplace_back(text == nullptr ? "" : text);
    H5free_memory(text);
  }
  return out;
}

bool Hdf5Reader::has_attribute(const std::string& object, const std::string& name) const {
  return H5Aexists_by_name(impl_->file.get(), object.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

std::string Hdf5Reader::text_attribute(const std::string& object, const std::string& name) const {
  const Handle a = impl_->attribute(object, name);
  const Handle type(H5Aget_type(a.get()));
  if (H5Tget_class(type.get()) != H5T_STRING) impl_->fail(object, "attribute \"" + name + "\" holds no text");
  return read_string(type.get(), [&](hid_t memory, void* buffer) { return H5Aread(a.get(), memory, buffer); });
}

double Hdf5Reader::number_attribute(const std::string& object, const std::string& name) const {
  const Handle a = impl_->attribute(object, name);
  const Handle space(H5Aget_space(a.get()));
  double value = 0;
  if (H5Sget_simple_extent_npoints(space.get()) != 1 || H5Aread(a.get(), H5T_NATIVE_DOUBLE, &value) < 0)
    impl_->fail(object, "attribute \"" + name + "\" is not one number");
  return value;
}

namespace {

/// True if deflating these values pays: dense numbers, whose digits are as good as noise, lose an eighth, in 30 ms a
/// MB.
///
/// Bits a byte of a Huffman code (Shannon's entropy), mean over the eight places of a byte in a number, which shuffling
/// puts side by side; of stretches of neighbours, so that real and imaginary parts both count.
bool packs_well(std::span<const double> values) {
  constexpr std::size_t stretches = 8, each = 256, places = sizeof(double);
  constexpr double pays =
      6;  // bits of 8: what has more keeps over 0.73 of its size in results of the examples, noise 0.88
  std::array<std::array<std::uint32_t, 256>, places> count{};
  std::size_t taken = 0;
  const std::size_t apart = std::max(values.size() / stretches, each);
  for (std::size_t first = 0; first < values.size(); first += apart)
    for (const double value : values.subspan(first, std::min(each, values.size() - first))) {
      const auto bytes = std::bit_cast<std::array<std::uint8_t, places>>(value);
      for (std::size_t place = 0; place < places; ++place) ++count[place][bytes[place]];
      ++taken;
    }
  double bits = 0;
  for (const auto& of_place : count)
    for (const std::uint32_t n : of_place)
      if (n > 0) bits += n * std::log2(static_cast<double>(taken) / n);
  return bits <= pays * static_cast<double>(places * taken);
}

}  // namespace

struct Hdf5Writer::Impl {
  Handle file;
  Packing packing = Packing::deflate;

  /// Building in memory fails only for want of memory or by a mistake of ours, hence no InputError.
  static hid_t check(hid_t id, const char* doing) {
    if (id < 0) throw std::runtime_error(std::string("HDF5 could not ") + doing);
    return id;
  }
  Handle create(const std::string& name, hid_t type, const std::vector<std::size_t>& shape, bool packed = false) {
    const std::vector<hsize_t> extent(shape.begin(), shape.end());
    const Handle space(check(extent.empty() ? H5Screate(H5S_SCALAR)
                                            : H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr),
                             "make a dataspace"));
    const Handle links(H5Pcreate(H5P_LINK_CREATE));
    H5Pset_create_intermediate_group(links.get(), 1);
    // netCDF-4 requires the order of creation to be tracked on groups and their attributes.
    const Handle creation(H5Pcreate(H5P_DATASET_CREATE));
    H5Pset_attr_creation_order(creation.get(), H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
    if (packed) {
      constexpr std::size_t chunk_values = 65536;
      std::vector<hsize_t> chunk(extent);
      for (std::size_t size = values_in(shape); size > chunk_values; size = (size + 1) / 2) {
        hsize_t& longest = *std::max_element(chunk.begin(), chunk.end());
        longest = (longest + 1) / 2;
      }
      H5Pset_chunk(creation.get(), static_cast<int>(chunk.size()), chunk.data());
      H5Pset_shuffle(creation.get());
      H5Pset_deflate(creation.get(), 1);
    }
    return Handle(
        check(H5Dcreate2(file.get(), name.c_str(), type, space.get(), links.get(), creation.get(), H5P_DEFAULT),
              ("create " + name).c_str()));
  }
  /// Room for the closing zero, without which netCDF reads past the end of a text.
  static Handle string_type(std::size_t length) {
    Handle type(H5Tcopy(H5T_C_S1));
    H5Tset_size(type.get(), length + 1);
    H5Tset_cset(type.get(), H5T_CSET_UTF8);
    return type;
  }
};

Hdf5Writer::Hdf5Writer(Packing packing) : impl_(std::make_unique<Impl>()) {
  impl_->packing = packing;
  silence();
  const Handle access(H5Pcreate(H5P_FILE_ACCESS));
  H5Pset_fapl_core(access.get(), std::size_t{1} << 20, /*backing_store=*/0);
  const Handle creation(H5Pcreate(H5P_FILE_CREATE));
  H5Pset_link_creation_order(creation.get(), H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
  H5Pset_attr_creation_order(creation.get(), H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
  // The name is never used on disk, but HDF5 refuses two open files of one name.
  static std::atomic<int> counter = 0;
  const std::string name = fmt::format("froude-in-memory-{}", counter.fetch_add(1));
  impl_->file = Handle(
      Impl::check(H5Fcreate(name.c_str(), H5F_ACC_TRUNC, creation.get(), access.get()), "make a file in memory"));
}
Hdf5Writer::~Hdf5Writer() = default;

void Hdf5Writer::write(const std::string& dataset, std::span<const double> values, std::vector<std::size_t> shape) {
  constexpr std::size_t worth_compressing = 4096;
  ensure(values_in(shape) == values.size(), "Hdf5Writer::write: shape and values disagree");
  const bool packed = impl_->packing == Packing::deflate && values.size() > worth_compressing && packs_well(values);
  const Handle d = impl_->create(dataset, H5T_IEEE_F64LE, shape, packed);
  if (!values.empty())
    Impl::check(H5Dwrite(d.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), "write numbers");
}

void Hdf5Writer::write_scalar(const std::string& dataset, double value) { write(dataset, {&value, 1}, {}); }

void Hdf5Writer::write_text(const std::string& dataset, std::string_view text) {
  const Handle type = Impl::string_type(text.size());
  const Handle d = impl_->create(dataset, type.get(), {});
  const std::string closed(text);
  Impl::check(H5Dwrite(d.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, closed.c_str()), "write text");
}

void Hdf5Writer::write_texts(const std::string& dataset, std::span<const std::string> texts) {
  // netCDF-4 takes strings of variable length for texts, and those of fixed length for arrays of single characters.
  const Handle type(H5Tcopy(H5T_C_S1));
  H5Tset_size(type.get(), H5T_VARIABLE);
  H5Tset_cset(type.get(), H5T_CSET_UTF8);
  const Handle d = impl_->create(dataset, type.get(), {texts.size()});
  std::vector<const char*> raw;
  for (const std::string& text : texts) raw.push_back(text.c_str());
  Impl::check(H5Dwrite(d.get(), type.get(), H5S_ALL, H5S_ALL, H5P_DEFAULT, raw.data()), "write texts");
}

void Hdf5Writer::attribute(const std::string& object, const std::string& name, std::string_view text) {
  const Handle type = Impl::string_type(text.size());
  const Handle space(H5Screate(H5S_SCALAR));
  const Handle a(Impl::check(H5Acreate_by_name(impl_->file.get(), object.c_str(), name.c_str(), type.get(), space.get(),
                                               H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                             "make an attribute"));
  const std::string closed(text);
  Impl::check(H5Awrite(a.get(), type.get(), closed.c_str()), "write an attribute");
}

void Hdf5Writer::attribute(const std::string& object, const std::string& name, double value) {
  const Handle space(H5Screate(H5S_SCALAR));
  const Handle a(Impl::check(H5Acreate_by_name(impl_->file.get(), object.c_str(), name.c_str(), H5T_IEEE_F64LE,
                                               space.get(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                             "make an attribute"));
  Impl::check(H5Awrite(a.get(), H5T_NATIVE_DOUBLE, &value), "write an attribute");
}

void Hdf5Writer::make_dimension(const std::string& dataset) {
  const Handle d(Impl::check(H5Dopen2(impl_->file.get(), dataset.c_str(), H5P_DEFAULT), "open a dimension"));
  const std::string name = dataset.substr(dataset.rfind('/') + 1);
  Impl::check(H5DSset_scale(d.get(), name.c_str()), "make a dimension scale");
}

void Hdf5Writer::attach_dimension(const std::string& dataset, std::size_t axis, const std::string& dimension) {
  const Handle d(Impl::check(H5Dopen2(impl_->file.get(), dataset.c_str(), H5P_DEFAULT), "open a dataset"));
  const Handle s(Impl::check(H5Dopen2(impl_->file.get(), dimension.c_str(), H5P_DEFAULT), "open a dimension"));
  Impl::check(H5DSattach_scale(d.get(), s.get(), static_cast<unsigned>(axis)), "attach a dimension scale");
}

void Hdf5Writer::save(const std::filesystem::path& path) {
  H5Fflush(impl_->file.get(), H5F_SCOPE_GLOBAL);
  const ssize_t size = H5Fget_file_image(impl_->file.get(), nullptr, 0);
  if (size < 0) Impl::check(-1, "measure the file in memory");
  const auto bytes = static_cast<std::size_t>(size);
  const auto image = std::make_unique_for_overwrite<std::byte[]>(bytes);
  if (H5Fget_file_image(impl_->file.get(), image.get(), bytes) < 0) Impl::check(-1, "copy the file in memory");
  impl_->file = Handle();
  write_atomically(path, std::span(image.get(), bytes));
}

}  // namespace hydro::io
