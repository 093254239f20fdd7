#include "fit/experiment.hpp"

#include <fmt/ranges.h>
#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/random.hpp"
#include "planned.hpp"

namespace fit {
namespace {

constexpr double whole_turn = 2 * std::numbers::pi;

/// A number as a product of powers: ln value = ln factor + powers · (ln D, ln A, ln T).
struct Product {
  const char* name;
  std::optional<double> OscillationNumbers::*member;
  double factor;
  Eigen::Vector3d powers;
};

std::array<Product, 7> products(double viscosity) {  // (F98)
  using N = OscillationNumbers;
  return {{{"diameter", &N::diameter, 1, {1, 0, 0}},
           {"amplitude", &N::amplitude, 1, {0, 1, 0}},
           {"period", &N::period, 1, {0, 0, 1}},
           {"speed", &N::speed, whole_turn, {0, 1, -1}},
           {"KC", &N::kc, whole_turn, {-1, 1, 0}},
           {"Re", &N::re, whole_turn / viscosity, {1, 1, -1}},
           {"beta", &N::beta, 1 / viscosity, {2, 0, -1}}}};
}

/// The products that `rows` do not tell, by name.
std::string left_open(const Eigen::MatrixXd& rows, const std::array<Product, 7>& all, Eigen::Index rank) {
  std::vector<std::string> names;
  for (const Product& p : all) {
    Eigen::MatrixXd more(rows.rows() + 1, 3);
    more << rows, p.powers.transpose();
    if (hydro::dense::PivotedQr(more).rank() > rank) names.push_back(p.name);
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

/// A steady oscillation as it would be measured.
ForceRecord made(const PlannedOscillation& plan, int cycles, const hydro::RandomStream& random) {
  ForceRecord out;
  const auto n = static_cast<std::size_t>(std::llround(cycles * plan.period / plan.step));
  const double omega = whole_turn / plan.period;
  const std::vector<double> noise = noise_with_memory(n, plan.noise, plan.memory, plan.step, random);
  for (std::size_t i = 0; i < n; ++i) {
    const double t = plan.step * static_cast<double>(i), v = plan.amplitude * omega * std::cos(omega * t),
                 a = -plan.amplitude * omega * omega * std::sin(omega * t);
    out.time.push_back(t);
    out.velocity.push_back(v);
    out.acceleration.push_back(a);
    out.force.push_back(morison_force(plan.cylinder, plan.cd, plan.inertia, v, a) + noise[i]);
  }
  return out;
}

void check(const PlannedOscillation& plan) {
  hydro::require(plan.amplitude > 0 && plan.period > 0, "amplitude and period must be positive, got {} m and {} s",
                 plan.amplitude, plan.period);
  check_noise(plan.noise, plan.memory);
  hydro::require(plan.step > 0 && plan.step < plan.period / 8,
                 "a period of {} s needs eight samples at least, and they are {} s apart", plan.period, plan.step);
}

double width_of(const PlannedLength& length, Wanted wanted) {
  return wanted == Wanted::cd ? length.cd_half_width : length.inertia_half_width;
}

}  // namespace

OscillationNumbers complete(const OscillationNumbers& given, double viscosity) {  // (F98)
  hydro::require(viscosity > 0 && std::isfinite(viscosity), "the viscosity must be positive, got {} m²/s", viscosity);
  const auto all = products(viscosity);
  std::vector<const Product*> known;
  for (const Product& p : all)
    if (const auto& value = given.*p.member) {
      hydro::require(*value > 0 && std::isfinite(*value), "{} must be positive, got {}", p.name, *value);
      known.push_back(&p);
    }
  Eigen::MatrixXd rows(std::ssize(known), 3);
  Eigen::VectorXd logs(std::ssize(known));
  for (std::size_t i = 0; i < known.size(); ++i) {
    rows.row(static_cast<Eigen::Index>(i)) = known[i]->powers.transpose();
    logs[static_cast<Eigen::Index>(i)] = std::log(*(given.*known[i]->member) / known[i]->factor);
  }
  const Eigen::Index rank = known.empty() ? 0 : hydro::dense::PivotedQr(rows).rank();
  if (rank < 3)
    throw hydro::InputError(fmt::format("what is given leaves open: {}",
                                        known.empty() ? std::string("everything") : left_open(rows, all, rank)),
                            {}, "give one of these as well");
  const Eigen::Vector3d x = hydro::dense::PivotedQr(rows).solve(logs);
  for (std::size_t i = 0; i < known.size(); ++i) {
    const double value = known[i]->factor * std::exp(known[i]->powers.dot(x)), told = *(given.*known[i]->member);
    if (std::abs(value / told - 1) > 1e-3)
      throw hydro::InputError(fmt::format("what is given contradicts itself: {} is {:.5g}, and with all the others it "
                                          "would be nearer to {:.5g}",
                                          known[i]->name, told, value),
                              {}, "leave one of them out: three tell all");
  }
  OscillationNumbers out;
  for (const Product& p : all) out.*p.member = p.factor * std::exp(p.powers.dot(x));
  return out;
}

PlannedLength told_by(const PlannedOscillation& plan, int cycles, int seeds, std::uint64_t seed) {  // (F99)
  check(plan);
  hydro::require(cycles >= 2, "a planned record needs two cycles at least, got {}", cycles);
  hydro::require(seeds >= 1, "a plan needs one made record at least, got {}", seeds);
  std::vector<double> cd, inertia;
  PlannedLength out{.cycles = cycles, .cd_half_width = 0, .inertia_half_width = 0, .cd_held = 0, .inertia_held = 0};
  for (int s = 0; s < seeds; ++s) {
    const MorisonFit fit = fit_morison(plan.cylinder, made(plan, cycles, {seed, static_cast<std::uint64_t>(s)}),
                                       {.confidence = plan.confidence});
    const Interval &c = fit.cd.interval, &i = fit.inertia.interval;
    cd.push_back((c.high - c.low) / 2);
    inertia.push_back((i.high - i.low) / 2);
    out.cd_held += c.low < plan.cd && plan.cd < c.high ? 1.0 / seeds : 0;
    out.inertia_held += i.low < plan.inertia && plan.inertia < i.high ? 1.0 / seeds : 0;
  }
  out.cd_half_width = median_of_widths(cd);
  out.inertia_half_width = median_of_widths(inertia);
  if (!std::isfinite(out.cd_half_width) || !std::isfinite(out.inertia_half_width))
    throw hydro::NumericsError(
        "fits of made records give no interval: noise, mass, length and density are out of all proportion");
  return out;
}

std::vector<PlannedLength> lengths_for(const PlannedOscillation& plan, Wanted wanted, double width, int most,
                                       int seeds) {  // (F99)
  hydro::require(width > 0 && std::isfinite(width), "the half width of an interval must be positive, got {}", width);
  hydro::require(most >= 3, "a length is looked for from three cycles on, and {} are the most", most);
  return lengths_until(
      3, most, [&](int cycles) { return told_by(plan, cycles, seeds); },
      [&](const PlannedLength& l) { return width_of(l, wanted) <= width; },
      [](const PlannedLength& l) { return l.cycles; });
}

namespace {

void require_positive(const char* what, double value) {
  hydro::require(std::isfinite(value) && value > 0, "{} must be positive, got {}", what, value);
}

}  // namespace

double drag_over_inertia(double cd, double kc, double inertia) {
  require_positive("the drag coefficient", cd);
  require_positive("KC", kc);
  require_positive("the inertia coefficient", inertia);
  return cd * kc / (std::numbers::pi * std::numbers::pi * inertia);
}

// (F109)
LoadSizes load_sizes(const Cylinder& c, double speed, double period, double cd, double inertia) {
  require_positive("the diameter", c.diameter);
  require_positive("the length", c.length);
  require_positive("the density", c.density);
  require_positive("the period", period);
  require_positive("the speed", speed);
  require_positive("the drag coefficient", cd);
  require_positive("the inertia coefficient", inertia);
  const double acceleration = whole_turn / period * speed;
  LoadSizes out{.drag = c.density / 2 * cd * c.diameter * c.length * speed * speed,
                .inertia = (c.density * inertia * c.volume() + c.mass_beyond_load_cells) * acceleration,
                .largest = 0};
  // D sin² + I |cos| is largest where cos = I/2D, or at the turn.
  out.largest = out.inertia < 2 * out.drag ? out.drag + out.inertia * out.inertia / (4 * out.drag) : out.inertia;
  return out;
}

double shedding_frequency_hz(double strouhal, double speed, double diameter) {
  require_positive("the Strouhal number", strouhal);
  require_positive("the speed", speed);
  require_positive("the diameter", diameter);
  return strouhal * speed / diameter;
}

double steady_tow_s(double length, double speed, double acceleration) {
  hydro::require(length > 0 && speed > 0 && acceleration > 0,
                 "length, speed and acceleration must be positive, got {} m, {} m/s, {} m/s²", length, speed,
                 acceleration);
  return std::max(0.0, length / speed - speed / acceleration);
}

}  // namespace fit
