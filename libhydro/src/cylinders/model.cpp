#include "model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bottom_mounted.hpp"
#include "deep.hpp"
#include "hydro/potential/coefficients.hpp"
#include "tails.hpp"

namespace hydro::cylinders {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using std::numbers::pi;

/// |M − N| of two loads of a cylinder, measured against the diagonal.
double relative_change(const MatrixXcd& M, const MatrixXcd& N) {
  double largest = 0;
  for (Index i = 0; i < M.rows(); ++i)
    for (Index j = 0; j < M.cols(); ++j)
      largest = std::max(largest, std::abs(M(i, j) - N(i, j)) / std::sqrt(std::abs(N(i, i)) * std::abs(N(j, j))));
  return largest;
}

/// Compression may be coarser than what is left out: its errors have random signs, and few add up.
constexpr double precision_of_compression = 10;

/// \throws InputError for more terms of the sums over the depth than are taken
void require_few(int terms, double omega) {
  if (terms > most_terms)
    throw InputError(fmt::format("at {:.6g} rad/s the sums over the depth need more than {} terms", omega, most_terms),
                     {},
                     "the depth is too many times the draught, radius or wavelength: state a smaller depth, or "
                     "leave out this frequency");
}

/// Of sums over the depth; no kind of cylinder takes fewer.
int terms_of_radius(double radius, double depth) { return count_of_terms(300 / radius * depth / pi); }

}  // namespace

namespace {

VerticalModes modes_of(double omega, const Water& water, int evanescent) {
  return std::isinf(omega) ? VerticalModes::at_infinite_frequency(water.depth, evanescent)
                           : VerticalModes::at(omega, water, evanescent);
}

}  // namespace

void require_coupling(const Channels& channels, const char* scatterers, double omega) {
  constexpr double most_left_out = 0.1;
  if (channels.left_out > most_left_out)
    throw InputError(
        fmt::format("at {:.6g} rad/s no digit is certain: waves between the {} need more partial waves than "
                    "there can be",
                    omega, scatterers),
        {},
        fmt::format("the gaps between {0} are too small, or the waves too short, for their radii: move the "
                    "{0} apart or leave out this frequency",
                    scatterers));
}

Resolution Resolution::doubled() const { return {2 * gap_functions, std::pow(threshold, 1.5), equations, orders}; }

Model::Model(const std::vector<CylinderBody>& bodies, const Water& water, const Resolution& resolution,
             const std::vector<double>& omega, Asked asked)
    : water_(water), resolution_(resolution), orders_(resolution.orders) {
  sort_into_types(bodies);
  lattice_ = find_lattice(cylinders_);
  motion_ = MatrixXd::Zero(6 * static_cast<Index>(cylinders_.size()), 6 * static_cast<Index>(bodies.size()));
  Index row = 0, column = 0;
  for (const CylinderBody& body : bodies) {
    for (const Cylinder& c : body.cylinders) {
      const Eigen::Vector3d place(c.centre.x(), c.centre.y(), 0);
      motion_.block<6, 6>(row, column) = potential::rigid_shift(place - body.reference_point);
      row += 6;
    }
    column += 6;
  }
  solved_ = SolvedMotions(cylinders_, type_of_, motion_, [](std::size_t, const Eigen::Matrix2d&) { return true; });
  for (const double w : omega)
    orders_ = std::max(orders_, grouping(modes_that_may_couple(cylinders_, water_, w)).within.highest_order() + 1);
  orders_ = std::max(orders_, grouping(modes_that_may_couple(cylinders_, water_, infinite)).within.highest_order() + 1);
  if (asked == Asked::answers) build_types();
}

void Model::build_types() {
  const double h = water_.depth.metres();
  for (Type& t : types_) {
    if (t.top) {
      t.submerged.emplace(t.radius, *t.top, t.draught, h, resolution_.gap_functions, orders_);
    } else if (t.draught) {
      t.truncated.emplace(t.radius, *t.draught, h, resolution_.gap_functions, orders_);
    }
  }
}

