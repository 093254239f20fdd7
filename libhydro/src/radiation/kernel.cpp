#include "hydro/radiation/kernel.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "averaged.hpp"
#include "corners.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/product.hpp"
#include "polygon.hpp"

namespace hydro::radiation {
namespace {

using detail::EndWeights;
using detail::oscillating_weights;

constexpr double two_over_pi = 2 / std::numbers::pi;

EndWeights cosine_weights(double a, double b, double t) { return oscillating_weights(a, b, t, 0); }
EndWeights sine_weights(double a, double b, double t) { return oscillating_weights(a, b, t, std::numbers::pi / 2); }

Eigen::VectorXd largest_diagonal(const DampingTable& damping) {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(damping.B.front().rows());
  for (const auto& B : damping.B) out = out.cwiseMax(B.diagonal().cwiseAbs());
  return out;
}

// Panel codes scatter around zero damping: by a few hundredths of a mode's own largest at irregular frequencies near
// the end of a table, and by round-off of the others for a mode that makes no waves at all (yaw of a body of
// revolution).
constexpr double scatter = 0.05, round_off = 1e-6;

/// Most negative B_ii relative to the largest of its mode, modes without waves left out; 0 or more.
double most_negative(const DampingTable& damping) {
  const Eigen::VectorXd largest = largest_diagonal(damping);
  double share = 0;
  for (const auto& B : damping.B)
    for (Eigen::Index i = 0; i < largest.size(); ++i)
      if (largest[i] > round_off * largest.maxCoeff()) share = std::max(share, -B(i, i) / largest[i]);
  return share;
}

void check(const DampingTable& damping) {
  require(!damping.omega.empty() && damping.omega.size() == damping.B.size(), "the damping table is empty or ragged");
  require(damping.omega.front() > 0, "damping is given at {} rad/s; frequencies must be positive",
          damping.omega.front());
  for (std::size_t i = 1; i < damping.omega.size(); ++i)
    require(damping.omega[i] > damping.omega[i - 1], "damping frequencies do not increase at {} rad/s",
            damping.omega[i]);
  const Eigen::VectorXd largest = largest_diagonal(damping);
  for (Eigen::Index mode = 0; mode < largest.size(); ++mode) {
    const double tolerated = std::max(scatter * largest[mode], round_off * largest.maxCoeff());
    for (std::size_t i = 0; i < damping.omega.size(); ++i)
      if (damping.B[i](mode, mode) < -tolerated)
        throw InputError(
            fmt::format("radiation damping of mode {} is negative, {:.4g} at {:.4g} rad/s: a hull at rest in calm "
                        "water cannot be a source of power",
                        mode, damping.B[i](mode, mode), damping.omega[i]),
            {}, "look at the data with `froude bem check`, or put them right with `froude bem heal --passivity`");
  }
}

/// What is missing beyond the last frequency, ∫ B dω, if B_ii falls on as the power that its last octave shows. Near a
/// peak B falls faster than it goes on to, so no more than ω⁻² is credited; less than ω^−1.25 is not believed, since
/// K(0) is finite. Pairs by |B_ij| ≤ √(B_ii B_jj). (R4)
Eigen::MatrixXd missing_tail(const DampingTable& damping) {
  const Eigen::Index n = damping.B.front().rows();
  const double last = damping.omega.back();
  const auto middle = static_cast<std::size_t>(std::lower_bound(damping.omega.begin(), damping.omega.end(), last / 2) -
                                               damping.omega.begin());
  Eigen::VectorXd tail(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double end = std::abs(damping.B.back()(i, i)), mid = std::abs(damping.B[middle](i, i));
    const double octaves = std::log(last / damping.omega[middle]);
    const double slope = octaves > 0 && end > 0 && mid > 0 ? std::log(mid / end) / octaves : 2;
    tail[i] = two_over_pi * end * last / (std::clamp(slope, 1.25, 2.0) - 1);
  }
  return (tail * tail.transpose()).cwiseSqrt();
}

/// Error of taking B as straight between samples: ∫ |B''| (ω−a)(b−ω)/2 dω = |B''| h³/12 on each interval, the second
/// derivative from three neighbouring samples. (R4)
Eigen::MatrixXd bend(const DampingTable& damping) {
  const auto& w = damping.omega;
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(damping.B.front().rows(), damping.B.front().cols());
  for (std::size_t i = 0; i + 1 < w.size(); ++i) {
    // The first interval, from ω = 0 where B = 0, bends like the one after it.
    const double before = i == 0 ? 0 : w[i - 1], h0 = w[i] - before, h1 = w[i + 1] - w[i];
    const Eigen::MatrixXd B_before = i == 0 ? Eigen::MatrixXd::Zero(sum.rows(), sum.cols()) : damping.B[i - 1];
    const Eigen::MatrixXd second =
        2 * ((damping.B[i + 1] - damping.B[i]) / h1 - (damping.B[i] - B_before) / h0) / (h0 + h1);
    sum += two_over_pi * second.cwiseAbs() * (h0 * h0 * h0 + h1 * h1 * h1) / 2 / 12 *
           (i == 0 || i + 2 == w.size() ? 1.5 : 1);
  }
  return sum;
}

/// K(t) of a table by (R3).
class CosineTransform {
 public:
  /// `share`: places at which B bends less than this share of its largest value are left out of each().
  explicit CosineTransform(const DampingTable& damping, double share = 1e-13)
      : damping_(damping), polygon_(damping.omega), share_(share) {}

