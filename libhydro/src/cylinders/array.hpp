#pragma once
/// \file  Cylinders close to each other, solved together (C10)-(C12). Not installed.
#include <Eigen/Core>

#include <complex>
#include <vector>

#include "channels.hpp"
#include "scatterer.hpp"

namespace hydro::cylinders {

/// A group of cylinders as others see it; in the partial waves (n, m) and the six motions of each member, about its
/// centre in the still waterplane. Loads are ∬ φ n dS.
struct Compound {
  Eigen::MatrixXcd T;  ///< waves sent out by waves that arrive
  Eigen::MatrixXcd R;  ///< waves sent out by motion
  Eigen::MatrixXcd E;  ///< loads by waves that arrive
  Eigen::MatrixXcd L;  ///< loads by motion
};

/// Where partial waves of many cylinders stand in a column: cylinder by cylinder, by vertical mode, by order.
class WaveIndex {
 public:
  explicit WaveIndex(const Channels& channels);
  Eigen::Index operator()(std::size_t cylinder, int n, int m) const {
    return static_cast<Eigen::Index>(cylinder) * count_ + middle_[static_cast<std::size_t>(n)] + m;
  }

 private:
  std::vector<Eigen::Index> middle_;
  Eigen::Index count_;
};

/// [n][|m|]: the factors s_m, then e^{κ_n a} K_m(κ_n a), of (C4).
using RadialScales = std::vector<std::vector<double>>;
RadialScales radial_scales(const VerticalModes& modes, double radius, const Channels& channels);

/// Graf's theorem (C10): (2M + 1, 2M + 1) for each vertical mode that is not weaker than `least` when it arrives.
using Translation = std::vector<Eigen::MatrixXcd>;
Translation translation(const Cylinder& to, const Cylinder& from, const RadialScales& scale_to,
                        const RadialScales& scale_from, const VerticalModes& modes, const Channels& channels,
                        double least);

class Array {
 public:
  /// `scatterer[i]` belongs to cylinder i; several may be the same object. `precision`: of the compression (C12).
  Array(std::vector<Cylinder> cylinders, const std::vector<const Scatterer*>& scatterer, const VerticalModes& modes,
        Channels channels, double precision);

  /// Complex unknowns that are solved for together.
  Eigen::Index unknowns() const { return first_unknown_.back(); }
  /// The group in the partial waves `outer`, which must be among the channels.
  Compound compound(const Channels& outer) const;

 private:
  /// T ≈ out · in of one azimuthal order.
  struct Factors {
    Eigen::MatrixXcd in;   ///< (rank, vertical modes)
    Eigen::MatrixXcd out;  ///< (vertical modes, rank)
  };
  /// One kind of cylinder.
  struct Kind {
    const Scatterer* scatterer;
    std::vector<Factors> factors;     ///< [|m|]
    std::vector<Eigen::Index> first;  ///< [m + M]: first unknown of order m; then their number
    Eigen::MatrixXcd R, E, L;         ///< (count, 6), (6, count), (6, 6)
    RadialScales scale;
  };

  Kind kind(const Cylinder& cylinder, const Scatterer& scatterer) const;
  void expand(Kind& kind) const;
  Factors compressed(const Eigen::MatrixXcd& T, int azimuthal, double radius) const;
  std::vector<Translation> translations() const;
  Eigen::MatrixXcd translated(const std::vector<Translation>& G, const Eigen::MatrixXcd& b) const;
  Eigen::MatrixXcd received(const Eigen::MatrixXcd& a) const;  ///< in · a
  Eigen::MatrixXcd sent(const Eigen::MatrixXcd& y) const;      ///< out · y
  Eigen::MatrixXcd system(const std::vector<Translation>& G) const;
  Eigen::MatrixXcd moved() const;  ///< R v for all unit motions
  Eigen::MatrixXcd incident(const Eigen::MatrixXcd& from_outside) const;
  Eigen::MatrixXcd scattered(const Eigen::MatrixXcd& a) const;  ///< T a
  const Kind& kind_of(std::size_t cylinder) const { return kinds_[kind_of_[cylinder]]; }
  Eigen::Index size() const { return static_cast<Eigen::Index>(cylinders_.size()) * channels_.count(); }

  std::vector<Cylinder> cylinders_;
  const VerticalModes& modes_;
  Channels channels_;
  WaveIndex index_;
  double precision_, closest_;
  std::vector<Kind> kinds_;
  std::vector<std::size_t> kind_of_;
  std::vector<Eigen::Index> first_unknown_;  // of each cylinder; then their number
};

}  // namespace hydro::cylinders
