#pragma once
/// \file  Coefficients of a floating hemisphere against the tables of Hulme (1982), for every case that computes them.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "harness/case.hpp"
#include "hydro/io/csv.hpp"
#include "hydro/potential/coefficients.hpp"
#include "hydro/potential/operations/operations.hpp"

namespace froude::validation::hulme {

using hydro::io::CsvTable;

constexpr double radius = 5;  // m, of the panelled hemispheres

struct Suspect {
  std::string column;
  double Ka;
};

struct Compared {
  double mu = 0, lambda = 0;  ///< largest errors
  plot::Panel panel;
};

/// One mode against its table, entry by entry; `suspect` entries are shown in the picture but not compared.
inline Compared compare(const hydro::potential::FrequencyTable& ours, const CsvTable& hulme, hydro::Mode mode,
                        const std::vector<Suspect>& suspect) {
  const hydro::Water& water = ours.coefficients().water;
  const double unit = 2.0 / 3 * std::numbers::pi * water.density * std::pow(radius, 3);
  const auto i = static_cast<int>(mode);
  Compared result;
  result.panel.x = {.label = "Ka"};
  result.panel.y = {.label = std::string(hydro::mode_names[static_cast<std::size_t>(i)]) + " mu, lambda"};
  plot::Series ours_mu{.name = "mu, panels", .x = {}, .y = {}}, ours_lambda{.name = "lambda, panels", .x = {}, .y = {}};
  const std::vector<double>&Ka = hulme.column("Ka"), &mu = hulme.column("mu"), &lambda = hulme.column("lambda");
  for (std::size_t n = 0; n < Ka.size(); ++n) {
    const double omega = std::sqrt(Ka[n] * water.gravity / radius);
    if (omega < ours.lowest() || omega > ours.highest()) continue;
    ours_mu.x.push_back(Ka[n]);
    ours_mu.y.push_back(ours.added_mass(omega)(i, i) / unit);
    ours_lambda.x.push_back(Ka[n]);
    ours_lambda.y.push_back(ours.damping(omega)(i, i) / (unit * omega));
    const auto trusted = [&](const std::string& column) {
      return std::none_of(suspect.begin(), suspect.end(),
                          [&](const Suspect& s) { return s.column == column && s.Ka == Ka[n]; });
    };
    if (trusted("mu")) result.mu = std::max(result.mu, std::abs(ours_mu.y.back() - mu[n]));
    if (trusted("lambda")) result.lambda = std::max(result.lambda, std::abs(ours_lambda.y.back() - lambda[n]));
  }
  const auto table = [&](const std::string& name, const std::vector<double>& y) {
    return plot::Series{.name = name, .x = Ka, .y = y, .line = false, .marks = true};
  };
  result.panel.series = {ours_mu, ours_lambda, table("mu, Hulme", mu), table("lambda, Hulme", lambda)};
  return result;
}

inline double limit_of(const std::optional<Eigen::MatrixXd>& A, hydro::Mode mode, double density,
                       const std::string& which) {
  hydro::require(A.has_value(), "the panel data hold no added mass at {} frequency", which);
  const auto i = static_cast<int>(mode);
  return (*A)(i, i) / (2.0 / 3 * std::numbers::pi * density * std::pow(radius, 3));
}

/// Both tables, μ = A/(⅔πρa³) and λ = B/(⅔πρa³ω) over Ka.
struct Tables {
  CsvTable heave, surge;
};
inline Tables tables(const std::filesystem::path& heave, const std::filesystem::path& surge) {
  return {CsvTable::read(heave), CsvTable::read(surge)};
}

inline Outcome against(const Tables& table, const hydro::potential::FrequencyTable& ours) {
  using hydro::Mode;
  const auto heave = compare(ours, table.heave, Mode::heave, {});
  const auto surge = compare(ours, table.surge, Mode::surge, {{"mu", 0.7}, {"lambda", 3.4}});
  const auto& c = ours.coefficients();
  const double rho = c.water.density;
  return {.numbers = {{"heave: largest error of mu", heave.mu, ""},
                      {"heave: largest error of lambda", heave.lambda, ""},
                      {"surge: largest error of mu", surge.mu, ""},
                      {"surge: largest error of lambda", surge.lambda, ""},
                      {"heave: mu at zero frequency", limit_of(c.A_zero, Mode::heave, rho, "zero"), ""},
                      {"heave: mu at infinite frequency", limit_of(c.A_inf, Mode::heave, rho, "infinite"), ""},
                      {"surge: mu at zero frequency", limit_of(c.A_zero, Mode::surge, rho, "zero"), ""},
                      {"surge: mu at infinite frequency", limit_of(c.A_inf, Mode::surge, rho, "infinite"), ""}},
          .pictures = {{"coefficients",
                        "Added mass and damping of the hemisphere, panels against Hulme's tables.",
                        {.title = "Floating hemisphere", .panels = {heave.panel, surge.panel}},
                        true}}};
}

}  // namespace froude::validation::hulme