  Eigen::MatrixXd at(double t) const {
    const auto weight = polygon_.gather([t](double a, double b) { return cosine_weights(a, b, t); });
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(damping_.B.front().rows(), damping_.B.front().cols());
    for (std::size_t j = 0; j < weight.size(); ++j) K += two_over_pi * weight[j] * damping_.B[j];
    return K;
  }

  /// K at 0, step, 2 step … by the corners of B (R23).
  template <class Use>
  void each(double step, std::size_t count, Use use) const {
    const detail::Corners B = corners();
    const Eigen::MatrixXd jumps = B.jumps();
    const Eigen::Index n = damping_.B.front().rows(), last = B.at.size() - 1;
    const Eigen::ArrayXd turn_c = (B.at * step).cos(), turn_s = (B.at * step).sin();
    constexpr std::size_t batch = 64;  // products of rotations are off by as many roundings
    Eigen::MatrixXd cosines(B.at.size(), static_cast<Eigen::Index>(batch)), K;
    Eigen::RowVectorXd end(static_cast<Eigen::Index>(batch));
    for (std::size_t first = 0; first < count; first += batch) {
      const auto size = static_cast<Eigen::Index>(std::min(batch, count - first));
      Eigen::ArrayXd c = (B.at * (static_cast<double>(first) * step)).cos(),
                     s = (B.at * (static_cast<double>(first) * step)).sin(), on;
      for (Eigen::Index i = 0; i < size; ++i) {
        cosines.col(i) = c.matrix();
        end[i] = s[last];
        on = turn_c * c - turn_s * s;
        s = turn_s * c + turn_c * s;
        c.swap(on);
      }
      K = transposed_product(jumps, cosines.leftCols(size));
      for (Eigen::Index i = 0; i < size; ++i) {
        const std::size_t sample = first + static_cast<std::size_t>(i);
        const double t = static_cast<double>(sample) * step;
        if (t * B.at[last] < late) {
          use(sample, at(t));
          continue;
        }
        const Eigen::VectorXd by_parts = two_over_pi / t * (end[i] * B.value.row(last).transpose() - K.col(i) / t);
        use(sample, Eigen::MatrixXd(by_parts.reshaped(n, n)));
      }
    }
  }

 private:
  static constexpr double late = 4;  // rad: before it the sum over corners loses digits to cancellation

  detail::Corners corners() const {
    const auto& node = polygon_.nodes();
    const detail::Corners all{Eigen::Map<const Eigen::ArrayXd>(node.data(), static_cast<Eigen::Index>(node.size())),
                              polygon_.values(detail::flattened(damping_.B))};
    return all.needed(share_);
  }

