#include "fit/simulated.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

#include "hydro/base/error.hpp"
#include "support/coloured_noise.hpp"

namespace simulated_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A flow ẏ = f(y; θ) by Runge–Kutta steps, sampled, its first component measured. Windows may begin anywhere.
class Flow final : public fit::Simulation {
 public:
  using Rate = std::function<Eigen::VectorXd(const Eigen::VectorXd&, const Eigen::VectorXd&)>;
  Flow(Rate rate, Eigen::VectorXd begin, double step, Eigen::Index samples, bool windows)
      : rate_(std::move(rate)), middle_{std::move(begin)}, step_(step), samples_(samples), windows_(windows) {}

  Eigen::Index coordinates(std::size_t window) override { return windows_ ? middle_.at(window).size() : 0; }
  Eigen::MatrixXd follow(std::size_t window, const Eigen::VectorXd& theta, const Eigen::VectorXd& start) override {
    Eigen::VectorXd y = middle_.at(windows_ ? window : 0);
    if (windows_) y += start;
    Eigen::MatrixXd out(samples_, 1);
    for (Eigen::Index i = 0; i < samples_; ++i, y = stepped(y, theta)) out(i, 0) = y[0];
    if (!out.allFinite()) throw hydro::NumericsError("the flow ran away");
    return out;
  }
  void hand_on(std::size_t window, const Eigen::VectorXd& theta, const Eigen::VectorXd& start) override {
    Eigen::VectorXd y = middle_.at(window) + start;
    for (Eigen::Index i = 0; i < samples_; ++i) y = stepped(y, theta);
    middle_.resize(window + 1);
    middle_.push_back(y);
  }

 private:
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
  std::vector<Eigen::VectorXd> middle_;
  double step_;
  Eigen::Index samples_;
  bool windows_;
};

Eigen::VectorXd vector(std::initializer_list<double> values) {
  return Eigen::Map<const Eigen::VectorXd>(values.begin(), std::ssize(values));
}

/// ẍ + b₁ẋ + b₂|ẋ|ẋ + ω²x = 0; and a third state that nobody sees.
Eigen::VectorXd swing(const Eigen::VectorXd& y, const Eigen::VectorXd& theta) {
  return vector({y[1], -theta[0] * y[1] - theta[1] * std::abs(y[1]) * y[1] - theta[2] * y[0], -y[2]});
}
const Eigen::VectorXd swing_truth = vector({0.05, 0.3, 4.0});

fit::SimulationProblem swing_problem(double noise, std::uint64_t stream, std::size_t windows = 1) {
  const Eigen::Index samples = 300 / static_cast<Eigen::Index>(windows);
  fit::SimulationProblem p{
      .parameters = {{"linear", 0.1}, {"quadratic", 0.1}, {"restoring", 4.1}}, .measured = {}, .deviations = {0.01}};
  const auto e = froude_test::ar1_noise(300, 0, noise, stream);
  const Eigen::MatrixXd all = Flow(swing, vector({1, 0, 1}), 0.05, 300, false).follow(0, swing_truth, {}) +
                              Eigen::Map<const Eigen::VectorXd>(e.data(), 300);
  for (std::size_t w = 0; w < windows; ++w)
    p.measured.emplace_back(all.middleRows(static_cast<Eigen::Index>(w) * samples, samples));
  return p;
}

TEST(Simulated, FindsTheParametersOfARunWithoutNoise) {
  Flow flow(swing, vector({1, 0, 1}), 0.05, 300, false);
  const auto f = fit::fit_simulation(flow, swing_problem(0, 1));
  for (std::size_t k = 0; k < 3; ++k)  // differences are good to 1e-4 of a step: the search creeps to 1e-8 of the cost
    EXPECT_NEAR(*f.parameters[k].value, swing_truth[static_cast<Eigen::Index>(k)], 1e-5) << k;
  EXPECT_LT(f.rms[0], 1e-5);
}

