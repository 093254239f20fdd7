#include "vector_fit.hpp"

#include <algorithm>
#include <cmath>

#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/product.hpp"
#include "hydro/base/random.hpp"
#include "pole_basis.hpp"

namespace hydro::radiation::detail {
namespace {

Eigen::MatrixXcd basis(const std::vector<Pole>& poles, const std::vector<double>& omega) {
  Eigen::MatrixXcd out(static_cast<Eigen::Index>(omega.size()), columns(poles));
  for (std::size_t i = 0; i < omega.size(); ++i) out.row(static_cast<Eigen::Index>(i)) = basis_at(poles, omega[i]);
  return out;
}

/// Zeros of σ(s) = d + Σ c_k φ_k(s): eigenvalues of A − b cᵀ/d, where φ_k is realised by blocks [−a b; −b −a] and b =
/// (1, 0).
std::vector<Pole> zeros(const std::vector<Pole>& poles, const Eigen::VectorXd& c, double d, double slowest) {
  const Eigen::Index n = c.size();
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(n), out = c;
  Eigen::Index at = 0;
  for (const Pole& p : poles) {
    b[at] = 1;
    A(at, at) = -p.decay;
    if (p.omega > 0) {
      A(at + 1, at + 1) = -p.decay;
      A(at, at + 1) = p.omega;
      A(at + 1, at) = -p.omega;
      out[at + 1] = -c[at + 1];
      ++at;
    }
    ++at;
  }
  const Eigen::VectorXcd zeros_of = dense::eigenvalues(A - b * out.transpose() / d);
  std::vector<Pole> found;
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto z = zeros_of[i];
    if (z.imag() < 0) continue;
    // A zero in the right half plane is mirrored: the modulus on the axis, which the data see, stays.
    found.push_back({std::max(std::abs(z.real()), slowest), z.imag() > 0 ? z.imag() : 0});
  }
  return found;
}

/// What is left of X, a function times σ's basis, once the functions that span Q are projected out, as its triangle R.
Eigen::MatrixXd by_factors(const Samples& s, const Eigen::MatrixXcd& sigma, const Eigen::MatrixXd& Q) {
  const Eigen::Index n = sigma.cols(), functions = s.values.cols();
  Eigen::MatrixXd out(functions * n, n);
  for (Eigen::Index f = 0; f < functions; ++f) {
    Eigen::MatrixXd X = s.weighted(s.values.col(f).asDiagonal() * sigma);
    X -= Q * (Q.transpose() * X);
    out.middleRows(f * n, n) = dense::HouseholderQr(X).R();
  }
  return out;
}

/// The triangle R of all of them together, RᵀR = Σ XᵀX − (QᵀX)ᵀ(QᵀX), in half of the time. Below what rounding takes of
/// the sums their difference has no digits: as much is added as makes it positive.
Eigen::MatrixXd by_squares(const Samples& s, const Eigen::MatrixXcd& sigma, const Eigen::MatrixXd& Q) {
  const Eigen::Index n = sigma.cols();
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(n, n), own = all;
  for (Eigen::Index f = 0; f < s.values.cols(); ++f) {
    const Eigen::MatrixXd X = s.weighted(s.values.col(f).asDiagonal() * sigma);
    all += transposed_product(X, X);
    const Eigen::MatrixXd along = transposed_product(Q, X);
    own += transposed_product(along, along);
  }
  const Eigen::VectorXd size = all.diagonal().cwiseMax(1e-300).cwiseSqrt(), scale = size.cwiseInverse();
  const Eigen::MatrixXd left = scale.asDiagonal() * (all - own) * scale.asDiagonal();
  for (double lost = 1e-13; lost < 1; lost *= 10) {
    Eigen::MatrixXd more = left;
    more.diagonal().array() += lost;
    if (const dense::Cholesky factors(more); factors) return factors.L().transpose() * size.asDiagonal();
  }
  throw NumericsError("the equations of a search of poles are not finite");
}

/// One relaxed step of vector fitting: the zeros of σ are the better poles.
std::vector<Pole> relocated(const Samples& s, const std::vector<Pole>& poles, double slowest) {
  const Eigen::MatrixXcd phi = basis(poles, s.omega);
  const Eigen::Index rows = phi.rows(), n = phi.cols();
  Eigen::MatrixXcd numerator(rows, n);  // (σK̂) with its zero at rest, and iω for a shift of A∞
  numerator.leftCols(n - 1) = phi * vanishing_at_rest(poles);
  for (Eigen::Index i = 0; i < rows; ++i) numerator(i, n - 1) = {0, s.omega[static_cast<std::size_t>(i)]};
  Eigen::MatrixXd F = s.weighted(numerator);
  const Eigen::VectorXd sizes = F.colwise().norm().cwiseInverse();
  F = F * sizes.asDiagonal();
  const Eigen::MatrixXd Q = dense::HouseholderQr(F).thin_Q();
  Eigen::MatrixXcd sigma(rows, n + 1);
  sigma << phi, Eigen::VectorXcd::Ones(rows);
  // Each function's own coefficients are projected out; what is left of it asks something of σ alone. Squares lose half
  // of the digits, which can be spared where data are many times the unknowns; few unknowns are quick either way.
  constexpr Eigen::Index many_times = 3, few = 64;
  const bool squares = n >= few && 2 * rows > many_times * (n + 1);
  const Eigen::MatrixXd left = squares ? by_squares(s, sigma, Q) : by_factors(s, sigma, Q);
  // Relaxed: the mean of Re σ is one, rather than its value at infinity, so that σ is not pulled by the start.
  const double size = s.weighted(s.values).norm() / static_cast<double>(rows);
  Eigen::MatrixXd system(left.rows() + 1, n + 1);
  system << left, size * sigma.real().colwise().sum();
  Eigen::VectorXd right = Eigen::VectorXd::Zero(system.rows());
  right[system.rows() - 1] = size * static_cast<double>(rows);
  const Eigen::VectorXd scale = system.colwise().norm().cwiseMax(1e-300).cwiseInverse();
  const Eigen::VectorXd x = scale.asDiagonal() * dense::PivotedQr(system * scale.asDiagonal()).solve(right);
  const double d = std::abs(x[n]) > 1e-8 ? x[n] : std::copysign(1e-8, x[n]);
  return zeros(poles, x.head(n), d, slowest);
}

}  // namespace

