#include <algorithm>
#include <cmath>

#include "harness/case.hpp"
#include "hydro/potential/coefficients.hpp"
#include "hydro/radiation/rational.hpp"
#include "hydro/radiation/tail.hpp"

namespace froude::validation::kramers_kronig {
namespace {

using hydro::radiation::DampingTable;

constexpr double a = 0.3, b = 1.1, w2 = a * a + b * b, A_inf = 2;  // (R9)

double D(double omega) { return std::pow(w2 - omega * omega, 2) + 4 * a * a * omega * omega; }
double exact_B(double omega) { return 2 * a * omega * omega / D(omega); }
double exact_A(double omega) { return A_inf + (w2 - omega * omega) / D(omega); }

Eigen::MatrixXd one(double value) { return Eigen::MatrixXd::Constant(1, 1, value); }

}  // namespace

Outcome outcome(const Folders&) {
  DampingTable table;
  std::vector<Eigen::MatrixXd> A;
  constexpr double last = 20;
  constexpr int count = 1000;
  for (int i = 1; i <= count; ++i) {
    table.omega.push_back(last * i / count);
    table.B.push_back(one(exact_B(table.omega.back())));
    A.push_back(one(exact_A(table.omega.back())));
  }
  const auto fit = hydro::radiation::fit(table, A, one(A_inf));
  plot::Series given{.name = "closed form", .x = {}, .y = {}},
      back{.name = "from the other", .x = {}, .y = {}, .dashed = true}, given_B = given, back_B = back;
  double off_A = 0, off_B = 0, off_fit = 0;
  for (double omega = 0.15; omega < 5; omega += 0.05) {
    const double from_B = hydro::radiation::added_mass_above_limit(table, omega)(0, 0);
    const double from_A = hydro::radiation::damping_from_added_mass(table.omega, A, one(A_inf), omega)(0, 0);
    const std::complex<double> K = fit.model.transform(omega)(0, 0);
    off_A = std::max(off_A, std::abs(from_B - (exact_A(omega) - A_inf)));
    off_B = std::max(off_B, std::abs(from_A - exact_B(omega)));
    off_fit = std::max(off_fit, std::abs(K - std::complex<double>(exact_B(omega), omega * (exact_A(omega) - A_inf))));
    given.x.push_back(omega), given.y.push_back(exact_A(omega) - A_inf);
    back.x.push_back(omega), back.y.push_back(from_B);
    given_B.x.push_back(omega), given_B.y.push_back(exact_B(omega));
    back_B.x.push_back(omega), back_B.y.push_back(from_A);
  }
  Outcome out;
  out.numbers = {{"largest error of A from B", off_A, ""},
                 {"largest error of B from A", off_B, ""},
                 {"largest error of the common fit of both", off_fit, ""}};
  plot::Panel mass{.x = {"frequency", "rad/s"}, .y = {"A - A(inf)"}, .series = {given, back}},
      damping{.x = {"frequency", "rad/s"}, .y = {"B"}, .series = {given_B, back_B}};
  out.pictures.push_back({"both-ways",
                          "Added mass from damping and damping from added mass.",
                          {.title = "Kramers and Kronig", .panels = {mass, damping}}});
  return out;
}

}  // namespace froude::validation::kramers_kronig
