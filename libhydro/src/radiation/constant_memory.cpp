#include "hydro/radiation/constant_memory.hpp"

#include "hydro/base/error.hpp"

namespace hydro::radiation {
namespace {

class NoState final : public MemoryState {
 public:
  explicit NoState(int modes) : modes_(modes) {}
  void accept(const Eigen::VectorXd&) override {}
  void find_history_force(double, Eigen::VectorXd& out) const override { out.setZero(modes_); }
  void keep_state(StateBytes&) override {}

 private:
  int modes_;
};

}  // namespace

ConstantMemory::ConstantMemory(Eigen::MatrixXd B, double omega, double step)
    : B_(std::move(B)), omega_(omega), step_(step) {
  require(B_.rows() == B_.cols() && omega > 0 && step > 0,
          "constant radiation needs a square damping matrix, a frequency and a step, got ({}, {}), {} rad/s, {} s",
          B_.rows(), B_.cols(), omega, step);
}

std::string ConstantMemory::describe() const {
  return fmt::format("constant added mass and damping at {:.4g} rad/s", omega_);
}

std::unique_ptr<MemoryState> ConstantMemory::start(const Eigen::VectorXd&) const {
  return std::make_unique<NoState>(modes());
}

}  // namespace hydro::radiation
