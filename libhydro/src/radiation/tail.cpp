#include "hydro/radiation/tail.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"
#include "polygon.hpp"

namespace hydro::radiation {
namespace {

using detail::EndWeights;
using detail::flattened;

constexpr double two_over_pi = 2 / std::numbers::pi;
/// Corners of the tail in units of the last frequency; the first has the table's last value, the last is zero.
constexpr std::array<double, 7> corners{1, 1.15, 1.35, 1.6, 2, 2.7, 4};
constexpr Eigen::Index free_corners = corners.size() - 2;

/// Principal value of (2/π) ∫_a^b f(ν)/(ν² − ω²) dν for f straight, ω not a or b. (R10) Its logarithms are kept from
/// one end to the next begin: pieces that follow each other share them.
class AddedMassWeights {
 public:
  explicit AddedMassWeights(double omega) : omega_(omega) {}

  EndWeights operator()(double a, double b) {
    const Ends at_a = a == at_ ? logarithms_ : at(a);
    logarithms_ = at(b);
    at_ = b;
    const double dL = logarithms_.L - at_a.L, dQ = logarithms_.Q - at_a.Q, h = b - a;
    return {two_over_pi * (b * dL - dQ) / h, two_over_pi * (dQ - a * dL) / h};
  }

 private:
  struct Ends {
    double L, Q;
  };
  Ends at(double v) const {
    return {std::log(std::abs((v - omega_) / (v + omega_))) / (2 * omega_),
            std::log(std::abs(v * v - omega_ * omega_)) / 2};
  }

