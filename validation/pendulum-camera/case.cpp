#include <algorithm>
#include <cmath>
#include <string>

#include "answers/fit_kind.hpp"
#include "answers/fit_scene.hpp"
#include "harness/case.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"

namespace froude::validation::pendulum_camera {
namespace {

/// The scene of the fit, whose track lies among the data of others.
scene::FitScene fit_of(const Folders& folders, const std::string& run) {
  const auto file = folders.own() / "fit.toml";
  std::string text = hydro::io::read_text(file);
  const std::string name = "track.csv";
  const auto at = text.find(name);
  hydro::ensure(at != std::string::npos, "the fit names its track");
  text.replace(at, name.size(), folders.shared("pendulum_camera/ibm_double_pendulum/" + run).string());
  return scene::parse_fit(text, file);
}

/// rms of a panel that shows what is left.
double rms_of(const plot::Panel& panel) {
  double squares = 0, n = 0;
  for (const double left : panel.series.front().y)
    if (std::isfinite(left)) squares += left * left, ++n;
  return std::sqrt(squares / n);
}

}  // namespace

Outcome outcome(const Folders& folders) {
  const scene::FitScene scene = fit_of(folders, "0.csv");
  const scene::FitAnswer answer = scene.of->answer(scene);
  if (answer.report.refused) throw hydro::NumericsError(answer.report.refused->why);
  Outcome out;
  // J1, the centre and the inertia of the second arm, as the scene lists them; masses and lengths are its own.
  const auto& told = answer.report.estimates;
  const auto value = [&](std::size_t k) { return told.at(k).coefficient.value.value(); };
  constexpr double mass = 0.77, length = 0.145, length_2 = 0.11094, first = length * length / 4;  // kg, m, kg m²
  const double inertia = value(0) + first + mass * length * length, arm = value(1) * length_2;
  out.numbers.push_back({"coupling over the first inertia", mass * length * arm / inertia, ""});
  out.numbers.push_back({"second inertia over the first", (value(2) + mass * arm * arm) / inertia, ""});
  double widest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& interval = told[k].coefficient.interval;
    widest = std::max(widest, (interval.high - interval.low) / 2 / value(k));
  }
  out.numbers.push_back({"largest relative half-width of an inertia or a centre", widest, ""});
  out.numbers.push_back({"residual of the first arm over 0.5 s", rms_of(answer.panels.at(1)), "rad"});
  out.numbers.push_back({"residual of the second arm over 0.5 s", rms_of(answer.panels.at(3)), "rad"});
  out.pictures.push_back({"motion",
                          "Angles of both arms on film, what the fit makes of them, and what is left.",
                          {.title = "A double pendulum on film", .panels = answer.panels},
                          true});
  return out;
}

}  // namespace froude::validation::pendulum_camera
