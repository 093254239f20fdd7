#include "hydro/potential/doctor/check.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "doctor.hpp"
#include "hydro/waves/dispersion.hpp"
#include "potential/modes.hpp"
#include "potential/readers.hpp"

namespace hydro::potential {
namespace doctor {
namespace {

Series series_of(const Coefficients& c, const std::vector<Eigen::MatrixXd>& matrices) {
  Series series;
  for (std::size_t w = 0; w < matrices.size(); ++w)
    series.push_back({frequency_text(c.omega[w]), c.omega[w], &matrices[w]});
  return series;
}

/// s_i of (P11).
Eigen::VectorXd sizes(const Series& series, Eigen::Index n) {
  Eigen::VectorXd s = Eigen::VectorXd::Zero(n);
  for (const Sample& sample : series) s = s.cwiseMax(sample.matrix->diagonal().cwiseAbs());
  return with_floor(std::move(s));
}

}  // namespace

double size_of_entry(const Eigen::VectorXd& s, Eigen::Index i, Eigen::Index j) {
  const double size = std::sqrt(s(i) * s(j));
  return size > 0 ? size : 1;
}

bool acts(const std::vector<Eigen::MatrixXd>& matrices, const Eigen::VectorXd& s, Eigen::Index i) {
  double most = 0;
  for (const auto& m : matrices) most = std::max(most, std::abs(m(i, i)));
  return most >= s(i) && most > 0;
}

Patient::Patient(const Coefficients& coefficients) : c(coefficients), A(series_of(c, c.A)), B(series_of(c, c.B)) {
  if (c.A_zero) A.push_back({"zero frequency", 0.0, &*c.A_zero});
  if (c.A_inf) A.push_back({"infinite frequency", {}, &*c.A_inf});
  size_of_A = sizes(A, c.modes());
  size_of_B = sizes(B, c.modes());
  for (const double omega : c.omega) k.push_back(waves::wavenumber(omega, c.water));
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto at = values.begin() + static_cast<long>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

std::string frequency_text(double omega) { return fmt::format("{:.4g} rad/s", omega); }

std::string entry_text(const char* name, Eigen::Index i, Eigen::Index j, const std::string& at) {
  return fmt::format("{}({}, {}) at {}: {} and {}", name, i + 1, j + 1, at, mode_label(i), mode_label(j));
}

Finding not_looked_at(const char* check, const std::string& reason) {
  return {.check = check, .where = "nowhere", .message = "not looked at: " + reason};
}

std::string likely_cause(double ratio, const Water& water) {
  struct Mistake {
    double factor;
    const char* meaning;
  };
  const double g = water.gravity, rho = water.density;
  const std::array<Mistake, 6> known{{{g, "gravity"},
                                      {rho, "the density"},
                                      {rho * g, "density times gravity"},
                                      {1000, "the thousand between kg and t, or N and kN"},
                                      {2 * std::numbers::pi, "2π"},
                                      {180 / std::numbers::pi, "180/π, as between degrees and radians"}}};
  if (!(ratio > 0)) return "";
  constexpr double near = 0.1;
  for (const auto& [factor, meaning] : known)
    for (const double f : {factor, 1 / factor})
      if (std::abs(ratio / f - 1) < near)
        return fmt::format("; that is near {}{}", f == factor ? "" : "1 by ", meaning);
  return "";
}

}  // namespace doctor

std::string_view to_string(Severity severity) {
  switch (severity) {
    case Severity::note:
      return "note";
    case Severity::warning:
      return "warning";
    case Severity::error:
      break;
  }
  return "error";
}

const std::vector<std::string>& check_names() {
  static const std::vector<std::string> names{"symmetry of A",
                                              "symmetry of B",
                                              "reciprocity of A",
                                              "reciprocity of B",
                                              "sign of B",
                                              "passivity of B",
                                              "positivity of A(inf)",
                                              "limit at zero",
                                              "limit at infinity",
                                              "repeated frequency",
                                              "spikes",
                                              "Kramers-Kronig",
                                              "A(inf) by Ogilvie",
                                              "low-frequency tail",
                                              "high-frequency tail",
                                              "Haskind relation",
                                              "heave in long waves",
                                              "surge and sway in long waves",
                                              "moments in long waves",
                                              "place of the bodies",
                                              "restoring matrix",
                                              "waterplane and volume",
                                              "added mass and volume"};
  return names;
}

std::vector<Finding> check(const Coefficients& c) {
  c.validate();
  const doctor::Patient patient(c);
  std::vector<Finding> out;
  for (const auto one :
       {doctor::check_symmetry, doctor::check_reciprocity, doctor::check_sign_of_damping, doctor::check_passivity,
        doctor::check_positivity_of_limit, doctor::check_limits, doctor::check_repeated_frequencies,
        doctor::check_spikes, doctor::check_causality, doctor::check_haskind, doctor::check_long_waves,
        doctor::check_restoring, doctor::check_waterplane, doctor::check_added_mass_and_volume})
    one(patient, out);
  return out;
}

std::vector<Finding> refused(const std::vector<Finding>& findings, const std::vector<std::string>& accepted) {
  const auto& names = check_names();
  for (const std::string& name : accepted)
    if (std::find(names.begin(), names.end(), name) == names.end()) {
      const std::string near = nearest(name, names);
      throw InputError(
          fmt::format("there is no check \"{}\"", name), {},
          near.empty() ? "the checks are listed by `froude bem check`" : fmt::format("did you mean \"{}\"?", near));
    }
  std::vector<Finding> out;
  for (const Finding& f : findings)
    if (f.severity == Severity::error && std::find(accepted.begin(), accepted.end(), f.check) == accepted.end())
      out.push_back(f);
  return out;
}

}  // namespace hydro::potential
