#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "answers/linear_response.hpp"
#include "answers/simulate.hpp"
#include "dynamics/frequency/modes.hpp"
#include "harness/case.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"
#include "hydro/signal/fft.hpp"
#include "hydro/signal/harmonics.hpp"
#include "hydro/waves/dispersion.hpp"

namespace froude::validation::fagerbakke_arrays {
namespace {

constexpr double pi = std::numbers::pi, asked_steepness = 1.0 / 80, looked_at = 100;  // s, the end of each run

/// Means of the springs of each set of table 5.2, N/m.
const std::map<std::string, double> springs{{"S1", 29332}, {"S2", 26258}, {"S3", 14898}, {"S4", 6390}};

struct Replacement {
  std::string from, to;
};
std::string replaced(std::string text, const std::vector<Replacement>& all) {
  for (const auto& [from, to] : all) {
    const std::size_t at = text.find(from);
    hydro::require(at != std::string::npos, "the scene of modules has no \"{}\"", from);
    text.replace(at, from.size(), to);
  }
  return text;
}

/// The scene with another number of modules; `axial`: springs along the line between their ends, as tested.
scene::Scene modules(const Folders& folders, int count, bool axial = false) {
  std::string text = hydro::io::read_text(folders.own() / "scene.toml");
  if (count == 1) {  // one module has both moorings, and nothing beside it
    const std::size_t begin = text.find("[[connector]]"), end = text.find("[ask]");
    text.erase(begin, end - begin);
    text = replaced(text,
                    {{", \"m2\"]", "]"}, {"4280", "8560"}, {", \"spring*force_x\"", ""}, {", \"spring*force*\"", ""}});
  }
  if (axial)
    text = replaced(text, {{"\"bushing\"", "\"axial\""},
                           {"\"(29332, 0, 0) N/m\"", "\"29332 N/m\"\nrest_length = \"as placed\""},
                           {"spring*force_x", "spring*force"}});
  if (count > 1) text = replaced(text, {{"\"m2\"]", fmt::format("\"m{}\"]", count)}});
  text = replaced(text, {{"(-6.5, 0, 0)", fmt::format("({}, 0, 0)", -6.5 * (count - 1))},
                         {"count = 2", fmt::format("count = {}", count)}});
  return scene::parse(text, folders.own() / "scene.toml");
}

/// Modules whose coefficients are known, in waves of any period, with any springs.
class Array {
 public:
  explicit Array(scene::Scene scene) : scene_(std::move(scene)), prepared_(compile::prepare(scene_)) {}

  void set(double stiffness, double period, double steepness = asked_steepness) {
    for (auto& c : prepared_.bushing) c.stiffness[0] = stiffness;
    for (auto& c : prepared_.axial) c.law.stiffness = stiffness;
    const double omega = 2 * pi / period, length = 2 * pi / hydro::waves::wavenumber(omega, scene_.water);
    amplitude_ = steepness * length / 2;
    period_ = period;
    scene_.rao->omega = {omega};
    scene_.rao->drag->steepness = steepness;
    auto& wave = std::get<scene::RegularWave>(scene_.waves->kind);
    wave.amplitude = amplitude_;
    wave.period = period;
    // The less drag, the longer what the start leaves behind.
    scene_.waves->ramp = steepness < asked_steepness ? 600 : 100;
    scene_.run->duration = steepness < asked_steepness ? 1600 : 200;
  }
  double amplitude() const { return amplitude_; }
  double period() const { return period_; }
  Responses responses() const { return respond(scene_, prepared_); }
  /// Amplitude of one signal over periods, with drag at the steepness asked.
  plot::Series curve(const std::string& name, const std::string& signal, double stiffness) {
    plot::Series out{.name = name, .x = {}, .y = {}};
    for (double period = 8; period > 2.45; period -= 0.1) {
      set(stiffness, period);
      out.x.push_back(period);
      out.y.push_back(std::abs(responses().signal(signal).values[0]));
    }
    return out;
  }
  /// The last hundred seconds.
  Run run() const {
    Run r = run_model(scene_, compile::time_model(scene_, prepared_));
    hydro::require(r.stopped.empty(), "modules in waves of {} s: {}", period_, r.stopped);
    const auto first = r.time.size() - static_cast<std::size_t>(std::lround(looked_at / scene_.run->every));
    r.time.erase(r.time.begin(), r.time.begin() + static_cast<std::ptrdiff_t>(first));
    for (auto& s : r.signals) s.values.erase(s.values.begin(), s.values.begin() + static_cast<std::ptrdiff_t>(first));
    return r;
  }
  std::vector<double> own_frequencies() const {
    std::vector<double> out;
    for (const auto& m : dynamics::frequency::free_motions(compile::frequency_model(prepared_), prepared_.groups).modes)
      out.push_back(m.omega);
    return out;
  }

