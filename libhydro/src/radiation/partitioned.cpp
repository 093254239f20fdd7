#include "hydro/radiation/partitioned.hpp"

#include <fftw3.h>

#include <bit>
#include <cmath>
#include <complex>
#include <mutex>

#include "hydro/base/error.hpp"
#include "signal/planner.hpp"

namespace hydro::radiation {
namespace {

using signal::Plan;

/// Real transforms of all modes at once, in place over columns: one column a mode.
struct Transform {
  int length, modes;
  Plan forward, inverse;

  Transform(int length_, int modes_) : length(length_), modes(modes_) {
    Eigen::MatrixXd real(length, modes);
    Eigen::MatrixXcd half(bins(), modes);
    auto* out = reinterpret_cast<fftw_complex*>(half.data());
    const std::lock_guard lock(signal::planner());
    // Unaligned: the arrays at hand in a run are others. Estimated: the choice depends on the length alone.
    constexpr unsigned flags = FFTW_ESTIMATE | FFTW_UNALIGNED;
    forward.reset(
        fftw_plan_many_dft_r2c(1, &length, modes, real.data(), nullptr, 1, length, out, nullptr, 1, bins(), flags));
    inverse.reset(
        fftw_plan_many_dft_c2r(1, &length, modes, out, nullptr, 1, bins(), real.data(), nullptr, 1, length, flags));
  }
  int bins() const { return length / 2 + 1; }
  void to_frequency(Eigen::MatrixXd& x, Eigen::MatrixXcd& X) const {
    fftw_execute_dft_r2c(forward.get(), x.data(), reinterpret_cast<fftw_complex*>(X.data()));
  }
  void to_time(Eigen::MatrixXcd& X, Eigen::MatrixXd& x) const {
    fftw_execute_dft_c2r(inverse.get(), reinterpret_cast<fftw_complex*>(X.data()), x.data());
  }
};

/// Lags first … 2·first − 1 of the kernel, transformed.
struct Part {
  std::size_t lags;
  Transform transform;
  Eigen::MatrixXcd spectrum;  // (modes · modes, bins), scaled by 1/length

  Part(const RetardationKernel& kernel, std::size_t first)
      : lags(first), transform(static_cast<int>(2 * first), kernel.modes()) {
    const int n = kernel.modes();
    Eigen::MatrixXd column(2 * static_cast<Eigen::Index>(first), n);
    Eigen::MatrixXcd transformed(transform.bins(), n);
    spectrum.resize(n * n, transform.bins());
    for (int j = 0; j < n; ++j) {
      column.setZero();
      for (std::size_t l = first; l < std::min(2 * first, kernel.samples()); ++l)
        column.row(static_cast<Eigen::Index>(l - first)) =
            kernel.at(l).col(j).transpose() / static_cast<double>(2 * first);
      transform.to_frequency(column, transformed);
      spectrum.middleRows(j * n, n) = transformed.transpose();
    }
  }
};

}  // namespace

struct PartitionedConvolution::Parts {
  int modes;
  std::size_t samples, head;
  double step;
  Eigen::MatrixXd K0, K1;
  KernelSum near;  // lags 1 … head − 1
  std::vector<Part> parts;

  Parts(const RetardationKernel& kernel, std::size_t head_)
      : modes(kernel.modes()),
        samples(kernel.samples()),
        head(std::min(head_, std::bit_ceil(kernel.samples()))),
        step(kernel.step()),
        K0(kernel.at(0)),
        K1(kernel.at(1)),
        near(kernel, 1, std::min(head, kernel.samples())) {
    for (std::size_t first = head; first < samples; first *= 2) parts.emplace_back(kernel, first);
  }
  std::size_t longest() const { return parts.empty() ? head : parts.back().lags; }
};

namespace {

/// The newest velocities, and what parts already summed give to the steps to come.
template <class Parts>
class PartitionedState final : public MemoryState {
 public:
  PartitionedState(const Parts& parts, const Eigen::VectorXd& velocity)
      : parts_(parts),
        history_(parts.modes, std::max(parts.longest(), parts.head + 1)),
        due_(Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(2 * parts.longest()), parts.modes)),
        before_(Eigen::VectorXd::Zero(parts.modes)) {
    for (const Part& p : parts_.parts) {
      const int n = parts.modes;
      work_.push_back({Eigen::MatrixXd(p.transform.length, n), Eigen::MatrixXcd(p.transform.bins(), n),
                       Eigen::MatrixXcd(p.transform.bins(), n)});
    }
    take(0.5 * velocity);  // the trapezium rule gives the first velocity half its weight
  }
  void accept(const Eigen::VectorXd& velocity) override {
    before_ = due_.row(at(0)).transpose();
    due_.row(at(0)).setZero();
    ++count_;
    take(velocity);
  }
  void find_history_force(double fraction, Eigen::VectorXd& late) const override {
    late = due_.row(at(0)).transpose();
    parts_.near.add(history_, 0, late);
    if (fraction == 1) {
      late *= parts_.step;
      return;
    }
    const Eigen::VectorXd newest = history_.newest();  // the rest as DirectConvolution::history_force
    Eigen::VectorXd early = before_ + parts_.K0 * newest;
    parts_.near.add(history_, 1, early);
    const Eigen::MatrixXd K_newest = fraction * parts_.K1 + (1 - fraction) * parts_.K0;
    late = parts_.step * (fraction * late + (1 - fraction) * early + (fraction - 1) / 2 * (K_newest * newest));
  }