void Model::sort_into_types(const std::vector<CylinderBody>& bodies) {
  for (const CylinderBody& body : bodies)
    for (const Cylinder& c : body.cylinders) {
      cylinders_.push_back(c);
      const auto same = [&](const Type& t) { return t.radius == c.radius && t.draught == c.draught && t.top == c.top; };
      const auto known = std::find_if(types_.begin(), types_.end(), same);
      type_of_.push_back(static_cast<std::size_t>(known - types_.begin()));
      if (known == types_.end()) types_.push_back({c.radius, c.draught, c.top, {}, {}});
    }
}

VerticalModes modes_that_may_couple(const std::vector<Cylinder>& cylinders, const Water& water, double omega) {
  const double h = water.depth.metres();
  // Before anything is as large as the wave is short: orders, of which there are as many as wavelengths in a radius.
  if (std::isfinite(omega)) require_few(count_of_terms(30 * omega * omega / water.gravity * h / pi), omega);
  double smallest = infinite;
  for (const Cylinder& c : cylinders) smallest = std::min(smallest, c.radius);
  require_few(terms_of_radius(smallest, h), omega);
  return modes_of(omega, water, static_cast<int>(std::min(2000.0, 50 * h / smallest)) + 10);
}

int Model::exterior_terms(const Type& t, double K) const {
  if (t.submerged) return t.submerged->exterior_terms(K);
  return t.truncated ? t.truncated->exterior_terms(K) : bottom_mounted_terms(t.radius, water_.depth.metres(), K);
}

VerticalModes Model::modes(double omega) const {
  const double K = omega * omega / water_.gravity;
  int terms = 0;
  for (const Type& t : types_) terms = std::max(terms, exterior_terms(t, K));
  require_few(terms, omega);
  return modes_of(omega, water_, terms);
}

Grouping Model::grouping(const VerticalModes& modes) const {
  return choose_grouping(cylinders_, type_of_, lattice(), modes, resolution_.threshold,
                         static_cast<double>(solved_.columns().size()), expected_steps(modes, cylinders_),
                         resolution_.equations);
}

// The sums over the depth below cylinders that stand above the bed, as seen.
double Model::building_work() const {
  constexpr double term = 1.9e3, pair = 0.07;
  double work = 0;
  for (const Type& t : types_)
    if (const double terms = terms_of_radius(t.radius, water_.depth.metres()); t.draught)
      work += term * terms + pair * terms * terms;
  return work;
}

// Beside the equations between groups: those within, the single cylinders with their sums over the depth (as seen), and
// the waves far away.
ModelCost Model::cost(double omega, double headings) const {
  constexpr double single = 3e6, with_column = 3e7, term = 1e3, number = 16, term_bytes = 400;
  const VerticalModes depth_modes = modes_that_may_couple(cylinders_, water_, omega);
  const Grouping g = grouping(depth_modes);
  const double motions = static_cast<double>(solved_.columns().size()), columns = motions + headings;
  const EquationsCost between = equations_cost(g, cylinders_.size(), lattice(), columns, resolution_.equations);
  const EquationsCost within = compounds_cost(g, cylinders_, type_of_);
  const double size = static_cast<double>(cylinders_.size()) * g.between.count();
  const double far = 2 * (depth_modes.k * distance_across(cylinders_) + 40) * size * motions;
  double cylinders = 0, sums = 0;
  const double functions = resolution_.gap_functions;  // as many times more than usual
  for (const Type& t : types_) {
    const int terms = terms_of_radius(t.radius, water_.depth.metres());
    cylinders += (t.top ? with_column : single) + term * functions * terms;
    sums = std::max(sums, term_bytes * functions * terms);
  }
  int unknowns = g.members.size() > 1 ? static_cast<int>(size) : g.between.count();
  for (const auto& members : g.members)
    if (members.size() > 1) unknowns = std::max(unknowns, g.within.count() * static_cast<int>(members.size()));
  return {unknowns, between.work + within.work + far + cylinders,
          between.bytes + within.bytes + sums + 4 * number * size * columns, between.iterative};
}

