#include "answers/second_order_spectra.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "answers/refined_densities.hpp"
#include "answers/sea_directions.hpp"
#include "answers/sea_drag.hpp"
#include "answers/second_order_loads.hpp"
#include "compile/compile.hpp"
#include "compile/members.hpp"
#include "compile/signal_list.hpp"
#include "dynamics/frequency/amplitudes.hpp"
#include "dynamics/frequency/modes.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/parallel.hpp"

namespace froude {
namespace {

using dynamics::frequency::LinearDrag, dynamics::frequency::SmallMotions;
using Pairs = SecondOrderLoads::Pairs;
using Eigen::Index;

/// Signals per newton of load: by the motions alone, since these loads bring no wave with them.
class Transfer {
 public:
  Transfer(const SmallMotions& about, const compile::Prepared& prepared, const std::vector<compile::Signal>& signals,
           std::vector<int> modes, const LinearDrag* drag)
      : about_(about), groups_(prepared.groups), modes_(std::move(modes)), drag_(drag) {
    const dynamics::Still still(about.still, about.linear.multipliers);
    for (const auto& s : signals) {
      variations_.push_back(s.variation(still));
      variations_.back().by_wave = nullptr;
    }
  }

  /// (signals, loads)
  Eigen::MatrixXcd at(double omega) const {
    const auto found = answers_to_loads(about_, groups_, {omega}, modes_, drag_);
    Eigen::MatrixXcd out(static_cast<Index>(variations_.size()), static_cast<Index>(modes_.size()));
    for (Index s = 0; s < out.rows(); ++s)
      for (Index m = 0; m < out.cols(); ++m) {
        const auto load = static_cast<std::size_t>(m);
        out(s, m) = dynamics::amplitude(variations_[static_cast<std::size_t>(s)], found.xi[load].col(0),
                                        found.lambda[load].col(0), omega, 0);
      }
    return out;
  }

 private:
  const SmallMotions& about_;
  const std::vector<dynamics::frequency::PotentialGroup>& groups_;
  std::vector<int> modes_;
  const LinearDrag* drag_;
  std::vector<dynamics::Variation> variations_;
};

/// Takes away what is rounding against the largest of the same unit.
void silence(Eigen::VectorXd& values, const std::vector<compile::Signal>& signals, double rounding) {
  std::map<std::string, double> largest;
  for (std::size_t s = 0; s < signals.size(); ++s)
    largest[signals[s].unit] = std::max(largest[signals[s].unit], std::abs(values[static_cast<Index>(s)]));
  for (std::size_t s = 0; s < signals.size(); ++s)
    if (double& v = values[static_cast<Index>(s)]; std::abs(v) <= rounding * largest[signals[s].unit]) v = 0;
}

/// The highest frequency that all coefficients know, rad/s.
double end_of_data(const compile::Prepared& prepared) {
  double out = std::numeric_limits<double>::infinity();
  for (const auto& g : prepared.groups)
    if (g.radiation) out = std::min(out, g.table.highest());
  return out;
}

/// The highest frequency of responses to these loads. What the coefficients do not reach must be little.
double end_of(const SecondOrderLoads& loads, Pairs pairs, const scene::Scene& scene, const compile::Prepared& prepared,
              std::vector<std::string>& notes) {
  const double end = loads.highest(pairs), data = end_of_data(prepared);
  if (end <= data) return end;
  const double above = loads.share_above(pairs, data);
  const std::string what = fmt::format(
      "{:.2g} % of the pairs of waves have a {} of frequencies above the {:.4g} rad/s at which coefficients end",
      100 * above, pairs == Pairs::sums ? "sum" : "difference", data);
  if (above > scene.accuracy || data <= loads.lowest(pairs))
    throw hydro::InputError(what + ", more than the accuracy asked", scene.rao->place,
                            pairs == Pairs::sums
                                ? "compute added mass and damping up to higher frequencies, or leave `sum` out"
                                : "compute added mass and damping up to higher frequencies");
  notes.push_back(what + ", and no response");
  return data;
}

/// Evenly, and where motions of their own have their frequencies: no resonance stays unseen between two.
std::vector<double> first_frequencies(double low, double high, const SmallMotions& about,
                                      const compile::Prepared& prepared) {
  constexpr int intervals = 32;
  std::vector<double> out;
  for (int i = 0; i <= intervals; ++i) out.push_back(low + (high - low) * i / intervals);
  for (const auto& mode : dynamics::frequency::free_motions(about, prepared.groups).modes)
    if (mode.omega > low && mode.omega < high) out.push_back(mode.omega);
  std::sort(out.begin(), out.end());
  const double same = 1e-9 * (high - low);
  out.erase(std::unique(out.begin(), out.end(), [&](double a, double b) { return b - a < same; }), out.end());
  return out;
}

/// The spectra of all signals through (Q1), of differences or sums.
RefinedDensities spectra_of(const SecondOrderLoads& loads, Pairs pairs, const Transfer& transfer,
                            const std::vector<compile::Signal>& signals, const std::vector<double>& first,
                            double accuracy) {
  return {first, accuracy, [&](const std::vector<double>& omega) {
            std::vector<Column> out(omega.size());
            hydro::in_parallel(omega.size(), hydro::all_processors(), [&](std::size_t w) {
              const Eigen::MatrixXcd H = transfer.at(omega[w]);
              const auto density = [&](const Eigen::MatrixXcd& of_loads) {
                Eigen::VectorXd of = (H * of_loads * H.adjoint()).diagonal().real().cwiseMax(0);
                silence(of, signals, 1e-18);  // squares of what is a billionth
                return of;
              };
              out[w] = {omega[w], density(loads.spectrum(pairs, omega[w], accuracy / 4, density))};
            });
            return out;
          }};
}

/// Everything that a number of sectors leads to.
struct Found {
  Eigen::VectorXd offset;
  std::optional<RefinedDensities> slow, sum;

