#include "compile/defect.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <vector>

#include "compile/kept.hpp"
#include "compile/signals.hpp"
#include "compile/waves.hpp"
#include "hydro/base/interpolation.hpp"
#include "hydro/radiation/missing_load.hpp"
#include "hydro/waves/dispersion.hpp"

namespace froude::compile {
namespace {

using dynamics::frequency::PotentialGroup;
using hydro::potential::Coefficients;
using hydro::radiation::MissingImpedance;
using Complex = std::complex<double>;

/// B + iωA, below the first frequency with B as ω² and A as there.
Eigen::MatrixXcd impedance(const SymmetricData& data, double omega) {
  const auto& known = data.damping.omega;
  const double inside = std::max(omega, known.front()), slow = std::pow(omega / inside, 2);
  const hydro::Stencil cubic = hydro::cubic_stencil(known, inside);
  Eigen::MatrixXcd Z(data.A.front().rows(), data.A.front().cols());
  Z.real() = slow * hydro::combined(cubic, known.size(),
                                    [&](std::size_t k) -> const Eigen::MatrixXd& { return data.damping.B[k]; });
  Z.imag() =
      omega * hydro::combined(cubic, known.size(), [&](std::size_t k) -> const Eigen::MatrixXd& { return data.A[k]; });
  return Z;
}

/// 0, the frequencies, and those that cut each interval in `parts`.
std::vector<double> with_parts(const std::vector<double>& omega, int parts) {
  std::vector<double> out{0};
  for (const double end : omega) {
    const double begin = out.back();
    for (int part = 1; part < parts; ++part) out.push_back(begin + (end - begin) * part / parts);
    out.push_back(end);
  }
  return out;
}

/// Between two frequencies of the data. The transform of a kernel as long as π over their spacing goes through half a
/// turn there, and what a cubic misses is a hump.
constexpr int parts_of_an_interval = 4;

Eigen::MatrixXcd missing_at(const MemoryInRun& memory, double omega) {
  return impedance(*memory.data, omega) - memory.transform(omega) - Complex(0, omega) * memory.A;
}
MissingImpedance missing_of(const MemoryInRun& memory) {
  MissingImpedance out{with_parts(memory.data->damping.omega, memory.poles ? 1 : parts_of_an_interval), {}};
  for (const double omega : out.omega) out.Z.push_back(missing_at(memory, omega));
  return out;
}

/// What a table leaves open between its frequencies (R26), for matrices of any shape.
class LeftOut {
 public:
  /// `value(k)`: an array of complex numbers at frequency k of `omega`.
  template <class Value>
  LeftOut(const std::vector<double>& omega, Value value) : omega_(omega) {
    const std::size_t count = omega.size();
    none_ = 0 * value(std::size_t{0});
    for (std::size_t k = 0; k < count; ++k) {
      value_.push_back(value(k));
      twice_.push_back(missed(k, 1, value));
      fourfold_.push_back(missed(k, 2, value));
    }
  }

  /// Zero at the frequencies of the table and outside it.
  Eigen::ArrayXXcd at(double omega) const {
    if (omega_.size() < 3 || omega <= omega_.front() || omega >= omega_.back()) return none_;
    const std::size_t after =
        static_cast<std::size_t>(std::upper_bound(omega_.begin(), omega_.end(), omega) - omega_.begin());
    const double s = (omega - omega_[after - 1]) / (omega_[after] - omega_[after - 1]);
    // The remainder of a cubic through four even places, one in the middle.
    const double shape = 16.0 / 9 * s * (1 - s) * (1 + s) * (2 - s);
    return shape * (blended(after, s) / gain(after)) + bent(after, omega);
  }

 private:
  /// value(k) less the cubic through the frequencies `apart` and 3·`apart` places from it; empty at an end.
  template <class Value>
  Eigen::ArrayXXcd missed(std::size_t k, std::size_t apart, Value value) const {
    if (k < apart || k + apart >= omega_.size()) return {};
    std::vector<std::size_t> neighbour;
    std::vector<double> at;
    for (const int places : {-3, -1, 1, 3}) {
      const auto j = static_cast<std::ptrdiff_t>(k) + places * static_cast<std::ptrdiff_t>(apart);
      if (j < 0 || j >= static_cast<std::ptrdiff_t>(omega_.size())) continue;
      neighbour.push_back(static_cast<std::size_t>(j));
      at.push_back(omega_[neighbour.back()]);
    }
    return value(k) - hydro::combined(hydro::cubic_stencil(at, omega_[k]), at.size(),
                                      [&](std::size_t j) { return value(neighbour[j]); });
  }

