#include "hydro/radiation/pole_memory.hpp"

#include <cmath>

#include "hydro/base/error.hpp"
#include "machine.hpp"

namespace hydro::radiation {
namespace {

using Complex = std::complex<double>;
using Carry = PoleMemory::Carry;

/// z(t+h) = e^{ph} z(t) + ∫₀^h e^{pτ} v(t+h−τ) dτ with v straight from `before` to `after`. (R14)
Carry carry(const Pole& pole, double h) {
  const Complex p(-pole.decay, pole.omega), x = p * h;
  Carry c;
  c.growth = std::exp(x);
  // (eˣ − 1)/x and (eˣ − 1 − x)/x² lose their digits where x is small; there their series, Σ x^k/(k+2)! for the latter.
  Complex first = (c.growth - 1.0) / x, second = (first - 1.0) / x;
  if (std::abs(x) < 0.1) {
    second = 0;
    for (int k = 12; k-- > 0;) second = (1.0 + x * second) / (k + 2.0);
    first = 1.0 + x * second;
  }
  c.after = h * second;
  c.before = h * (first - second);
  return c;
}

/// The states of one run: z of each oscillation at the newest step, and carried over to the end of the next one.
class PoleState final : public MemoryState {
 public:
  PoleState(const PoleMemory& memory, const Eigen::VectorXd& velocity)
      : memory_(memory),
        z_(Eigen::MatrixXd::Zero(velocity.size(), memory.model().order())),
        ahead_(z_),
        velocity_(velocity) {
    look_ahead();
  }
  void accept(const Eigen::VectorXd& velocity) override {
    z_ = ahead_;
    Eigen::Index column = 0;
    for (std::size_t k = 0; k < memory_.model().poles.size(); ++k) {
      const Carry& c = memory_.carried_over_a_step()[k];
      z_.col(column++) += c.after.real() * velocity;
      if (memory_.model().poles[k].omega > 0) z_.col(column++) += c.after.imag() * velocity;
    }
    velocity_ = velocity;
    look_ahead();
  }
  void find_history_force(double fraction, Eigen::VectorXd& out) const override {
    if (fraction == 1) {
      out = history_force_.head(z_.rows());
      return;
    }
    Eigen::MatrixXd there(z_.rows(), z_.cols());
    move(memory_.carried_over(fraction * memory_.step()), there);
    memory_.find_load(there, out);
    out.conservativeResize(z_.rows());
  }

 private:
  /// The states without what the velocity at the end adds, into a matrix of their size.
  void move(const std::vector<Carry>& carries, Eigen::MatrixXd& out) const {
    Eigen::Index column = 0;
    for (std::size_t k = 0; k < carries.size(); ++k) {
      const Carry& c = carries[k];
      if (memory_.model().poles[k].omega > 0) {
        out.col(column) =
            c.growth.real() * z_.col(column) - c.growth.imag() * z_.col(column + 1) + c.before.real() * velocity_;
        out.col(column + 1) =
            c.growth.imag() * z_.col(column) + c.growth.real() * z_.col(column + 1) + c.before.imag() * velocity_;
        column += 2;
      } else {
        out.col(column) = c.growth.real() * z_.col(column) + c.before.real() * velocity_;
        ++column;
      }
    }
  }
  void look_ahead() {
    move(memory_.carried_over_a_step(), ahead_);
    memory_.find_load(ahead_, history_force_);
  }

  const PoleMemory& memory_;
  Eigen::MatrixXd z_, ahead_;
  Eigen::VectorXd velocity_, history_force_;  // with the rows that find_load() adds
};

/// out = matrix · x, columns one after the other, `rows` a multiple of eight: two registers of sums are carried through
/// all columns.
FROUDE_EVERY_MACHINE void product(const double* matrix, std::size_t rows, const double* x, std::size_t columns,
                                  double* out) {
  for (std::size_t r = 0; r < rows; r += 8) {
    Four low{}, high{}, low_too{}, high_too{};
    const double* column = matrix + r;
    std::size_t c = 0;
    for (; c + 2 <= columns; c += 2, column += 2 * rows) {
      low += *reinterpret_cast<const Four*>(column) * x[c];
      high += *reinterpret_cast<const Four*>(column + 4) * x[c];
      low_too += *reinterpret_cast<const Four*>(column + rows) * x[c + 1];
      high_too += *reinterpret_cast<const Four*>(column + rows + 4) * x[c + 1];
    }
    if (c < columns) {
      low += *reinterpret_cast<const Four*>(column) * x[c];
      high += *reinterpret_cast<const Four*>(column + 4) * x[c];
    }
    *reinterpret_cast<Four*>(out + r) = low + low_too;
    *reinterpret_cast<Four*>(out + r + 4) = high + high_too;
  }
}

Eigen::MatrixXd weighted(const PoleModel& m, const std::vector<Carry>& carries) {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(m.modes(), m.modes());
  for (std::size_t k = 0; k < carries.size(); ++k)
    sum += carries[k].after.real() * m.C[k] + carries[k].after.imag() * m.S[k];
  return sum;
}

}  // namespace

PoleMemory::PoleMemory(PoleModel model, double step) : model_(std::move(model)), step_(step) {
  require(step > 0, "a memory needs a positive step, got {} s", step);
  require(!model_.poles.empty() && model_.C.size() == model_.poles.size() && model_.S.size() == model_.poles.size(),
          "a pole model needs poles, each with its two matrices");
  for (const Pole& p : model_.poles)
    require(p.decay > 0 && p.omega >= 0, "pole −{} ± {}i does not decay", p.decay, p.omega);
  full_ = carried_over(step);
  instantaneous_ = weighted(model_, full_);
  output_ = Eigen::MatrixXd::Zero((modes() + 7) / 8 * 8, modes() * model_.order());
  Eigen::Index at = 0;
  for (std::size_t k = 0; k < model_.poles.size(); ++k) {
    output_.block(0, at++ * modes(), modes(), modes()) = model_.C[k];
    if (model_.poles[k].omega > 0) output_.block(0, at++ * modes(), modes(), modes()) = model_.S[k];
  }
}

std::string PoleMemory::describe() const {
  return fmt::format("sum of exponentials, {} states a mode", model_.order());
}

std::unique_ptr<MemoryState> PoleMemory::start(const Eigen::VectorXd& velocity) const {
  ensure(velocity.size() == modes(), "PoleMemory: velocity of another size");
  return std::make_unique<PoleState>(*this, velocity);
}

Eigen::MatrixXd PoleMemory::instantaneous(double fraction) const {
  return fraction == 1 ? instantaneous_ : weighted(model_, carried_over(fraction * step_));
}

std::vector<PoleMemory::Carry> PoleMemory::carried_over(double h) const {
  std::vector<Carry> out;
  for (const Pole& p : model_.poles) out.push_back(carry(p, h));
  return out;
}

void PoleMemory::find_load(const Eigen::MatrixXd& z, Eigen::VectorXd& out) const {
  out.resize(output_.rows());
  product(output_.data(), static_cast<std::size_t>(output_.rows()), z.data(), static_cast<std::size_t>(z.size()),
          out.data());
}

}  // namespace hydro::radiation
