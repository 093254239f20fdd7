#include <Eigen/Eigenvalues>

#include <cmath>
#include <functional>
#include <numbers>

#include "harness/case.hpp"
#include "hydro/io/csv.hpp"
#include "hydro/potential/coefficients.hpp"
#include "hydro/potential/operations/operations.hpp"

namespace froude::validation::fagerbakke_eigen {
namespace {

constexpr int modules = 5;
constexpr double mooring = 4280;      // N/m, at each end
constexpr double module_mass = 9088;  // kg
constexpr double long_period = 20;    // s

double mean_stiffness(const hydro::io::CsvTable& springs, const std::string& set) {
  const std::vector<std::string>& names = springs.text_column("spring");
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i].starts_with(set + ".")) {
      sum += springs.column("stiffness_full_N_m")[i];
      ++count;
    }
  hydro::require(count > 0, "springs.csv has no spring of the set {}", set);
  return sum / count;
}

// A chain of equal masses, one spring a gap, both ends moored to the ground; rising eigenvalues of the stiffness, N/m.
Eigen::VectorXd chain_eigenvalues(double connector) {
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(modules, modules);
  for (int gap = 0; gap + 1 < modules; ++gap) {
    K(gap, gap) += connector;
    K(gap + 1, gap + 1) += connector;
    K(gap, gap + 1) -= connector;
    K(gap + 1, gap) -= connector;
  }
  K(0, 0) += mooring;
  K(modules - 1, modules - 1) += mooring;
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K).eigenvalues();
}

// ω² (m + A(ω)) = κ. A changes slowly with ω, so the plain iteration contracts; it is stopped at rounding.
double own_frequency(double kappa, const std::function<double(double)>& added_mass) {
  double omega = std::sqrt(kappa / (module_mass + added_mass(2 * std::numbers::pi / long_period)));
  for (int i = 0; i < 200; ++i) {
    const double next = std::sqrt(kappa / (module_mass + added_mass(omega)));
    if (std::abs(next - omega) < 1e-13 * omega) return next;
    omega = next;
  }
  throw hydro::NumericsError(fmt::format("the eigenfrequency near {} rad/s did not settle in 200 iterations", omega));
}

}  // namespace

Outcome outcome(const Folders& folders) {
  const auto springs = hydro::io::CsvTable::read(folders.reference("springs.csv"));
  const auto printed = hydro::io::CsvTable::read(folders.reference("eigenperiods.csv"));
  const hydro::potential::FrequencyTable module(hydro::potential::read(folders.example("pontoon1.nc")),
                                                {Eigen::Vector3d::Zero()});
  const auto added_mass = [&](double omega) { return module.added_mass(omega)(0, 0); };
  const double two_pi = 2 * std::numbers::pi, at_long = module_mass + added_mass(two_pi / long_period);

  Outcome outcome;
  plot::Panel panel{.x = {.label = "mode"}, .y = {.label = "eigenperiod", .unit = "s"}, .series = {}};
  const std::vector<double>& mode = printed.column("mode");
  for (const std::string set : {"S1", "S2", "S3", "S4"}) {
    const Eigen::VectorXd kappa = chain_eigenvalues(mean_stiffness(springs, set));
    plot::Series ours{.name = set + ", A at own frequency", .x = mode, .y = {}, .dashed = true};
    for (int n = 0; n < modules; ++n) {
      const std::string name = fmt::format("{} mode {}", set, n + 1);
      outcome.numbers.push_back({name + ", added mass at 20 s", two_pi * std::sqrt(at_long / kappa[n]), "s"});
      ours.y.push_back(two_pi / own_frequency(kappa[n], added_mass));
      outcome.numbers.push_back({name + ", added mass at its own frequency", ours.y.back(), "s"});
    }
    panel.series.push_back(std::move(ours));
    panel.series.push_back(
        {.name = set + ", printed", .x = mode, .y = printed.column(set + "_s"), .line = false, .marks = true});
  }
  outcome.numbers.push_back({"mass and added mass at 20 s", at_long, "kg"});
  outcome.pictures = {
      {"periods", "Surge eigenperiods of five coupled modules.", {.title = "Surge eigenperiods", .panels = {panel}}}};
  return outcome;
}

}  // namespace froude::validation::fagerbakke_eigen
