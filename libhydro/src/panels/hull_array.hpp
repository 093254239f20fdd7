#pragma once
/// \file  Hulls that stand apart: each kind solved by itself, in the partial waves that pass between them. (G18) to
/// (G20) in docs/theory/panels.md. Not installed.
#include <map>
#include <optional>

#include "cylinders/answers.hpp"
#include "cylinders/drift.hpp"
#include "one_frequency.hpp"

namespace hydro::panels {

/// What a hull sends out when it is struck by regular waves about its axis, the origin, or moved about the origin; its
/// wet part lies within `radius` of the axis. The model is of that hull alone, in water of the modes' depth.
cylinders::Compound compound_of_hull(const Model& model, const cylinders::VerticalModes& modes, double radius,
                                     const cylinders::Channels& channels);

/// Where hulls stand, and which are equal.
struct HullPlaces {
  std::vector<HullBody> kind;  ///< one of each, its axis moved to the origin, which is its reference
  std::vector<cylinders::Cylinder> circle_of_kind;  ///< about the origin
  std::vector<cylinders::Cylinder> circle;          ///< of each body: about its wet part
  std::vector<std::size_t> kind_of;                 ///< each body
  std::vector<cylinders::CircleOwner> owner;        ///< of each circle, one a body
  Eigen::MatrixXd motion;                           ///< (6N, 6N): velocities at the axes when the bodies move
  std::optional<cylinders::Lattice> lattice;        ///< found in the places
};
HullPlaces places_of(const std::vector<HullBody>& bodies);

/// The first two hulls of which the circle of one reaches the other; partial waves then do not serve.
struct TooNear {
  std::size_t first, second;
  double distance, radii;  ///< of the axes; of both circles together, m
};
std::optional<TooNear> too_near(const HullPlaces& places);

/// Which partial waves pass, and in which depth.
struct PartialWaves {
  Water water;  ///< of finite depth
  cylinders::VerticalModes modes;
  cylinders::Channels channels;
};
/// `threshold`: coupling below which partial waves are left out (C11). omega may be +∞.
PartialWaves partial_waves(const HullPlaces& places, const Water& water, double omega, double threshold);
/// The same that serve at all of `omega`, if the depth is finite.
cylinders::Channels channels_of_all(const HullPlaces& places, const Water& water, const std::vector<double>& omega,
                                    double threshold);

class HullArray : public Discretisation {
 public:
  /// `omega`: all that will be asked for, limits apart; `threshold` as partial_waves().
  /// \throws InputError if hulls are too near
  HullArray(const std::vector<HullBody>& bodies, const Water& water, const std::vector<double>& omega, double threshold,
            bool lid);

  std::unique_ptr<const Solver> solver() const override;
  std::unique_ptr<const Discretisation> refined() const override;
  std::unique_ptr<const Discretisation> graded(double highest, int gradings) const override;
  void require_short_panels(double highest) const override;
  Cost cost(const std::vector<double>& omega, std::size_t headings, int threads, int refined) const override;
  bool has_zero() const override { return false; }
  /// In infinite depth the modes of each frequency are those of another depth.
  bool varies_smoothly() const override { return !water_.depth.is_infinite(); }
  double length() const override;
  void describe(SelfCheck& check) const override;
  std::unique_ptr<const Solver> with_more_partial_waves() const override;

 private:
  HullArray(const HullArray& other, std::vector<PanelMesh> mesh);

  std::shared_ptr<const HullPlaces> places_;
  Water water_;
  std::vector<double> omega_;
  double threshold_;
  std::vector<PanelMesh> mesh_;  // of each kind
};

}  // namespace hydro::panels
