#pragma once
/// \file  Fits that cannot come right: searches begun far away, models that lack what acted, channels exchanged or
///        turned round. Whatever such a fit tells with an interval must be true all the same.
#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "fit/problem/any.hpp"
#include "fit/problem/decay.hpp"
#include "fit/problem/friction.hpp"
#include "fit/problem/morison.hpp"
#include "fit/problem/motion.hpp"
#include "fit/problem/radiation.hpp"
#include "fit/problem/towing.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/random.hpp"
#include "support/coloured_noise.hpp"
#include "support/morison_records.hpp"

namespace froude_test {

/// A flow ẏ = f(y; θ) by Runge–Kutta steps, whose first components are measured. Windows begin where they are told.
class MeasuredFlow final : public fit::Simulation {
 public:
  using Rate = std::function<Eigen::VectorXd(const Eigen::VectorXd& y, const Eigen::VectorXd& theta)>;
  MeasuredFlow(Rate rate, Eigen::VectorXd begin, double step, std::vector<Eigen::Index> windows, Eigen::Index channels)
      : rate_(std::move(rate)),
        begin_{std::move(begin)},
        step_(step),
        windows_(std::move(windows)),
        channels_(channels) {}

  Eigen::Index coordinates(std::size_t window) override { return windows_.size() > 1 ? begin_.at(window).size() : 0; }
  Eigen::MatrixXd follow(std::size_t window, const Eigen::VectorXd& theta, const Eigen::VectorXd& start) override {
    Eigen::VectorXd y = begun(window, start);
    Eigen::MatrixXd out(windows_.at(window), channels_);
    for (Eigen::Index i = 0; i < out.rows(); ++i, y = stepped(y, theta)) out.row(i) = y.head(channels_);
    if (!out.allFinite() || out.cwiseAbs().maxCoeff() > 1e6) throw hydro::NumericsError("the flow ran away");
    return out;
  }
  void hand_on(std::size_t window, const Eigen::VectorXd& theta, const Eigen::VectorXd& start) override {
    Eigen::VectorXd y = begun(window, start);
    for (Eigen::Index i = 0; i < windows_[window]; ++i) y = stepped(y, theta);
    begin_.resize(window + 1);
    begin_.push_back(y);
  }

