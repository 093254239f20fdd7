#include "groups.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "hydro/base/dense.hpp"
#include "hydro/base/product.hpp"

namespace hydro::cylinders {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using std::numbers::pi;

/// Sets of cylinders joined by gaps up to `reach`: each takes the smallest number of those it is joined to.
std::vector<std::vector<std::size_t>> joined(const std::vector<Cylinder>& cylinders, double reach) {
  const std::size_t N = cylinders.size();
  std::vector<std::size_t> label(N);
  for (std::size_t i = 0; i < N; ++i) label[i] = i;
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double gap = (cylinders[i].centre - cylinders[j].centre).norm() - cylinders[i].radius - cylinders[j].radius;
      if (gap > reach || label[i] == label[j]) continue;
      const std::size_t kept = std::min(label[i], label[j]), gone = std::max(label[i], label[j]);
      std::replace(label.begin(), label.end(), gone, kept);
    }
  std::map<std::size_t, std::vector<std::size_t>> sets;
  for (std::size_t i = 0; i < N; ++i) sets[label[i]].push_back(i);
  std::vector<std::vector<std::size_t>> members;
  for (auto& [first, set] : sets) members.push_back(std::move(set));
  return members;
}

/// Different gaps between cylinders from the smallest on, at most `most`; they differ by a tenth at least.
std::vector<double> distinct_gaps(const std::vector<Cylinder>& cylinders, std::size_t most) {
  std::vector<double> gaps;
  for (std::size_t i = 0; i < cylinders.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      gaps.push_back((cylinders[i].centre - cylinders[j].centre).norm() - cylinders[i].radius - cylinders[j].radius);
  std::sort(gaps.begin(), gaps.end());
  std::vector<double> distinct;
  for (const double gap : gaps) {
    if (distinct.size() == most) break;
    if (distinct.empty() || gap > 1.1 * distinct.back()) distinct.push_back(1.0001 * gap);
  }
  return distinct;
}

double square(double x) { return x * x; }
double cube(double x) { return x * x * x; }

constexpr double compression = 0.4;  // unknowns left of the partial waves within groups, as seen
constexpr double number = sizeof(Complex);
constexpr int most_steps = 100;

/// Errors of many pairs have random signs.
double weakest_passage(double precision, std::size_t cylinders) {
  return 1e-2 * precision / std::sqrt(static_cast<double>(cylinders));
}

Grouping grouped(const std::vector<Cylinder>& cylinders, const VerticalModes& modes, double threshold, double reach) {
  Grouping g{joined(cylinders, reach), {}, {}, 0, 0};
  std::vector<std::size_t> group(cylinders.size());
  for (std::size_t s = 0; s < g.members.size(); ++s)
    for (const std::size_t c : g.members[s]) group[c] = s;
  g.within =
      coupled_channels(cylinders, modes, threshold, [&](std::size_t i, std::size_t j) { return group[i] == group[j]; });
  g.between =
      coupled_channels(cylinders, modes, threshold, [&](std::size_t i, std::size_t j) { return group[i] != group[j]; });
  g.between.order[0] = std::max(g.between.order[0], g.within.order[0]);  // arriving waves have all orders
  g.within = g.within.united_with(g.between);
  return g;
}

}  // namespace

double distance_across(const std::vector<Cylinder>& cylinders) {
  double largest = 0;
  for (const Cylinder& a : cylinders)
    for (const Cylinder& b : cylinders) largest = std::max(largest, (a.centre - b.centre).norm());
  return largest;
}

double expected_steps(const VerticalModes& modes, const std::vector<Cylinder>& cylinders) {
  return 4 + 0.28 * modes.k * distance_across(cylinders);
}

std::string shape_of(const std::vector<std::size_t>& members, const std::vector<Cylinder>& cylinders,
                     const std::vector<std::size_t>& kind) {
  std::string shape;
  const Eigen::Vector2d origin = cylinders[members.front()].centre;
  for (const std::size_t c : members) {
    const Eigen::Vector2d place = (cylinders[c].centre - origin) / cylinders[c].radius * 1e9;
    shape += fmt::format("{}@{},{};", kind[c], std::llround(place.x()), std::llround(place.y()));
  }
  return shape;
}

