#include "hydro/radiation/choice.hpp"

#include <algorithm>
#include <cmath>

#include "hydro/base/error.hpp"
#include "hydro/radiation/convolution.hpp"
#include "hydro/radiation/partitioned.hpp"
#include "hydro/radiation/pole_memory.hpp"
#include "hydro/radiation/tail.hpp"

namespace hydro::radiation {

std::string name_of(Method method) {
  switch (method) {
    case Method::direct:
      return "direct";
    case Method::partitioned:
      return "partitioned";
    case Method::poles:
      return "poles";
  }
  return "";
}

DataError error_against(const DampingTable& damping, const std::vector<Eigen::MatrixXd>& A,
                        const Eigen::MatrixXd& A_inf, const std::vector<Eigen::MatrixXcd>& transforms) {
  Eigen::VectorXd largest = Eigen::VectorXd::Zero(damping.B.front().rows());
  for (const auto& B : damping.B) largest = largest.cwiseMax(B.diagonal().cwiseAbs());
  Eigen::VectorXd scale = Eigen::VectorXd::Zero(largest.size());  // modes without waves count for nothing, as in (R5)
  for (Eigen::Index i = 0; i < largest.size(); ++i)
    if (largest[i] > 1e-6 * largest.maxCoeff()) scale[i] = 1 / std::sqrt(largest[i]);
  DataError worst{0, damping.omega.front()};
  for (std::size_t k = 0; k < damping.omega.size(); ++k) {
    const std::complex<double> i_omega(0, damping.omega[k]);
    const Eigen::MatrixXcd off = transforms[k] - damping.B[k] - i_omega * (A[k] - A_inf);
    const double error = (scale.asDiagonal() * off.cwiseAbs() * scale.asDiagonal()).maxCoeff();
    if (error > worst.value) worst = {error, damping.omega[k]};
  }
  return worst;
}

namespace {

std::vector<Eigen::MatrixXcd> transforms(const PoleModel& model, const std::vector<double>& omega) {
  std::vector<Eigen::MatrixXcd> out;
  for (const double w : omega) out.push_back(model.transform(w));
  return out;
}

// Microseconds on one core of a 3 GHz machine (validation/cost/radiation): a number of the kernel read once in cache or
// from memory, a product of the partitioned sum, a product of a pole model, and what a step costs anyhow. (R20)
constexpr double read_near = 2.0e-4, read_far = 5.0e-4, near_numbers = 3e6, part_product = 3.0e-4,
                 pole_product = 1.2e-4, overhead = 0.3;

double direct_cost(double modes, double lags) {
  const double numbers = modes * (modes + 1) / 2 * lags;
  return overhead + numbers * (numbers < near_numbers ? read_near : read_far);
}

struct Weighed {
  std::optional<ExtrapolatedDamping> whole;
  std::shared_ptr<const MemorySurvey> survey;
  std::optional<MemoryGrid> grid;  // of the kernel, which is made only if it is taken
  std::optional<RationalFit> fit;
};

void weigh_convolutions(const DampingTable& damping, const std::vector<Eigen::MatrixXd>& A,
                        const std::optional<Eigen::MatrixXd>& A_inf, const MemoryDemand& demand, Weighed& w,
                        ChosenMemory& out) {
  w.whole = extrapolated(damping, A, A_inf);
  w.survey = std::make_shared<const MemorySurvey>(w.whole->table);
  const MemorySurvey& survey = *w.survey;
  const double length =
      demand.length ? *demand.length : survey.length(demand.tolerance / 2);  // half is left for the tail
  w.grid = MemoryGrid{demand.step, std::max(length, 2 * demand.step)};
  out.lags = w.grid->samples();
  out.truncation = survey.remaining_after(w.grid->kept());
  out.misfit = w.whole->misfit;
  out.shift = w.whole->shift;
  const auto error = error_against(damping, A, w.whole->A_inf, survey.transforms(damping.omega, w.grid->kept()));
  const auto modes = static_cast<int>(damping.B.front().rows());
  const double n = modes, lags = static_cast<double>(out.lags);
  if (demand.method.value_or(Method::direct) == Method::direct)
    out.alternatives.push_back({Method::direct, error.value, error.at_omega, direct_cost(n, lags), false});
  if (demand.method.value_or(Method::partitioned) == Method::partitioned)
    out.alternatives.push_back({Method::partitioned, error.value, error.at_omega,
                                overhead + part_product * PartitionedConvolution::mean_step(modes, out.lags), false});
}

void weigh_poles(const DampingTable& damping, const std::vector<Eigen::MatrixXd>& A,
                 const std::optional<Eigen::MatrixXd>& A_inf, const MemoryDemand& demand, const Fitting& fitting,
                 Weighed& w, ChosenMemory& out) {
  w.fit = fitting ? fitting() : fit(damping, A, A_inf, {.tolerance = demand.tolerance});
  out.fit = w.fit->report;
  const auto error = error_against(damping, A, w.fit->A_inf, transforms(w.fit->model, damping.omega));
  const double n = w.fit->model.modes();
  // A model that could give energy is not on offer.
  if (w.fit->report.passive || demand.method == Method::poles)
    out.alternatives.push_back(
        {Method::poles, error.value, error.at_omega, overhead + pole_product * n * n * w.fit->model.order(), false});
}

/// Index of the one to take: within the tolerance before outside, then cost; outside, error before cost.
std::size_t preferred(const std::vector<Alternative>& all) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < all.size(); ++i) {
    const Alternative &a = all[i], &b = all[best];
    const bool better = a.within != b.within             ? a.within
                        : a.within || a.error == b.error ? a.microseconds < b.microseconds
                                                         : a.error < b.error;
    if (better) best = i;
  }
  return best;
}

}  // namespace