TEST(Simulated, GivesIntervalsThatHold) {
  int held = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Flow flow(swing, vector({1, 0, 1}), 0.05, 300, false);
    const auto f = fit::fit_simulation(flow, swing_problem(0.01, seed));
    for (std::size_t k = 0; k < 3; ++k)
      held += f.parameters[k].interval.low < swing_truth[static_cast<Eigen::Index>(k)] &&
              swing_truth[static_cast<Eigen::Index>(k)] < f.parameters[k].interval.high;
  }
  EXPECT_GE(held, 51);  // of 60, 57 expected; three deviations of the binomial are 5
}

TEST(Simulated, FitsStartsOfWindowsAndSaysWhichNobodySees) {
  Flow flow(swing, vector({1, 0, 1}), 0.05, 100, true);
  const auto f = fit::fit_simulation(flow, swing_problem(0.01, 5, 3));
  EXPECT_EQ(f.starts_all, 9);
  EXPECT_EQ(f.starts_seen, 6);  // the third state changes nothing that is measured
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_LT(f.parameters[k].interval.low, swing_truth[static_cast<Eigen::Index>(k)]);
    EXPECT_GT(f.parameters[k].interval.high, swing_truth[static_cast<Eigen::Index>(k)]);
  }
}

TEST(Simulated, GivesBandsThatHoldTheTrueMotionAndNewSamples) {
  double motion = 0, samples = 0, inside = 0;
  const Eigen::MatrixXd truth = Flow(swing, vector({1, 0, 1}), 0.05, 300, false).follow(0, swing_truth, {});
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Flow flow(swing, vector({1, 0, 1}), 0.05, 300, false);
    const auto f = fit::fit_simulation(flow, swing_problem(0.01, seed));
    const Eigen::MatrixXd anew = swing_problem(0.01, 100 + seed).measured[0];
    motion += static_cast<double>(((f.motion[0] - truth).array().abs() <= f.fit_band[0].array()).count());
    samples += static_cast<double>(((f.motion[0] - anew).array().abs() <= f.sample_band[0].array()).count());
    inside += f.inside / 20;
    EXPECT_TRUE((f.fit_band[0].array() <= f.sample_band[0].array()).all());
  }
  // Of the motion three numbers are uncertain, so 20 records are some 60 facts: three deviations of a share of 0.95.
  EXPECT_NEAR(motion / 6000, 0.95, 0.085);
  EXPECT_NEAR(samples / 6000, 0.95, 0.01);  // 6000 samples: three deviations
  EXPECT_NEAR(inside, 0.95, 0.015);         // these the fit has seen: a hundredth of their variance less
}

TEST(Simulated, GoesOnFromTheFitOfAnotherRecordToWhereItWouldHaveComeItself) {
  Flow flow(swing, vector({1, 0, 1}), 0.05, 100, true), same(swing, vector({1, 0, 1}), 0.05, 100, true);
  const auto first = fit::fit_simulation(flow, swing_problem(0.01, 5, 3));
  auto second = swing_problem(0.01, 6, 3);
  const auto alone = fit::fit_simulation(same, second);
  second.begin = &first;
  const auto after = fit::fit_simulation(flow, second);
  EXPECT_LT(after.windows_followed, alone.windows_followed / 2);
  EXPECT_EQ(after.starts_seen, alone.starts_seen);
  for (std::size_t k = 0; k < 3; ++k) {  // both leave a few hundredths of a standard error, (F41)
    EXPECT_NEAR(*after.parameters[k].value, *alone.parameters[k].value, 0.05 * alone.parameters[k].standard_error);
    EXPECT_NEAR(after.parameters[k].standard_error / alone.parameters[k].standard_error, 1, 0.01);
  }
  second.measured.pop_back();
  EXPECT_THAT([&] { fit::fit_simulation(flow, second); },
              testing::ThrowsMessage<hydro::InputError>(HasSubstr("has 3 windows, this record 2")));
}

