/// \file  `froude bem irf`: what the radiation data say in the time domain.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>

#include "froude/commands.hpp"
#include "froude/outputs.hpp"
#include "froude/plot.hpp"
#include "hydro/base/dense.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/types.hpp"
#include "hydro/io/atomic_file.hpp"
#include "hydro/radiation/rational.hpp"
#include "hydro/radiation/state_space.hpp"
#include "hydro/radiation/tail.hpp"

namespace froude {
namespace {

using hydro::dense::symmetric_part;
using hydro::potential::Coefficients;
using hydro::radiation::DampingTable;
using hydro::radiation::RationalFit;
using nlohmann::json;

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

json told(const Path& file, const Coefficients& c, const Analysis& a) {
  const auto& r = a.fit.report;
  json poles = json::array(), modes = json::array();
  for (const auto& p : a.fit.model.poles) poles.push_back({{"decay_rad_per_s", p.decay}, {"omega_rad_per_s", p.omega}});
  for (Eigen::Index i = 0; i < c.modes(); ++i)
    modes.push_back({{"mode", mode_name(c, i)},
                     {"K0", a.fit.model.kernel(0)(i, i)},
                     {"error", r.error_per_pair(i, i)},
                     {"A_infinite_of_the_fit", a.fit.A_inf(i, i)},
                     {"A_infinite_by_Ogilvie", a.ogilvie.value(i, i)},
                     {"spread_by_Ogilvie", a.ogilvie.spread(i, i)}});
  return {{"file", file.string()},
          {"order", r.order},
          {"error", r.error},
          {"error_before_passivity", r.error_before},
          {"passive", r.passive},
          {"margin", r.margin},
          {"most_negative_before", r.most_negative},
          {"lift", r.lift},
          {"shift_of_A_infinite", r.shift},
          {"why", r.why},
          {"poles", poles},
          {"modes", modes}};
}

void tell(const Path& file, const Coefficients& c, const Analysis& a, const Console& console) {
  const auto& r = a.fit.report;
  console.out << fmt::format("{}\n  fit         order {}, off the data by up to {:.2g} of the largest damping; {}\n",
                             file.string(), r.order, r.error, r.why);
  if (r.passive)
    console.out << fmt::format(
        "  passive     certified with a margin of {:.2g}; that cost an error of {:.2g} in place of {:.2g}\n", r.margin,
        r.error, r.error_before);
  else
    console.out << "  passive     not certified: the fit may give energy to a motion\n";
  console.out << fmt::format("  A(inf)      moved by {:.2g} of its diagonal\n", r.shift);
  console.out << fmt::format("  {:>14}  {:>14}\n", "decay [rad/s]", "omega [rad/s]");
  for (const auto& p : a.fit.model.poles) console.out << fmt::format("  {:>14.5g}  {:>14.5g}\n", p.decay, p.omega);
  console.out << fmt::format("  {:<16}  {:>12}  {:>10}  {:>14}  {:>14}  {:>10}\n", "mode", "K(0)", "error",
                             "A(inf), fit", "A(inf), R6", "spread");
  for (Eigen::Index i = 0; i < c.modes(); ++i)
    console.out << fmt::format("  {:<16}  {:>12.5g}  {:>10.2g}  {:>14.6g}  {:>14.6g}  {:>10.2g}\n", mode_name(c, i),
                               a.fit.model.kernel(0)(i, i), r.error_per_pair(i, i), a.fit.A_inf(i, i),
                               a.ogilvie.value(i, i), a.ogilvie.spread(i, i));
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

void export_fit(const BemIrfArguments& arguments, const Coefficients& c, const Analysis& a, const Console& console) {
  if (!arguments.output) return;
  const std::string extension = arguments.output->extension().string();
  if (extension == ".ss")
    hydro::radiation::write_openfast(a.fit.model, "Radiation of " + c.source, *arguments.output);
  else if (extension == ".h5")
    hydro::radiation::write_bemio_state_space(a.fit.model, c.water.density, 0.05, shown_length(a.fit),
                                              *arguments.output);
  else
    throw hydro::InputError(
        fmt::format("the name \"{}\" does not tell a format", arguments.output->filename().string()), {},
        "end it with .ss (OpenFAST) or .h5 (BEMIO state-space groups)");
  if (!console.json) console.out << fmt::format("wrote {}\n", arguments.output->string());
}

}  // namespace

void bem_irf(const BemIrfArguments& arguments, const Console& console) {
  hydro::require(arguments.bem.files.size() == 1, "one file can be looked at at a time; {} are given",
                 arguments.bem.files.size());
  hydro::require(arguments.tolerance > 0 && arguments.tolerance < 1, "a tolerance lies between 0 and 1, got {}",
                 arguments.tolerance);
  const Path& file = arguments.bem.files.front();
  require_outputs(named({{"-o", arguments.output}, {"--picture", arguments.picture}}),
                  files_of_coefficients(arguments.bem.files));
  const Coefficients c = hydro::potential::read(file, arguments.bem.options);
  const Analysis a = analyse(c, arguments.tolerance);
  if (console.json)
    console.out << told(file, c, a).dump(1) << '\n';
  else
    tell(file, c, a, console);
  export_fit(arguments, c, a, console);
  if (arguments.picture) {
    hydro::io::write_atomically(*arguments.picture, plot::svg(picture(c, a)));
    if (!console.json) console.out << fmt::format("wrote {}\n", arguments.picture->string());
  }
}

}  // namespace froude