EquationsCost equations_cost(const Grouping& grouping, std::size_t cylinders, const Lattice* lattice, double columns,
                             Equations wanted) {
  constexpr double step = 2.5;  // beside the waves that pass, as seen
  const double N = static_cast<double>(cylinders), size = N * grouping.between.count();
  if (grouping.members.size() == 1) return {false, 0, 0};
  const double orders = 0.5 * grouping.between.highest_order();  // for most pairs, as seen
  const double pairwise = square(N * (2 * orders + 1));
  const double entries = lattice != nullptr ? std::min(pairwise, lattice->work(orders)) : pairwise;
  double within = 0;  // entries of T
  for (const auto& members : grouping.members)
    within += square(static_cast<double>(members.size()) * grouping.between.count());
  const double elimination = cube(size) / 3 + square(size) * columns;
  const double steps = grouping.steps, iteration = step * columns * steps * (entries + within + steps * size);
  const bool iterative = wanted == Equations::automatic ? iteration < elimination : wanted == Equations::iterative;
  const double kept = within + 6 * size * columns, one = columns_at_a_time;
  if (iterative) return {true, iteration, number * (kept + entries + (steps + 5) * size * std::min(columns, one))};
  return {false, elimination, number * (kept + pairwise + 2 * square(size))};  // the matrix and its factors
}

EquationsCost compounds_cost(const Grouping& grouping, const std::vector<Cylinder>& cylinders,
                             const std::vector<std::size_t>& kind) {
  EquationsCost sum{false, 0, 0};
  std::set<std::string> known;
  for (const auto& members : grouping.members) {
    if (members.size() == 1 || !known.insert(shape_of(members, cylinders, kind)).second) continue;
    const double size = static_cast<double>(members.size()), all = size * grouping.within.count();
    const double n = compression * all, columns = size * (grouping.between.count() + 6);
    sum.work += cube(n) / 3 + square(n) * columns + 4 * all * grouping.within.vertical() * columns;
    sum.bytes = std::max(sum.bytes, number * (2 * square(n) + 4 * all * columns));
  }
  return sum;
}

Grouping choose_grouping(const std::vector<Cylinder>& cylinders, const std::vector<std::size_t>& kind,
                         const Lattice* lattice, const VerticalModes& modes, double threshold, double columns,
                         double steps, Equations wanted) {
  const auto with_reach = [&](double reach) {
    Grouping g = grouped(cylinders, modes, threshold, reach);
    g.steps = steps;
    g.work =
        equations_cost(g, cylinders.size(), lattice, columns, wanted).work + compounds_cost(g, cylinders, kind).work;
    return g;
  };
  Grouping best = with_reach(0);
  for (const double reach : distinct_gaps(cylinders, 8)) {
    Grouping g = with_reach(reach);
    if (g.work < best.work) best = std::move(g);
  }
  return best;
}

Grouping each_alone(const Channels& channels, const VerticalModes& modes, const std::vector<Cylinder>& cylinders) {
  Grouping out{{}, channels, channels, expected_steps(modes, cylinders), 0};
  for (std::size_t c = 0; c < cylinders.size(); ++c) out.members.push_back({c});
  return out;
}

Groups::Groups(std::vector<Cylinder> cylinders, const Lattice* lattice, const VerticalModes& modes, Grouping grouping,
               double precision)
    : cylinders_(std::move(cylinders)),
      lattice_(lattice),
      modes_(modes),
      grouping_(std::move(grouping)),
      index_(grouping_.between),
      precision_(precision) {
  groups_.members = grouping_.members;
  for (const Cylinder& c : cylinders_) scale_.push_back(radial_scales(modes_, c.radius, grouping_.between));
}

