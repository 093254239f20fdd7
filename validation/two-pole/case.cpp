#include <algorithm>
#include <cmath>

#include "harness/case.hpp"
#include "hydro/radiation/kernel.hpp"

namespace froude::validation::two_pole {
namespace {

using hydro::radiation::DampingTable;
using hydro::radiation::RetardationKernel;

constexpr double a = 0.3, b = 1.1, w2 = a * a + b * b, A_inf = 2;
constexpr double memory = 25, step = 0.025;  // s; e^{−25a} = 6e-4

double exact_K(double t) { return std::exp(-a * t) * (std::cos(b * t) - a / b * std::sin(b * t)); }
double D(double omega) { return std::pow(w2 - omega * omega, 2) + 4 * a * a * omega * omega; }
double exact_B(double omega) { return 2 * a * omega * omega / D(omega); }
double exact_A(double omega) { return A_inf + (w2 - omega * omega) / D(omega); }

DampingTable table_of(double last, int count) {
  DampingTable table;
  for (int i = 1; i <= count; ++i) {
    table.omega.push_back(last * i / count);
    table.B.push_back(Eigen::MatrixXd::Constant(1, 1, exact_B(table.omega.back())));
  }
  return table;
}

// ∫₀^L K cos ωt dt by Simpson's rule over the kernel's own samples.
double damping_from(const RetardationKernel& kernel, double omega) {
  double sum = 0;
  const std::size_t last = kernel.samples() - 1;
  for (std::size_t i = 0; i <= last; ++i) {
    const double weight = i == 0 || i == last ? 1 : i % 2 == 1 ? 4 : 2;
    sum += weight * kernel.at(i)(0, 0) * std::cos(omega * kernel.step() * static_cast<double>(i));
  }
  return sum * kernel.step() / 3;
}

// Error of B from K at low and middling frequencies, over: error of K along the memory, its missing end, Simpson's
// (step ω)⁴.
double error_of_damping(const RetardationKernel& kernel) {
  double worst = 0, largest_B = 0;
  for (double omega = 0.1; omega < 5; omega += 0.1) {
    worst = std::max(worst, std::abs(damping_from(kernel, omega) - exact_B(omega)));
    largest_B = std::max(largest_B, exact_B(omega));
  }
  const double simpson = kernel.length() / 180 * std::pow(kernel.step() * (5 + b), 4);
  return worst / (kernel.error_bound()(0, 0) * kernel.length() + kernel.truncation() * largest_B + simpson);
}

double error_of_infinite_added_mass(const DampingTable& table) {
  std::vector<Eigen::MatrixXd> A;
  for (const double omega : table.omega) A.push_back(Eigen::MatrixXd::Constant(1, 1, exact_A(omega)));
  const auto found = hydro::radiation::infinite_added_mass(table, A);
  return std::abs(found.value(0, 0) - A_inf) / found.spread(0, 0);
}

struct Given {
  std::string name;
  DampingTable table;
};

}  // namespace

Outcome outcome(const Folders&) {
  Outcome outcome;
  plot::Panel shape{.x = {.label = "t", .unit = "s"}, .y = {.label = "K"}, .series = {}};
  plot::Panel error{
      .x = {.label = "t", .unit = "s"}, .y = {.label = "error of K", .scale = plot::Scale::logarithmic}, .series = {}};
  for (const Given& given : {Given{"fine table", table_of(40, 2000)}, Given{"panel table", table_of(6, 60)}}) {
    const auto kernel = RetardationKernel::from_damping(given.table, {.step = step, .length = memory});
    plot::Series K{.name = given.name, .x = {}, .y = {}}, off{.name = given.name, .x = {}, .y = {}};
    for (std::size_t i = 0; i < kernel.samples(); ++i) {
      const double t = step * static_cast<double>(i);
      K.x.push_back(t), K.y.push_back(kernel.at(i)(0, 0));
      off.x.push_back(t), off.y.push_back(std::abs(kernel.at(i)(0, 0) - exact_K(t)));
    }
    const double worst = *std::max_element(off.y.begin(), off.y.end());
    outcome.numbers.push_back({given.name + ": largest error of K", worst, ""});
    outcome.numbers.push_back({given.name + ": error of K over its bound", worst / kernel.error_bound()(0, 0), ""});
    outcome.numbers.push_back({given.name + ": error of B from K over its bound", error_of_damping(kernel), ""});
    outcome.numbers.push_back({given.name + ": error of A at infinite frequency over its spread",
                               error_of_infinite_added_mass(given.table), ""});
    shape.series.push_back(std::move(K));
    error.series.push_back(std::move(off));
  }
  outcome.pictures = {{"kernel",
                       "Retardation function from tabulated damping, and its error.",
                       {.title = "A body whose memory is known exactly", .panels = {shape, error}}}};
  return outcome;
}

}  // namespace froude::validation::two_pole