TEST(Simulated, FollowsAChaoticFlowInWindowsWhereOneRunCannot) {
  // Lorenz (1963): neighbours part as e^{0.9 t}, so over 20 s a start is forgotten by e^18.
  const auto lorenz = [](const Eigen::VectorXd& y, const Eigen::VectorXd& q) {
    return vector({q[0] * (y[1] - y[0]), y[0] * (q[1] - y[2]) - y[1], y[0] * y[1] - q[2] * y[2]});
  };
  const Eigen::VectorXd truth = vector({10, 28, 8.0 / 3}), begin = vector({-8, 7, 27});
  const auto e = froude_test::ar1_noise(1000, 0, 0.1, 9);
  const Eigen::MatrixXd all =
      Flow(lorenz, begin, 0.02, 1000, false).follow(0, truth, {}) + Eigen::Map<const Eigen::VectorXd>(e.data(), 1000);
  fit::SimulationProblem p{
      .parameters = {{"sigma", 9}, {"rho", 27}, {"beta", 2.5}}, .measured = {all}, .deviations = {0.1}};
  Flow whole(lorenz, begin, 0.02, 1000, false);
  const auto lost = fit::fit_simulation(whole, p);
  EXPECT_GT(lost.rms[0], 1);  // ends at a wrong minimum
  p.measured.clear();
  for (int w = 0; w < 20; ++w) p.measured.emplace_back(all.middleRows(50 * w, 50));
  Flow flow(lorenz, begin, 0.02, 50, true);
  const auto f = fit::fit_simulation(flow, p);
  EXPECT_NEAR(f.rms[0], 0.1, 0.01);
  for (std::size_t k = 0; k < 3; ++k) {
    const double off = std::abs(*f.parameters[k].value - truth[static_cast<Eigen::Index>(k)]);
    EXPECT_LT(off, 3.5 * f.parameters[k].standard_error) << k;
    EXPECT_LT(off, 0.02 * truth[static_cast<Eigen::Index>(k)]) << k;
  }
}

TEST(Simulated, NamesWhatTheRecordDoesNotTell) {
  // Only the product of the two acts.
  const auto product = [](const Eigen::VectorXd& y, const Eigen::VectorXd& q) { return vector({-q[0] * q[1] * y[0]}); };
  fit::SimulationProblem p{.parameters = {{"mass", 1}, {"rate", 0.5}}, .measured = {}, .deviations = {0.01}};
  Flow flow(product, vector({1}), 0.1, 60, false);
  p.measured = {flow.follow(0, vector({1, 0.7}), {})};
  const auto f = fit::fit_simulation(flow, p);
  EXPECT_FALSE(f.parameters[0].value);
  EXPECT_FALSE(f.parameters[1].value);
  EXPECT_THAT(f.weakest, AllOf(HasSubstr("mass"), HasSubstr("rate")));
  EXPECT_LT(f.singular_values[1], 1e-3 * f.singular_values[0]);
}

TEST(Simulated, SaysThatASearchEndedAtABound) {
  auto p = swing_problem(0.01, 3);
  p.parameters[1] = {"quadratic", 0.1, 0.0, 0.2};  // the truth is 0.3
  Flow flow(swing, vector({1, 0, 1}), 0.05, 300, false);
  const auto f = fit::fit_simulation(flow, p);
  EXPECT_FALSE(f.parameters[1].value);
  EXPECT_THAT(f.parameters[1].why_not, HasSubstr("bound 0.2"));
}

TEST(Simulated, TellsNothingOfASearchThatUsedUpItsIterations) {
  auto p = swing_problem(0.01, 3);
  p.iterations_reach = 1;
  Flow flow(swing, vector({1, 0, 1}), 0.05, 300, false);
  const auto f = fit::fit_simulation(flow, p);
  EXPECT_EQ(f.search.outcome, fit::SearchReport::Outcome::out_of_iterations);
  EXPECT_THAT(f.refused, HasSubstr("all 1 of its iterations are used up"));
  for (const auto& c : f.parameters) {
    EXPECT_FALSE(c.value);
    EXPECT_TRUE(std::isinf(c.interval.low) && std::isinf(c.interval.high));
  }
  EXPECT_TRUE(f.fit_band.empty() && f.sample_band.empty());
  p.accept_residuals = true;  // which is no acceptance of a search without an end
  EXPECT_FALSE(fit::fit_simulation(flow, p).parameters[0].value);
}

