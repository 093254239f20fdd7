#include "fit/problem/restoring.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "hydro/signal/distributions.hpp"
#include "telling.hpp"

namespace fit::restoring {
namespace {

/// All runs in one system, columns[i]·x = load[i].
struct System {
  Eigen::MatrixXd columns;
  Eigen::VectorXd load, motion;
  Eigen::Index runs, terms;
};

System system_of(const Problem& problem) {
  Eigen::Index points = 0;
  for (const Run& run : problem.runs) points += std::ssize(run.motion);
  const Eigen::Index runs = std::ssize(problem.runs), terms = problem.options.cubic ? 2 : 1;
  System out{Eigen::MatrixXd::Zero(points, runs + terms), Eigen::VectorXd(points), Eigen::VectorXd(points), runs,
             terms};
  Eigen::Index row = 0;
  for (Eigen::Index r = 0; r < runs; ++r) {
    const Run& run = problem.runs[static_cast<std::size_t>(r)];
    of_run(run.source, [&] {
      hydro::require(run.motion.size() == run.load.size(), "there are {} motions and {} loads", run.motion.size(),
                     run.load.size());
    });
    for (std::size_t i = 0; i < run.motion.size(); ++i, ++row) {
      const double x = run.motion[i];
      of_run(run.source,
             [&] { hydro::require(std::isfinite(x) && std::isfinite(run.load[i]), "point {} is not finite", i + 1); });
      out.columns(row, r) = 1;
      out.columns(row, runs) = x;
      if (terms == 2) out.columns(row, runs + 1) = x * x * x;
      out.motion[row] = x;
      out.load[row] = run.load[i];
    }
  }
  return out;
}

/// How residuals that follow one another along the motion correlate: what the curve leaves out shows here.
double correlation_along(const Eigen::VectorXd& motion, const Eigen::VectorXd& residual) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(motion.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return motion[a] < motion[b]; });
  double sum = 0;
  for (std::size_t i = 1; i < order.size(); ++i) sum += residual[order[i - 1]] * residual[order[i]];
  return sum / residual.squaredNorm();
}

Coefficient told(const std::string& name, double value, double error, double t, double dof) {
  Coefficient out{.name = name, .value = value, .standard_error = error, .why_not = {}};
  out.interval = {value - t * error, value + t * error};
  out.white_interval = out.interval;
  out.effective_samples = dof;
  if (out.interval.low <= 0 && out.interval.high >= 0) {
    out.value.reset();
    out.why_not = "it cannot be told from zero";
  }
  return out;
}

/// The best values with what tells their errors.
struct Curve {
  Eigen::VectorXd x, error, residual;
  double deviation, dof, t;  ///< of a point; t of the level asked for
};

Curve fit_curve(const System& s, const Options& options) {
  const auto dof = static_cast<double>(s.columns.rows() - s.columns.cols());
  hydro::require(dof > 0, "there are {} points for {} coefficients, a preload for each test among them",
                 s.columns.rows(), s.columns.cols());
  // Columns of like size, or the cube of a small motion would count as nothing.
  const Eigen::VectorXd scale = s.columns.colwise().norm().transpose();
  hydro::require((scale.array() > 0).all(), "nothing moves: all points stand at zero");
  const Eigen::MatrixXd columns = s.columns * scale.cwiseInverse().asDiagonal();
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
  qr.setThreshold(1e-10);
  hydro::require(qr.rank() == columns.cols(),
                 "the points stand at too few different places to tell a stiffness{} from a preload",
                 options.cubic ? ", a cubic term" : "");
  Curve out{.x = qr.solve(s.load).cwiseQuotient(scale),
            .error = {},
            .residual = {},
            .deviation = 0,
            .dof = dof,
            .t = hydro::signal::student_t_quantile((1 + options.confidence) / 2, dof)};
  out.residual = s.load - s.columns * out.x;
  out.deviation = std::sqrt(out.residual.squaredNorm() / dof);
  const Eigen::MatrixXd inverse = (columns.transpose() * columns).inverse();
  out.error = out.deviation * inverse.diagonal().cwiseSqrt().cwiseQuotient(scale);
  return out;
}

/// Coefficients of all tests together, and what a scene of motion may include.
void add_coefficients(const System& s, const Curve& curve, const Problem& problem, Report& report) {
  const bool turns = problem.turns;
  const std::string load = turns ? "N m" : "N", motion = turns ? "rad" : "m";
  Facts include;
  for (Eigen::Index j = 0; j < s.terms; ++j) {
    const Eigen::Index at = s.runs + j;
    const std::string unit = fmt::format("{}/{}{}", load, motion, j == 0 ? "" : "^3");
    Coefficient c = told(j == 0 ? "stiffness" : "cubic", curve.x[at], curve.error[at], curve.t, curve.dof);
    count_slope(slope_error_of({{problem.load_slope, 1}, {problem.motion_slope, j == 0 ? -1.0 : -3.0}}), curve.x[at],
                c);
    if (c.value) include.emplace_back(c.name, fmt::format("{:.10g} {}", *c.value, unit));
    report.estimates.push_back({c, unit});
  }
  if (!include.empty()) report.facts.emplace_back("coefficients", std::move(include));
  report.say("points lie {:.3g} {} about the curve", curve.deviation, load);
}

/// Of n independent residuals the correlation would scatter by 1/√n: what is beyond three times that is no chance.
void add_form(const System& s, const Curve& curve, Report& report) {
  const double along = correlation_along(s.motion, curve.residual);
  report.facts.emplace_back("correlation_along", along);
  if (along > 3 / std::sqrt(static_cast<double>(s.motion.size())))
    report.warn(
        fmt::format("points beside each other lie off to the same side (their correlation is {:.2f}): the curve "
                    "has another form, or friction holds the load on the way back; intervals are too narrow",
                    along));
}

}  // namespace

Solution solve(const Problem& problem) {
  hydro::require(!problem.runs.empty(), "a fit of stiffness needs one test at least");
  const System s = system_of(problem);
  const Curve curve = fit_curve(s, problem.options);
  Solution out{.report = {}, .preload = curve.x.head(s.runs), .stiffness = curve.x[s.runs], .cubic = 0, .fitted = {}};
  if (s.terms == 2) out.cubic = curve.x[s.runs + 1];
  Report& report = out.report;
  report.heading = fmt::format("load = preload + stiffness x{} over {} points of {} test{}",
                               s.terms == 2 ? " + cubic x^3" : "", s.columns.rows(), s.runs, s.runs > 1 ? "s" : "");
  report.facts = {{"points", s.columns.rows()}, {"residual_deviation", curve.deviation}};
  add_coefficients(s, curve, problem, report);
  Eigen::Index row = 0;
  for (std::size_t r = 0; r < problem.runs.size(); ++r) {
    const Eigen::Index points = std::ssize(problem.runs[r].motion);
    out.fitted.emplace_back(s.columns.middleRows(row, points) * curve.x);
    row += points;
    const double preload = out.preload[static_cast<Eigen::Index>(r)];
    Report part = begin_run(problem.runs[r].source);
    part.facts.emplace_back("preload", preload);
    part.say("{}: preload {:.4g} {}", problem.runs[r].source.name(), preload, problem.turns ? "N m" : "N");
    report.parts.push_back(std::move(part));
  }
  add_form(s, curve, report);
  return out;
}

}  // namespace fit::restoring
