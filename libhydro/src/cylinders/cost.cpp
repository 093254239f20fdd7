#include <algorithm>
#include <chrono>

#include "deep.hpp"
#include "model.hpp"
#include "potential/operations/where_needed.hpp"
#include "potential/solver_request.hpp"
#include "request.hpp"

namespace hydro::cylinders {
namespace {

using Clock = std::chrono::steady_clock;

/// Complex multiplications a second of products of matrices on this machine, one thread.
double measured_rate() {
  constexpr Eigen::Index size = 128;
  const Eigen::MatrixXcd a = Eigen::MatrixXcd::Constant(size, size, {0.5, 0.1});
  Eigen::MatrixXcd b = a;
  double least = infinite;
  for (int run = 0; run < 5; ++run) {
    const auto start = Clock::now();
    b = (a * b / static_cast<double>(size)).eval();
    least = std::min(least, std::chrono::duration<double>(Clock::now() - start).count());
  }
  ensure(b.allFinite(), "products of matrices are finite");
  return static_cast<double>(size * size * size) / least;
}

/// One model a frequency, in the water that is used for it.
Model model_at(const std::vector<CylinderBody>& bodies, const Water& water, double omega,
               const Resolution& resolution) {
  return {bodies, effective_water(bodies, water, omega), resolution, {}, Model::Asked::cost};
}

}  // namespace

namespace {

double across(const std::vector<CylinderBody>& bodies) {
  std::vector<Cylinder> all;
  for (const CylinderBody& body : bodies) all.insert(all.end(), body.cylinders.begin(), body.cylinders.end());
  return distance_across(all);
}

}  // namespace

Cost cost(const std::vector<CylinderBody>& bodies, const Water& water, const std::vector<double>& first,
          const std::vector<double>& heading, const Options& options) {
  check(bodies, water.depth);
  check_request(first, heading, options);
  const std::vector<double> omega =
      options.frequency_tolerance
          ? potential::expected_frequencies(first, *options.frequency_tolerance, across(bodies), water)
          : first;
  const Resolution usual{1, share_of_tolerance * options.tolerance, options.equations};
  Cost c{0, 0, 0, 0, false};
  double work = 0, bytes = 0;
  const auto add = [&](double w, const Resolution& resolution) {
    const Model model = model_at(bodies, water, w, resolution);
    const ModelCost here = model.cost(w, static_cast<double>(heading.size()));
    if (water.depth.is_infinite()) work += model.building_work();
    c.unknowns = std::max(c.unknowns, here.unknowns);
    c.iterative = c.iterative || here.iterative;
    bytes = std::max(bytes, here.bytes);
    work += here.work;
  };
  for (const double w : omega) add(w, usual);
  add(infinite, usual);
  constexpr double to_choose = 6;  // models, and then one that serves
  work += (to_choose + 1) * model_at(bodies, water, infinite, usual).building_work();
  for (const std::size_t i : frequencies_to_double(omega.size(), options.doubled_frequencies))
    add(omega[i], usual.doubled());
  const int threads = potential::thread_count(options.threads, omega.size());
  c.frequencies = static_cast<int>(omega.size());
  c.bytes = bytes * threads;
  c.seconds = work / measured_rate() / threads;
  return c;
}

}  // namespace hydro::cylinders