TEST(Simulated, TellsNothingWhereResidualsExceedWhatIsStated) {
  auto p = swing_problem(0.01, 3);
  p.parameters = {{"linear", 0.1}, {"restoring", 4.1}};  // without the quadratic damping that acts
  class Linear final : public fit::Simulation {
   public:
    Linear() : flow_(swing, vector({1, 0, 1}), 0.05, 300, false) {}
    Eigen::Index coordinates(std::size_t) override { return 0; }
    Eigen::MatrixXd follow(std::size_t w, const Eigen::VectorXd& q, const Eigen::VectorXd& start) override {
      return flow_.follow(w, vector({q[0], 0, q[1]}), start);
    }
    void hand_on(std::size_t, const Eigen::VectorXd&, const Eigen::VectorXd&) override {}

   private:
    Flow flow_;
  } linear;
  const auto f = fit::fit_simulation(linear, p);
  EXPECT_TRUE(f.search.ended());
  EXPECT_GT(f.stated[0].rms, f.stated[0].allowed);
  EXPECT_THAT(f.refused, AllOf(HasSubstr("stated as 0.01"), HasSubstr("which allows")));
  EXPECT_FALSE(f.parameters[0].value);
  p.accept_residuals = true;
  const auto taken = fit::fit_simulation(linear, p);
  ASSERT_TRUE(taken.parameters[0].value);
  EXPECT_EQ(taken.refused, "");
  // Intervals are made from the residuals: at the least as much wider than those of the deviation stated.
  p.deviations[0] = taken.stated[0].rms;
  const auto restated = fit::fit_simulation(linear, p);
  EXPECT_NEAR(taken.parameters[0].standard_error / restated.parameters[0].standard_error, 1, 1e-3);
}

TEST(Simulated, GoesOnWithShorterStepsWhereOnesOfFullLengthFail) {
  // x_i = c_i arctan θ, from θ = 10: a full step goes to −90, where the residuals are larger, and so does half of it.
  class Arctan final : public fit::Simulation {
   public:
    Eigen::Index coordinates(std::size_t) override { return 0; }
    Eigen::MatrixXd follow(std::size_t, const Eigen::VectorXd& p, const Eigen::VectorXd&) override {
      Eigen::MatrixXd out(200, 1);
      for (Eigen::Index i = 0; i < 200; ++i) out(i, 0) = (1 + std::sin(0.1 * static_cast<double>(i))) * std::atan(p[0]);
      return out;
    }
    void hand_on(std::size_t, const Eigen::VectorXd&, const Eigen::VectorXd&) override {}
  } arctan;
  const auto e = froude_test::ar1_noise(200, 0, 1, 5);
  const Eigen::MatrixXd measured =
      arctan.follow(0, vector({0.5}), {}) + Eigen::Map<const Eigen::VectorXd>(e.data(), 200);
  const auto f =
      fit::fit_simulation(arctan, {.parameters = {{"theta", 10}}, .measured = {measured}, .deviations = {1.0}});
  EXPECT_TRUE(f.search.ended()) << f.search.why;
  ASSERT_TRUE(f.parameters[0].value) << f.refused;
  EXPECT_LT(f.parameters[0].interval.low, 0.5);
  EXPECT_GT(f.parameters[0].interval.high, 0.5);
}