  double omega_, at_ = -1;
  Ends logarithms_{};
};

EndWeights added_mass_weights(double a, double b, double omega) { return AddedMassWeights(omega)(a, b); }

/// Added mass at ω of a unit corner of the tail.
double corner_weight(std::size_t corner, double last, double omega) {
  double sum = 0;
  if (corner > 0) sum += added_mass_weights(corners[corner - 1] * last, corners[corner] * last, omega).b;
  if (corner + 1 < corners.size())
    sum += added_mass_weights(corners[corner] * last, corners[corner + 1] * last, omega).a;
  return sum;
}

/// The fit of (R11) for all pairs at once: they share the design matrix.
struct Problem {
  std::vector<double> omega;  // where A is compared: middles of pieces, off the corners of B
  Eigen::MatrixXd design,
      right;  // rows: omega; columns: free corners and, where A∞ is not known, a constant; right: pairs
};

Problem problem(const DampingTable& damping, const std::vector<Eigen::MatrixXd>& A,
                const std::optional<Eigen::MatrixXd>& A_inf) {
  const detail::Polygon polygon(damping.omega);
  const auto& node = polygon.nodes();
  const double first = damping.omega.front(), last = damping.omega.back();
  Problem p;
  for (std::size_t i = 0; i + 1 < node.size(); i += 2)
    if (const double middle = (node[i] + node[i + 1]) / 2; middle > first && middle < 0.95 * last)
      p.omega.push_back(middle);
  const auto rows = static_cast<Eigen::Index>(p.omega.size());
  p.design = Eigen::MatrixXd::Ones(rows, free_corners + (A_inf ? 0 : 1));
  p.right.resize(rows, A.front().size());
  const Eigen::MatrixXd all_A = flattened(A), all_B = flattened(damping.B);
  for (Eigen::Index r = 0; r < rows; ++r) {
    const double omega = p.omega[static_cast<std::size_t>(r)];
    std::vector<double> known = polygon.gather(AddedMassWeights(omega));
    known.back() += corner_weight(0, last, omega);
    const Eigen::RowVectorXd at_omega = combined(cubic_stencil(damping.omega, omega), A.size(), [&](std::size_t i) {
      return Eigen::RowVectorXd(all_A.row(static_cast<Eigen::Index>(i)));
    });
    p.right.row(r) =
        at_omega - Eigen::Map<const Eigen::RowVectorXd>(known.data(), static_cast<Eigen::Index>(known.size())) * all_B;
    if (A_inf) p.right.row(r) -= A_inf->reshaped().transpose();
    for (Eigen::Index k = 0; k < free_corners; ++k)
      p.design(r, k) = corner_weight(static_cast<std::size_t>(k) + 1, last, omega);
  }
  return p;
}

/// Adds the rows that prefer a straight tail: second differences over the corners, the two known ends included.
void prefer_straightness(Problem& p, const Eigen::RowVectorXd& last_B) {
  // A hundredth of the data's weight kept wiggles, a tenth bent the fit; between them the tail hardly depends on it.
  constexpr double preference = 0.03;
  const double weight = preference * p.design.leftCols(free_corners).cwiseAbs().maxCoeff() *
                        std::sqrt(static_cast<double>(p.design.rows()));
  const Eigen::Index rows = p.design.rows();
  p.design.conservativeResize(rows + free_corners, Eigen::NoChange);
  p.right.conservativeResize(rows + free_corners, Eigen::NoChange);
  p.design.bottomRows(free_corners).setZero();
  p.right.bottomRows(free_corners).setZero();
  for (Eigen::Index k = 0; k < free_corners; ++k) {
    const auto c = static_cast<std::size_t>(k) + 1;
    const double h0 = corners[c] - corners[c - 1], h1 = corners[c + 1] - corners[c];
    const double before = 2 * h1 / (h0 + h1), after = 2 * h0 / (h0 + h1);  // h₀h₁ times the second divided difference
    p.design(rows + k, k) = -2 * weight;
    if (k > 0) p.design(rows + k, k - 1) = before * weight;
    if (k + 1 < free_corners) p.design(rows + k, k + 1) = after * weight;
    if (k == 0) p.right.row(rows) = -before * weight * last_B;
  }
}

/// The nearest matrix that takes no power from nowhere: negative eigenvalues, in modes scaled by `size`, are set to
/// zero. (R11)
Eigen::MatrixXd passive(const Eigen::MatrixXd& B, const Eigen::VectorXd& size) {
  const Eigen::MatrixXd scaled =
      size.cwiseInverse().asDiagonal() * dense::symmetric_part(B) * size.cwiseInverse().asDiagonal();
  return size.asDiagonal() * dense::positive_part(scaled) * size.asDiagonal();
}

}  // namespace

Eigen::MatrixXd added_mass_above_limit(const DampingTable& damping, double omega) {
  require(omega > 0, "added mass is asked for at {} rad/s; frequencies must be positive", omega);
  const detail::Polygon polygon(damping.omega);
  double nearest = std::abs(omega - polygon.nodes().front());
  for (const double node : polygon.nodes()) nearest = std::min(nearest, std::abs(omega - node));
  // At a corner the logarithms of the two pieces are infinite and cancel: the mean of both sides is the limit.
  const double aside = nearest < 1e-7 * omega ? 1e-6 * omega : 0;
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(damping.B.front().rows(), damping.B.front().cols());
  for (const double at : {omega - aside, omega + aside}) {
    const auto weight = polygon.gather(AddedMassWeights(at));
    for (std::size_t j = 0; j < weight.size(); ++j) sum += weight[j] / 2 * damping.B[j];
  }
  return sum;
}

Eigen::MatrixXd damping_from_added_mass(const std::vector<double>& given, const std::vector<Eigen::MatrixXd>& A,
                                        const Eigen::MatrixXd& A_inf, double omega) {
  require(!given.empty() && given.size() == A.size(), "added mass and its frequencies differ in number: {} and {}",
          A.size(), given.size());
  require(omega > 0 && omega < given.back(), "damping is asked for at {} rad/s; the added mass tells it up to {}",
          omega, given.back());
  // The part above the first value goes to zero with ω, as the polygon takes it; the constant below it is integrated by
  // hand: ∫₀^Ω dν/(ν² − ω²) = ln|(Ω−ω)/(Ω+ω)|/2ω.
  DampingTable above{given, {}};
  for (const auto& a : A) above.B.push_back(a - A.front());
  const double last = given.back(), log = std::log((last - omega) / (last + omega)) / (2 * omega);
  return -omega * omega * (added_mass_above_limit(above, omega) + two_over_pi * log * (A.front() - A_inf));
}

ExtrapolatedDamping extrapolated(const DampingTable& damping, const std::vector<Eigen::MatrixXd>& A,
                                 const std::optional<Eigen::MatrixXd>& A_inf) {
  require(A.size() == damping.omega.size() && damping.omega.size() >= 3,
          "a tail needs added mass and damping at three frequencies at least, got {} and {}", A.size(),
          damping.omega.size());
  const Eigen::Index n = damping.B.front().rows();
  Problem p = problem(damping, A, A_inf);
  const Eigen::Index rows = p.design.rows();
  prefer_straightness(p, damping.B.back().reshaped().transpose());
  Eigen::MatrixXd found = dense::PivotedQr(p.design).solve(p.right);

  ExtrapolatedDamping out;
  out.table = damping;
  out.A_inf = A_inf ? *A_inf : Eigen::MatrixXd(found.row(free_corners).reshaped(n, n));
  const Eigen::VectorXd size =
      out.A_inf.diagonal().cwiseAbs().cwiseMax(1e-12 * out.A_inf.cwiseAbs().maxCoeff()).cwiseSqrt();
  for (Eigen::Index k = 0; k < free_corners; ++k)
    found.row(k) = passive(found.row(k).reshaped(n, n), size).reshaped().transpose();
  const double last = damping.omega.back(), spacing = last - damping.omega[damping.omega.size() - 2];
  const auto count = static_cast<int>(std::lround((corners.back() - 1) * last / spacing));
  for (int i = 1; i <= count; ++i) {
    const double omega = last * (1 + (corners.back() - 1) * i / count);
    const Stencil s = straight_stencil(corners, omega / last);
    Eigen::MatrixXd B = Eigen::MatrixXd::Zero(n, n);
    for (std::size_t k = 0; k < 2; ++k) {
      const std::size_t corner = s.first + k;
      if (corner == 0)
        B += s.weight[k] * damping.B.back();
      else if (corner <= free_corners)
        B += s.weight[k] * found.row(static_cast<Eigen::Index>(corner) - 1).reshaped(n, n);
    }
    out.table.omega.push_back(omega);
    out.table.B.push_back(std::move(B));
  }
  // What the passive tail and the data's own scatter leave over the slower motions goes into the constant.
  Eigen::MatrixXd left = p.design.topRows(rows) * found - p.right.topRows(rows);
  const auto slow = std::max<Eigen::Index>(
      1, std::count_if(p.omega.begin(), p.omega.end(), [&](double omega) { return omega <= 0.6 * last; }));
  const Eigen::RowVectorXd mean = left.topRows(slow).colwise().mean();
  left.rowwise() -= mean;
  out.A_inf -= mean.reshaped(n, n);
  const Eigen::MatrixXd rms = (left.topRows(slow).cwiseAbs2().colwise().mean()).cwiseSqrt().reshaped(n, n);
  out.misfit = (size.cwiseInverse().asDiagonal() * rms * size.cwiseInverse().asDiagonal()).maxCoeff();
  out.shift =
      (size.cwiseInverse().asDiagonal() * mean.reshaped(n, n).cwiseAbs() * size.cwiseInverse().asDiagonal()).maxCoeff();
  return out;
}

}  // namespace hydro::radiation
