#pragma once
/// \file  Mooring lines of cases: one uniform line from an anchor to a fairlead in still water, and what is read off
/// it.
#include <memory>
#include <numbers>
#include <vector>

#include "dynamics/line/equilibrium.hpp"
#include "dynamics/line/stepper.hpp"
#include "hydro/waves/kinematics/field.hpp"

namespace froude::validation {

/// A uniform line, its water and its bed.
struct MooringLine {
  double length, mass_per_length, diameter, axial_stiffness, axial_damping;
  double cd, cd_tangential, ca;
  Eigen::Vector3d anchor, fairlead;
  hydro::Water water;
  std::vector<dynamics::line::Bed> bed = {};
  dynamics::line::Wet wet = dynamics::line::Wet::all;
  bool catenary = true;  ///< segments between their nodes (D88)

  double weight() const {  // in water, N/m
    return (mass_per_length - water.density * std::numbers::pi / 4 * diameter * diameter) * water.gravity;
  }

  dynamics::line::Description description(int segments,
                                          std::shared_ptr<const dynamics::line::Path> prescribed = nullptr) const {
    namespace dl = dynamics::line;
    dl::Description d;
    d.nodes.assign(static_cast<std::size_t>(segments) + 1, dl::Node{});
    dl::Segment s = dl::Segment::rod(length / segments, mass_per_length * length / segments);
    s.axial_stiffness = axial_stiffness;
    s.axial_damping = axial_damping;
    s.diameter = diameter;
    s.cd = cd;
    s.cd_tangential = cd_tangential;
    s.ca = ca;
    s.catenary = catenary;
    d.segments.assign(static_cast<std::size_t>(segments), s);
    d.held = {{.node = 0}, {.node = segments, .path = std::move(prescribed)}};
    d.gravity = water.gravity;
    d.bed = bed;
    d.water = {std::make_shared<hydro::waves::HarmonicField>(std::vector<hydro::waves::Harmonic>{}, water,
                                                             hydro::waves::HarmonicField::Options{}),
               wet, true};
    return d;
  }

  dynamics::line::State at_rest(int segments) const {
    namespace dl = dynamics::line;
    const dl::Line line(description(segments));
    dl::State s{.position = dl::Places::Zero(3, segments + 1),
                .velocity = dl::Places::Zero(3, segments + 1),
                .tension = Eigen::VectorXd::Zero(segments)};
    s.position.col(0) = anchor;
    s.position.col(segments) = fairlead;
    return dl::equilibrium(line, dl::hanging_shape(line, s));
  }
};

/// Pull on what holds the fairlead and the anchor, N.
struct EndPulls {
  Eigen::Vector3d fairlead, anchor;
};
inline EndPulls end_pulls(const MooringLine& m, const dynamics::line::State& s) {
  const dynamics::line::Line line(m.description(static_cast<int>(s.tension.size())));
  dynamics::line::Stepper stepper(line, {.scheme = dynamics::line::Scheme::generalised_alpha});
  const auto balance = *stepper.balance(s);
  return {-balance.holding.rightCols<1>(), -balance.holding.leftCols<1>()};
}

/// Pulls at the fairlead against time while it is moved, N.
struct PrescribedRun {
  std::vector<double> time, fairlead, anchor;
  int newton_iterations = 0, halvings = 0;
};
inline PrescribedRun run_prescribed(const MooringLine& m, int segments,
                                    std::shared_ptr<const dynamics::line::Path> prescribed, double from, double until,
                                    double h) {
  namespace dl = dynamics::line;
  const dl::Line line(m.description(segments, std::move(prescribed)));
  dl::State s = m.at_rest(segments);
  s.time = from;
  dl::Stepper stepper(line, {.scheme = dl::Scheme::generalised_alpha});
  stepper.start(s);
  PrescribedRun out;
  for (int i = 1; i <= static_cast<int>(std::lround((until - from) / h)); ++i) {
    const auto report = stepper.step(s, h);
    s.time = from + i * h;
    const auto balance = *stepper.balance(s);
    out.time.push_back(s.time);
    out.fairlead.push_back(balance.holding.rightCols<1>().norm());
    out.anchor.push_back(balance.holding.leftCols<1>().norm());
    out.newton_iterations += report.newton_iterations;
    out.halvings += report.halvings;
  }
  return out;
}

}  // namespace froude::validation