  Eigen::VectorXd squares() const {
    Eigen::VectorXd out = offset.cwiseAbs2();
    for (const auto* part : {&slow, &sum})
      if (*part) {
        const Eigen::VectorXd before = out, more = (*part)->moment(0);
        out.resize(before.size() + more.size());
        out << before, more;
      }
    return out;
  }
  double error() const { return std::max(slow ? slow->error() : 0, sum ? sum->error() : 0) + error_of_drag; }
  /// Of the last rows of both.
  Eigen::VectorXd last_variances(Index count) const {
    Eigen::VectorXd out = Eigen::VectorXd::Zero(count);
    for (const auto* part : {&slow, &sum})
      if (*part) out += (*part)->moment(0).tail(count);
    return out;
  }
  double error_of_drag = 0;  ///< relative, of the coefficients
};

/// A scene made ready, and what of it does not depend on the sectors.
struct Question {
  const scene::Scene& scene;
  const compile::Prepared& prepared;
  const SmallMotions& about;
  const std::vector<compile::Signal>& signals;
  const std::vector<double>& first_order;  ///< frequencies, rad/s
};

/// The answers to these loads, with this drag or none.
Found answers_to(const SecondOrderLoads& loads, const Question& q, const LinearDrag* drag,
                 std::vector<std::string>& notes) {
  const Transfer transfer(q.about, q.prepared, q.signals, loads.modes(), drag);
  const double accuracy = q.scene.accuracy;
  Found out;
  out.offset = transfer.at(0).real() * loads.mean(accuracy / 4);
  silence(out.offset, q.signals, 1e-9);
  for (auto [pairs, spectra] : {std::pair{Pairs::differences, &out.slow}, std::pair{Pairs::sums, &out.sum}})
    if (loads.has(pairs)) {
      const double end = end_of(loads, pairs, q.scene, q.prepared, notes);
      *spectra = spectra_of(loads, pairs, transfer, q.signals,
                            first_frequencies(loads.lowest(pairs), end, q.about, q.prepared), accuracy);
    }
  return out;
}

/// Drag on members, linear in a sea and what its second-order loads make of motions. (D151)
class DragOfBoth {
 public:
  DragOfBoth(const Question& q, int sectors)
      : q_(q), scene_(q.scene), pieces_(compile::drag_of_responses(q.scene, q.prepared.bodies).pieces) {
    scene_.rao->headings.clear();
    for (const auto& waves : random_sea(q.scene).systems)
      systems_.push_back(system_of(waves, sectors, scene_.rao->headings));
  }

  /// Slower motions have less drag, which makes them faster: turns come nearer by half at least.
  Found settled(const SecondOrderLoads& loads, std::vector<std::string>& notes) const {
    constexpr int most = 40;
    const double enough = q_.scene.accuracy / 10;  // of the largest coefficient, on which deviations depend by a root
    std::vector<compile::Signal> signals = q_.signals;
    for (const dynamics::Variation& v : velocities_across(q_.about, pieces_))
      signals.push_back(
          {.name = {}, .unit = "m/s of drag", .meaning = {}, .value = {}, .variation = [v](const auto&) { return v; }});
    const Question with_velocities{q_.scene, q_.prepared, q_.about, signals, q_.first_order};
    const Eigen::VectorXd by_waves = coefficients({}, {});
    Eigen::VectorXd drag = by_waves;
    double change = 0;
    for (int turn = 1; turn <= most; ++turn) {
      std::vector<std::string> told;
      const LinearDrag linear = still_water_drag(drag, q_.about, pieces_);
      Found found = answers_to(loads, with_velocities, &linear, told);
      const auto slow = covariances_across(q_.about, pieces_, found.last_variances(3 * std::ssize(pieces_)));
      const Eigen::VectorXd next = coefficients(drag, slow);
      change = (next - drag).lpNorm<Eigen::Infinity>() / next.lpNorm<Eigen::Infinity>();
      if (change <= enough) {
        notes.insert(notes.end(), told.begin(), told.end());
        notes.push_back(told_of(by_waves.sum(), drag.sum(), turn));
        found.error_of_drag = change;
        return found;
      }
      drag = next;
    }
    throw hydro::NumericsError(fmt::format(
        "drag in slow drift did not settle in {} turns: the last would have changed it by {:.2g} of its largest", most,
        change));
  }