Groups::Groups(std::vector<Cylinder> cylinders, const std::vector<std::size_t>& kind, const Lattice* lattice,
               const std::vector<const Scatterer*>& scatterer, const VerticalModes& modes, Grouping grouping,
               double precision)
    : Groups(std::move(cylinders), lattice, modes, std::move(grouping), precision) {
  groups_.group_of.resize(cylinders_.size());
  std::map<std::string, std::shared_ptr<const Compound>> known;
  for (std::size_t g = 0; g < groups_.members.size(); ++g) {
    std::vector<Cylinder> own;
    std::vector<const Scatterer*> of_own;
    for (const std::size_t c : groups_.members[g]) {
      own.push_back(cylinders_[c]);
      of_own.push_back(scatterer[c]);
      groups_.group_of[c] = g;
    }
    auto& compound = known[shape_of(groups_.members[g], cylinders_, kind)];
    const Channels& channels = own.size() == 1 ? grouping_.between : grouping_.within;
    if (!compound)
      compound =
          std::make_shared<Compound>(Array(own, of_own, modes_, channels, precision).compound(grouping_.between));
    groups_.compound.push_back(compound);
  }
}

Groups::Groups(std::vector<Cylinder> cylinders, const std::vector<std::size_t>& kind, const Lattice* lattice,
               const std::vector<std::shared_ptr<const Compound>>& compound, const VerticalModes& modes,
               Grouping grouping, double precision)
    : Groups(std::move(cylinders), lattice, modes, std::move(grouping), precision) {
  for (std::size_t c = 0; c < cylinders_.size(); ++c) {
    groups_.group_of.push_back(c);
    groups_.compound.push_back(compound[kind[c]]);
  }
}

Between Groups::between(const Lattice* lattice) const {
  const double least = weakest_passage(precision_, cylinders_.size());
  return {cylinders_, groups_.group_of, scale_, modes_, grouping_.between, least, lattice};
}

Amplitudes Groups::apply(MatrixXcd Compound::*part, const Amplitudes& x, Index rows, Index columns) const {
  Amplitudes y = Amplitudes::Zero(rows * static_cast<Index>(cylinders_.size()), x.cols());
  for (std::size_t g = 0; g < groups_.members.size(); ++g) {
    const auto& members = groups_.members[g];
    const Index size = static_cast<Index>(members.size());
    Amplitudes of_group(columns * size, x.cols());
    for (Index i = 0; i < size; ++i)
      of_group.middleRows(i * columns, columns) =
          x.middleRows(static_cast<Index>(members[static_cast<std::size_t>(i)]) * columns, columns);
    Amplitudes result = Amplitudes::Zero(rows * size, x.cols());
    add_product((*groups_.compound[g]).*part, of_group, result);
    for (Index i = 0; i < size; ++i)
      y.middleRows(static_cast<Index>(members[static_cast<std::size_t>(i)]) * rows, rows) =
          result.middleRows(i * rows, rows);
  }
  return y;
}

// A few columns at a time bound the memory of the iteration.
std::optional<Iterated> Groups::iterated(const Between& between, const Amplitudes& arriving) const {
  const Index waves = grouping_.between.count();
  const auto equations = [&](const Amplitudes& a) -> Amplitudes {
    return a - between.translated(apply(&Compound::T, a, waves, waves));
  };
  Iterated all{Amplitudes(arriving.rows(), arriving.cols()), 0};
  for (Index first = 0; first < arriving.cols(); first += columns_at_a_time) {
    const Index count = std::min<Index>(columns_at_a_time, arriving.cols() - first);
    const auto some = iterate(equations, arriving.middleCols(first, count), 1e-3 * precision_, most_steps);
    if (!some) return {};
    all.x.middleCols(first, count) = some->x;
    all.steps = std::max(all.steps, some->steps);
  }
  return all;
}

namespace {

/// Of `columns` in all, the last are these velocities.
Amplitudes moving(const MatrixXd& motion, Index columns) {
  Amplitudes out = Amplitudes::Zero(motion.rows(), columns);
  out.rightCols(motion.cols()) = motion.cast<Complex>();
  return out;
}

}  // namespace

