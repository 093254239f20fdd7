#pragma once
/// \file  A thin owner of HDF5 handles: what Froude needs to read and write, nothing more.
///
/// Reading opens the file on disk. Writing builds the file in memory and puts it on disk whole (atomic_file.hpp), so a
/// full disk or a killed program never leaves half a file; memory needed is twice the file's size while saving.
/// Files written with dimension scales are valid netCDF-4: xarray opens them without help.
#include <complex>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hydro::io {

/// A dataset's numbers, row-major (last index fastest), with its shape; a scalar has an empty shape.
struct Array {
  std::vector<std::size_t> shape;
  std::vector<double> values;
};

/// An HDF5 file opened for reading. \throws InputError everywhere with file and path of the dataset.
class Hdf5Reader {
 public:
  explicit Hdf5Reader(const std::filesystem::path& path);  ///< also for a file that is no HDF5, or cut short
  ~Hdf5Reader();
  Hdf5Reader(const Hdf5Reader&) = delete;
  Hdf5Reader& operator=(const Hdf5Reader&) = delete;

  bool has(const std::string& dataset) const;  ///< a dataset or group of this absolute path
  bool is_text(const std::string& dataset) const;
  std::vector<std::string> children(const std::string& group) const;  ///< names in a group, sorted; empty if absent
  Array numbers(const std::string& dataset) const;                    ///< any number type, converted to double
  double scalar(const std::string& dataset) const;                    ///< exactly one number, of any shape
  std::string text(const std::string& dataset) const;                 ///< fixed or variable-length string, one element
  std::vector<std::string> texts(const std::string& dataset) const;   ///< variable-length strings, one axis
  bool has_attribute(const std::string& object, const std::string& name) const;
  std::string text_attribute(const std::string& object, const std::string& name) const;
  double number_attribute(const std::string& object, const std::string& name) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// How large arrays stand in a file: as they are, or shuffled and deflated, without loss.
enum class Packing { none, deflate };

/// An HDF5 file being built in memory; save() puts it on disk.
class Hdf5Writer {
 public:
  explicit Hdf5Writer(Packing packing = Packing::deflate);
  ~Hdf5Writer();
  Hdf5Writer(const Hdf5Writer&) = delete;
  Hdf5Writer& operator=(const Hdf5Writer&) = delete;

  /// Groups on the way are made as needed; `dataset` is an absolute path. Large arrays are chunked and packed.
  void write(const std::string& dataset, std::span<const double> values, std::vector<std::size_t> shape);
  void write_scalar(const std::string& dataset, double value);
  void write_text(const std::string& dataset, std::string_view text);
  void write_texts(const std::string& dataset, std::span<const std::string> texts);  ///< shape (texts.size())
  void attribute(const std::string& object, const std::string& name, std::string_view text);
  void attribute(const std::string& object, const std::string& name, double value);

  /// Makes `dataset` (one-dimensional) the coordinate of a dimension: a netCDF-4 dimension of the same name.
  void make_dimension(const std::string& dataset);
  /// Ties axis `axis` of `dataset` to a dimension made before.
  void attach_dimension(const std::string& dataset, std::size_t axis, const std::string& dimension);

  /// Writes the file atomically and closes it; nothing can be added afterwards. \throws InputError
  void save(const std::filesystem::path& path);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hydro::io