 private:
  Eigen::VectorXd coefficients(const Eigen::VectorXd& start, const std::vector<Eigen::Matrix3d>& slow) const {
    return sea_drag(scene_, q_.prepared, systems_, q_.first_order, start, slow).coefficient;
  }
  static std::string told_of(double by_waves, double all, int turns) {
    return fmt::format(
        "drag on members damps slow drift: {:.4g} N s/m in all, linear for the velocities of waves, slow drift and "
        "sums together, {:.4g} N s/m for those of waves alone; settled in {} turns; swings of slow drift are larger "
        "than Gaussian ones, so "
        "that its deviation comes out some hundredths too high",
        all, by_waves, turns);
  }

  const Question& q_;
  scene::Scene scene_;  // asked for the headings of the sea
  std::vector<dynamics::DragPiece> pieces_;
  std::vector<System> systems_;
};

Found found_with(const Question& q, int sectors, std::vector<std::string>& notes) {
  const SecondOrderLoads loads(q.scene, q.prepared.bodies, rays_of(random_sea(q.scene), sectors), notes);
  if (!compile::any_drag(q.scene)) return answers_to(loads, q, nullptr, notes);
  return DragOfBoth(q, sectors).settled(loads, notes);
}

/// Sectors of a spread sea are doubled until nothing changes by half of the accuracy; `error` is told what does.
Found found_of(const Question& q, double& error, std::vector<std::string>& notes) {
  constexpr int most = 72;
  Found found = found_with(q, 9, notes);
  if (!has_spreading(random_sea(q.scene))) return found;
  for (int sectors = 18;; sectors *= 2) {
    std::vector<std::string> told_already;
    Found finer = found_with(q, sectors, told_already);
    error = largest_change(found.squares(), finer.squares());
    found = std::move(finer);
    if (error < q.scene.accuracy / 2) return found;
    if (sectors == most)
      throw hydro::NumericsError(
          fmt::format("second-order responses of a sea with spreading change by {:.2g} from {} headings to {}, more "
                      "than the accuracy asked, {:g}",
                      error, most / 2, most, q.scene.accuracy));
  }
}

/// What answers of this kind suppose.
void tell_limits(const compile::Prepared& prepared, std::vector<std::string>& notes) {
  for (const auto& g : prepared.groups)
    if (g.radiation)
      notes.push_back(fmt::format(
          "below {:.4g} rad/s, where coefficients begin, slow drift has {}, and damping straight to none",
          g.table.lowest(), g.table.coefficients().A_zero ? "added mass straight to A(0)" : "their first added mass"));
  notes.emplace_back(
      "offset and slow drift go through stiffness and linear damping about rest: wave-drift damping and moorings that "
      "stiffen have no part");
  notes.emplace_back(
      "responses of second order are not Gaussian, and their sum with the first is not: largest values and damage are "
      "of the first order alone; for those of all, step a run and ask `froude extremes`");
}

}  // namespace

std::optional<SecondOrderResponses> second_order_responses(const scene::Scene& scene,
                                                           const std::shared_ptr<compile::Kept>& kept,
                                                           const std::vector<double>& first_order) {
  if (std::none_of(scene.bodies.begin(), scene.bodies.end(), [](const auto& b) { return b.second_order; }))
    return std::nullopt;
  SecondOrderResponses out;
  const compile::Prepared prepared = compile::prepare(scene, kept);
  const dynamics::Model model = compile::frequency_model(prepared, scene.rao->about);
  std::vector<std::string> told_already;  // with the first order
  const SmallMotions about = compile::small_motions(scene, model, scene.rao->about, told_already);
  const auto signals = compile::chosen_responses(compile::signal_list(scene, prepared, model), scene.rao->of,
                                                 scene.rao->of_places, told_already);
  const std::vector<double>& resolved = first_order.empty() ? scene.rao->omega : first_order;
  const Found found = found_of({scene, prepared, about, signals, resolved}, out.error, out.notes);
  out.error += found.error();
  for (std::size_t s = 0; s < signals.size(); ++s) {
    const auto row = static_cast<Index>(s);
    out.signals.push_back({signals[s].name, signals[s].unit, found.offset[row],
                           found.slow ? found.slow->spectrum(row) : hydro::signal::SpectrumPerHz{},
                           found.sum ? found.sum->spectrum(row) : hydro::signal::SpectrumPerHz{}});
  }
  tell_limits(prepared, out.notes);
  return out;
}

}  // namespace froude
