// Several records with the same parameters: what is shared, what is each record's own, and what nothing is known of.
#include "fit/several_records.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "fit/problem/motion.hpp"
#include "hydro/base/error.hpp"
#include "support/coloured_noise.hpp"

namespace several_records_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

/// x = A e^{−ct} cos ωt with the parameters c, ω and A, at the times that a record has; or in windows of equal length
/// whose start is the amplitude there, beside the one that was handed on.
class Ringing final : public fit::Simulation {
 public:
  Ringing(Eigen::VectorXd time, double amplitude, std::size_t windows = 1)
      : time_(std::move(time)), begin_{amplitude}, windows_(windows) {}
  Eigen::Index coordinates(std::size_t) override { return windows_ > 1 ? 1 : 0; }
  Eigen::MatrixXd follow(std::size_t window, const Eigen::VectorXd& p, const Eigen::VectorXd& start) override {
    ++followed;
    const Eigen::Index n = time_.size() / static_cast<Eigen::Index>(windows_);
    const Eigen::ArrayXd t = time_.segment(static_cast<Eigen::Index>(window) * n, n);
    const double own = windows_ > 1 ? begin_.at(window) + start[0] : p.size() > 2 ? p[2] : begin_[0];
    return (own * (-p[0] * (t - (windows_ > 1 ? t[0] : 0))).exp() * (p[1] * t).cos()).matrix();
  }
  void hand_on(std::size_t window, const Eigen::VectorXd& p, const Eigen::VectorXd& start) override {
    const Eigen::Index n = time_.size() / static_cast<Eigen::Index>(windows_);
    begin_.resize(window + 1);
    begin_.push_back((begin_[window] + start[0]) * std::exp(-p[0] * (time_[n] - time_[0])));
  }
  int followed = 0;

 private:
  Eigen::VectorXd time_;
  std::vector<double> begin_;
  std::size_t windows_;
};

const double rate = 0.12, omega = 2.5, noise = 0.05;
const Eigen::Vector3d amplitudes(1, 0.6, 0.8);

/// Records of several rates and lengths; the last is uneven.
std::vector<Eigen::VectorXd> times() {
  Eigen::VectorXd uneven(160);
  for (Eigen::Index i = 0; i < 160; ++i) {
    const double t = 0.1 * static_cast<double>(i);
    uneven[i] = t + 0.04 * std::sin(7.1 * t);
  }
  return {Eigen::VectorXd::LinSpaced(200, 0, 19.9), Eigen::VectorXd::LinSpaced(120, 0, 17.85), uneven};
}

/// Three records, of which the second and the third have an amplitude of their own that is fitted.
struct Campaign {
  std::vector<std::unique_ptr<Ringing>> own;
  std::shared_ptr<fit::SeveralRecords> simulation;
  fit::SimulationProblem problem{.parameters = {{"rate", 0.2}, {"omega", 2.45}, {"second", 0.5}, {"third", 1}},
                                 .measured = {},
                                 .deviations = {noise}};

  Campaign(double memory, std::uint64_t seed) {
    const auto all = times();
    std::vector<fit::SeveralRecords::Record> records;
    for (std::size_t r = 0; r < all.size(); ++r) {
      const double a = amplitudes[static_cast<Eigen::Index>(r)];
      own.push_back(std::make_unique<Ringing>(all[r], a));
      const auto e = froude_test::ar1_noise(static_cast<std::size_t>(all[r].size()), memory, noise, 10 * seed + r);
      problem.measured.emplace_back(own[r]->follow(0, Eigen::Vector3d(rate, omega, a), {}) +
                                    Eigen::Map<const Eigen::VectorXd>(e.data(), all[r].size()));
      std::vector<Eigen::Index> takes{0, 1};
      if (r > 0) takes.push_back(static_cast<Eigen::Index>(r) + 1);
      records.push_back({own[r].get(), 1, takes});
    }
    simulation = std::make_shared<fit::SeveralRecords>(std::move(records));
  }
};