TEST(Simulated, RefusesWhatItCannotBeginWith) {
  Flow flow(swing, vector({1, 0, 1}), 0.05, 300, false);
  auto p = swing_problem(0, 1);
  p.parameters[0].lowest = 0.2;
  EXPECT_THAT([&] { fit::fit_simulation(flow, p); },
              testing::ThrowsMessage<hydro::InputError>(HasSubstr("linear begins at 0.1")));
  p = swing_problem(0, 1);
  p.measured[0].conservativeResize(200, 1);
  EXPECT_THAT([&] { fit::fit_simulation(flow, p); },
              testing::ThrowsMessage<hydro::InputError>(HasSubstr("300 samples")));
}

/// cos ωt: whoever begins far from the frequency loses a swing and ends elsewhere.
Eigen::VectorXd swing_freely(const Eigen::VectorXd& y, const Eigen::VectorXd& theta) {
  return vector({y[1], -theta[0] * y[0]});
}

/// The cost where one parameter is held, all others at their best, by a dense look along the line: no search at all.
TEST(SimulatedProfile, IsWhereTheLikelihoodHasFallen) {
  // x(t) = a sin(bt): by a it is linear, so for b held the best a is a quotient.
  const auto follow = [](double a, double b) {
    Eigen::MatrixXd out(200, 1);
    for (Eigen::Index i = 0; i < 200; ++i) out(i, 0) = a * std::sin(b * 0.05 * static_cast<double>(i));
    return out;
  };
  class Sine final : public fit::Simulation {
   public:
    explicit Sine(std::function<Eigen::MatrixXd(double, double)> f) : f_(std::move(f)) {}
    Eigen::Index coordinates(std::size_t) override { return 0; }
    Eigen::MatrixXd follow(std::size_t, const Eigen::VectorXd& p, const Eigen::VectorXd&) override {
      return f_(p[0], p[1]);
    }
    void hand_on(std::size_t, const Eigen::VectorXd&, const Eigen::VectorXd&) override {}

   private:
    std::function<Eigen::MatrixXd(double, double)> f_;
  } sine(follow);
  const auto e = froude_test::ar1_noise(200, 0, 0.8, 5);
  const Eigen::MatrixXd measured = follow(1.0, 0.3) + Eigen::Map<const Eigen::VectorXd>(e.data(), 200);
  fit::SimulationProblem p{.parameters = {{"a", 1.1}, {"b", 0.31}}, .measured = {measured}, .deviations = {0.8}};
  const auto f = fit::fit_simulation(sine, p);
  const auto profile = fit::profile_interval(sine, p, f, 1);
  const auto cost = [&](double b) {
    const Eigen::VectorXd shape = follow(1, b), x = measured;
    const double a = shape.dot(x) / shape.squaredNorm();
    return (x - a * shape).squaredNorm() / 2 / 0.64;
  };
  // What the cost rises by at both ends is t² s² (n/n_eff)/2, within 2·3 % and the search's own 5 % of it.
  const double least = cost(*f.parameters[1].value);
  EXPECT_NEAR(least, f.search.cost_last, 1e-3 * least);
  const double low = cost(profile.low) - least, high = cost(profile.high) - least,
               t = (f.parameters[1].interval.high - f.parameters[1].interval.low) / 2 / f.parameters[1].standard_error,
               rise = t * t * least / f.parameters[1].effective_samples;
  EXPECT_NEAR(low, rise, 0.12 * rise);
  EXPECT_NEAR(high, rise, 0.12 * rise);
  // Not symmetric: the half cycle that there is bends the likelihood.
  const double down = *f.parameters[1].value - profile.low, up = profile.high - *f.parameters[1].value;
  EXPECT_GT(std::abs(up - down), 0.05 * (up + down));
  EXPECT_THROW(fit::profile_interval(sine, p, f, 2), hydro::InputError);
}

