#pragma once
/// \file  A thin reader of netCDF files, classic (CDF-1, -2, -5) and HDF5-based: variables by name, axes by name.
///
/// Classic files that end too early are refused here: the library underneath would fill the missing part with zeros.
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace hydro::io {

/// Numbers with the names of their axes, row-major (last axis fastest). A scalar has no axes and one value.
struct LabelledArray {
  std::vector<std::string> axes;
  std::vector<std::size_t> shape;
  std::vector<double> values;
};

/// One axis asked for: its name and the length that it must have.
struct Axis {
  std::string name;
  std::size_t length = 0;
};

/// A netCDF file opened for reading. \throws InputError everywhere, with the file and the variable.
class NetcdfReader {
 public:
  explicit NetcdfReader(const std::filesystem::path& path);  ///< also for a file that is no netCDF, or cut short
  ~NetcdfReader();
  NetcdfReader(const NetcdfReader&) = delete;
  NetcdfReader& operator=(const NetcdfReader&) = delete;

  bool has(const std::string& variable) const;
  bool is_text(const std::string& variable) const;
  /// Names of the axes; the axis of characters of a text variable is not among them.
  std::vector<std::string> axes(const std::string& variable) const;
  /// Any number type as double; values equal to the variable's _FillValue become NaN.
  LabelledArray numbers(const std::string& variable) const;
  /// The values in the order of axes that the caller wants, whatever order the file has. Axes of length one that are
  /// not asked for are dropped; an axis asked for with length one may be absent.
  /// \throws InputError if another axis is left over (the file sweeps a parameter) or a length differs
  std::vector<double> arranged(const std::string& variable, const std::vector<Axis>& order) const;
  double scalar(const std::string& variable) const;  ///< exactly one number, whatever its axes
  /// The strings of a text variable of at most one axis, without padding.
  std::vector<std::string> texts(const std::string& variable) const;
  /// A global text attribute, "" if there is none.
  std::string text_attribute(const std::string& name) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The size in bytes that the header of a classic netCDF file promises. \throws InputError if the header itself is cut
/// short or is not one of CDF-1, CDF-2 and CDF-5. Layout: "The NetCDF Classic Format Specification" (Unidata).
std::size_t classic_netcdf_size(const std::filesystem::path& path);

}  // namespace hydro::io
