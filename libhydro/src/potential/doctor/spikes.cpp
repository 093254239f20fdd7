// Values that do not fit between their neighbours, and what they may be. (P72), (P73)
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "doctor.hpp"
#include "potential/readers.hpp"
#include "spikes.hpp"

namespace hydro::potential {

namespace {

/// How far each value is from the cubic through its two neighbours on each side. (P72)
std::vector<double> misfits(const std::vector<double>& omega, const std::vector<double>& values) {
  std::vector<double> out(omega.size(), 0.0);
  for (std::size_t k = 2; k + 2 < omega.size(); ++k)
    out[k] =
        values[k] - through(omega, {k - 2, k - 1, k + 1, k + 2}, omega[k], [&](std::size_t i) { return values[i]; });
  return out;
}

}  // namespace

double lowest_irregular_frequency(const Coefficients& c) {
  if (!c.C) return 0;
  double lowest = std::numeric_limits<double>::infinity();
  for (int b = 0; b < c.bodies(); ++b) {
    const Eigen::Index i = 6 * static_cast<Eigen::Index>(b) + 2;
    const double C33 = (*c.C)(i, i);
    if (!(C33 > 0)) continue;
    const double area = C33 / (c.water.density * c.water.gravity);
    constexpr double first_zero = 2.404825557695773;  // of the Bessel function J₀
    lowest = std::min(lowest, std::sqrt(c.water.gravity * first_zero * std::sqrt(std::numbers::pi / area)));
  }
  return lowest;
}

std::string_view to_string(SpikeKind kind) {
  switch (kind) {
    case SpikeKind::single_number:
      return "a single wrong number";
    case SpikeKind::lonely:
      return "of one body alone, so not of the water between bodies";
    case SpikeKind::irregular:
      return "probably an irregular frequency";
    case SpikeKind::resonance:
      break;
  }
  return "a resonance of the water between or inside bodies";
}

namespace {

/// Beyond this of the mode's size a misfit is looked at; converged meshes stay below.
constexpr double visible = 0.05;
/// … and this many times the median misfit of its own curve, so that a coarse table is not one row of spikes.
constexpr double outstanding = 8;

std::vector<double> diagonal(const std::vector<Eigen::MatrixXd>& matrices, Eigen::Index i) {
  std::vector<double> out;
  for (const auto& m : matrices) out.push_back(m(i, i));
  return out;
}

double largest_near(const std::vector<double>& values, std::size_t k) {
  double most = 0;
  for (std::size_t i = k - 2; i <= k + 2; ++i) most = std::max(most, std::abs(values[i]));
  return most;
}

/// What a misfit at k may be, from how A and B go together there. (P73)
SpikeKind kind_of(const Coefficients& c, const std::vector<double>& of_A, const std::vector<double>& of_B,
                  std::size_t k, double lowest_irregular, double smallest_B) {
  // A resonance has a peak in B of the height by which ωA swings; one without the other is no resonance.
  const double swing = c.omega[k] * largest_near(of_A, k), peak = largest_near(of_B, k);
  constexpr double alone = 0.1;
  if (swing < alone * peak || peak < alone * swing) return SpikeKind::single_number;
  if (c.omega[k] < lowest_irregular) return SpikeKind::resonance;
  return c.bodies() > 1 && smallest_B >= 0 ? SpikeKind::resonance : SpikeKind::irregular;
}

/// Spikes of A_ii and B_ii of one mode; of neighbours only the farthest off.
void spikes_of_mode(const Coefficients& c, Eigen::Index i, double size_of_A, double size_of_B, double lowest_irregular,
                    std::vector<Spike>& out) {
  const std::vector<double> A = misfits(c.omega, diagonal(c.A, i)), B = misfits(c.omega, diagonal(c.B, i));
  std::vector<double> relative(c.omega.size());
  for (std::size_t k = 0; k < relative.size(); ++k)
    relative[k] = std::max(std::abs(A[k]) / size_of_A, std::abs(B[k]) / size_of_B);
  const double threshold = std::max(visible, outstanding * doctor::quantile(relative, 0.5));
  for (std::size_t k = 2; k + 2 < relative.size(); ++k) {
    if (relative[k] < threshold || largest_near(relative, k) > relative[k]) continue;
    double smallest_B = c.B[k](i, i);
    for (std::size_t q = k - 1; q <= k + 1; ++q) smallest_B = std::min(smallest_B, c.B[q](i, i));
    out.push_back({k, i, relative[k], kind_of(c, A, B, k, lowest_irregular, smallest_B)});
  }
}

}  // namespace

std::vector<Spike> find_spikes(const Coefficients& c) {
  const doctor::Patient p(c);
  const double lowest = lowest_irregular_frequency(c);
  std::vector<Spike> out;
  for (Eigen::Index i = 0; i < c.modes(); ++i)
    if (doctor::acts(c.A, p.size_of_A, i) && doctor::acts(c.B, p.size_of_B, i))
      spikes_of_mode(c, i, p.size_of_A(i), p.size_of_B(i), lowest, out);
  return out;
}

namespace doctor {

void check_repeated_frequencies(const Patient& p, Findings& out) {
  Finding f{.check = "repeated frequency", .where = "A and B", .message = "no two frequencies have the same matrices"};
  for (std::size_t w = 1; w < p.c.omega.size(); ++w)
    for (std::size_t v = 0; v < w; ++v) {
      if (p.c.A[w] != p.c.A[v] || p.c.B[w] != p.c.B[v] || p.c.B[w].isZero(0)) continue;
      f = {.severity = Severity::error,
           .check = "repeated frequency",
           .where = fmt::format("A and B at {} and {}", frequency_text(p.c.omega[v]), frequency_text(p.c.omega[w])),
           .message = "the matrices of two frequencies are the same to the last digit",
           .why = "A and B change with frequency: one of the two is under a wrong name (P72)",
           .remedy = "leave one of the two out, or read the right one",
           .omega = p.c.omega[w]};
    }
  out.push_back(std::move(f));
}

namespace {

/// Spikes of several modes at one frequency, or next to it, are one affair.
struct Affair {
  Spike worst;
  std::vector<Eigen::Index> modes;
};

std::vector<Affair> affairs(std::vector<Spike> spikes, int bodies) {
  std::stable_sort(spikes.begin(), spikes.end(), [](const Spike& a, const Spike& b) { return a.at < b.at; });
  std::vector<Affair> out;
  for (const Spike& s : spikes) {
    if (out.empty() || s.at > out.back().worst.at + 1) out.push_back({s, {}});
    Affair& affair = out.back();
    if (std::find(affair.modes.begin(), affair.modes.end(), s.mode) == affair.modes.end())
      affair.modes.push_back(s.mode);
    // Irregular frequencies touch several modes, not all at their worst at a sample; a wrong number touches one.
    const SpikeKind kind = std::max(affair.worst.kind, s.kind, [](SpikeKind x, SpikeKind y) {
      const auto rank = [](SpikeKind k) { return k == SpikeKind::irregular ? 2 : k == SpikeKind::resonance ? 1 : 0; };
      return rank(x) < rank(y);
    });
    if (s.size > affair.worst.size) affair.worst = s;
    affair.worst.kind = kind;
  }
  for (Affair& affair : out) {
    const bool one_body = std::all_of(affair.modes.begin(), affair.modes.end(),
                                      [&](Eigen::Index mode) { return mode / 6 == affair.modes.front() / 6; });
    if (bodies > 1 && one_body && affair.worst.kind == SpikeKind::resonance) affair.worst.kind = SpikeKind::lonely;
  }
  return out;
}

Finding spike_finding(const Patient& p, const Affair& affair, double lowest_irregular) {
  const Spike& s = affair.worst;
  Finding f{
      .severity = s.kind == SpikeKind::resonance ? Severity::note : Severity::warning,
      .check = "spikes",
      .where = fmt::format("A and B of {}{} at {}", mode_label(s.mode),
                           affair.modes.size() > 1 ? fmt::format(" and {} other modes", affair.modes.size() - 1) : "",
                           frequency_text(p.c.omega[s.at])),
      .message =
          fmt::format("{}: {:.2g} of the mode's size beside what its neighbours tell", to_string(s.kind), s.size),
      .body = static_cast<int>(s.mode / 6) + 1,
      .entry = {{static_cast<int>(s.mode) + 1, static_cast<int>(s.mode) + 1}},
      .omega = p.c.omega[s.at]};
  if (s.kind == SpikeKind::irregular && lowest_irregular > 0)
    f.message += fmt::format("; below {:.4g} rad/s there is none", lowest_irregular);
  if (f.severity != Severity::note) {
    f.why = "between its neighbours A and B of a hull are smooth; a spike rings in K(t) for ever (P72)";
    f.remedy = s.kind == SpikeKind::irregular ? "compute with a lid; `froude bem heal` takes the spike out"
                                              : "look at this number in the file; `froude bem heal` takes it out";
  }
  constexpr double impossible = 0.3;
  if (s.kind == SpikeKind::single_number && s.size > impossible) f.severity = Severity::error;
  return f;
}

}  // namespace

void check_spikes(const Patient& p, Findings& out) {
  if (p.c.omega.size() < 10) {
    out.push_back(not_looked_at("spikes", "too few frequencies"));
    return;
  }
  const double lowest = lowest_irregular_frequency(p.c);
  const auto all = affairs(find_spikes(p.c), p.c.bodies());
  const std::size_t before = out.size();
  for (const Affair& affair : all) out.push_back(spike_finding(p, affair, lowest));
  look_at_excitation_spikes(p, out);
  if (out.size() == before)
    out.push_back({.check = "spikes",
                   .where = p.c.X.empty() ? "A and B" : "A, B and X",
                   .message = "all values fit between their neighbours"});
}

}  // namespace doctor
}  // namespace hydro::potential