  void keep_state(StateBytes& bytes) override { bytes.pass(history_, due_, before_, count_, taken_); }

 private:
  struct Work {
    Eigen::MatrixXd time;
    Eigen::MatrixXcd velocity, load;
  };
  /// Row of due_ for the step `ahead` of the next one.
  Eigen::Index at(std::size_t ahead) const {
    return static_cast<Eigen::Index>((count_ + ahead) % static_cast<std::size_t>(due_.rows()));
  }
  void take(const Eigen::VectorXd& velocity) {
    history_.push(velocity);
    ++taken_;
    for (std::size_t i = 0; i < parts_.parts.size() && taken_ % parts_.parts[i].lags == 0; ++i)
      add_part(parts_.parts[i], work_[i]);
  }
  void add_part(const Part& part, Work& w) {
    const auto lags = static_cast<Eigen::Index>(part.lags);
    for (int j = 0; j < parts_.modes; ++j) {
      const Eigen::Map<const Eigen::VectorXd> newest(history_.newest_first(j), lags);
      w.time.col(j).head(lags) = newest.reverse();
      w.time.col(j).tail(lags).setZero();
    }
    part.transform.to_frequency(w.time, w.velocity);
    const Eigen::Index n = parts_.modes;
    for (Eigen::Index bin = 0; bin < part.transform.bins(); ++bin) {
      const Eigen::Map<const Eigen::MatrixXcd> K(part.spectrum.col(bin).data(), n, n);
      load_.noalias() = K * w.velocity.row(bin).transpose();
      w.load.row(bin) = load_.transpose();
    }
    part.transform.to_time(w.load, w.time);
    for (Eigen::Index ahead = 0; ahead + 1 < 2 * lags; ++ahead)
      due_.row(at(static_cast<std::size_t>(ahead))) += w.time.row(ahead);
  }

  const Parts& parts_;
  VelocityHistory history_;
  Eigen::MatrixXd due_;     // ring over steps to come, (steps, modes)
  Eigen::VectorXd before_;  // what was due at the newest step
  std::vector<Work> work_;
  Eigen::VectorXcd load_;
  std::size_t count_ = 0, taken_ = 0;
};

}  // namespace

PartitionedConvolution::PartitionedConvolution(const RetardationKernel& kernel, std::size_t head) {
  require(head >= 4 && std::has_single_bit(head), "the direct head must be a power of two from 4 on, got {} lags",
          head);
  parts_ = std::make_unique<const Parts>(kernel, head);
}
PartitionedConvolution::~PartitionedConvolution() = default;
PartitionedConvolution::PartitionedConvolution(PartitionedConvolution&&) noexcept = default;

int PartitionedConvolution::modes() const { return parts_->modes; }
double PartitionedConvolution::step() const { return parts_->step; }

std::string PartitionedConvolution::describe() const {
  return fmt::format("partitioned convolution, {:.4g} s of memory in steps of {:.4g} s, {} parts after {} lags",
                     parts_->step * static_cast<double>(parts_->samples - 1), parts_->step, parts_->parts.size(),
                     parts_->head);
}

std::unique_ptr<MemoryState> PartitionedConvolution::start(const Eigen::VectorXd& velocity) const {
  ensure(velocity.size() == modes(), "PartitionedConvolution: velocity of another size");
  return std::make_unique<PartitionedState<Parts>>(*parts_, velocity);
}

Eigen::MatrixXd PartitionedConvolution::instantaneous(double fraction) const {
  return parts_->K0 * (fraction * parts_->step / 2);
}

namespace {

/// A complex product is four real ones; a real transform of length N costs about 2 N log₂ N.
double part_cost(double lags, double n) {
  return 4 * n * n * (lags + 1) + 2 * n * 2 * (2 * lags) * std::log2(2 * lags);
}

}  // namespace

double PartitionedConvolution::mean_step(int modes, std::size_t samples, std::size_t head) {
  const double n = modes;
  double sum = n * n * static_cast<double>(std::min(head, samples));
  for (std::size_t lags = head; lags < samples; lags *= 2)
    sum += part_cost(static_cast<double>(lags), n) / static_cast<double>(lags);
  return sum;
}

double PartitionedConvolution::worst_step(int modes, std::size_t samples, std::size_t head) {
  const double n = modes;
  double sum = n * n * static_cast<double>(std::min(head, samples));
  for (std::size_t lags = head; lags < samples; lags *= 2) sum += part_cost(static_cast<double>(lags), n);
  return sum;
}

}  // namespace hydro::radiation
