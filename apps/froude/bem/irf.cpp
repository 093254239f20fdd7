/// \file  `froude bem irf`: what the radiation data say in the time domain.
#include <algorithm>
#include <cmath>

#include "answers/picture.hpp"
#include "froude/commands.hpp"
#include "froude/outputs.hpp"
#include "froude/report.hpp"
#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/types.hpp"
#include "hydro/radiation/rational.hpp"
#include "hydro/radiation/state_space.hpp"
#include "hydro/radiation/tail.hpp"

namespace froude {
namespace {

using hydro::dense::symmetric_part;
using hydro::potential::Coefficients;
using hydro::radiation::DampingTable;
using hydro::radiation::RationalFit;

/// What the data hold, made symmetric, and what was found from them.
struct Analysis {
  DampingTable damping;
  std::vector<Eigen::MatrixXd> A;
  hydro::radiation::ExtrapolatedDamping extrapolated;
  hydro::radiation::InfiniteAddedMass ogilvie;
  RationalFit fit;
};

Analysis analyse(const Coefficients& c, double tolerance) {
  Analysis a{{c.omega, {}}, {}, {}, {}, {}};
  for (const auto& B : c.B) a.damping.B.push_back(symmetric_part(B));
  for (const auto& A : c.A) a.A.push_back(symmetric_part(A));
  std::optional<Eigen::MatrixXd> A_inf;
  if (c.A_inf) A_inf = symmetric_part(*c.A_inf);
  a.extrapolated = hydro::radiation::extrapolated(a.damping, a.A, A_inf);
  a.ogilvie = hydro::radiation::infinite_added_mass(a.damping, a.A);
  a.fit = hydro::radiation::fit(a.damping, a.A, A_inf, {.tolerance = tolerance});
  return a;
}

std::string mode_name(const Coefficients& c, Eigen::Index mode) {
  const std::string name(hydro::mode_names[static_cast<std::size_t>(mode % 6)]);
  return c.bodies() == 1 ? name : c.body[static_cast<std::size_t>(mode / 6)].name + "." + name;
}

Report report_of(const Path& file, const Coefficients& c, const Analysis& a) {
  const auto& r = a.fit.report;
  Report out;
  out.say("{}", fact("file", file.string()));
  out.say("  fit         order {}, off the data by up to {:.2g} of the largest damping; {}", fact("order", r.order),
          fact("error", r.error), fact("why", r.why));
  out.keep("passive", r.passive).keep("margin", r.margin).keep("error_before_passivity", r.error_before);
  out.keep("most_negative_before", r.most_negative).keep("lift", r.lift);
  if (r.passive)
    out.say("  passive     certified with a margin of {:.2g}; that cost an error of {:.2g} in place of {:.2g}",
            r.margin, r.error, r.error_before);
  else
    out.say("  passive     not certified: the fit may give energy to a motion");
  out.say("  A(inf)      moved by {:.2g} of its diagonal", fact("shift_of_A_infinite", r.shift));
  out.say("  {:>14}  {:>14}", "decay [rad/s]", "omega [rad/s]").keep("poles", Json::array());
  for (const auto& p : a.fit.model.poles)
    out.row("poles", "  {:>14.5g}  {:>14.5g}", fact("decay_rad_per_s", p.decay), fact("omega_rad_per_s", p.omega));
  out.say("  {:<16}  {:>12}  {:>10}  {:>14}  {:>14}  {:>10}", "mode", "K(0)", "error", "A(inf), fit", "A(inf), R6",
          "spread");
  for (Eigen::Index i = 0; i < c.modes(); ++i)
    out.row("modes", "  {:<16}  {:>12.5g}  {:>10.2g}  {:>14.6g}  {:>14.6g}  {:>10.2g}", fact("mode", mode_name(c, i)),
            fact("K0", a.fit.model.kernel(0)(i, i)), fact("error", r.error_per_pair(i, i)),
            fact("A_infinite_of_the_fit", a.fit.A_inf(i, i)), fact("A_infinite_by_Ogilvie", a.ogilvie.value(i, i)),
            fact("spread_by_Ogilvie", a.ogilvie.spread(i, i)));
  return out;
}

/// Time after which the slowest pole has lost all but a thousandth, but no more than a minute.
double shown_length(const RationalFit& fit) {
  double slowest = 1e9;
  for (const auto& p : fit.model.poles) slowest = std::min(slowest, p.decay);
  return std::min(60.0, std::log(1e3) / slowest);
}

/// Diagonal kernels and damping of one body's modes that make waves: data and fit.
plot::Figure picture(const Coefficients& c, const Analysis& a) {
  plot::Figure f{.title = "Radiation of " + c.body.front().name, .panels = {}};
  const double length = shown_length(a.fit);
  for (Eigen::Index i = 0; i < 6; ++i) {
    if (a.fit.model.kernel(0)(i, i) == 0) continue;
    plot::Panel K{.x = {"time", "s"}, .y = {"K " + mode_name(c, i)}, .series = {}};
    plot::Series data{.name = "from damping", .x = {}, .y = {}}, fit{.name = "fit", .x = {}, .y = {}, .dashed = true};
    for (int k = 0; k <= 300; ++k) {
      const double t = length * k / 300;
      fit.x.push_back(t);
      fit.y.push_back(a.fit.model.kernel(t)(i, i));
    }
    const double told_to = std::min(length, hydro::radiation::RetardationKernel::longest_time(a.extrapolated.table));
    for (int k = 0; k <= 300; ++k) {
      const double t = told_to * k / 300;
      data.x.push_back(t);
      data.y.push_back(hydro::radiation::retardation(a.extrapolated.table, t)(i, i));
    }
    K.series = {std::move(data), std::move(fit)};
    plot::Panel B{.x = {"frequency", "rad/s"}, .y = {"B " + mode_name(c, i)}, .series = {}};
    plot::Series given{.name = "data", .x = c.omega, .y = {}, .line = false, .marks = true},
        fitted{.name = "fit", .x = {}, .y = {}};
    for (const auto& m : a.damping.B) given.y.push_back(m(i, i));
    for (int k = 1; k <= 600; ++k) {
      fitted.x.push_back(1.5 * c.omega.back() * k / 600);
      fitted.y.push_back(a.fit.model.transform(fitted.x.back()).real()(i, i));
    }
    B.series = {std::move(given), std::move(fitted)};
    f.panels.push_back(std::move(K));
    f.panels.push_back(std::move(B));
  }
  return f;
}

void export_fit(const BemIrfArguments& arguments, const Coefficients& c, const Analysis& a) {
  if (!arguments.output) return;
  if (arguments.output->extension() == ".ss")
    hydro::radiation::write_openfast(a.fit.model, "Radiation of " + c.source, *arguments.output);
  else
    hydro::radiation::write_bemio_state_space(a.fit.model, c.water.density, 0.05, shown_length(a.fit),
                                              *arguments.output);
}

}  // namespace

void bem_irf(const BemIrfArguments& arguments, const Console& console) {
  hydro::require(arguments.bem.files.size() == 1, "one file can be looked at at a time; {} are given",
                 arguments.bem.files.size());
  hydro::require(arguments.tolerance > 0 && arguments.tolerance < 1, "a tolerance lies between 0 and 1, got {}",
                 arguments.tolerance);
  if (arguments.output && arguments.output->extension() != ".ss" && arguments.output->extension() != ".h5")
    throw hydro::InputError(
        fmt::format("the name \"{}\" does not tell a format", arguments.output->filename().string()), {},
        "end it with .ss (OpenFAST) or .h5 (BEMIO state-space groups)");
  const Path& file = arguments.bem.files.front();
  require_outputs(named({{"-o", arguments.output}, {"--picture", arguments.picture}}),
                  files_of_coefficients(arguments.bem.files));
  require_picture(arguments.picture);
  const Coefficients c = hydro::potential::read(file, arguments.bem.options);
  const Analysis a = analyse(c, arguments.tolerance);
  export_fit(arguments, c, a);
  if (arguments.picture) plot::write_picture(*arguments.picture, picture(c, a));
  tell(report_of(file, c, a).wrote(arguments.output).wrote(arguments.picture), console);
}

}  // namespace froude
