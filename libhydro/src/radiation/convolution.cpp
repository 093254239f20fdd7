#include "hydro/radiation/convolution.hpp"

#include "hydro/base/error.hpp"

namespace hydro::radiation {

VelocityHistory::VelocityHistory(int modes, std::size_t samples)
    : twice_(Eigen::MatrixXd::Zero(modes, static_cast<Eigen::Index>(2 * samples))), samples_(samples) {}

void VelocityHistory::push(const Eigen::VectorXd& velocity) {
  head_ = (head_ + samples_ - 1) % samples_;
  twice_.col(static_cast<Eigen::Index>(head_)) = velocity;
  twice_.col(static_cast<Eigen::Index>(head_ + samples_)) = velocity;
  ++pushed_;
}

Eigen::Map<const Eigen::VectorXd> VelocityHistory::newest_first() const {
  return {twice_.data() + static_cast<Eigen::Index>(head_) * twice_.rows(),
          twice_.rows() * static_cast<Eigen::Index>(samples_)};
}

DirectConvolution::DirectConvolution(const RetardationKernel& kernel)
    : modes_(kernel.modes()), samples_(kernel.samples() - 1), step_(kernel.step()), K0_(kernel.at(0)) {
  late_.resize(modes_, modes_ * static_cast<Eigen::Index>(samples_));
  early_.resizeLike(late_);
  for (std::size_t j = 0; j < samples_; ++j) {
    const auto column = static_cast<Eigen::Index>(j) * modes_;
    late_.middleCols(column, modes_) = kernel.at(j + 1);
    early_.middleCols(column, modes_) = kernel.at(j);
  }
}

Eigen::VectorXd DirectConvolution::decided(const VelocityHistory& history, double fraction) const {
  ensure(fraction > 0 && fraction <= 1, "DirectConvolution: fraction outside (0, 1]");
  const auto v = history.newest_first();
  // A step of fraction·h and full steps of h behind it: the newest stored velocity weighs (fraction + 1)/2, the
  // others 1.
  if (fraction == 1) return step_ * (late_ * v);
  const Eigen::VectorXd sum = fraction * (late_ * v) + (1 - fraction) * (early_ * v);
  const Eigen::MatrixXd K_newest = fraction * late_.leftCols(modes_) + (1 - fraction) * K0_;
  return step_ * (sum + (fraction - 1) / 2 * (K_newest * v.head(modes_)));
}

}  // namespace hydro::radiation
