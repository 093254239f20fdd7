#include "hydro/radiation/convolution.hpp"

#include <algorithm>

#include "hydro/base/error.hpp"
#include "hydro/base/machine.hpp"

namespace hydro::radiation {

VelocityHistory::VelocityHistory(int modes, std::size_t samples)
    : twice_(Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(2 * samples), modes)), samples_(samples) {}

void VelocityHistory::push(const Eigen::VectorXd& velocity) {
  head_ = (head_ + samples_ - 1) % samples_;
  twice_.row(static_cast<Eigen::Index>(head_)) = velocity.transpose();
  twice_.row(static_cast<Eigen::Index>(head_ + samples_)) = velocity.transpose();
}

namespace {

/// Lags that are summed together: the velocities of thirty modes at so many lags stay in the first cache.
constexpr std::size_t block = 128;

struct TwoSums {
  double with_u, with_v;
};

/// Σ K u and Σ K v, each K read once. Four running sums: the order of additions is fixed, and none waits for another.
FROUDE_EVERY_MACHINE TwoSums two_sums(const double* K, const double* u, const double* v, std::size_t n) {
  Four a0{}, a1{}, b0{}, b1{};
  std::size_t i = 0;
  for (; i + 8 <= n; i += 8) {
    const Four k0 = *reinterpret_cast<const Four*>(K + i), k1 = *reinterpret_cast<const Four*>(K + i + 4);
    a0 += k0 * *reinterpret_cast<const Four*>(u + i);
    a1 += k1 * *reinterpret_cast<const Four*>(u + i + 4);
    b0 += k0 * *reinterpret_cast<const Four*>(v + i);
    b1 += k1 * *reinterpret_cast<const Four*>(v + i + 4);
  }
  a0 += a1;
  b0 += b1;
  TwoSums out{(a0[0] + a0[1]) + (a0[2] + a0[3]), (b0[0] + b0[1]) + (b0[2] + b0[3])};
  for (; i < n; ++i) {
    out.with_u += K[i] * u[i];
    out.with_v += K[i] * v[i];
  }
  return out;
}

}  // namespace

KernelSum::KernelSum(const RetardationKernel& kernel, std::size_t first, std::size_t last)
    : modes_(kernel.modes()), samples_(last - first) {
  // Block by block, and in it pair by pair: the sum reads straight through.
  const auto n = static_cast<std::size_t>(modes_);
  numbers_.reserve(samples_ * n * (n + 1) / 2);
  const double tolerated = 1e-9 * kernel.at(0).cwiseAbs().maxCoeff();
  for (std::size_t from = first; from < last; from += block)
    for (int j = 0; j < modes_; ++j)
      for (int i = 0; i <= j; ++i)
        for (std::size_t l = from; l < std::min(last, from + block); ++l) {
          const double upper = kernel.at(l)(i, j), lower = kernel.at(l)(j, i);
          if (std::abs(upper - lower) > tolerated)
            throw InputError(fmt::format("the radiation kernel is not symmetric in modes {} and {}: {:.6g} and {:.6g}",
                                         i, j, upper, lower),
                             {}, "make the damping symmetric: (B + Bᵀ)/2");
          numbers_.push_back((upper + lower) / 2);
        }
}

void KernelSum::add(const VelocityHistory& history, std::size_t later, Eigen::VectorXd& out) const {
  const double* K = numbers_.data();
  for (std::size_t from = 0; from < samples_; from += block) {
    const std::size_t count = std::min(block, samples_ - from);
    for (int j = 0; j < modes_; ++j) {
      const double* vj = history.newest_first(j) + from + later;
      double on_j = 0;
      for (int i = 0; i < j; ++i, K += count) {
        const TwoSums sums = two_sums(K, history.newest_first(i) + from + later, vj, count);
        on_j += sums.with_u;
        out[i] += sums.with_v;
      }
      out[j] += on_j + two_sums(K, vj, vj, count).with_u;
      K += count;
    }
  }
}

namespace {

class DirectState final : public MemoryState {
 public:
  DirectState(const DirectConvolution& convolution, const Eigen::VectorXd& velocity)
      : convolution_(convolution), history_(convolution.make_history()) {
    history_.push(0.5 * velocity);  // the trapezium rule gives the first velocity half its weight
  }
  void accept(const Eigen::VectorXd& velocity) override { history_.push(velocity); }
  void find_history_force(double fraction, Eigen::VectorXd& out) const override {
    out = convolution_.history_force(history_, fraction);
  }
  void keep_state(StateBytes& bytes) override { bytes.pass(history_); }

 private:
  const DirectConvolution& convolution_;
  VelocityHistory history_;
};

}  // namespace

DirectConvolution::DirectConvolution(const RetardationKernel& kernel)
    : samples_(kernel.samples() - 1),
      step_(kernel.step()),
      K0_(kernel.at(0)),
      K1_(kernel.at(1)),
      sum_(kernel, 1, kernel.samples()) {}

std::string DirectConvolution::describe() const {
  return fmt::format("direct convolution, {:.4g} s of memory in steps of {:.4g} s", length(), step_);
}

std::unique_ptr<MemoryState> DirectConvolution::start(const Eigen::VectorXd& velocity) const {
  return std::make_unique<DirectState>(*this, velocity);
}

Eigen::VectorXd DirectConvolution::history_force(const VelocityHistory& history, double fraction) const {
  ensure(fraction > 0 && fraction <= 1, "DirectConvolution: fraction outside (0, 1]");
  Eigen::VectorXd late = Eigen::VectorXd::Zero(modes());
  sum_.add(history, 0, late);
  if (fraction == 1) return step_ * late;
  // A step of fraction·h and full steps of h behind it: the newest stored velocity weighs (fraction + 1)/2, the
  // others 1; K straight between its samples.
  const Eigen::VectorXd newest = history.newest();
  Eigen::VectorXd early = K0_ * newest;
  sum_.add(history, 1, early);
  const Eigen::MatrixXd K_newest = fraction * K1_ + (1 - fraction) * K0_;
  return step_ * (fraction * late + (1 - fraction) * early + (fraction - 1) / 2 * (K_newest * newest));
}

}  // namespace hydro::radiation