int intervals_held(double memory, int seeds) {
  const double truth[] = {rate, omega, amplitudes[1], amplitudes[2]};
  int held = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    Campaign c(memory, static_cast<std::uint64_t>(seed));
    const auto f = fit::fit_simulation(*c.simulation, c.problem);
    for (std::size_t k = 0; k < 4; ++k)
      held += f.parameters[k].interval.low < truth[k] && truth[k] < f.parameters[k].interval.high;
  }
  return held;
}

// 100 seeds of four intervals: 380 of 400 are expected; 92 % to 98 %, which is 2.75 deviations of the binomial.
TEST(SeveralRecords, HoldTheTruthAsOftenAsTheySayInWhiteNoise) {
  const int held = intervals_held(0, 100);
  EXPECT_GE(held, 368);
  EXPECT_LE(held, 392);
}

TEST(SeveralRecords, HoldTheTruthAsOftenAsTheySayInNoiseWithAMemory) {
  const int held = intervals_held(0.6, 100);
  EXPECT_GE(held, 368);
  EXPECT_LE(held, 395);  // few records and a memory: the interval of Student may be wider, it may not be narrower
}

// The same record four times over tells as much as four: (F4) of white noise gives half the error.
TEST(SeveralRecords, AddUpWhatEachTells) {
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(200, 0, 19.9);
  const auto error_of = [&](int copies) {
    Ringing ringing(t, 1);
    const auto e = froude_test::ar1_noise(200, 0, noise, 3);
    const Eigen::MatrixXd record =
        ringing.follow(0, Eigen::Vector2d(rate, omega), {}) + Eigen::Map<const Eigen::VectorXd>(e.data(), 200);
    fit::SeveralRecords all(std::vector<fit::SeveralRecords::Record>(copies, {&ringing, 1, {0, 1}}));
    const auto f = fit::fit_simulation(all, {.parameters = {{"rate", 0.2}, {"omega", 2.45}},
                                             .measured = std::vector<Eigen::MatrixXd>(copies, record),
                                             .deviations = {noise}});
    return std::pair{f.parameters[0].standard_error, f.parameters[0].effective_samples};
  };
  const auto [one, samples] = error_of(1);
  const auto [four, all_samples] = error_of(4);
  EXPECT_NEAR(four / one, 0.5, 0.03);  // degrees of freedom 198 and 798, and what the autoregression takes for memory
  EXPECT_NEAR(all_samples / samples, 4, 0.2);
}

TEST(SeveralRecords, AreRunForTheirOwnParametersAlone) {
  Campaign c(0, 1);
  fit::fit_simulation(*c.simulation, c.problem);
  EXPECT_TRUE(c.simulation->moves(1, 2));
  EXPECT_FALSE(c.simulation->moves(0, 2));
  EXPECT_FALSE(c.simulation->moves(1, 3));
  EXPECT_TRUE(c.simulation->moves(0, 1));
  EXPECT_LT(c.own[0]->followed, c.own[1]->followed);  // two sensitivities against three
}

// The second record begins where its own simulation does, not where the first one ended.
TEST(SeveralRecords, HandNothingOnFromOneToTheNext) {
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(80, 0, 7.9);
  Ringing first(t, 1, 2), second(t, 0.5, 2);
  fit::SeveralRecords both({{&first, 2, {0, 1}}, {&second, 2, {0, 1}}});
  const Eigen::Vector2d p(rate, omega);
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(1);
  both.hand_on(0, p, none);
  both.hand_on(1, p, none);
  EXPECT_NEAR(both.follow(1, p, none)(0, 0), std::exp(-rate * t[40]) * std::cos(omega * t[40]), 1e-12);
  EXPECT_NEAR(both.follow(2, p, none)(0, 0), 0.5, 1e-12);
  both.hand_on(2, p, none);
  EXPECT_NEAR(both.follow(3, p, none)(0, 0), 0.5 * std::exp(-rate * t[40]) * std::cos(omega * t[40]), 1e-12);
}

