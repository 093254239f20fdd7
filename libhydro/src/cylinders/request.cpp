#include "request.hpp"

#include <algorithm>
#include <cmath>

#include "hydro/base/parallel.hpp"

namespace hydro::cylinders {
namespace {

void require_increasing(const std::vector<double>& values, const char* what, const char* unit) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    require(std::isfinite(values[i]), "{} must be finite, got {} {}", what, values[i], unit);
    require(i == 0 || values[i] > values[i - 1], "{} must increase, but {} {} follows {}", what, values[i], unit,
            values[i == 0 ? 0 : i - 1]);
  }
}

}  // namespace

void check_request(const std::vector<double>& omega, const std::vector<double>& heading, const Options& options) {
  require(!omega.empty(), "no frequency is asked for");
  require_increasing(omega, "frequencies", "rad/s");
  require(omega.front() > 0, "a frequency must be positive, got {} rad/s", omega.front());
  require_increasing(heading, "headings", "rad");
  require(options.tolerance >= 1e-9 && options.tolerance <= 0.1, "the tolerance must be between 1e-9 and 0.1, got {}",
          options.tolerance);
  require(options.threads >= 0 && options.threads <= 1024, "the number of threads must be between 0 and 1024, got {}",
          options.threads);
  require(options.doubled_frequencies >= 0, "the number of frequencies to double must not be negative, got {}",
          options.doubled_frequencies);
}

int thread_count(const Options& options, std::size_t work) {
  const int wanted = options.threads > 0 ? options.threads : all_processors();
  return std::min(wanted, static_cast<int>(work));
}

std::vector<std::size_t> frequencies_to_double(std::size_t all, int wanted) {
  std::vector<std::size_t> chosen;
  const std::size_t count = std::min(all, static_cast<std::size_t>(wanted));
  for (std::size_t i = 0; i < count; ++i) chosen.push_back(count == 1 ? all / 2 : i * (all - 1) / (count - 1));
  return chosen;
}

}  // namespace hydro::cylinders
