// What A and B are by themselves: symmetric, B passive, A(∞) a kinetic energy. (P60), (P61)

#include <algorithm>
#include <cmath>
#include <limits>

#include "doctor.hpp"
#include "hydro/base/dense.hpp"

namespace hydro::potential::doctor {
namespace {

struct Worst {
  double value = 0;
  Eigen::Index i = 0, j = 0;
  std::string at;
  std::optional<double> omega;
};

Worst worst_asymmetry(const Series& series, const Eigen::VectorXd& s, bool within_bodies) {
  Worst worst;
  for (const Sample& sample : series)
    for (Eigen::Index i = 0; i < s.size(); ++i)
      for (Eigen::Index j = i + 1; j < s.size(); ++j) {
        if ((i / 6 == j / 6) != within_bodies) continue;
        const auto& M = *sample.matrix;
        const double value = std::abs(M(i, j) - M(j, i)) / size_of_entry(s, i, j);
        if (value > worst.value) worst = {value, i, j, sample.at, sample.omega};
      }
  return worst;
}

/// How two entries that should be equal behave along the frequencies; one bad frequency does not count.
struct Pair {
  double difference = 0;  ///< upper quartile of |M_ij − M_ji|, relative
  bool opposite = false;  ///< M_ij is about −M_ji, and not small
  Eigen::Index i = 0, j = 0;
};

Pair pair_over_frequencies(const Series& series, const Eigen::VectorXd& s, Eigen::Index i, Eigen::Index j) {
  std::vector<double> differences, sums;
  for (const Sample& sample : series) {
    const auto& M = *sample.matrix;
    differences.push_back(std::abs(M(i, j) - M(j, i)) / size_of_entry(s, i, j));
    sums.push_back(std::abs(M(i, j) + M(j, i)) / size_of_entry(s, i, j));
  }
  const double difference = quantile(std::move(differences), 0.75), sum = quantile(std::move(sums), 0.75);
  // A pair that differs by twice what it has in common, and by more than twice what a mesh leaves, has a wrong sign.
  return {difference, difference > 2 * sum && difference > 2 * usual_asymmetry, i, j};
}

/// The worst pair over all frequencies; one of opposite signs before one that only differs.
Pair worst_pair(const Series& series, const Eigen::VectorXd& s, bool within_bodies) {
  Pair worst;
  for (Eigen::Index i = 0; i < s.size(); ++i)
    for (Eigen::Index j = i + 1; j < s.size(); ++j) {
      if ((i / 6 == j / 6) != within_bodies) continue;
      const Pair pair = pair_over_frequencies(series, s, i, j);
      if (pair.opposite > worst.opposite || (pair.opposite == worst.opposite && pair.difference > worst.difference))
        worst = pair;
    }
  return worst;
}

/// Beyond this, all along the frequencies, no mesh is an excuse: good published data reach 0.02, poor ones 0.2.
constexpr double impossible_asymmetry = 0.3;

Finding symmetry_finding(const char* name, const char* kind, const Series& series, const Eigen::VectorXd& s,
                         bool within_bodies) {
  const Worst worst = worst_asymmetry(series, s, within_bodies);
  Finding f{.check = fmt::format("{} of {}", kind, name),
            .where = worst.value > 0 ? entry_text(name, worst.i, worst.j, worst.at) : std::string(name),
            .message = fmt::format("largest |{0}_ij − {0}_ji| is {1:.2g} of sqrt({0}_ii {0}_jj); up to {2} is usual",
                                   name, worst.value, usual_asymmetry),
            .body = static_cast<int>(worst.i / 6) + 1,
            .entry = {{static_cast<int>(worst.i) + 1, static_cast<int>(worst.j) + 1}},
            .omega = worst.omega};
  if (worst.value <= usual_asymmetry) return f;
  f.severity = Severity::warning;
  f.why = within_bodies ? "the fluid's reaction has a potential (P60): what is not symmetric creates or destroys energy"
                        : "what body i does to body j equals what j does to i (P60)";
  f.remedy = "compute on a finer mesh, or check that rows and columns were not mixed up; `froude bem heal` averages";
  const Pair pair = worst_pair(series, s, within_bodies);
  if (pair.opposite || pair.difference > impossible_asymmetry) {
    f.severity = Severity::error;
    f.where = entry_text(name, pair.i, pair.j, "most frequencies");
    f.entry = {{static_cast<int>(pair.i) + 1, static_cast<int>(pair.j) + 1}};
    f.body = static_cast<int>(pair.i / 6) + 1;
    f.omega.reset();
    f.message = fmt::format("{0}_ij and {0}_ji {1} at most frequencies: by {2:.2g} of sqrt({0}_ii {0}_jj)", name,
                            pair.opposite ? "are of opposite sign" : "differ", pair.difference);
    f.remedy = "look for a wrong sign, a transposed block, or a wrong mode in this pair";
  }
  return f;
}

/// Smallest eigenvalue of the symmetric part, scaled by sqrt(s_i s_j).
double smallest_eigenvalue(const Eigen::MatrixXd& M, const Eigen::VectorXd& s) {
  const Eigen::Index n = s.size();
  const Eigen::MatrixXd scaled = Eigen::MatrixXd::NullaryExpr(
      n, n, [&](Eigen::Index i, Eigen::Index j) { return (M(i, j) + M(j, i)) / (2 * size_of_entry(s, i, j)); });
  return dense::symmetric_eigenvalues(scaled)(0);
}

}  // namespace

void check_symmetry(const Patient& p, Findings& out) {
  out.push_back(symmetry_finding("A", "symmetry", p.A, p.size_of_A, true));
  out.push_back(symmetry_finding("B", "symmetry", p.B, p.size_of_B, true));
}

void check_reciprocity(const Patient& p, Findings& out) {
  if (p.c.bodies() < 2) return;
  out.push_back(symmetry_finding("A", "reciprocity", p.A, p.size_of_A, false));
  out.push_back(symmetry_finding("B", "reciprocity", p.B, p.size_of_B, false));
}

/// B_ii < 0 would make a hull in calm water a source of power. (P61)
void check_sign_of_damping(const Patient& p, Findings& out) {
  Worst worst;
  for (const Sample& sample : p.B)
    for (Eigen::Index i = 0; i < p.size_of_B.size(); ++i) {
      const double value = -(*sample.matrix)(i, i) / size_of_entry(p.size_of_B, i, i);
      if (value > worst.value) worst = {value, i, i, sample.at, sample.omega};
    }
  Finding f{.check = "sign of B", .where = "B", .message = "no diagonal entry of B is negative"};
  if (worst.value > 0) {
    // How unsymmetric the data are is how far their own discretisation error reaches; data that are bad in this respect
    // are not forgiven more than usual ones for it.
    const double asymmetry =
        std::max(worst_asymmetry(p.B, p.size_of_B, true).value, worst_asymmetry(p.B, p.size_of_B, false).value);
    constexpr double round_off = 1e-9;
    if (worst.value > std::max(round_off, std::min(asymmetry, usual_negative_damping))) f.severity = Severity::warning;
    if (worst.value > impossible_negative_damping) f.severity = Severity::error;
    f.where = entry_text("B", worst.i, worst.j, worst.at);
    f.body = static_cast<int>(worst.i / 6) + 1;
    f.entry = {{static_cast<int>(worst.i) + 1, static_cast<int>(worst.i) + 1}};
    f.omega = worst.omega;
    f.message =
        fmt::format("B is negative by {:.2g} of its largest value in that mode; the data are unsymmetric by {:.2g}",
                    worst.value, asymmetry);
  }
  if (f.severity != Severity::note) {
    f.why = "a hull that oscillates in calm water would gain energy from it (P61)";
    f.remedy =
        "irregular frequencies or too coarse a mesh do this: use a lid, a finer mesh, or leave these frequencies out";
  }
  out.push_back(std::move(f));
}

/// Power given to the waves is ½ v* B v: no motion may have it negative. (P61)
void check_passivity(const Patient& p, Findings& out) {
  double smallest = std::numeric_limits<double>::infinity();
  std::vector<double> all;
  const Sample* worst = &p.B.front();
  for (const Sample& sample : p.B) {
    const double value = smallest_eigenvalue(*sample.matrix, p.size_of_B);
    all.push_back(value);
    if (value < smallest) {
      smallest = value;
      worst = &sample;
    }
  }
  Finding f{.check = "passivity of B",
            .where = "B at " + worst->at,
            .message = fmt::format(
                "smallest eigenvalue of the symmetric part, scaled by sqrt(B_ii B_jj), is {:.2g}; down to {} is usual",
                smallest, -usual_negative_damping),
            .omega = worst->omega};
  if (smallest < -usual_negative_damping) {
    f.severity = Severity::warning;
    f.why = "some motion takes power from calm water (P61), and a simulation may grow without bound";
    f.remedy = "use a finer mesh, or `froude bem heal`, which finds the nearest passive B";
  }
  // Negative by this much at half of the frequencies is no local trouble but a wrong block.
  constexpr double impossible = 0.05;
  if (const double middle = quantile(std::move(all), 0.5); middle < -impossible) {
    f.severity = Severity::error;
    f.message += fmt::format("; at half of the frequencies it is below {:.2g}", middle);
    f.remedy = "look for blocks of wrong sign or of another body";
  }
  out.push_back(std::move(f));
}

/// ½ vᵀA(∞)v is the kinetic energy of the water set in motion by a blow. (P60)
void check_positivity_of_limit(const Patient& p, Findings& out) {
  if (!p.c.A_inf) {
    out.push_back(not_looked_at("positivity of A(inf)", "A(∞) is absent"));
    return;
  }
  const double smallest = smallest_eigenvalue(*p.c.A_inf, p.size_of_A);
  // Asymmetry of usual size may carry an eigenvalue that is zero in truth as far below it.
  Finding f{.severity = smallest < -usual_asymmetry ? Severity::error : Severity::note,
            .check = "positivity of A(inf)",
            .where = "A at infinite frequency",
            .message = fmt::format("smallest eigenvalue, scaled by sqrt(A_ii A_jj), is {:.2g}", smallest)};
  if (f.severity != Severity::note) {
    f.why = "½ v A(∞) v is the kinetic energy of water set in motion by a blow (P60); time-domain runs invert M + A(∞)";
    f.remedy = "look for a wrong sign or unit in A(∞); without it, it is estimated from A and B";
  }
  out.push_back(std::move(f));
}

void check_limits(const Patient& p, Findings& out) {
  const auto finding = [](bool is_there, const char* limit, Severity severity, const char* remedy) {
    return Finding{.severity = is_there ? Severity::note : severity,
                   .check = fmt::format("limit at {}", limit),
                   .where = fmt::format("A as frequency tends to {}", limit),
                   .message = is_there ? "present" : "absent",
                   .why = is_there ? "" : "a table ends; what lies beyond has to be known or estimated",
                   .remedy = is_there ? "" : remedy};
  };
  out.push_back(finding(p.c.A_zero.has_value(), "zero", Severity::note,
                        "nothing needs it but extrapolation to long waves; in finite depth heave has no such limit"));
  out.push_back(finding(p.c.A_inf.has_value(), "infinity", Severity::warning,
                        "time-domain runs need it: compute omega = infinity too, or it is estimated from A and B"));
}

}  // namespace hydro::potential::doctor