  const DampingTable& damping_;
  detail::Polygon polygon_;
  double share_;
};

std::size_t steps_in(double length, double step) { return static_cast<std::size_t>(std::floor(length / step + 1e-9)); }

/// Step for looking at the whole kernel: eight samples in the shortest period that the table holds.
double survey_step(const DampingTable& damping) { return 2 * std::numbers::pi / damping.omega.back() / 8; }

/// ∫_t^∞ |K_ij| dt / √(max B_ii max B_jj), its largest entry, at each sample of K (samples, pairs); decreasing in t.
/// Beyond the longest time nothing is known; what follows is taken to be no more than the last quarter before it. (R5)
std::vector<double> remaining_memory(const DampingTable& damping, const Eigen::MatrixXd& K, double step) {
  const Eigen::VectorXd damped = largest_diagonal(damping);
  Eigen::VectorXd scale = Eigen::VectorXd::Zero(damped.size());  // a mode without damping has no memory to cut
  for (Eigen::Index i = 0; i < damped.size(); ++i)
    if (damped[i] > 1e-6 * damped.maxCoeff()) scale[i] = 1 / std::sqrt(damped[i]);
  const Eigen::MatrixXd of_pairs = step * scale * scale.transpose();
  const auto magnitude = [&](Eigen::Index i) {
    return K.row(i).cwiseAbs().cwiseProduct(of_pairs.reshaped().transpose());
  };
  Eigen::RowVectorXd left = Eigen::RowVectorXd::Zero(K.cols());
  for (Eigen::Index i = K.rows() - K.rows() / 4; i < K.rows(); ++i) left += magnitude(i);
  std::vector<double> out(static_cast<std::size_t>(K.rows()));
  for (Eigen::Index i = K.rows(); i-- > 0;) {
    out[static_cast<std::size_t>(i)] = left.maxCoeff();
    left += magnitude(i);
  }
  return out;
}

/// \throws InputError if the table does not tell a memory of this length
void require_told(const DampingTable& damping, const MemoryGrid& grid) {
  require(grid.step > 0 && grid.length > 0, "memory needs a positive step and length, got {} s and {} s", grid.step,
          grid.length);
  const double longest = RetardationKernel::longest_time(damping);
  if (grid.length > longest * (1 + 1e-9))
    throw InputError(
        fmt::format(
            "a memory of {:.4g} s is asked for, but frequencies {:.4g} rad/s apart tell the memory up to {:.4g} s only",
            grid.length, std::numbers::pi / longest, longest),
        {}, "compute the coefficients at more frequencies, or ask for a shorter memory");
}

}  // namespace

std::size_t MemoryGrid::samples() const { return std::max<std::size_t>(1, steps_in(length, step)) + 1; }

Eigen::MatrixXd retardation(const DampingTable& damping, double t_s) { return CosineTransform(damping).at(t_s); }

double negative_share(const DampingTable& damping) {
  check(damping);
  return most_negative(damping);
}

double RetardationKernel::longest_time(const DampingTable& damping) {
  // From ω = 0 to the first frequency B rises from nothing without a bend worth an echo; bend() counts what it costs.
  double widest = damping.omega.size() == 1 ? damping.omega.front() : 0;
  for (std::size_t i = 1; i < damping.omega.size(); ++i)
    widest = std::max(widest, damping.omega[i] - damping.omega[i - 1]);
  return std::numbers::pi / widest;
}

MemorySurvey::MemorySurvey(const DampingTable& damping) {
  check(damping);
  step_ = survey_step(damping);
  longest_ = RetardationKernel::longest_time(damping);
  const CosineTransform K(damping);
  modes_ = damping.B.front().rows();
  K_.resize(static_cast<Eigen::Index>(steps_in(longest_, step_) + 1), modes_ * modes_);
  K.each(step_, static_cast<std::size_t>(K_.rows()), [&](std::size_t i, const Eigen::MatrixXd& at) {
    K_.row(static_cast<Eigen::Index>(i)) = at.reshaped().transpose();
  });
  remaining_ = remaining_memory(damping, K_, step_);
}

double MemorySurvey::remaining_after(double time) const {
  return remaining_[std::min(remaining_.size() - 1, steps_in(time, step_))];
}

double MemorySurvey::length(double tolerance) const {
  require(tolerance > 0, "a memory tolerance must be positive, got {}", tolerance);
  for (std::size_t i = 1; i < remaining_.size(); ++i)
    if (remaining_[i] <= tolerance) return static_cast<double>(i) * step_;
  return longest_;
}

// By the trapezium rule with its correction (h²/12) d/dt [K e^{−iωt}] at t = 0, where K is level: the next one is of
// order (ωh)⁴/720, 2e-6 at the end of the table.
std::vector<Eigen::MatrixXcd> MemorySurvey::transforms(const std::vector<double>& omega, double length) const {
  const auto count = std::min(K_.rows(), static_cast<Eigen::Index>(steps_in(length, step_) + 1));
  const auto frequencies = static_cast<Eigen::Index>(omega.size());
  Eigen::MatrixXd weight(count, 2 * frequencies);  // of each sample, for real parts and for imaginary ones
  for (Eigen::Index f = 0; f < frequencies; ++f) {
    const double x = omega[static_cast<std::size_t>(f)] * step_;
    const std::complex<double> turn = std::polar(1.0, -x);
    std::complex<double> phase = turn;
    weight(0, 2 * f) = 0.5;
    weight(0, 2 * f + 1) = -x / 12;
    for (Eigen::Index j = 1; j < count; ++j) {
      weight(j, 2 * f) = phase.real();
      weight(j, 2 * f + 1) = phase.imag();
      phase = j % 64 == 0 ? std::polar(1.0, -x * static_cast<double>(j + 1)) : phase * turn;
    }
  }
  const Eigen::MatrixXd parts = step_ * transposed_product(K_.topRows(count), weight);  // (pairs, both parts)
  std::vector<Eigen::MatrixXcd> out(omega.size(), Eigen::MatrixXcd(modes_, modes_));
  for (Eigen::Index f = 0; f < frequencies; ++f) {
    Eigen::MatrixXcd& at = out[static_cast<std::size_t>(f)];
    at.real() = parts.col(2 * f).reshaped(modes_, modes_);
    at.imag() = parts.col(2 * f + 1).reshaped(modes_, modes_);
  }
  return out;
}

RetardationKernel RetardationKernel::from_damping(const DampingTable& damping, const MemoryGrid& grid) {
  return from_damping(damping, grid, MemorySurvey(damping));
}

RetardationKernel RetardationKernel::from_damping(const DampingTable& damping, const MemoryGrid& grid,
                                                  const MemorySurvey& survey) {
  check(damping);
  require_told(damping, grid);
  return sampled(CosineTransform(damping), damping, grid, survey);
}

RetardationKernel RetardationKernel::averaged(const DampingTable& damping, const MemoryGrid& grid,
                                              const MemorySurvey& survey) {
  check(damping);
  require_told(damping, grid);
  const DampingTable mean = averaged_over_steps(damping, grid.step);
  return sampled(CosineTransform(mean, averaged_share), damping, grid, survey);
}

template <class Transform>
RetardationKernel RetardationKernel::sampled(const Transform& K, const DampingTable& damping, const MemoryGrid& grid,
                                             const MemorySurvey& survey) {
  RetardationKernel kernel;
  kernel.step_ = grid.step;
  K.each(grid.step, grid.samples(), [&](std::size_t, Eigen::MatrixXd at) { kernel.K_.push_back(std::move(at)); });
  kernel.error_ = missing_tail(damping) + bend(damping);
  kernel.negative_share_ = most_negative(damping);
  kernel.truncation_ = survey.remaining_after(kernel.length());
  return kernel;
}

RetardationKernel RetardationKernel::from_samples(std::vector<Eigen::MatrixXd> K, double step) {
  require(step > 0 && K.size() >= 2, "a sampled kernel needs a positive step and two samples, got {} s and {}", step,
          K.size());
  for (const auto& m : K)
    require(m.rows() == K.front().rows() && m.cols() == m.rows() && m.rows() > 0,
            "a sample of the kernel is ({}, {}), the first is ({}, {})", m.rows(), m.cols(), K.front().rows(),
            K.front().cols());
  RetardationKernel kernel;
  kernel.step_ = step;
  kernel.error_ = Eigen::MatrixXd::Zero(K.front().rows(), K.front().cols());
  kernel.K_ = std::move(K);
  return kernel;
}

InfiniteAddedMass infinite_added_mass(const DampingTable& damping, const std::vector<Eigen::MatrixXd>& A) {
  check(damping);
  require(A.size() == damping.omega.size(), "added mass and damping have different numbers of frequencies");
  // ∫₀^T K sin ωt dt by straight pieces of K, at samples fine enough for the highest frequency.
  const double step = survey_step(damping) / 4;
  const std::size_t count = steps_in(RetardationKernel::longest_time(damping), step) + 1;
  std::vector<Eigen::MatrixXd> K;
  const CosineTransform transform(damping);
  transform.each(step, count, [&](std::size_t, Eigen::MatrixXd at) { K.push_back(std::move(at)); });
  const Eigen::Index n = K.front().rows();
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(n, n), squares = sum;
  double weight = 0;
  for (std::size_t f = 0; f < A.size(); ++f) {
    const double omega = damping.omega[f];
    Eigen::MatrixXd integral = Eigen::MatrixXd::Zero(n, n);
    for (std::size_t i = 0; i + 1 < count; ++i) {
      const auto w = sine_weights(static_cast<double>(i) * step, static_cast<double>(i + 1) * step, omega);
      integral += w.a * K[i] + w.b * K[i + 1];
    }
    const Eigen::MatrixXd estimate = A[f] + integral / omega;
    sum += omega * omega * estimate;
    squares += omega * omega * estimate.cwiseAbs2();
    weight += omega * omega;
  }
  InfiniteAddedMass out;
  out.value = sum / weight;
  out.spread = (squares / weight - out.value.cwiseAbs2()).cwiseMax(0).cwiseSqrt();
  return out;
}

}  // namespace hydro::radiation
