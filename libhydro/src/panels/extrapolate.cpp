#include "extrapolate.hpp"

#include <algorithm>
#include <cmath>

namespace hydro::panels {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// By what the error falls as panels are halved: measured 2.4 to 3.4 on graded cylinders and boxes, √8 in the middle.
const double usual_ratio = std::sqrt(8.0);
constexpr double least_ratio = 2, greatest_ratio = 4;

/// The last difference over (ratio − 1), Richardson's step; the ratio of the last two differences, if there are two
/// that have one sign, within what theory knows.
template <class Matrix>
Matrix richardson(const std::vector<const Matrix*>& v) {
  const std::size_t n = v.size();
  Matrix step = *v[n - 1] - *v[n - 2];
  for (Index i = 0; i < step.rows(); ++i)
    for (Index j = 0; j < step.cols(); ++j) {
      double ratio = usual_ratio;
      if (n > 2 && std::abs(step(i, j)) > 0) {
        const auto observed = ((*v[n - 2])(i, j) - (*v[n - 3])(i, j)) / step(i, j);
        if (std::real(observed) > 0) ratio = std::clamp(std::abs(observed), least_ratio, greatest_ratio);
      }
      step(i, j) /= ratio - 1;
    }
  return step;
}

}  // namespace

OneFrequency sum(const OneFrequency& a, double s, const OneFrequency& b) {
  return {a.A + s * b.A,
          a.B + s * b.B,
          a.B_far + s * b.B_far,
          a.X + s * b.X,
          a.X_far + s * b.X_far,
          std::max(a.partial_waves, b.partial_waves),
          a.A_parts + s * b.A_parts,
          a.B_parts + s * b.B_parts,
          a.X_parts + s * b.X_parts};
}

Extrapolated sum(const Extrapolated& a, double s, const Extrapolated& b) {
  Extrapolated out = a;
  for (std::size_t i = 0; i < out.size(); ++i) out[i] += s * b[i];
  return out;
}

Extrapolated step_to_the_limit(const std::vector<const Extrapolated*>& all) {
  Extrapolated out;
  for (std::size_t i = 0; i < all.front()->size(); ++i) {
    std::vector<const Eigen::MatrixXcd*> values;
    for (const Extrapolated* one : all) values.push_back(&(*one)[i]);
    out.push_back(richardson(values));
  }
  return out;
}

MatrixXd step_to_the_limit(const std::vector<MatrixXd>& all) {
  std::vector<const MatrixXd*> values;
  for (const MatrixXd& one : all) values.push_back(&one);
  return richardson(values);
}

double doubtful_share(std::size_t meshes) { return meshes > 2 ? 0.3 : 0.6; }

double doubtful_share_of_parts(std::size_t meshes) { return meshes > 2 ? 0.5 : 1; }

std::vector<Extrapolated> Solver::scales(const std::vector<const Extrapolated*>&) const { return {}; }

std::vector<Extrapolated> scales_of_waves(const std::vector<const Extrapolated*>& solved) {
  constexpr double least_of_largest = 1e-12;  // rounding
  using Eigen::VectorXd;
  const auto sizes_of = [](const Extrapolated& one, std::size_t matrix) -> VectorXd {
    const Eigen::MatrixXcd& M = one[matrix];
    if (matrix < 3) return M.diagonal().cwiseAbs();
    return M.cols() > 0 ? VectorXd(M.cwiseAbs().rowwise().maxCoeff()) : VectorXd::Zero(M.rows());
  };
  std::vector<Extrapolated> out;
  for (const Extrapolated* one : solved) {
    out.emplace_back();
    for (const Eigen::MatrixXcd& M : *one) out.back().push_back(Eigen::MatrixXcd::Ones(M.rows(), M.cols()));
  }
  constexpr std::size_t added_mass_of_parts = 5;  // as that of the whole, it does not vanish
  for (std::size_t m = 1; m < solved.front()->size(); ++m) {
    if (m == added_mass_of_parts) continue;
    VectorXd largest = sizes_of(*solved.front(), m);
    for (const Extrapolated* one : solved) largest = largest.cwiseMax(sizes_of(*one, m));
    VectorXd so_far = least_of_largest * largest;
    for (std::size_t i = 0; i < solved.size(); ++i) {
      so_far = so_far.cwiseMax(sizes_of(*solved[i], m));
      const VectorXd s = (largest.array() > 0).select(so_far, VectorXd::Ones(largest.size()));
      if (m < 3)
        out[i][m] = (s.cwiseSqrt() * s.cwiseSqrt().transpose()).cast<std::complex<double>>();
      else
        out[i][m].colwise() = s.cast<std::complex<double>>();
    }
  }
  return out;
}

std::vector<double> cubic_weights(const std::vector<double>& nodes, double x, int without) {
  std::vector<std::size_t> used;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (static_cast<int>(i) != without) used.push_back(i);
  // Two on each side of x, as far as there are: nodes that crowd about a resonance are not taken for what lies beside
  // it.
  const auto above = std::partition_point(used.begin(), used.end(), [&](std::size_t i) { return nodes[i] < x; });
  const std::ptrdiff_t left = std::max<std::ptrdiff_t>(above - used.begin() - 2, 0);
  const std::ptrdiff_t count = std::min<std::ptrdiff_t>(std::ssize(used), 4);
  used.erase(used.begin(), used.begin() + std::min(left, std::ssize(used) - count));
  used.resize(static_cast<std::size_t>(count));
  std::vector<double> weights(nodes.size(), 0);
  for (const std::size_t i : used) {
    weights[i] = 1;
    for (const std::size_t j : used)
      if (j != i) weights[i] *= (x - nodes[j]) / (nodes[i] - nodes[j]);
  }
  return weights;
}

}  // namespace hydro::panels
