#include <nlohmann/json.hpp>

#include <cmath>
#include <numbers>

#include "froude/linear_response.hpp"
#include "froude/scene_result.hpp"
#include "hydro/base/error.hpp"
#include "hydro/io/atomic_file.hpp"
#include "hydro/io/csv.hpp"

namespace froude {
namespace {

/// The highest point of a response and where it is.
struct Peak {
  double amplitude = 0, period = 0, phase = 0;
};

Peak peak(const ComplexSignal& signal, const std::vector<double>& omega) {
  Peak best;
  for (std::size_t i = 0; i < omega.size(); ++i)
    if (std::abs(signal.values[i]) >= best.amplitude)
      best = {std::abs(signal.values[i]), 2 * std::numbers::pi / omega[i],
              std::arg(signal.values[i]) * 180 / std::numbers::pi};
  return best;
}

void write_rao_csv(const Path& path, const std::vector<double>& omega, const std::vector<ComplexSignal>& signals) {
  std::vector<std::vector<double>> numbers;
  std::vector<double> period;
  for (const double w : omega) period.push_back(2 * std::numbers::pi / w);
  for (const auto& s : signals) {
    std::vector<double> amplitude, phase;
    for (const auto& v : s.values) {
      amplitude.push_back(std::abs(v));
      phase.push_back(std::arg(v));
    }
    numbers.push_back(std::move(amplitude));
    numbers.push_back(std::move(phase));
  }
  std::vector<hydro::io::CsvColumn> columns{{"omega", "rad/s", &omega}, {"period", "s", &period}};
  for (std::size_t i = 0; i < signals.size(); ++i) {
    columns.push_back({signals[i].name + " amplitude", signals[i].units, &numbers[2 * i]});
    columns.push_back({signals[i].name + " phase", "deg", &numbers[2 * i + 1]});
  }
  hydro::io::write_csv(
      path, columns,
      {"amplitudes per metre of wave amplitude; phase leads the wave at the origin, Re(X exp(+i omega t))"});
}

/// One panel for each unit, so that metres and newtons do not share an axis.
plot::Figure figure(const scene::Scene& scene, const std::vector<double>& omega,
                    const std::vector<ComplexSignal>& signals) {
  plot::Figure f{.title = scene.title.empty() ? "Response amplitude operators" : scene.title, .panels = {}};
  std::vector<double> period;
  for (const double w : omega) period.push_back(2 * std::numbers::pi / w);
  std::vector<std::string> units;
  for (const auto& s : signals) {
    auto at = std::find(units.begin(), units.end(), s.units);
    if (at == units.end()) {
      units.push_back(s.units);
      f.panels.push_back({.x = {"wave period", "s"}, .y = {"amplitude", s.units}, .series = {}});
      at = units.end() - 1;
    }
    plot::Series line{s.name, period, {}};
    for (const auto& v : s.values) line.y.push_back(std::abs(v));
    f.panels[static_cast<std::size_t>(at - units.begin())].series.push_back(std::move(line));
  }
  return f;
}

void tell(const Console& console, const scene::Scene& scene, const std::vector<double>& omega,
          const std::vector<ComplexSignal>& signals, const Path& file, const std::vector<std::string>& notes) {
  if (console.json) {
    nlohmann::json j{{"file", file.string()}, {"omega_rad_per_s", omega}, {"notes", notes}};
    for (const auto& s : signals) {
      nlohmann::json amplitude = nlohmann::json::array(), phase = nlohmann::json::array();
      for (const auto& v : s.values) {
        amplitude.push_back(std::abs(v));
        phase.push_back(std::arg(v));
      }
      j["signals"][s.name] = {{"unit", s.units}, {"amplitude", amplitude}, {"phase_rad", phase}};
    }
    console.out << j.dump(1) << '\n';
    return;
  }
  console.out << fmt::format("{}: {} signals at {} frequencies, periods {:.4g} to {:.4g} s\n",
                             scene.file.filename().string(), signals.size(), omega.size(),
                             2 * std::numbers::pi / omega.back(), 2 * std::numbers::pi / omega.front());
  console.out << fmt::format("{:<24} {:>12} {:<7} {:>10} {:>10}\n", "signal", "largest", "unit", "at T [s]",
                             "phase [deg]");
  for (const auto& s : signals) {
    const Peak p = peak(s, omega);
    console.out << fmt::format("{:<24} {:>12.5g} {:<7} {:>10.4g} {:>10.1f}\n", s.name, p.amplitude, s.units, p.period,
                               p.phase);
  }
  for (const auto& note : notes) console.out << "note: " << note << '\n';
  console.out << "wrote " << file.string() << '\n';
}

}  // namespace

void rao(const SceneArguments& arguments, const Console& console) {
  const scene::Scene scene = scene::read(arguments.scene);
  require_asked(scene.rao.has_value(), scene, "rao", "rao = { periods = \"2 s .. 8 s, 61 values\" }");
  const Path file = checked_output(arguments, ".rao.h5");
  const auto [omega, signals, notes] = respond(scene);
  write_rao(file, omega, scene.rao->heading.radians(), signals, provenance_of(scene, notes));
  if (arguments.csv) write_rao_csv(*arguments.csv, omega, signals);
  if (arguments.picture) hydro::io::write_atomically(*arguments.picture, plot::svg(figure(scene, omega, signals)));
  tell(console, scene, omega, signals, file, notes);
}

}  // namespace froude