Eigen::MatrixXd Samples::weighted(const Eigen::MatrixXcd& functions) const {
  return weight.asDiagonal() * stacked(functions);
}

Eigen::MatrixXd vanishing_at_rest(const std::vector<Pole>& poles) {
  const Eigen::VectorXd at_rest = basis_at(poles, 0).real().transpose();
  const Eigen::Index n = at_rest.size();
  return dense::HouseholderQr(at_rest).full_Q().rightCols(n - 1);
}

Samples compressed(const Samples& s, double relative) {
  const Eigen::MatrixXd Y = s.weighted(s.values);
  // Y = U S Vᵀ by the smaller of YᵀY = V S² Vᵀ and YYᵀ = U S² Uᵀ; U S = Y V.
  const bool few = Y.cols() < Y.rows();
  const auto [values, vectors] =
      few ? dense::symmetric_eigen(Y.transpose() * Y) : dense::symmetric_eigen(Y * Y.transpose());
  const Eigen::VectorXd size = values.cwiseMax(0).cwiseSqrt();
  const Eigen::Index n = size.size(), rows = Y.rows() / 2;
  const auto kept = std::max<Eigen::Index>(1, (size.array() > relative * size[n - 1]).count());
  Eigen::MatrixXd U = vectors.rightCols(kept);
  if (few)
    U = Y * U;
  else
    U *= size.tail(kept).asDiagonal();
  // Signs are free; mixtures that follow shall not hang on what rounding made of them.
  for (auto column : U.colwise()) {
    Eigen::Index largest = 0;
    column.cwiseAbs().maxCoeff(&largest);
    if (column[largest] < 0) column = -column;
  }
  Samples out{s.omega, s.weight, Eigen::MatrixXcd(rows, kept)};
  out.values.real() = s.weight.head(rows).cwiseInverse().asDiagonal() * U.topRows(rows);
  out.values.imag() = s.weight.tail(rows).cwiseInverse().asDiagonal() * U.bottomRows(rows);
  return out;
}

Samples mixed(const Samples& s, Eigen::Index most) {
  const Eigen::Index functions = s.values.cols();
  if (functions <= most) return s;
  const RandomStream normal(0, 0);
  Eigen::MatrixXd mix(functions, most);
  for (Eigen::Index i = 0; i < mix.size(); ++i)
    mix.data()[i] = normal.normal(static_cast<std::uint64_t>(i)) / std::sqrt(static_cast<double>(most));
  return {s.omega, s.weight, s.values * mix};
}

std::vector<Pole> grown(std::vector<Pole> poles, int order, const std::vector<double>& omega, Eigen::VectorXd missed) {
  const auto spacing = [&](std::size_t i) {
    const std::size_t before = i == 0 ? 0 : i - 1, after = std::min(i + 1, omega.size() - 1);
    return (omega[after] - omega[before]) / static_cast<double>(after - before);
  };
  while (columns(poles) < order) {
    Eigen::Index worst = 0;
    missed.maxCoeff(&worst);
    const auto at = static_cast<std::size_t>(worst);
    const double width = std::max(spacing(at), 0.01 * omega[at]);
    poles.push_back({width, omega[at]});
    // What a pair explains no other is needed for.
    for (std::size_t i = 0; i < omega.size(); ++i) {
      const double apart = (omega[i] - omega[at]) / (2 * width);
      missed[static_cast<Eigen::Index>(i)] *= 1 - std::exp(-apart * apart);
    }
  }
  return poles;
}

std::vector<Pole> spread(const std::vector<double>& omega, int order) {
  std::vector<Pole> poles;
  const int pairs = order / 2;
  const double last = omega.back();
  for (int i = 0; i < pairs; ++i) {
    const double at = omega.front() + (last - omega.front()) * (i + 0.5) / pairs;
    poles.push_back({0.02 * last / pairs + 0.01 * at, at});
  }
  return poles;
}

std::vector<Pole> settled(const Samples& samples, std::vector<Pole> poles, int rounds, double slowest) {
  for (int i = 0; i < rounds; ++i) poles = relocated(samples, poles, slowest);
  std::sort(poles.begin(), poles.end(), [](const Pole& p, const Pole& q) { return p.omega < q.omega; });
  return poles;
}

}  // namespace hydro::radiation::detail