  /// What slopes from three points leave out of the cubic through four, which is of one order more: it is zero in the
  /// middle between two frequencies, where leaving out sees nothing of it.
  Eigen::ArrayXXcd bent(std::size_t after, double omega) const {
    if (after < 2 || after + 1 >= omega_.size()) return none_;
    Eigen::ArrayXXcd out = -hydro::combined(hydro::cubic_stencil(omega_, omega), omega_.size(),
                                            [&](std::size_t k) -> const Eigen::ArrayXXcd& { return value_[k]; });
    for (std::size_t k = after - 2; k < after + 2; ++k) {
      double weight = 1;
      for (std::size_t j = after - 2; j < after + 2; ++j)
        if (j != k) weight *= (omega - omega_[j]) / (omega_[k] - omega_[j]);
      out += weight * value_[k];
    }
    return out;
  }

  /// What twice the spacing misses, from one end of the interval before `after` to its other.
  Eigen::ArrayXXcd blended(std::size_t after, double s) const {
    const auto &left = twice_[after - 1], &right = twice_[after];
    if (left.size() == 0) return right;
    if (right.size() == 0) return left;
    return (1 - s) * left + s * right;
  }

  /// By how much halving the spacing makes the error smaller: as it did from four times to twice the spacing about
  /// here, but not by more than the order three of the cubic, and not by less than nothing.
  Eigen::ArrayXXd gain(std::size_t after) const {
    constexpr std::size_t about = 2;
    Eigen::ArrayXXd coarse = Eigen::ArrayXXd::Zero(none_.rows(), none_.cols()), fine = coarse;
    for (std::size_t k = after > about ? after - 1 - about : 0; k < std::min(after + about + 1, omega_.size()); ++k) {
      if (fourfold_[k].size() == 0) continue;
      coarse += fourfold_[k].abs2();
      fine += twice_[k].abs2();
    }
    return (fine > 0).select((coarse / fine.max(1e-300)).sqrt(), 1.0).max(1.0).min(8.0);
  }