ChosenMemory choose(const DampingTable& damping, const std::vector<Eigen::MatrixXd>& A,
                    const std::optional<Eigen::MatrixXd>& A_inf, const MemoryDemand& demand, const Fitting& fitting) {
  require(demand.tolerance > 0 && demand.step > 0, "a memory needs a positive tolerance and step");
  require(!(demand.length && demand.method == Method::poles), "a sum of exponentials has no length of memory to fix");
  ChosenMemory out;
  Weighed w;
  const bool wants_poles = demand.method ? *demand.method == Method::poles : !demand.length;
  if (demand.method != Method::poles) weigh_convolutions(damping, A, A_inf, demand, w, out);
  if (wants_poles && damping.omega.size() >= 4) weigh_poles(damping, A, A_inf, demand, fitting, w, out);
  require(!out.alternatives.empty(), "a rational fit needs four frequencies at least, got {}", damping.omega.size());
  for (Alternative& a : out.alternatives) a.within = a.error <= demand.tolerance;
  const Alternative& taken = out.alternatives[preferred(out.alternatives)];
  out.method = taken.method;
  out.why = demand.method  ? "asked for"
            : taken.within ? fmt::format("the cheapest within {:.2g} of the data", demand.tolerance)
                           : fmt::format("nearest to the data; none is within {:.2g}", demand.tolerance);
  out.negative_share = negative_share(damping);
  if (taken.method == Method::poles) {
    const auto memory = std::make_shared<const PoleMemory>(w.fit->model, demand.step);
    out.transform = [memory](double omega) { return memory->model().transform(omega); };
    out.memory = memory;
    out.A_inf = w.fit->A_inf;
    return out;
  }
  out.A_inf = w.whole->A_inf;
  const auto kernel = RetardationKernel::averaged(w.whole->table, *w.grid, *w.survey);
  out.transform = [survey = w.survey, length = kernel.length()](double omega) {
    return survey->transforms({omega}, length).front();
  };
  if (taken.method == Method::direct)
    out.memory = std::make_shared<DirectConvolution>(kernel);
  else
    out.memory = std::make_shared<PartitionedConvolution>(kernel);
  return out;
}

}  // namespace hydro::radiation
