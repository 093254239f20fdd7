#include "dynamics/frequency/signal_amplitudes.hpp"

#include <utility>

namespace dynamics::frequency {
namespace {

/// One heading below the other, cells by rows.
Eigen::MatrixXcd by_cells(const std::vector<Eigen::MatrixXcd>& of_headings) {
  if (of_headings.empty()) return {};
  const Eigen::Index each = of_headings.front().cols();
  Eigen::MatrixXcd out(each * static_cast<Eigen::Index>(of_headings.size()), of_headings.front().rows());
  Eigen::Index row = 0;
  for (const Eigen::MatrixXcd& one : of_headings) {
    out.middleRows(row, each) = one.transpose();
    row += each;
  }
  return out;
}

}  // namespace

SignalAmplitudes::SignalAmplitudes(const Amplitudes& found, std::vector<double> omega, std::vector<double> headings)
    : omega_(std::move(omega)),
      headings_(std::move(headings)),
      xi_(by_cells(found.xi)),
      lambda_(by_cells(found.lambda)) {}

void SignalAmplitudes::add_motion(const Variation::Part& part, int mode, std::vector<std::complex<double>>& out) const {
  if (part.by_motion[mode] == 0 && part.by_velocity[mode] == 0 && part.by_acceleration[mode] == 0) return;
  const std::complex<double>* x = xi_.col(6 * part.body + mode).data();
  std::complex<double>* sum = out.data();
  for (std::size_t h = 0; h < headings_.size(); ++h)
    for (const double omega : omega_) {
      const double in_phase = part.by_motion[mode] - omega * omega * part.by_acceleration[mode],
                   ahead = omega * part.by_velocity[mode];
      *sum++ +=
          std::complex<double>(in_phase * x->real() - ahead * x->imag(), in_phase * x->imag() + ahead * x->real());
      ++x;
    }
}

void SignalAmplitudes::add_radiation(const Variation::Radiated& part, std::vector<std::complex<double>>& out) const {
  for (std::size_t w = 0; w < omega_.size(); ++w) {
    const Eigen::RowVectorXcd row = part.row(omega_[w]);
    for (std::size_t cell = w; cell < out.size(); cell += omega_.size())
      for (std::size_t b = 0; b < part.bodies.size(); ++b)
        for (int mode = 0; mode < 6; ++mode)
          out[cell] += row[6 * static_cast<Eigen::Index>(b) + mode] *
                       xi_(static_cast<Eigen::Index>(cell), 6 * part.bodies[b] + mode);
  }
}

// (Q7)
std::vector<std::complex<double>> SignalAmplitudes::of(const Variation& variation) const {
  std::vector<std::complex<double>> out;
  if (variation.by_wave) {
    out.reserve(omega_.size() * headings_.size());
    for (const double heading : headings_)
      for (const double omega : omega_) out.push_back(variation.by_wave(omega, heading));
  } else {
    out.resize(omega_.size() * headings_.size());
  }
  for (const Variation::Part& part : variation.parts)
    for (int mode = 0; mode < 6; ++mode) add_motion(part, mode, out);
  const auto cells = static_cast<Eigen::Index>(out.size());
  for (const auto& [row, factor] : variation.by_multiplier)
    Eigen::Map<Eigen::VectorXcd>(out.data(), cells) += factor * lambda_.col(row);
  if (variation.by_radiation) add_radiation(*variation.by_radiation, out);
  return out;
}

}  // namespace dynamics::frequency
