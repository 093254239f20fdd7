#include "request.hpp"

#include "potential/solver_request.hpp"

namespace hydro::cylinders {
void check_request(const std::vector<double>& omega, const std::vector<double>& heading, const Options& options) {
  potential::check_solver_request(omega, heading, options.threads);
  require(options.tolerance >= 1e-9 && options.tolerance <= 0.1, "the tolerance must be between 1e-9 and 0.1, got {}",
          options.tolerance);
  potential::check_frequency_tolerance(options.frequency_tolerance, omega.size());
  if (options.frequency_tolerance)
    require(*options.frequency_tolerance >= 10 * options.tolerance,
            "frequencies cannot be foreseen to {:.2g} where each is solved to {:.2g}: ten times that is needed",
            *options.frequency_tolerance, options.tolerance);
  require(options.doubled_frequencies >= 0, "the number of frequencies to double must not be negative, got {}",
          options.doubled_frequencies);
}

std::vector<std::size_t> frequencies_to_double(std::size_t all, int wanted) {
  return potential::spread(all, wanted, all / 2);
}

}  // namespace hydro::cylinders
