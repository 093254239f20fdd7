#pragma once
/// \file  What passes between groups of cylinders, pair by pair, and the equations that it gives (C11), (C15). Not
/// installed.
#include <Eigen/Core>

#include <functional>
#include <memory>
#include <vector>

#include "array.hpp"
#include "lattice.hpp"

namespace hydro::cylinders {

/// Cylinders in groups, and each group as one scatterer.
struct GroupedCylinders {
  std::vector<std::vector<std::size_t>> members;
  std::vector<std::shared_ptr<const Compound>> compound;  ///< of each group
  std::vector<std::size_t> group_of;                      ///< each cylinder
};

class Between {
 public:
  /// `scale[i]`: radial scales of cylinder i. Orders whose effect on a pair is below `least` are left out there. With a
  /// lattice, far pairs pass over it where that takes fewer multiplications, and system() cannot be had.
  Between(const std::vector<Cylinder>& cylinders, const std::vector<std::size_t>& group_of,
          const std::vector<RadialScales>& scale, const VerticalModes& modes, const Channels& channels, double least,
          const Lattice* lattice);

  bool uses_lattice() const { return far_.has_value(); }
  /// G b: what arrives at each cylinder from those of other groups.
  Amplitudes translated(const Amplitudes& b) const;
  /// 1 − G T, dense.
  Eigen::MatrixXcd system(const GroupedCylinders& groups) const;

 private:
  using Pass = std::function<Translation(std::size_t to, std::size_t from)>;
  struct Link {
    std::size_t to, from;
    std::shared_ptr<const Translation> G;
    std::size_t first;  ///< vertical mode from which on it is passed here: 1 if the wave passes over the lattice
  };
  /// Pairs that stand the same way, cell by cell.
  struct Class {
    std::size_t to_kind, from_kind;
    Eigen::Index row, column;
    std::vector<std::pair<std::size_t, std::size_t>> pairs;  ///< of different groups
    bool within;                                             ///< one of them is a group's own
    std::shared_ptr<const Translation> G;
    Eigen::Index order() const { return G->front().rows() / 2; }
  };
  static std::vector<Class> classes(const Lattice& lattice, const std::vector<std::size_t>& group_of);
  void link_classes(const Lattice& lattice, std::vector<Class> all, const Pass& pass);
  Translation trimmed(Translation G, const std::vector<std::vector<double>>& strongest, double least) const;

  WaveIndex index_;
  Eigen::Index count_, size_;
  std::vector<Link> link_;
  std::optional<LatticePassage> far_;
};

}  // namespace hydro::cylinders