TEST(SimulatedProfile, OfOneParameterAloneAndAtABoundEndsThere) {
  Flow flow(swing, vector({1, 0, 1}), 0.05, 300, false);
  class One final : public fit::Simulation {
   public:
    explicit One(fit::Simulation& all) : all_(all) {}
    Eigen::Index coordinates(std::size_t w) override { return all_.coordinates(w); }
    Eigen::MatrixXd follow(std::size_t w, const Eigen::VectorXd& p, const Eigen::VectorXd& start) override {
      return all_.follow(w, vector({0.05, p[0], 4.0}), start);
    }
    void hand_on(std::size_t, const Eigen::VectorXd&, const Eigen::VectorXd&) override {}

   private:
    fit::Simulation& all_;
  } one(flow);
  auto p = swing_problem(0.03, 4);
  p.deviations = {0.03};
  p.parameters = {{"quadratic", 0.2}};
  const auto f = fit::fit_simulation(one, p);
  const auto free = fit::profile_interval(one, p, f, 0);
  const auto& plain = f.parameters[0].interval;
  const double width = plain.high - plain.low;
  EXPECT_NEAR(free.low, plain.low, 0.1 * width);  // nearly linear
  EXPECT_NEAR(free.high, plain.high, 0.1 * width);
  p.parameters[0].first = *f.parameters[0].value;
  p.parameters[0].lowest = p.parameters[0].first - width / 8;
  const auto bounded = fit::profile_interval(one, p, fit::fit_simulation(one, p), 0);
  EXPECT_EQ(bounded.low, p.parameters[0].lowest);
}

TEST(SimulatedProfile, OfAMotionInWindowsFitsTheirStartsAgain) {
  Flow flow(swing, vector({1, 0, 1}), 0.05, 100, true);
  const auto p = swing_problem(0.01, 7, 3);
  const auto f = fit::fit_simulation(flow, p);
  const auto profile = fit::profile_interval(flow, p, f, 2);
  const auto& plain = f.parameters[2].interval;
  EXPECT_NEAR(profile.low, plain.low, 0.1 * (plain.high - plain.low));  // nearly linear in the restoring
  EXPECT_NEAR(profile.high, plain.high, 0.1 * (plain.high - plain.low));
}

TEST(SeveralStarts, FindTheMinimumThatOneStartMisses) {
  const auto e = froude_test::ar1_noise(300, 0, 0.05, 5);
  const Eigen::MatrixXd measured = Flow(swing_freely, vector({1, 0}), 0.05, 300, false).follow(0, vector({9.0}), {}) +
                                   Eigen::Map<const Eigen::VectorXd>(e.data(), 300);
  fit::SimulationProblem p{.parameters = {{"restoring", 3.0, 1.0, 25.0}}, .measured = {measured}, .deviations = {0.05}};
  Flow flow(swing_freely, vector({1, 0}), 0.05, 300, false);
  const auto once = fit::fit_simulation(flow, p);
  EXPECT_GT(once.rms[0], 0.3);  // 15 s of swings of 2 s: a start at 3.6 s has lost them
  EXPECT_FALSE(once.parameters[0].value);
  EXPECT_THAT(once.refused, HasSubstr("stated as 0.05"));
  const auto several = fit::fit_simulation_from(flow, p, 24);
  EXPECT_NEAR(several.best.parameters[0].value.value(), 9.0, 0.02);
  EXPECT_NEAR(several.best.rms[0], 0.05, 0.01);
  EXPECT_GE(several.agree, 1);
  EXPECT_LT(several.agree, 24);
  EXPECT_EQ(several.failed, 0);
}

TEST(SeveralStarts, NeedBoundsAndMoreThanOne) {
  auto p = swing_problem(0, 1);
  Flow flow(swing, vector({1, 0, 1}), 0.05, 300, false);
  EXPECT_THAT([&] { fit::fit_simulation_from(flow, p, 3); },
              testing::ThrowsMessage<hydro::InputError>(HasSubstr("no bounds on both sides")));
  for (auto& q : p.parameters) q.lowest = 0, q.highest = 6;
  EXPECT_THROW(fit::fit_simulation_from(flow, p, 1), hydro::InputError);
  const auto several = fit::fit_simulation_from(flow, p, 3);
  EXPECT_NEAR(several.best.parameters[2].value.value(), 4, 1e-6);
}

}  // namespace
}  // namespace simulated_test
