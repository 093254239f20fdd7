#include "scene/fit_models.hpp"

namespace froude::scene {
namespace {

constexpr FitWord<::fit::Derivative> derivatives[] = {{"local polynomial", ::fit::Derivative::local_polynomial},
                                                      {"smoothing spline", ::fit::Derivative::smoothing_spline},
                                                      {"fourier series", ::fit::Derivative::fourier_series}};
constexpr FitWord<::fit::FilterChoice::Kind> low_passes[] = {{"butterworth", ::fit::FilterChoice::Kind::butterworth},
                                                             {"symmetric weights", ::fit::FilterChoice::Kind::finite}};
constexpr FitWord<::fit::WindowChoice::Kind> windows[] = {{"span", ::fit::WindowChoice::Kind::span},
                                                          {"full cycles", ::fit::WindowChoice::Kind::full_cycles}};

std::vector<::fit::FilterChoice> read_filters(const Record& prepare) {
  using Kind = ::fit::FilterChoice::Kind;
  std::vector<::fit::FilterChoice> out;
  for (const Record& n : prepare.tables("notch"))
    out.push_back({.kind = Kind::notch, .hz = hertz(n, "centre"), .width = hertz(n, "width")});
  if (prepare.has("moving_average"))
    out.push_back({.kind = Kind::moving_average, .seconds = prepare.si("moving_average")});
  if (!prepare.has("low_pass")) return out;
  const Record& low = prepare.table("low_pass");
  ::fit::FilterChoice f{.kind = value_of_word(low_passes, low.text("kind")), .hz = hertz(low, "cutoff")};
  if (low.has("order")) {
    f.order = static_cast<int>(low["order"].integer);
    if (f.order < 1 || f.order > 10) throw low.wrong("order", "must lie between 1 and 10");
  }
  out.push_back(f);
  return out;
}

::fit::WindowChoice read_window(const Record& window) {
  ::fit::WindowChoice out{.kind = value_of_word(windows, window.text("kind"))};
  if (window.has("last") && window["last"].integer < 1) throw window.wrong("last", "must be 1 at least");
  if (window.has("last")) out.cycles = static_cast<int>(window["last"].integer);
  if (window.has("tolerance")) out.tolerance = window.si("tolerance");
  out.from = given(window, "from");
  out.to = given(window, "to");
  if (window.has("to") && !(out.from < out.to)) throw window.wrong("to", "must be later than from");
  return out;
}

}  // namespace

::fit::PrepareOptions read_steps(const Record& root) {
  ::fit::PrepareOptions out;
  if (!root.has("prepare")) return out;
  const Record& prepare = root.table("prepare");
  out.longest_gap_s = given(prepare, "longest_gap");
  if (prepare.has("outliers")) {
    const Record& outliers = prepare.table("outliers");
    out.outlier_window_s = outliers.si("window");
    out.outlier_deviations = outliers.si("deviations");
    if (out.outlier_deviations < 3) throw outliers.wrong("deviations", "must be 3 at least: noise itself comes so far");
  }
  if (prepare.has("resample")) out.resample_hz = hertz(prepare, "resample");
  if (prepare.has("derivative_bandwidth")) out.derivative_bandwidth_hz = hertz(prepare, "derivative_bandwidth");
  out.derivative = value_of_word(derivatives, prepare.text("derivative_method"));
  out.filters = read_filters(prepare);
  if (prepare.has("window")) out.window = read_window(prepare.table("window"));
  out.average_cycles = prepare.has("mean_cycle");
  if (out.average_cycles && out.window.kind != ::fit::WindowChoice::Kind::full_cycles)
    throw prepare.wrong("mean_cycle", "needs cycles", "set window = { kind = \"full cycles\" }");
  return out;
}

}  // namespace froude::scene