Scatterer Model::scatterer(const Type& t, const VerticalModes& modes, const Channels& channels) const {
  const int orders = channels.highest_order() + 1, vertical = channels.vertical();
  if (t.submerged) return t.submerged->at(modes, orders, vertical);
  return t.truncated ? t.truncated->at(modes, orders, vertical) : bottom_mounted(t.radius, modes, orders, vertical);
}

std::vector<Scatterer> Model::scatterers(const VerticalModes& modes, const Channels& channels) const {
  std::vector<Scatterer> all;
  for (const Type& t : types_) all.push_back(scatterer(t, modes, channels));
  return all;
}

Groups Model::groups(const std::vector<Scatterer>& of_type, const VerticalModes& modes,
                     const Grouping& grouping) const {
  std::vector<const Scatterer*> each;
  for (const std::size_t type : type_of_) each.push_back(&of_type[type]);
  return {cylinders_, type_of_, lattice(), each, modes, grouping, precision_of_compression * resolution_.threshold};
}

OneFrequency Model::at(double omega, const std::vector<double>& heading) const {
  const VerticalModes depth_modes = modes(omega);
  const Grouping kept = grouping(depth_modes);
  require_coupling(kept.within, "cylinders", omega);
  const auto of_type = scatterers(depth_modes, kept.within);
  OneFrequency result =
      answers(groups(of_type, depth_modes, kept), {omega, water_, depth_modes, heading, motion_, solved_,
                                                   distance_across(cylinders_), orders_, resolution_.equations});
  result.partial_waves = kept.within.count();
  result.left_out = kept.within.left_out;
  return result;
}

MatrixXd Model::added_mass_at_infinity() const {
  const VerticalModes depth_modes = modes(infinite);
  const Grouping kept = grouping(depth_modes);
  const auto of_type = scatterers(depth_modes, kept.within);
  return cylinders::added_mass_at_infinity(groups(of_type, depth_modes, kept), water_, motion_, solved_,
                                           resolution_.equations);
}

double Model::difference(const Model& other, double omega) const {
  const VerticalModes mine = modes(omega), others = other.modes(omega);
  const Channels wave_only{{1}};
  const auto ours = scatterers(mine, wave_only), theirs = other.scatterers(others, wave_only);
  double largest = 0;
  for (std::size_t t = 0; t < types_.size(); ++t) {
    if (!types_[t].truncated) continue;
    for (std::size_t m = 0; m < 2; ++m)
      largest = std::max(largest, relative_change(ours[t].order[m].L, theirs[t].order[m].L));
  }
  return largest;
}

int choose_gap_functions(const std::vector<CylinderBody>& bodies, const Water& water, const std::vector<double>& omega,
                         double tolerance) {
  constexpr int most = 24;
  int count = 3;
  for (const double w : {omega.front(), omega.back(), infinite}) {
    const Water here = effective_water(bodies, water, w);
    const std::vector<double> list = std::isinf(w) ? std::vector<double>{} : std::vector<double>{w};
    while (true) {
      const Model coarse(bodies, here, {count, 1}, list), fine(bodies, here, {2 * count, 1}, list);
      const double change = coarse.difference(fine, w);
      if (change < tolerance) break;
      if (2 * count > most)
        throw InputError(fmt::format("at {:.6g} rad/s the cylinders can be solved to about {:.1f} digits; {:.1f} are "
                                     "asked for",
                                     w, -std::log10(change), -std::log10(tolerance)),
                         {},
                         "ask for less accuracy, or leave out this frequency: the depth is too many times the "
                         "draught, radius or wavelength");
      count *= 2;
    }
  }
  return count;
}

}  // namespace hydro::cylinders
