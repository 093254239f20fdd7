#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iterator>

#include "hydro/base/error.hpp"
#include "hydro/io/netcdf.hpp"

namespace hydro::io {
namespace {

/// Reads the big-endian header of a classic file and keeps only what the size depends on.
class ClassicHeader {
 public:
  explicit ClassicHeader(const std::filesystem::path& path) : path_(path), in_(path, std::ios::binary) {
    char magic[4] = {};
    in_.read(magic, 4);
    version_ = magic[3];
    if (!in_ || std::string_view(magic, 3) != "CDF" || (version_ != 1 && version_ != 2 && version_ != 5))
      fail("not a classic netCDF file");
  }

  std::size_t promised_size() {
    records_ = count();
    read_dimensions();
    skip_attributes();
    return read_variables();
  }

 private:
  static constexpr std::uint64_t most = std::uint64_t{1} << 40;
  static constexpr std::uint64_t streaming32 = 0xffffffffu, streaming64 = ~std::uint64_t{0};

  [[noreturn]] void fail(const std::string& why) const {
    throw InputError(why, {.file = path_.string()}, "write it again or fetch it once more");
  }
  std::uint64_t integer(int bytes) {
    std::uint64_t value = 0;
    for (int i = 0; i < bytes; ++i) {
      const int c = in_.get();
      if (c == std::char_traits<char>::eof()) fail("the netCDF header is cut short");
      value = value << 8 | static_cast<std::uint64_t>(c);
    }
    return value;
  }
  std::uint64_t tag() { return integer(4); }
  /// Numbers of things are 64 bits wide in CDF-5, 32 before.
  std::uint64_t count() { return integer(version_ == 5 ? 8 : 4); }
  static std::uint64_t padded(std::uint64_t bytes) { return (bytes + 3) / 4 * 4; }
  /// Of two numbers from the file. Nobody has variables of 2^40 bytes; what is damaged has, and overflows.
  std::uint64_t product(std::uint64_t a, std::uint64_t b) const {
    if (a != 0 && b > most / a) fail("the netCDF header is damaged");
    return a * b;
  }
  void skip(std::uint64_t bytes) {
    if (bytes > most) fail("the netCDF header is damaged");
    in_.ignore(static_cast<std::streamsize>(padded(bytes)));
    if (!in_) fail("the netCDF header is cut short");
  }
  std::uint64_t type_size(std::uint64_t type) {
    switch (type) {
      case 1:
      case 2:
      case 7:
        return 1;
      case 3:
      case 8:
        return 2;
      case 4:
      case 5:
      case 9:
        return 4;
      case 6:
      case 10:
      case 11:
        return 8;
      default:
        fail("the netCDF header is damaged: there is no type " + std::to_string(type));
    }
  }
  void read_dimensions() {
    tag();
    for (std::uint64_t n = count(); n > 0; --n) {
      skip(count());  // the name
      dimension_.push_back(count());
    }
  }
  void skip_attributes() {
    tag();
    for (std::uint64_t n = count(); n > 0; --n) {
      skip(count());
      const std::uint64_t size = type_size(tag());
      skip(product(count(), size));
    }
  }
  std::size_t read_variables() {
    std::uint64_t end = 0, record_begin_end = 0, record_size = 0;
    int record_variables = 0;
    tag();
    for (std::uint64_t n = count(); n > 0; --n) {
      skip(count());
      std::uint64_t values = 1;
      bool is_record = false;
      for (std::uint64_t rank = count(), i = 0; i < rank; ++i) {
        const std::uint64_t id = count();
        if (id >= dimension_.size()) fail("the netCDF header is damaged: a dimension is missing");
        if (dimension_[id] == 0 && i == 0)
          is_record = true;  // the one unlimited dimension has length 0 in the header
        else
          values = product(values, dimension_[id]);
      }
      skip_attributes();
      const std::uint64_t bytes = product(values, type_size(tag()));
      count();  // vsize, redundant and saturated for large variables
      const std::uint64_t begin = integer(version_ == 1 ? 4 : 8);
      if (is_record) {
        ++record_variables;
        record_size += padded(bytes);
        record_begin_end = std::max(record_begin_end, begin + bytes);
        last_record_bytes_ = bytes;
      } else {
        end = std::max(end, begin + bytes);
      }
    }
    const bool streaming = records_ == (version_ == 5 ? streaming64 : streaming32);
    if (record_variables > 0 && records_ > 0 && !streaming) {
      if (record_variables == 1) record_size = last_record_bytes_;  // a lone record variable is not padded
      end = std::max(end, record_begin_end + product(records_ - 1, record_size));
    }
    return end;
  }

  std::filesystem::path path_;
  std::ifstream in_;
  int version_ = 0;
  std::uint64_t records_ = 0, last_record_bytes_ = 0;
  std::vector<std::uint64_t> dimension_;
};

}  // namespace

std::size_t classic_netcdf_size(const std::filesystem::path& path) { return ClassicHeader(path).promised_size(); }

}  // namespace hydro::io