  const std::vector<double>& omega_;
  Eigen::ArrayXXcd none_;
  std::vector<Eigen::ArrayXXcd> value_, twice_, fourfold_;
};

/// What poles may be off: what they would miss of each frequency, were it left out.
MissingImpedance open_between_poles(const MemoryInRun& memory) {
  const auto& omega = memory.data->damping.omega;
  std::vector<Eigen::MatrixXcd> residual;
  for (const double at : omega) residual.push_back(missing_at(memory, at));
  return {omega, missed_if_left_out(memory.poles->model(), omega, residual)};
}

/// What the cubics of A and B may be off.
MissingImpedance open_between_cubics(const SymmetricData& data) {
  const auto& omega = data.damping.omega;
  const LeftOut left_out(omega, [&](std::size_t k) -> Eigen::ArrayXXcd {
    Eigen::MatrixXcd both(data.A[k].rows(), data.A[k].cols());
    both.real() = data.damping.B[k];
    both.imag() = data.A[k];
    return both.array();
  });
  MissingImpedance out{with_parts(omega, parts_of_an_interval), {}};
  for (const double at : out.omega) {
    Eigen::MatrixXcd Z = left_out.at(at).matrix();
    Z.imag() *= at;
    out.Z.push_back(std::move(Z));
  }
  return out;
}

/// Beyond the last frequency ω_N nothing is known: what the memory has there may be all wrong, and so may be what it
/// lets fall faster than ω_N/ω of what it had at the end. From there on doubt grows to all of it over an eighth of ω_N.
Eigen::MatrixXcd open_beyond(const MemoryInRun& memory, double over) {
  constexpr double doubtful_from = 0.125;
  const double last = memory.data->damping.omega.back();
  const Eigen::ArrayXXcd at_end = memory.transform(last).array();
  Eigen::ArrayXXcd there = memory.transform(over * last).array();
  for (Eigen::Index i = 0; i < there.size(); ++i) {
    const double size = std::abs(there(i)), least = std::abs(at_end(i)) / over;
    if (size < least) there(i) = size > 0 ? there(i) * (least / size) : Complex(least);
  }
  return (std::min(1.0, (over - 1) / doubtful_from) * there).matrix();
}

/// What the data leave open between their frequencies and beyond the last.
MissingImpedance open_in_data(const MemoryInRun& memory) {
  MissingImpedance out = memory.poles ? open_between_poles(memory) : open_between_cubics(*memory.data);
  const double last = memory.data->damping.omega.back();
  for (const double over : {1.03125, 1.0625, 1.125, 1.25, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0}) {
    out.omega.push_back(over * last);
    out.Z.push_back(open_beyond(memory, over));
  }
  // Far beyond, added mass is A(∞), which the data have or the fit has found.
  out.Z.back().imag().setZero();
  return out;
}

/// Adds what each group lacks. Groups with the same data and memory share it.
template <class Missing>
void add_missing(const TimeModel& model, const VelocityRecord& motion, Missing missing_of_group, LoadRecord& out) {
  const SymmetricData* known = nullptr;
  MissingImpedance missing;
  for (const MemoryInRun& memory : model.memories) {
    if (memory.data.get() != known) missing = missing_of_group(memory);
    known = memory.data.get();
    const Eigen::MatrixXd velocity = motion.of_modes(memory.modes, Eigen::all);
    out.on_modes(memory.modes, Eigen::all) += missing_load(missing, velocity, motion.spacing);
  }
}

/// Excitation of a group by waves of one heading at each frequency of its table, without the phase of the waves' way
/// to each body: what a FrequencyTable takes cubics through.
std::vector<Eigen::ArrayXXcd> without_way(const PotentialGroup& group, const std::vector<dynamics::RigidBody>& bodies,
                                          double heading) {
  const Coefficients& c = group.table.coefficients();
  std::vector<Eigen::ArrayXXcd> out;
  for (const double omega : c.omega) {
    Eigen::VectorXcd X = group.table.excitation(omega, heading);
    const double k = hydro::waves::wavenumber(omega, c.water);
    for (std::size_t b = 0; b < group.bodies.size(); ++b) {
      const auto& at = bodies[static_cast<std::size_t>(group.bodies[b])].properties().rest_position.xyz;
      X.segment<6>(6 * static_cast<Eigen::Index>(b)) *=
          std::polar(1.0, k * (at.x() * std::cos(heading) + at.y() * std::sin(heading)));
    }
    out.emplace_back(X.array());
  }
  return out;
}

/// What the excitation of one group may be off for each component of the sea, with the phase of the excitation itself:
/// its own is not known.
Eigen::MatrixXcd open_excitation(const PotentialGroup& group, const std::vector<dynamics::RigidBody>& bodies,
                                 const hydro::waves::Sea& sea) {
  const auto& omega = group.table.coefficients().omega;
  Eigen::MatrixXcd out(group.table.coefficients().modes(), static_cast<Eigen::Index>(sea.components().size()));
  std::optional<LeftOut> left_out;
  double heading = 0;
  Eigen::Index column = 0;
  for (const auto& c : sea.components()) {
    if (!left_out || heading != c.heading) {
      const auto X = without_way(group, bodies, c.heading);
      left_out.emplace(omega, [&](std::size_t k) -> const Eigen::ArrayXXcd& { return X[k]; });
      heading = c.heading;
    }
    const Eigen::VectorXcd X = group.table.excitation(c.omega, c.heading);
    const Eigen::ArrayXd open = left_out->at(c.omega).abs();
    for (Eigen::Index i = 0; i < X.size(); ++i)
      out(i, column) = elevation_at_origin(c) * std::polar(open(i), std::arg(X[i]));
    ++column;
  }
  return out;
}

void add_open_excitation(const scene::Scene& scene, const Prepared& prepared, const hydro::waves::Sea& sea,
                         LoadRecord& out) {
  const StepGrid grid{out.spacing, static_cast<std::size_t>(out.on_modes.cols())};
  for (const PotentialGroup& group : prepared.groups) {
    if (!group.excitation) continue;
    const auto load = signals(sea, open_excitation(group, prepared.bodies, sea), grid, scene.waves->ramp);
    for (Eigen::Index sample = 0; sample < out.on_modes.cols(); ++sample) {
      const Eigen::VectorXd now = load.at(static_cast<double>(sample) * out.spacing);
      for (std::size_t b = 0; b < group.bodies.size(); ++b)
        out.on_modes.col(sample).segment<6>(6 * group.bodies[b]) += now.segment<6>(6 * static_cast<Eigen::Index>(b));
    }
  }
}

LoadRecord none(const VelocityRecord& motion) {
  return {motion.spacing, Eigen::MatrixXd::Zero(motion.of_modes.rows(), motion.of_modes.cols())};
}

}  // namespace

std::optional<LoadRecord> memory_defect(const TimeModel& model, const VelocityRecord& motion) {
  if (model.memories.empty()) return {};
  LoadRecord out = none(motion);
  add_missing(model, motion, missing_of, out);
  return out;
}

std::optional<LoadRecord> data_defect(const scene::Scene& scene, const Prepared& prepared, const TimeModel& model,
                                      const VelocityRecord& motion) {
  if (prepared.groups.empty()) return {};
  LoadRecord out = none(motion);
  add_missing(model, motion, open_in_data, out);
  if (model.water.sea) add_open_excitation(scene, prepared, *model.water.sea, out);
  return out;
}

}  // namespace froude::compile
