#include <algorithm>
#include <cmath>

#include "potential/readers.hpp"
#include "wamit.hpp"

namespace hydro::potential {
namespace {

/// How far two matrices are apart, by their diagonals: Σ |a_ii − b_ii| / largest |A_ii|.
double distance(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, const Eigen::VectorXd& size) {
  double sum = 0;
  for (Eigen::Index i = 0; i < size.size(); ++i)
    if (size(i) > 0) sum += std::abs(a(i, i) - b(i, i)) / size(i);
  return sum;
}

/// How badly limits join the ends of the frequency range; an absent limit costs nothing.
double misfit(const Eigen::MatrixXd* at_zero, const Eigen::MatrixXd* at_infinity, const Eigen::MatrixXd& lowest,
              const Eigen::MatrixXd& highest) {
  Eigen::VectorXd size = lowest.diagonal().cwiseAbs().cwiseMax(highest.diagonal().cwiseAbs());
  for (const Eigen::MatrixXd* limit : {at_zero, at_infinity})
    if (limit != nullptr) size = size.cwiseMax(limit->diagonal().cwiseAbs());
  // A mode with hardly any added mass (yaw of a body of revolution) is noise of the panels and must not vote.
  for (const Eigen::Index kind : {0, 1}) {
    double most = 0;
    for (Eigen::Index i = 0; i < size.size(); ++i)
      if (is_translation(i) == (kind == 0)) most = std::max(most, size(i));
    for (Eigen::Index i = 0; i < size.size(); ++i)
      if (is_translation(i) == (kind == 0) && size(i) < 1e-3 * most) size(i) = 0;
  }
  return (at_zero != nullptr ? distance(*at_zero, lowest, size) : 0) +
         (at_infinity != nullptr ? distance(*at_infinity, highest, size) : 0);
}

/// One reading must fit twice as well as the other before it is believed.
constexpr double clearly = 0.5;

const Eigen::MatrixXd* A_of(const RadiationBlock* block) { return block != nullptr ? &block->A : nullptr; }

}  // namespace

WamitLimits assign_limits(const RadiationBlock* negative, const RadiationBlock* zero,
                          const std::vector<const RadiationBlock*>& finite, FirstColumn column,
                          const WamitTable& table) {
  const bool is_period = column == FirstColumn::period || column == FirstColumn::wavelength;
  if ((negative == nullptr && zero == nullptr) || is_period) return {negative, zero, std::nullopt};
  const Eigen::MatrixXd &lowest = finite.front()->A, &highest = finite.back()->A;
  const double as_periods = misfit(A_of(negative), A_of(zero), lowest, highest);
  const double as_frequencies = misfit(A_of(zero), A_of(negative), lowest, highest);
  if (as_periods < clearly * as_frequencies)
    return {negative, zero,
            "rows with PER < 0 are taken for zero frequency and rows with PER = 0 for infinite frequency: "
            "so they join the neighbouring frequencies"};
  if (as_frequencies < clearly * as_periods)
    return {zero, negative,
            "rows with PER = 0 are taken for zero frequency and rows with PER < 0 for infinite frequency: "
            "so they join the neighbouring frequencies"};
  const RadiationBlock* block = negative != nullptr ? negative : zero;
  throw InputError(fmt::format("with IPEROUT = {} this row is a limit of zero or infinite frequency, and the "
                               "neighbouring frequencies do not tell which",
                               static_cast<int>(column)),
                   table.place(block->first_row, 0), "write the files with IPEROUT = 1, or take the limits out");
}

std::optional<std::string> sign_of_wrong_iperout(const Coefficients& c) {
  if (c.omega.size() < 2) return std::nullopt;
  const Eigen::MatrixXd* zero = c.A_zero ? &*c.A_zero : nullptr;
  const Eigen::MatrixXd* inf = c.A_inf ? &*c.A_inf : nullptr;
  if (zero != nullptr && inf != nullptr &&
      misfit(zero, inf, c.A.back(), c.A.front()) < clearly * misfit(zero, inf, c.A.front(), c.A.back()))
    return "A(0) joins the highest frequency and A(∞) the lowest";
  if (!c.C || c.X.empty()) return std::nullopt;
  for (Eigen::Index i = 2; i < c.modes(); i += 6) {
    const double C33 = (*c.C)(i, i);
    const double lowest = std::abs(c.X.front()(i, 0)), highest = std::abs(c.X.front()(i, c.X.front().cols() - 1));
    // Long waves lift a floating body by C33 per metre; short ones hardly at all.
    if (C33 > 0 && lowest < clearly * highest && std::abs(highest - C33) < clearly * C33)
      return fmt::format("the {} excitation tends to C33 at the highest frequency and falls towards the lowest",
                         mode_label(i));
  }
  return std::nullopt;
}

namespace {

/// Loads on all bodies together in the longest wave of one heading.
struct LongestWave {
  std::complex<double> lift;
  Eigen::Vector2d push;  ///< imaginary part: of surge and sway
  double along;          ///< that of the push in the direction of travel
};

std::vector<LongestWave> longest_waves(const Coefficients& c) {
  std::vector<LongestWave> out;
  for (std::size_t h = 0; h < c.heading.size(); ++h) {
    LongestWave wave{0, Eigen::Vector2d::Zero(), 0};
    for (Eigen::Index body = 0; body < c.modes(); body += 6) {
      wave.lift += c.X[h](body + 2, 0);
      wave.push += c.X[h].block<2, 1>(body, 0).imag();
    }
    wave.along = wave.push.dot(Eigen::Vector2d(std::cos(c.heading[h]), std::sin(c.heading[h])));
    out.push_back(wave);
  }
  return out;
}

/// Σ of a matrix's entries between the heaves of all bodies.
double sum_of_heave(const Eigen::MatrixXd& m) {
  double sum = 0;
  for (Eigen::Index i = 2; i < m.rows(); i += 6)
    for (Eigen::Index j = 2; j < m.cols(); j += 6) sum += m(i, j);
  return sum;
}

/// What the imaginary part of heave says of the time factor: ωB₃₃ for ours, its opposite for the other. Bodies away
/// from the origin have a phase of the way as well, and then it says nothing.
enum class TimeFactorOfHeave { ours, other, not_told };

TimeFactorOfHeave time_factor_of_heave(const Coefficients& c, const std::vector<LongestWave>& waves) {
  const double expected = c.omega.front() * sum_of_heave(c.B.front());
  const auto all_are = [&](double sign) {
    constexpr double near = 0.5;  // of it: long waves and meshes leave less, a wrong sign twice of it
    return std::all_of(waves.begin(), waves.end(), [&](const LongestWave& wave) {
      return std::abs(wave.lift.imag() - sign * expected) < near * expected;
    });
  };
  return all_are(1) ? TimeFactorOfHeave::ours : all_are(-1) ? TimeFactorOfHeave::other : TimeFactorOfHeave::not_told;
}

}  // namespace

std::optional<WrongPhases> sign_of_other_time_factor(const Coefficients& c) {
  if (!c.C || c.X.empty()) return std::nullopt;
  double C33 = 0;
  for (Eigen::Index i = 2; i < c.modes(); i += 6) C33 += (*c.C)(i, i);
  const std::vector<LongestWave> waves = longest_waves(c);
  double largest = 0;
  for (const LongestWave& wave : waves) largest = std::max(largest, wave.push.norm());
  for (const LongestWave& wave : waves) {
    // Only waves so long that they lift the bodies with the water's level tell the sign.
    if (!(C33 > 0) || std::abs(wave.lift / C33 - 1.0) > 0.25) return std::nullopt;
    // A time factor turns the push of every heading round; mirrored headings and exchanged modes do not.
    constexpr double nothing = 0.01;  // of the largest: a file without sway has no push at 90 degrees
    if (wave.push.norm() >= nothing * largest && wave.along >= -0.5 * wave.push.norm()) return std::nullopt;
  }
  if (!(largest > 0)) return std::nullopt;
  const TimeFactorOfHeave heave = time_factor_of_heave(c, waves);
  if (heave == TimeFactorOfHeave::ours) return std::nullopt;  // headings, perhaps: the doctor's affair
  const std::string seen = "in the longest waves the bodies are pushed while the water accelerates the other way";
  const std::string hams = "HAMS writes WAMIT's files for e^(−iωt): give its ControlFile.in instead of the .1 file";
  if (heave == TimeFactorOfHeave::other) return WrongPhases{"the phases are of the other time factor: " + seen, hams};
  return WrongPhases{"the phases are of the other time factor, or headings are where waves come from: " + seen,
                     hams + "; or write headings as where waves go"};
}

}  // namespace hydro::potential
