#include "hydro/radiation/pole_memory.hpp"

#include <cmath>

#include "hydro/base/error.hpp"
#include "hydro/base/machine.hpp"
#include "mode_groups.hpp"

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
        velocity_(velocity.size()) {
    take_velocity(velocity);
    look_ahead();
  }
  void accept(const Eigen::VectorXd& velocity_of_modes) override {
    take_velocity(velocity_of_modes);
    z_.swap(ahead_);
    Eigen::Index column = 0;
    for (std::size_t k = 0; k < memory_.model().poles.size(); ++k) {
      const Carry& c = memory_.carried_over_a_step()[k];
      z_.col(column++) += c.after.real() * velocity_;
      if (memory_.model().poles[k].omega > 0) z_.col(column++) += c.after.imag() * velocity_;
    }
    look_ahead();
  }
  void find_history_force(double fraction, Eigen::VectorXd& out) const override {
    if (fraction == 1) {
      out = history_force_;
      return;
    }
    Eigen::MatrixXd there(z_.rows(), z_.cols());
    move(memory_.carried_over(fraction * memory_.step()), there);
    memory_.find_load(there, out);
  }
  void keep_state(StateBytes& bytes) override { bytes.pass(z_, ahead_, velocity_, history_force_); }

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
  void take_velocity(const Eigen::VectorXd& of_modes) {
    for (Eigen::Index i = 0; i < velocity_.size(); ++i)
      velocity_[i] = of_modes[memory_.sequence()[static_cast<std::size_t>(i)]];
  }
  void look_ahead() {
    move(memory_.carried_over_a_step(), ahead_);
    memory_.find_load(ahead_, history_force_);
  }

  const PoleMemory& memory_;
  Eigen::MatrixXd z_, ahead_;  // rows in the memory's sequence, as of velocity_
  Eigen::VectorXd velocity_, history_force_;
};

/// out = [M₁ M₂ …] · [x₁; x₂; …], matrices of `count` columns one after the other, `rows` a multiple of eight, each x
/// `apart` numbers from the one before: two registers of sums are carried through all columns.
FROUDE_EVERY_MACHINE void product(const double* matrix, std::size_t rows, const double* x, std::size_t matrices,
                                  std::size_t count, std::size_t apart, double* out) {
  for (std::size_t r = 0; r < rows; r += 8) {
    Four low{}, high{}, low_too{}, high_too{};
    const double* column = matrix + r;
    for (std::size_t m = 0; m < matrices; ++m) {
      const double* of = x + m * apart;
      std::size_t c = 0;
      for (; c + 2 <= count; c += 2, column += 2 * rows) {
        low += *reinterpret_cast<const Four*>(column) * of[c];
        high += *reinterpret_cast<const Four*>(column + 4) * of[c];
        low_too += *reinterpret_cast<const Four*>(column + rows) * of[c + 1];
        high_too += *reinterpret_cast<const Four*>(column + rows + 4) * of[c + 1];
      }
      if (c < count) {
        low += *reinterpret_cast<const Four*>(column) * of[c];
        high += *reinterpret_cast<const Four*>(column + 4) * of[c];
        column += rows;
      }
    }
    *reinterpret_cast<Four*>(out + r) = low + low_too;
    *reinterpret_cast<Four*>(out + r + 4) = high + high_too;
  }
}

/// True where the model has anything between two modes.
bool moves(const PoleModel& m, Eigen::Index i, Eigen::Index j) {
  for (std::size_t k = 0; k < m.poles.size(); ++k)
    if (m.C[k](i, j) != 0 || m.C[k](j, i) != 0 || m.S[k](i, j) != 0 || m.S[k](j, i) != 0) return true;
  return false;
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
  group_modes();
}

void PoleMemory::group_modes() {
  const auto feels = [&](Eigen::Index i, Eigen::Index j) { return moves(model_, i, j); };
  for (const auto& group : detail::groups_of_modes(modes(), feels)) {
    const Eigen::Index count = std::ssize(group);
    Group& made = groups_.emplace_back(Group{std::ssize(sequence_), count, {}});
    made.output = Eigen::MatrixXd::Zero((count + 7) / 8 * 8, count * model_.order());
    Eigen::Index at = 0;
    for (std::size_t k = 0; k < model_.poles.size(); ++k) {
      made.output.block(0, at++ * count, count, count) = model_.C[k](group, group);
      if (model_.poles[k].omega > 0) made.output.block(0, at++ * count, count, count) = model_.S[k](group, group);
    }
    sequence_.insert(sequence_.end(), group.begin(), group.end());
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
  out.resize(modes());
  for (const Group& g : groups_) {
    thread_local Eigen::VectorXd of_group;  // its room is kept from step to step
    if (of_group.size() < g.output.rows()) of_group.resize(g.output.rows());
    product(g.output.data(), static_cast<std::size_t>(g.output.rows()), z.data() + g.first,
            static_cast<std::size_t>(z.cols()), static_cast<std::size_t>(g.count), static_cast<std::size_t>(z.rows()),
            of_group.data());
    for (Eigen::Index i = 0; i < g.count; ++i) out[sequence_[static_cast<std::size_t>(g.first + i)]] = of_group[i];
  }
}

}  // namespace hydro::radiation
