// Refinement at some frequencies of many, on answers with a resonance whose limit is known. (G17)
#include "panels/controlled.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "panels/extrapolate.hpp"
#include "panels/self_check.hpp"

namespace hydro::panels::controlled_test {
namespace {

using Eigen::MatrixXcd;
using Eigen::MatrixXd;

/// Heave as the water of a moonpool makes it: a resonance over a smooth course. Meshes put its frequency too high, by
/// an amount that falls by √8 from each to the next.
struct Resonance {
  double omega = 1;     ///< of panels of no size, rad/s
  double width = 0.06;  ///< relative, of the half of its height
  double shift = 0.02;  ///< relative, of the coarsest mesh

  Extrapolated at(double w, double shifted) const {
    MatrixXcd A = MatrixXcd::Identity(6, 6), B = A, X = MatrixXcd::Ones(6, 1);
    if (std::isfinite(w)) {
      const double detuned = (w / (omega * (1 + shifted)) - 1) / width, height = 1 / (1 + detuned * detuned);
      A(2, 2) -= 2 * detuned * height;
      B(2, 2) = 0.2 + 2 * height;
      X(2, 0) = std::sqrt(B(2, 2));
    }
    return {A, B, X};
  }
};

OneFrequency as_answer(const Extrapolated& from) {
  return {.A = from[0].real(), .B = from[1].real(), .B_far = from[1].real(), .X = from[2], .X_far = from[2]};
}

class ResonantSolver final : public Solver {
 public:
  ResonantSolver(const Resonance& of, double shifted) : of_(of), shifted_(shifted) {}
  Extrapolated solved(double w, const std::vector<double>&) const override { return of_.at(w, shifted_); }
  OneFrequency answer(double, const std::vector<double>&, const Extrapolated& from) const override {
    return as_answer(from);
  }
  MatrixXd added_mass(double, const Extrapolated& from) const override { return from[0].real(); }
  std::vector<OneFrequency> alone(double, const std::vector<double>&, const Extrapolated& from) const override {
    return {as_answer(from)};
  }
  potential::WaveField field(const potential::FieldQuestion&, int) const override { return {}; }

 private:
  Resonance of_;
  double shifted_;
};

class ResonantMesh final : public Discretisation {
 public:
  ResonantMesh(const Resonance& of, int refinements) : of_(of), refinements_(refinements) {}
  std::unique_ptr<const Solver> solver() const override {
    return std::make_unique<ResonantSolver>(of_, of_.shift * std::pow(8, -0.5 * refinements_));
  }
  std::unique_ptr<const Discretisation> refined() const override {
    return std::make_unique<ResonantMesh>(of_, refinements_ + 1);
  }
  std::unique_ptr<const Discretisation> graded(double, int) const override {
    return std::make_unique<ResonantMesh>(of_, refinements_);
  }
  void require_short_panels(double) const override {}
  Cost cost(const std::vector<double>&, std::size_t, int, int) const override { return {}; }
  bool has_zero() const override { return false; }
  double length() const override { return 1; }
  void describe(SelfCheck& check) const override { check.panels = 100 << (2 * refinements_); }

 private:
  Resonance of_;
  int refinements_;
};

/// 49 frequencies, of which five are refined at first: 0.5, 0.75, 1, … rad/s.
std::vector<double> frequencies() {
  std::vector<double> out;
  for (int i = 0; i < 49; ++i) out.push_back(0.5 + i / 48.0);
  return out;
}

// A resonance between two nodes that are far apart bends more than a cubic through them sees. It must be met where it
// is, or the estimate must say that it is not; and few frequencies may serve.
TEST(ControlledPanels, KnowTheirErrorAtResonancesWhereverThoseLieBetweenNodes) {
  const std::vector<double> omega = frequencies();
  for (const double at : {0.76, 0.81, 0.87, 0.93, 1.0, 1.11}) {
    SCOPED_TRACE(at);
    const Resonance resonance{.omega = at};
    const Work work = controlled_work(ResonantMesh(resonance, 0), omega, {0.0}, {.tolerance = 0.25, .threads = 1});
    std::vector<OneFrequency> truth;
    for (const double w : omega) truth.push_back(as_answer(resonance.at(w, 0)));
    const Sizes size = sizes(truth, 1);
    double error = 0;
    for (std::size_t i = 0; i < omega.size(); ++i)
      error = std::max(error, largest(sum(work.results[i], -1, truth[i]), size));
    EXPECT_LE(error, work.check.estimate);
    EXPECT_LE(work.check.estimate, 0.25);
    EXPECT_LT(work.check.refined_omega.size(), 20U) << "of 49";
  }
}

}  // namespace
}  // namespace hydro::panels::controlled_test