// a = plane waves + G b, b = T a + R v with the matrices of the groups.
Arrived Groups::arrived(const std::vector<double>& heading, const MatrixXd& motion, Equations wanted) const {
  const Index headings = static_cast<Index>(heading.size()), columns = headings + motion.cols();
  const bool iterative =
      equations_cost(grouping_, cylinders_.size(), lattice_, static_cast<double>(columns), wanted).iterative;
  const Between passages = between(iterative ? lattice_ : nullptr);
  Arrived out{passages.translated(apply(&Compound::R, moving(motion, columns), grouping_.between.count(), 6)), 0,
              passages.uses_lattice()};
  out.a.leftCols(headings) += plane_waves(heading);
  if (groups_.members.size() == 1) return out;
  auto found = iterative ? iterated(passages, out.a) : std::nullopt;
  if (!found && wanted == Equations::iterative)
    throw InputError(fmt::format("the iteration between {} groups of cylinders did not converge in {} steps",
                                 groups_.members.size(), most_steps),
                     {}, "ask for direct equations, or leave the choice to the program");
  const auto eliminated = [&](const Between& all) -> Amplitudes {
    return dense::ComplexLu(all.system(groups_)).solve(out.a);
  };
  if (found) {
    out.steps = found->steps;
    out.a = std::move(found->x);
  } else {
    out.a = out.lattice ? eliminated(between(nullptr)) : eliminated(passages);
  }
  return out;
}

Amplitudes Groups::sent_out(const Amplitudes& a, const MatrixXd& motion) const {
  const Index waves = grouping_.between.count();
  return apply(&Compound::T, a, waves, waves) + apply(&Compound::R, moving(motion, a.cols()), waves, 6);
}

// loads = E a + L v.
Response Groups::respond(const std::vector<double>& heading, const MatrixXd& motion, Equations wanted) const {
  const Arrived there = arrived(heading, motion, wanted);
  const Amplitudes& a = there.a;
  return {sent_out(a, motion),
          apply(&Compound::E, a, 6, grouping_.between.count()) + apply(&Compound::L, moving(motion, a.cols()), 6, 6),
          there.steps, there.lattice};
}

// e^{−ikr cos(θ−β)} = Σ_m (−i)^m J_m(kr) e^{im(θ−β)}.
MatrixXcd Groups::plane_waves(const std::vector<double>& heading) const {
  MatrixXcd a = MatrixXcd::Zero(grouping_.between.count() * static_cast<Index>(cylinders_.size()),
                                static_cast<Index>(heading.size()));
  const int M = grouping_.between.highest_order();
  for (std::size_t c = 0; c < cylinders_.size(); ++c)
    for (std::size_t w = 0; w < heading.size(); ++w) {
      const double beta = heading[w];
      const Eigen::Vector2d towards(std::cos(beta), std::sin(beta));
      const Complex phase = std::polar(1.0, -modes_.k * cylinders_[c].centre.dot(towards));
      for (int m = -M; m <= M; ++m) {
        const double sign = m < 0 && m % 2 != 0 ? -1 : 1;  // J_{−m} = (−1)^m J_m
        a(index_(c, 0, m), static_cast<Index>(w)) =
            phase * std::polar(1.0, -m * (beta + pi / 2)) * sign / scale_[c][0][static_cast<std::size_t>(std::abs(m))];
      }
    }
  return a;
}

// H⁽²⁾_m(kr) → i^m √(2/(πkr)) e^{−i(kr − π/4)}, and r is shorter by the way to the cylinder along θ. Some angles at a
// time bound the memory.
MatrixXcd Groups::far_field(const MatrixXcd& sent_out, const std::vector<double>& angle) const {
  constexpr Index angles_at_a_time = 64;
  const Index all = static_cast<Index>(angle.size());
  MatrixXcd f(all, sent_out.cols());
  const int M = grouping_.between.highest_order();
  for (Index first = 0; first < all; first += angles_at_a_time) {
    const Index count = std::min(angles_at_a_time, all - first);
    MatrixXcd reach = MatrixXcd::Zero(count, sent_out.rows());
    for (Index t = 0; t < count; ++t) {
      const double theta = angle[static_cast<std::size_t>(first + t)];
      const Eigen::Vector2d towards(std::cos(theta), std::sin(theta));
      for (std::size_t c = 0; c < cylinders_.size(); ++c) {
        const Complex phase = std::polar(1.0, modes_.k * cylinders_[c].centre.dot(towards));
        for (int m = -M; m <= M; ++m)
          reach(t, index_(c, 0, m)) = phase * std::polar(1.0, m * theta + std::abs(m) * pi / 2) /
                                      scale_[c][0][static_cast<std::size_t>(std::abs(m))];
      }
    }
    f.middleRows(first, count).noalias() = reach * sent_out;
  }
  return f;
}

}  // namespace hydro::cylinders