 private:
  Eigen::VectorXd begun(std::size_t window, const Eigen::VectorXd& start) const {
    Eigen::VectorXd y = begin_.at(window);
    if (start.size() > 0) y += start;
    return y;
  }
  Eigen::VectorXd stepped(Eigen::VectorXd y, const Eigen::VectorXd& theta) const {
    const double h = step_ / 2;
    for (int i = 0; i < 2; ++i) {
      const Eigen::VectorXd a = rate_(y, theta), b = rate_(y + h / 2 * a, theta), c = rate_(y + h / 2 * b, theta),
                            d = rate_(y + h * c, theta);
      y += h / 6 * (a + 2 * b + 2 * c + d);
    }
    return y;
  }
  Rate rate_;
  std::vector<Eigen::VectorXd> begin_;
  double step_;
  std::vector<Eigen::Index> windows_;
  Eigen::Index channels_;
};

/// A problem with what is true of its coefficients.
struct SpoiltFit {
  std::string how;
  fit::AnyProblem problem;
  std::vector<std::pair<std::string, double>> truth;
};

namespace spoilt {

inline constexpr double step = 0.05, noise = 0.01;
inline constexpr Eigen::Index samples = 400;

/// Two bodies side by side on springs with one between them, y = (x₁, x₂, v₁, v₂); θ = (ω₁², ω₂², κ, b, q, c):
/// stiffness each, coupling, linear and quadratic damping of the first, and a stiffness that grows as x².
inline Eigen::VectorXd pair_rate(const Eigen::VectorXd& y, const Eigen::VectorXd& p) {
  Eigen::VectorXd out(4);
  for (int i = 0; i < 2; ++i) {
    const double x = y[i], v = y[2 + i], other = y[1 - i];
    out[i] = v;
    // The second body has three times the mass of the first, and nothing damps it but the first.
    const double coupling = i == 0 ? p[2] : p[2] / 3, damping = i == 0 ? p[3] * v + p[4] * std::abs(v) * v : 0;
    out[2 + i] = -p[i] * (1 + p[5] * x * x) * x - coupling * (x - other) - damping;
  }
  return out;
}

inline Eigen::VectorXd with(std::initializer_list<double> values) {
  return Eigen::Map<const Eigen::VectorXd>(values.begin(), std::ssize(values));
}

inline const Eigen::VectorXd pair_begin = with({1, 0, 0, 0});

/// What was measured of the pair: the truth with white noise.
inline Eigen::MatrixXd pair_record(const Eigen::VectorXd& truth, std::uint64_t seed) {
  Eigen::MatrixXd out = MeasuredFlow(pair_rate, pair_begin, step, {samples}, 2).follow(0, truth, {});
  for (Eigen::Index c = 0; c < 2; ++c) {
    const auto e = ar1_noise(samples, 0, noise, 100 * seed + static_cast<std::uint64_t>(c));
    out.col(c) += Eigen::Map<const Eigen::VectorXd>(e.data(), samples);
  }
  return out;
}

/// Of ω₁², ω₂², κ and b, which begin at `first`; in one run, or in windows.
inline fit::motion::Problem pair_problem(const Eigen::MatrixXd& record, const Eigen::Vector4d& first, int windows = 1) {
  const std::vector<Eigen::Index> lengths(static_cast<std::size_t>(windows), samples / windows);
  fit::motion::Problem out{.records = {{.source = {"pair.csv"}, .time = {}, .windows = lengths.size()}},
                           .simulation = std::make_shared<MeasuredFlow>(
                               [](const Eigen::VectorXd& y, const Eigen::VectorXd& q) {
                                 return pair_rate(y, with({q[0], q[1], q[2], q[3], 0, 0}));
                               },
                               pair_begin, step, lengths, 2),
                           .parameters = {},
                           .signals = {{"x1", "m", noise}, {"x2", "m", noise}},
                           .measured = {},
                           .options = {}};
  for (Eigen::Index j = 0; j < samples; ++j) out.records[0].time.push_back(step * static_cast<double>(j));
  const char* names[] = {"k1", "k2", "coupling", "damping"};
  for (int k = 0; k < 4; ++k) out.parameters.push_back({{.name = names[k], .first = first[k], .lowest = 0}, "1/s"});
  for (int w = 0; w < windows; ++w)
    out.measured.emplace_back(record.middleRows(w * samples / windows, samples / windows));
  return out;
}

inline const Eigen::VectorXd pair_truth = with({4, 7, 0.8, 0.1, 0, 0});
inline std::vector<std::pair<std::string, double>> truth_of(const Eigen::VectorXd& p) {
  return {{"k1", p[0]}, {"k2", p[1]}, {"coupling", p[2]}, {"damping", p[3]}};
}

/// First values off by factors between 1/`most` and `most`.
inline Eigen::Vector4d off(double most, std::uint64_t seed) {
  const hydro::RandomStream random(77, seed);
  Eigen::Vector4d out = pair_truth.head(4);
  for (int k = 0; k < 4; ++k) out[k] *= std::pow(most, 2 * random.uniform(static_cast<std::uint64_t>(k)) - 1);
  return out;
}

inline SpoiltFit pair(const std::string& how, const Eigen::VectorXd& truth, Eigen::MatrixXd record,
                      const Eigen::Vector4d& first, int windows = 1) {
  return {how, pair_problem(record, first, windows), truth_of(truth)};
}

inline std::vector<double> times(std::size_t n, double h) {
  std::vector<double> out(n);
  for (std::size_t j = 0; j < n; ++j) out[j] = h * static_cast<double>(j);
  return out;
}

/// A motion of one degree of freedom let go from `amplitude`, ẍ = f(x, ẋ), sampled every 0.05 s with noise.
inline std::vector<double> let_go(const std::function<double(double, double)>& f, double amplitude, double sigma,
                                  std::uint64_t seed, std::size_t n = 1200) {
  const auto e = ar1_noise(n, 0.3, sigma, 5000 + seed);
  MeasuredFlow flow(
      [&](const Eigen::VectorXd& y, const Eigen::VectorXd&) {
        return with({y[1], f(y[0], y[1])});
      },
      with({amplitude, 0}), step, {static_cast<Eigen::Index>(n)}, 1);
  const Eigen::MatrixXd x = flow.follow(0, {}, {});
  std::vector<double> out(n);
  for (std::size_t j = 0; j < n; ++j) out[j] = x(static_cast<Eigen::Index>(j), 0) + e[j];
  return out;
}

inline SpoiltFit decay(const std::string& how, const std::vector<double>& x, const fit::DampingTerms& terms,
                       std::vector<std::pair<std::string, double>> truth) {
  return {how,
          fit::decay::Problem{.turns = true,
                              .runs = {{.source = {"decay.csv"}, .time = times(x.size(), step), .motion = x}},
                              .body = {},
                              .options = {.prepare = {}, .motion = {.terms = terms}, .memory = {}}},
          std::move(truth)};
}

/// A cylinder moved with an amplitude of 0.4 m, C_D = 1.3, C_A = 1.1; `more` acts beside.
inline SpoiltFit oscillated(const std::string& how, std::uint64_t seed, double sign,
                            const std::function<double(double t, double v)>& more, bool exchanged = false) {
  constexpr std::size_t n = 1200;
  constexpr double omega = 2 * std::numbers::pi / 4, a = 0.4;
  std::vector<double> position = ar1_noise(n, 0, 2e-4, 6000 + seed), force = ar1_noise(n, 0.5, 0.5, 7000 + seed);
  for (std::size_t j = 0; j < n; ++j) {
    const double t = step * static_cast<double>(j), v = a * omega * std::cos(omega * t);
    position[j] += a * std::sin(omega * t);
    force[j] +=
        sign * (fit::morison_force(moved_cylinder, 1.3, 1.1, v, -a * omega * omega * std::sin(omega * t)) + more(t, v));
  }
  if (exchanged) std::swap(position, force);
  fit::RawRun raw{
      .time = times(n, step), .force = {{"F", force, {}}}, .position = position, .velocity = {}, .acceleration = {}};
  return {how,
          fit::morison::Problem{.runs = {{.source = {"tank.csv"}, .cylinder = moved_cylinder, .raw = raw}},
                                .options = {.prepare = {.derivative_bandwidth_hz = 1},
                                            .longest_delay = {},
                                            .force = {},
                                            .coefficients = {"cd", "ca"},
                                            .law = {}}},
          {{"cd", 1.3}, {"ca", 1.1}}};
}

/// A body heaved at 3 rad/s, A = 60 kg, B = 90 N s/m; with force and motion in each other's place where `exchanged`.
inline SpoiltFit heaved(const std::string& how, std::uint64_t seed, double sign, bool exchanged = false) {
  constexpr std::size_t n = 1200;
  constexpr double omega = 3, a = 0.05, mass = 120, added = 60, damping = 90, stiffness = 2500;
  std::vector<double> motion = ar1_noise(n, 0, 1e-4, 8000 + seed), force = ar1_noise(n, 0.5, 0.5, 9000 + seed);
  for (std::size_t j = 0; j < n; ++j) {
    const double t = step * static_cast<double>(j), x = a * std::sin(omega * t), v = a * omega * std::cos(omega * t);
    motion[j] += x;
    force[j] += sign * (((mass + added) * omega * omega - stiffness) * x - damping * v);
  }
  if (exchanged) std::swap(motion, force);
  return {how,
          fit::radiation::Problem{
              .turns = false,
              .runs = {{.source = {"heave.csv"}, .time = times(n, step), .motion = motion, .force = force}},
              .body = {.mass = mass, .stiffness = stiffness},
              .options = {}},
          {{"added_mass", added}, {"damping", damping}}};
}

/// A cylinder towed at four speeds, C_D = 1.2, speed and force in each other's place.
inline SpoiltFit towed(const std::string& how, std::uint64_t seed) {
  const hydro::RandomStream random(78, seed);
  fit::towing::Problem out{.cylinder = held_cylinder, .runs = {}, .records = {}, .options = {}};
  for (int i = 0; i < 4; ++i) {
    const double speed = 0.3 + 0.2 * i, error = 0.05 * random.normal(static_cast<std::uint64_t>(i));
    out.runs.push_back({.speed = 0.5 * 997 * 0.12 * 0.5 * 1.2 * speed * speed + error,
                        .speed_deviation = 0.05,
                        .force = speed,
                        .force_deviation = 0.001});
  }
  return {how, std::move(out), {{"cd", 1.2}}};
}

/// A torque over ten seconds, of a joint that would slip at 3.68 N m to 3 N m.
inline SpoiltFit braked(const std::string& how, std::uint64_t seed, const std::function<double(double)>& torque) {
  constexpr std::size_t n = 200;
  std::vector<double> load = ar1_noise(n, 0.5, 0.01, 9500 + seed);
  for (std::size_t j = 0; j < n; ++j) load[j] += torque(step * static_cast<double>(j));
  return {how,
          fit::friction::Problem{.slides = false,
                                 .runs = {{{"brake.csv"}, times(n, step), load}},
                                 .options = {.ramp_s = 2, .slide_s = 2, .drop_s = step}},
          {{"static", 3.68}, {"dynamic", 3}}};
}

}  // namespace spoilt

/// Twenty ways to spoil a fit, with noise by a seed.
inline std::vector<std::function<SpoiltFit(std::uint64_t seed)>> ways_to_spoil() {
  using namespace spoilt;
  const auto record = [](std::uint64_t seed) { return pair_record(pair_truth, seed); };
  const auto lacking = [](double quadratic, double cubic) { return with({4, 7, 0.8, 0.1, quadratic, cubic}); };
  const auto nothing = [](double, double) { return 0.0; };
  return {
      [=](auto s) { return pair("motions begun off by up to 1.5", pair_truth, record(s), off(1.5, s)); },
      [=](auto s) { return pair("motions begun off by up to 4", pair_truth, record(s), off(4, s)); },
      [=](auto s) { return pair("motions begun off by up to 20", pair_truth, record(s), off(20, s)); },
      [=](auto s) { return pair("windows of a motion begun off by up to 4", pair_truth, record(s), off(4, s), 4); },
      [=](auto s) {
        const Eigen::VectorXd truth = lacking(0.3, 0);
        return pair("motion without its quadratic damping", truth, pair_record(truth, s), off(1.2, s));
      },
      [=](auto s) {
        const Eigen::VectorXd truth = lacking(0, 0.3);
        return pair("motion without its bent springs", truth, pair_record(truth, s), off(1.2, s));
      },
      [=](auto s) {
        const Eigen::VectorXd truth = lacking(0, 0.3);
        return pair("windows of a motion without its bent springs", truth, pair_record(truth, s), off(1.2, s), 4);
      },
      [=](auto s) {
        const Eigen::MatrixXd exchanged = record(s).rowwise().reverse();
        return pair("motion with its channels exchanged", pair_truth, exchanged, off(1.2, s));
      },
      [=](auto s) {
        const Eigen::MatrixXd exchanged = record(s).rowwise().reverse();
        return pair("windows of a motion with its channels exchanged", pair_truth, exchanged, off(1.2, s), 4);
      },
      [=](auto s) {
        Eigen::MatrixXd turned = record(s);
        turned.col(1) *= -1;
        return pair("motion with a channel turned round", pair_truth, turned, off(1.2, s));
      },
      [=](auto s) {
        const auto x = let_go([](double at, double v) { return -at - 0.3 * std::abs(v) * v; }, 0.5, 0.002, s);
        return decay("decay by linear damping where it is quadratic", x, {.linear = true},
                     {{"linear", 0}, {"period", 2 * std::numbers::pi}});
      },
      [=](auto s) {
        const auto x = let_go([](double at, double v) { return -at - 0.05 * v; }, 0.5, 0.002, s);
        return decay("decay by quadratic damping where it is linear", x, {.linear = false, .quadratic = true},
                     {{"quadratic", 0}, {"period", 2 * std::numbers::pi}});
      },
      [=](auto s) {
        const auto x = let_go([](double at, double v) { return -std::sin(at) - 0.05 * v; }, 1.2, 0.002, s);
        return decay("decay by a straight restoring where it is a sine", x, {.linear = true},
                     {{"linear", 0.05}, {"period", 2 * std::numbers::pi}});
      },
      [=](auto s) {
        auto x = let_go([](double at, double v) { return -at - 0.05 * v; }, 0.5, 0.002, s);
        x.insert(x.begin(), 300, 0.5);  // held for 15 s before
        return decay("decay with the time before its release", x, {.linear = true},
                     {{"linear", 0.05}, {"period", 2 * std::numbers::pi}});
      },
      [=](auto s) { return oscillated("force turned round", s, -1, nothing); },
      [=](auto s) { return oscillated("force and motion exchanged", s, 1, nothing, true); },
      [=](auto s) { return braked("torque of a joint that does not slip", s, [](double t) { return 0.8 * t; }); },
      [=](auto s) { return heaved("forced heave with force and motion exchanged", s, 1, true); },
      [=](auto s) { return heaved("forced heave with its force turned round", s, -1); },
      [=](auto s) { return towed("towing with speed and force exchanged", s); },
  };
}

/// A cylinder moved with a linear drag of 8 N s/m beside the quadratic one, which is not fitted: the one has nearly the
/// shape of the other, so that the residuals are those of any experiment, and drag is told too large.
inline SpoiltFit force_without_its_linear_drag(std::uint64_t seed) {
  return spoilt::oscillated("force without its linear drag", seed, 1, [](double, double v) { return -8 * v; });
}

/// How many times half the width of its interval a value that is told lies from the truth, at the most of all that the
/// fit tells; none where it tells none. Fits that throw tell nothing.
inline std::optional<double> wrong_by(const SpoiltFit& spoilt) {
  fit::Report report;
  try {
    report = fit::solve(spoilt.problem);
  } catch (const hydro::InputError&) {
    return {};
  } catch (const hydro::NumericsError&) {
    return {};
  }
  std::optional<double> out;
  for (const auto& [name, truth] : spoilt.truth) {
    const fit::Estimate* e = report.refused ? nullptr : report.find(name);
    if (e == nullptr || !e->coefficient.value) continue;
    const auto [low, high] = e->profile.value_or(e->coefficient.interval);
    const double value = *e->coefficient.value, half = truth < value ? value - low : high - value;
    out = std::max(out.value_or(0), std::abs(truth - value) / half);
  }
  return out;
}

}  // namespace froude_test