 private:
  scene::Scene scene_;
  compile::Prepared prepared_;
  double amplitude_ = 0, period_ = 0;
};

std::string kind_of(const std::string& signal) { return signal.substr(signal.find('.') + 1); }

/// The largest difference of first harmonics, of surge, heave, pitch and force each over the largest of its kind.
double apart(const Array& array, const Run& run, const Responses& rao) {
  std::map<std::string, double> largest, difference;
  const std::vector<double> omega{2 * pi / array.period(), 4 * pi / array.period(), 6 * pi / array.period()};
  for (const ComplexSignal& s : rao.signals) {
    const auto of_run =
        hydro::signal::fit_harmonics(run.time, run.signal(s.name), omega).amplitude[0] / array.amplitude();
    double &l = largest[kind_of(s.name)], &d = difference[kind_of(s.name)];
    l = std::max(l, std::abs(s.values[0]));
    d = std::max(d, std::abs(of_run - s.values[0]));
  }
  double out = 0;
  for (const auto& [kind, d] : difference) out = std::max(out, d / largest[kind]);
  return out;
}

/// Peaks above 1 % of the largest in the spectra of connector forces that are neither n ω nor an eigenfrequency.
double unexplained(const Array& array, const Run& run) {
  const double step = run.time[1] - run.time[0];
  const auto n = static_cast<std::size_t>(
      std::lround(std::floor(looked_at / array.period()) * array.period() / step));  // whole periods
  const double bin = 2 * pi / (static_cast<double>(n) * step);
  const auto own = array.own_frequencies();
  const auto known = [&](double omega) {
    const double order = omega * array.period() / (2 * pi);
    if (std::abs(order - std::round(order)) * 2 * pi / array.period() < 1.5 * bin && order > 0.5) return true;
    return std::any_of(own.begin(), own.end(), [&](double w) { return std::abs(w - omega) < 1.5 * bin; });
  };
  double count = 0;
  for (const auto& s : run.signals) {
    if (!s.name.starts_with("spring") || !(s.name.ends_with("force") || s.name.ends_with("force_x"))) continue;
    std::vector<double> windowed(s.values.end() - static_cast<std::ptrdiff_t>(n), s.values.end());
    double mean = 0;
    for (const double v : windowed) mean += v / static_cast<double>(n);
    for (std::size_t i = 0; i < n; ++i)
      windowed[i] = (windowed[i] - mean) * (1 - std::cos(2 * pi * static_cast<double>(i) / static_cast<double>(n)));
    const auto half = hydro::signal::real_fft(windowed);
    const auto height = [&](std::size_t k) { return std::abs(half[k]); };
    double top = 0;
    for (std::size_t k = 1; k < half.size(); ++k) top = std::max(top, height(k));
    for (std::size_t k = 1; k + 1 < half.size(); ++k)
      if (height(k) > 0.01 * top && height(k) > height(k - 1) && height(k) >= height(k + 1) &&
          !known(bin * static_cast<double>(k)))
        ++count;
  }
  return count;
}

/// The mean surge of the module that wanders most over the largest amplitude of surge.
double mean_over_amplitude(const Array& array, const Run& run) {
  double mean = 0, amplitude = 0;
  const std::vector<double> omega{2 * pi / array.period()};
  for (const auto& s : run.signals) {
    if (!s.name.ends_with(".surge") || !s.name.starts_with("m")) continue;
    const auto fit = hydro::signal::fit_harmonics(run.time, s.values, omega);
    mean = std::max(mean, std::abs(fit.mean));
    amplitude = std::max(amplitude, std::abs(fit.amplitude[0]));
  }
  return mean / amplitude;
}

struct Setting {
  const char* set;
  double period, steepness = asked_steepness;
};

}  // namespace

Outcome outcome(const Folders& folders) {
  Outcome out;
  double lines = 0;
  plot::Figure figure{.title = "Surge of the first module of a row, connectors S1, steepness 1/80",
                      .panels = {{.x = {"wave period", "s"}, .y = {"surge", "m/m"}, .series = {}}}};
  plot::Series stepped{.name = "runs", .x = {}, .y = {}, .line = false, .marks = true};
  auto& curves = figure.panels[0].series;
  const std::map<int, std::vector<Setting>> asked{
      {1, {{"S1", 3.5}, {"S1", 5}, {"S1", 7}}},
      {2, {{"S1", 3.5}, {"S1", 5}, {"S2", 5}, {"S3", 5}, {"S4", 5}, {"S1", 7}, {"S3", 5, 1.0 / 800}}},
      {3, {{"S1", 5}, {"S4", 7}, {"S1", 5, 1.0 / 800}}},
      {5, {{"S1", 5}, {"S1", 7}, {"S4", 7}, {"S1", 5, 1.0 / 800}}}};
  for (const auto& [count, settings] : asked) {
    Array array(modules(folders, count));
    curves.push_back(
        array.curve(fmt::format("{} module{}", count, count > 1 ? "s" : ""), "m1.surge", springs.at("S1")));
    for (const Setting& s : settings) {
      array.set(springs.at(s.set), s.period, s.steepness);
      const Run run = array.run();
      std::string name = count == 1 ? fmt::format("1 module, {} s", s.period)
                                    : fmt::format("{} modules, {}, {} s", count, s.set, s.period);
      if (s.steepness != asked_steepness) name += ", a tenth of the steepness";
      if (s.set == std::string("S1") && s.steepness == asked_steepness) {
        const auto fit =
            hydro::signal::fit_harmonics(run.time, run.signal("m1.surge"), std::vector<double>{2 * pi / s.period});
        stepped.x.push_back(s.period);
        stepped.y.push_back(std::abs(fit.amplitude[0]) / array.amplitude());
      }
      out.numbers.push_back({name + ": run less response", 100 * apart(array, run, array.responses()), "%"});
      if (count > 1) lines += unexplained(array, run);
    }
    if (count != 2) continue;
    for (const double k : {5000.0, 7500.0, 10000.0}) {
      array.set(k, 5);
      out.numbers.push_back({fmt::format("2 modules, {:.0f} N/m, 5 s: mean surge over its amplitude", k),
                             mean_over_amplitude(array, array.run()), ""});
    }
  }
  Array eyes(modules(folders, 2, true));
  eyes.set(10000, 5);
  const Run wandering = eyes.run();
  out.numbers.push_back({"2 modules, 10000 N/m between eyes, 5 s: mean surge over its amplitude",
                         mean_over_amplitude(eyes, wandering), ""});
  out.numbers.push_back({"2 modules, 10000 N/m between eyes, 5 s: lines of force that are not explained",
                         unexplained(eyes, wandering), ""});
  out.numbers.push_back(
      {"lines of force above 1 % that are neither n times the waves' nor an eigenfrequency", lines, ""});
  curves.push_back(std::move(stepped));
  out.pictures.push_back({"surge", "Lines: responses with linear drag; marks: runs with quadratic drag.", figure});
  return out;
}

}  // namespace froude::validation::fagerbakke_arrays