TEST(SeveralRecords, AreOneAtLeastOfAWindowEach) {
  EXPECT_THAT([] { fit::SeveralRecords none({}); }, ThrowsMessage<hydro::InputError>(HasSubstr("a record at least")));
  EXPECT_THAT(
      [] {
        fit::SeveralRecords none({{nullptr, 0, {}}});
      },
      ThrowsMessage<hydro::InputError>(HasSubstr("a window at least")));
}

/// Two records of x = A e^{−ct} cos ωt without noise, to which ±`off` is added in turn.
fit::motion::Problem alternating(double off) {
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(200, 0, 19.9);
  const auto ringing = std::make_shared<Ringing>(t, 1);
  const auto both = std::make_shared<fit::SeveralRecords>(
      std::vector<fit::SeveralRecords::Record>{{ringing.get(), 1, {0, 1}}, {ringing.get(), 1, {0, 1}}});
  Eigen::MatrixXd exact = ringing->follow(0, Eigen::Vector2d(rate, omega), {}), other = exact;
  for (Eigen::Index i = 0; i < 200; ++i) other(i, 0) += i % 2 == 0 ? off : -off;
  const std::vector<double> time(t.begin(), t.end());
  struct Both {
    std::shared_ptr<Ringing> of;
    std::shared_ptr<fit::SeveralRecords> all;
  };
  const auto owner = std::make_shared<Both>(Both{ringing, both});
  return {.records = {{.source = {"exact.csv"}, .time = time, .windows = 1},
                      {.source = {"off.csv"}, .time = time, .windows = 1}},
          .simulation = {owner, both.get()},
          .parameters = {{{.name = "rate", .first = rate}, "1/s"}, {{.name = "omega", .first = omega}, "rad/s"}},
          .signals = {{"x", "m", 0.02}},
          .measured = {exact, other},
          .options = {}};
}

// (F104): ±d in turn is d rms, and 1 − Σd²/Σ(x − x̄)² of it is explained.
TEST(Prediction, TellsWhatIsLeftAndWhatIsExplained) {
  const double off = 0.03;
  const fit::motion::Problem problem = alternating(off);
  const auto out = fit::motion::predict(problem, Eigen::Vector2d(rate, omega), {"first.toml", "first.toml"});
  ASSERT_EQ(out.report.parts.size(), 2u);
  const auto signal = [](const fit::Report& report, const char* name) {
    return std::get<double>(*fit::find(std::get<std::vector<fit::Facts>>(*fit::find(report.facts, "signal"))[0], name));
  };
  EXPECT_LT(signal(out.report.parts[0], "rms"), 1e-14);
  EXPECT_NEAR(signal(out.report.parts[0], "explained"), 1, 1e-12);
  EXPECT_NEAR(signal(out.report.parts[1], "rms"), off, 1e-12);
  const Eigen::ArrayXd x = problem.measured[1].array();
  const double part = 1 - 200 * off * off / (x - x.mean()).square().sum();
  EXPECT_NEAR(signal(out.report.parts[1], "explained"), part, 1e-9);
  EXPECT_NEAR(signal(out.report, "rms"), off / std::sqrt(2), 1e-12);
  EXPECT_TRUE(out.report.estimates.empty());
  EXPECT_THAT(out.report.heading, AllOf(HasSubstr("exact.csv, off.csv"), HasSubstr("nothing is fitted")));
  EXPECT_THAT(out.report.remarks[0], HasSubstr("rate 0.12 1/s, from first.toml"));
  EXPECT_THROW(fit::motion::predict(problem, Eigen::VectorXd(1), {"first.toml"}), hydro::InputError);
}

}  // namespace
}  // namespace several_records_test
