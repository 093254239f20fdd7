#pragma once
/// \file  What passes between groups of cylinders, pair by pair, and the equations that it gives (C11), (C15). Not
/// installed.
#include <Eigen/Core>

#include <functional>
#include <memory>
#include <vector>

#include "array.hpp"

namespace hydro::cylinders {

/// Amplitudes of partial waves, one column for each thing that arrives or moves; a row is contiguous.
using Amplitudes = Eigen::Matrix<std::complex<double>, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Cylinders in groups, and each group as one scatterer.
struct GroupedCylinders {
  std::vector<std::vector<std::size_t>> members;
  std::vector<std::shared_ptr<const Compound>> compound;  ///< of each group
  std::vector<std::size_t> group_of;                      ///< each cylinder
};

class Between {
 public:
  /// `scale[i]`: radial scales of cylinder i. Orders whose effect on a pair is below `least` are left out there.
  Between(const std::vector<Cylinder>& cylinders, const std::vector<std::size_t>& group_of,
          const std::vector<RadialScales>& scale, const VerticalModes& modes, const Channels& channels, double least);

  Eigen::Index size() const { return size_; }
  /// G b: what arrives at each cylinder from those of other groups.
  Amplitudes translated(const Amplitudes& b) const;
  /// 1 − G T, dense.
  Eigen::MatrixXcd system(const GroupedCylinders& groups) const;

 private:
  struct Link {
    std::size_t to, from;
    Translation G;
  };
  Translation trimmed(Translation G, const std::vector<std::vector<double>>& strongest, double least) const;

  WaveIndex index_;
  Eigen::Index count_, size_;
  std::vector<Link> link_;
};

}  // namespace hydro::cylinders
