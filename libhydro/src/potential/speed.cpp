#include "speed.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <chrono>
#include <limits>

#include "hydro/base/error.hpp"

namespace hydro::potential {

double multiplications_per_second() {
  using Clock = std::chrono::steady_clock;
  constexpr Eigen::Index size = 128;
  const Eigen::MatrixXcd a = Eigen::MatrixXcd::Constant(size, size, {0.5, 0.1});
  Eigen::MatrixXcd b = a;
  double least = std::numeric_limits<double>::infinity();
  for (int run = 0; run < 5; ++run) {
    const auto start = Clock::now();
    b = (a * b / static_cast<double>(size)).eval();
    least = std::min(least, std::chrono::duration<double>(Clock::now() - start).count());
  }
  ensure(b.allFinite(), "products of matrices are finite");
  return static_cast<double>(size * size * size) / least;
}

}  // namespace hydro::potential
