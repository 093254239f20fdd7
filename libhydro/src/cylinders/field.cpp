#include "hydro/cylinders/field.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "deep.hpp"
#include "drift.hpp"
#include "hydro/base/error.hpp"
#include "hydro/waves/dispersion.hpp"
#include "model.hpp"
#include "potential/solver_request.hpp"
#include "request.hpp"
#include "surface.hpp"

namespace hydro::cylinders {
namespace {

/// The orders of a wave that cylinders of this radius scatter by more than `least` of it: J_m(ka) < (ka/2)^m/m!.
/// \throws InputError for more than can be had
int orders_scattered(double ka, double least) {
  constexpr int most = 200;  // a radius of 20 wavelengths
  int m = 1;
  while (m <= most && m * std::log(ka / 2) - std::lgamma(m + 1) > std::log(least)) ++m;
  require(m <= most, "a cylinder's radius is {:.4g} wavelengths; its field is told up to about 20",
          ka / (2 * std::numbers::pi));
  return m;
}

/// Functions of small arguments would overflow not far beyond.
constexpr int most_evanescent_orders = 24;

/// Vertical modes that are told at a point so near to a cylinder.
int modes_near(const VerticalModes& modes, const Channels& passing, double nearest) {
  constexpr double weakest = 9;       // e⁻⁹, 1e-4: of a mode that is itself a small part
  constexpr double most_waves = 600;  // of a cylinder: its matrix has the square of it
  const double reach = nearest > 0 ? weakest / nearest * modes.depth / std::numbers::pi : most_waves;
  const double room = most_waves / (2 * passing.highest_order() + 1);
  const int wanted = 1 + static_cast<int>(std::min(std::ceil(reach), room));
  return std::max(passing.vertical(), std::min(wanted, static_cast<int>(modes.kappa.size())));
}

/// `a` in the channels of `to`, which are more.
Amplitudes widened(const Amplitudes& a, const Channels& from, const Channels& to, std::size_t cylinders) {
  const WaveIndex source(from), target(to);
  Amplitudes out = Amplitudes::Zero(to.count() * static_cast<Eigen::Index>(cylinders), a.cols());
  for (std::size_t c = 0; c < cylinders; ++c)
    for (int n = 0; n < from.vertical(); ++n)
      for (int m = -from.order[static_cast<std::size_t>(n)]; m <= from.order[static_cast<std::size_t>(n)]; ++m)
        out.row(target(c, n, m)) = a.row(source(c, n, m));
  return out;
}

/// Whose each cylinder is, body by body.
std::vector<CircleOwner> owners(const std::vector<CylinderBody>& bodies) {
  std::vector<CircleOwner> out;
  for (std::size_t b = 0; b < bodies.size(); ++b)
    out.insert(out.end(), bodies[b].cylinders.size(), {b, bodies[b].reference_point.head<2>()});
  return out;
}

}  // namespace

// Each cylinder is a group by itself, so that it tells, of what arrives, as many of the waves that it sends out as are
// wanted, whatever passes between them.
SentOut Model::sent_out(double omega, double heading, const Eigen::MatrixXd& velocity, double nearest) const {
  const VerticalModes depth_modes = modes(omega);
  Grouping alone = each_alone(
      coupled_channels(cylinders_, depth_modes, resolution_.threshold, [](std::size_t, std::size_t) { return true; }),
      depth_modes, cylinders_);
  alone.between.order[0] = std::max(alone.between.order[0], resolution_.orders - 1);
  alone.within = alone.between;
  require_coupling(alone.within, "cylinders", omega);
  const Eigen::MatrixXd moved = motion_ * velocity;
  const auto of_type = scatterers(depth_modes, alone.within);
  const Arrived there = groups(of_type, depth_modes, alone).arrived({heading}, moved, resolution_.equations);
  Grouping told = alone;
  const int highest = alone.between.highest_order();
  told.between.order.resize(static_cast<std::size_t>(modes_near(depth_modes, alone.between, nearest)));
  // What arrives as a wave is scattered into modes of its own orders, what arrives as a mode into those that pass.
  for (std::size_t n = 1; n < told.between.order.size(); ++n)
    told.between.order[n] = std::max(told.between.order[n], std::min(most_evanescent_orders, told.between.order[0]));
  told.within = told.between;
  const auto near_type = scatterers(depth_modes, told.within);
  const Groups near = groups(near_type, depth_modes, told);
  Amplitudes amplitude = near.sent_out(widened(there.a, alone.between, told.between, cylinders_.size()), moved);
  const std::vector<double> angle = angles_around(cylinders_, heading, depth_modes.k, highest);
  Eigen::MatrixXcd far = near.far_field(amplitude, angle);
  return {depth_modes, told.between, std::move(amplitude), angle, std::move(far)};
}

potential::WaveField wave_field(const std::vector<CylinderBody>& bodies, const Water& water,
                                const potential::FieldQuestion& question, const Options& options) {
  check(bodies, water.depth);
  check_request({question.omega}, {question.heading}, options);
  potential::check(question, bodies.size());
  const std::vector<double> omega{question.omega};
  const Water here = effective_water(bodies, water, question.omega);
  const double threshold = share_of_tolerance * options.tolerance;
  double largest = 0;
  for (const CylinderBody& body : bodies)
    for (const Cylinder& c : body.cylinders) largest = std::max(largest, c.radius);
  const int orders = orders_scattered(waves::wavenumber(question.omega, here) * largest, threshold);
  const Model model(
      bodies, here,
      {choose_gap_functions(bodies, water, omega, options.tolerance), threshold, options.equations, orders + 1}, omega);
  const std::vector<bool> known = outside(model.cylinders(), question.point);
  const double nearest = std::min(nearest_outside(model.cylinders(), question.point),
                                  question.drift ? nearest_counted(model.cylinders()) : infinite);
  const SentOut sent = model.sent_out(question.omega, question.heading, velocities_of(question), nearest);
  const int threads = potential::thread_count(options.threads, known.size());
  const auto of_modes = [&](int from, int to) {
    return potentials_at_surface(model.cylinders(), sent.modes, sent.channels, sent.amplitude, question.point, known,
                                 from, to, threads);
  };
  // b_n Z_n(0) falls as n^{−5/3} at the side of a cylinder, by the corner below: what is beyond N modes is six times
  // what the last fifth of them adds, and less where they decay on the way to a point.
  constexpr double beyond_last_fifth = 6;
  const int vertical = sent.channels.vertical(), most = vertical - (vertical + 4) / 5;
  const Eigen::MatrixXcd first = of_modes(0, most), last_fifth = of_modes(most, vertical);
  potential::WaveField out = field_of(first + last_fifth, sent.modes, water, question, known);
  const potential::WaveField without_last = field_of(first, sent.modes, water, question, known);
  out.far = far_field_of(sent.angle, sent.far, sent.modes, here, question.omega);
  if (question.drift) {
    out.on_bodies = body_drift(model.cylinders(), owners(bodies), sent.modes, sent.channels, sent.amplitude, question,
                               here, threads);
    // A product of two potentials has twice the tolerance.
    out.on_bodies->estimate = 2 * options.tolerance + missed(*out.on_bodies, mean_drift(out.far, question.omega, here));
  }
  out.estimate = options.tolerance + beyond_last_fifth * difference(without_last, out);
  return out;
}

}  // namespace hydro::cylinders
