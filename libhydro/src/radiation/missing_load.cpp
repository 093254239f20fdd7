#include "hydro/radiation/missing_load.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <numbers>

#include "hydro/base/error.hpp"
#include "hydro/base/interpolation.hpp"
#include "hydro/signal/fft.hpp"

namespace hydro::radiation {
namespace {

/// dv/dt by parabolas through three samples, (n, samples).
Eigen::MatrixXd derivative(const Eigen::MatrixXd& v, double spacing) {
  const Eigen::Index last = v.cols() - 1;
  if (last < 2) return Eigen::MatrixXd::Zero(v.rows(), v.cols());
  Eigen::MatrixXd out(v.rows(), v.cols());
  out.middleCols(1, last - 1) = (v.rightCols(last - 1) - v.leftCols(last - 1)) / (2 * spacing);
  out.col(0) = (-3 * v.col(0) + 4 * v.col(1) - v.col(2)) / (2 * spacing);
  out.col(last) = (3 * v.col(last) - 4 * v.col(last - 1) + v.col(last - 2)) / (2 * spacing);
  return out;
}

/// Z without the added mass of its last frequency.
class Remainder {
 public:
  explicit Remainder(const MissingImpedance& missing)
      : m_(missing), A_last_(missing.Z.back().imag() / missing.omega.back()) {}

  const Eigen::MatrixXd& A_last() const { return A_last_; }
  Eigen::MatrixXcd at(double omega) const {
    const double last = m_.omega.back();
    if (omega >= last) return std::pow(last / omega, 2) * m_.Z.back().real().cast<std::complex<double>>();
    const double inside = std::max(omega, m_.omega.front());
    Eigen::MatrixXcd Z = combined(cubic_stencil(m_.omega, inside), m_.omega.size(),
                                  [&](std::size_t k) -> const Eigen::MatrixXcd& { return m_.Z[k]; });
    Z -= std::complex<double>(0, inside) * A_last_;
    return Z;
  }

 private:
  const MissingImpedance& m_;
  Eigen::MatrixXd A_last_;
};

/// Samples over which a motion fades after its end, ten of the shortest periods of the table. What comes after the end
/// has no part in the load before it, but a motion cut off there would ring by the end of the table.
std::size_t fading(const MissingImpedance& missing, double spacing) {
  return static_cast<std::size_t>(20 * std::numbers::pi / missing.omega.back() / spacing) + 1;
}

/// One velocity, its fading and nothing, `length` samples in all.
std::vector<double> followed_by_nothing(const Eigen::RowVectorXd& velocity, std::size_t fading, std::size_t length) {
  std::vector<double> out(velocity.begin(), velocity.end());
  for (std::size_t k = 1; k < fading; ++k)
    out.push_back(velocity[velocity.size() - 1] *
                  std::pow(std::cos(std::numbers::pi / 2 * static_cast<double>(k) / static_cast<double>(fading)), 2));
  out.resize(length, 0.0);
  out.front() /= 2;  // a motion that begins at speed jumps there: the trapezium rule
  return out;
}

/// Samples after which a transform repeats: the run, and twice the time after which frequencies so far apart echo.
std::size_t padded(const MissingImpedance& missing, std::size_t samples, double spacing) {
  const double apart = missing.omega.back() / static_cast<double>(std::max<std::size_t>(missing.omega.size() - 1, 1));
  const double echoes = 4 * std::numbers::pi / apart / spacing;
  return std::bit_ceil(samples + fading(missing, spacing) + std::max(samples, static_cast<std::size_t>(echoes)));
}

}  // namespace

Eigen::MatrixXd missing_load(const MissingImpedance& missing, const Eigen::MatrixXd& velocity, double spacing) {
  require(!missing.omega.empty() && missing.omega.size() == missing.Z.size() && missing.omega.back() > 0,
          "a missing impedance needs frequencies, as many as matrices");
  require(missing.Z.front().rows() == velocity.rows() && spacing > 0,
          "velocities of {} modes meet a missing impedance of {}", velocity.rows(), missing.Z.front().rows());
  const Eigen::Index n = velocity.rows(), samples = velocity.cols();
  const std::size_t length = padded(missing, static_cast<std::size_t>(samples), spacing), half = length / 2 + 1;
  Eigen::MatrixXcd spectrum(n, static_cast<Eigen::Index>(half));
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto V = signal::real_fft(followed_by_nothing(velocity.row(i), fading(missing, spacing), length));
    spectrum.row(i) = Eigen::Map<const Eigen::RowVectorXcd>(V.data(), static_cast<Eigen::Index>(half));
  }
  const Remainder Z(missing);
  const double turn = 2 * std::numbers::pi / (static_cast<double>(length) * spacing);
  for (Eigen::Index k = 0; k < static_cast<Eigen::Index>(half); ++k)
    spectrum.col(k) = -(Z.at(turn * static_cast<double>(k)) * spectrum.col(k)).eval();
  Eigen::MatrixXd load = -Z.A_last() * derivative(velocity, spacing);
  std::vector<std::complex<double>> row(half);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < half; ++k) row[k] = spectrum(i, static_cast<Eigen::Index>(k));
    const std::vector<double> force = signal::inverse_real_fft(row, length);
    for (Eigen::Index t = 0; t < samples; ++t)
      load(i, t) += force[static_cast<std::size_t>(t)] / static_cast<double>(length);
  }
  return load;
}

}  // namespace hydro::radiation
