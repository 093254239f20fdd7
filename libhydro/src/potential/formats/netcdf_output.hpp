#pragma once
/// \file  Private: HDF5 that is also netCDF-4, as the writers of Froude's and Capytaine's layouts need it.
#include <numeric>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "hydro/io/hdf5.hpp"

namespace hydro::potential {

/// Writes datasets with their axes tied to dimensions, which is what makes the file netCDF-4.
class NetcdfOutput {
 public:
  explicit NetcdfOutput(io::Hdf5Writer& file) : file_(file) {}

  void axis(const std::string& name, const std::vector<double>& values, const char* units, const char* long_name) {
    file_.write(name, values, {values.size()});
    file_.make_dimension(name);
    describe(name, units, long_name);
  }
  /// Numbers 1 … n.
  void axis(const std::string& name, std::size_t n, const char* long_name) {
    std::vector<double> values(n);
    std::iota(values.begin(), values.end(), 1.0);
    axis(name, values, "1", long_name);
  }
  void table(const std::string& name, const std::vector<double>& values, const std::vector<std::string>& axes,
             const std::vector<std::size_t>& shape, const char* units, const char* long_name) {
    file_.write(name, values, shape);
    tie(name, axes);
    describe(name, units, long_name);
  }
  /// An axis of names.
  void names(const std::string& name, const std::vector<std::string>& values) {
    file_.write_texts(name, values);
    file_.make_dimension(name);
  }
  void texts(const std::string& name, const std::vector<std::string>& values, const std::string& axis) {
    file_.write_texts(name, values);
    tie(name, {axis});
  }
  void scalar(const std::string& name, double value, const char* units, const char* long_name) {
    file_.write_scalar(name, value);
    describe(name, units, long_name);
  }

 private:
  void tie(const std::string& name, const std::vector<std::string>& axes) {
    for (std::size_t i = 0; i < axes.size(); ++i) file_.attach_dimension(name, i, axes[i]);
  }
  void describe(const std::string& name, const char* units, const char* long_name) {
    file_.attribute(name, "units", units);
    file_.attribute(name, "long_name", long_name);
  }

  io::Hdf5Writer& file_;
};

/// Row by row.
inline void append(std::vector<double>& values, const Eigen::MatrixXd& m) {
  for (Eigen::Index i = 0; i < m.rows(); ++i)
    for (Eigen::Index j = 0; j < m.cols(); ++j) values.push_back(m(i, j));
}

}  // namespace hydro::potential
