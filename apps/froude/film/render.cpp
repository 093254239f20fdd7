// `froude film`: a film of a run, whose truth is known.
#include "fit/camera/render.hpp"

#include <algorithm>
#include <cmath>

#include "answers/camera_track.hpp"
#include "answers/simulate.hpp"
#include "fit/camera/track_file.hpp"
#include "froude/film/commands.hpp"
#include "froude/film/markers.hpp"
#include "froude/film/rendered.hpp"
#include "froude/outputs.hpp"
#include "froude/progress.hpp"
#include "froude/report.hpp"
#include "scene/placed.hpp"

namespace froude::film {
namespace {

namespace fc = ::fit::camera;

/// Samples of a run at any time, by the polynomial of degree 5 through those around it. (F102)
double between(const std::vector<double>& values, double step, double time) {
  constexpr int points = 6;
  const double x = time / step, last = static_cast<double>(std::ssize(values) - points);
  const double from = std::clamp(std::floor(x) - 2, 0.0, std::max(0.0, last));
  double sum = 0;
  for (int j = 0; j < points; ++j) {
    double weight = 1;
    for (int k = 0; k < points; ++k)
      if (k != j) weight *= (x - from - k) / (j - k);
    sum += weight * values[static_cast<std::size_t>(from) + static_cast<std::size_t>(j)];
  }
  return sum;
}

/// One coordinate of a marker over the run; a single value where it stays.
std::vector<double> coordinate(const scene::FilmScene::Marker& m, const Run& run, int axis) {
  if (m.at) return std::vector<double>(run.time.size(), (*m.at)[axis]);
  return scene::placed(m.place, [&] { return run.signal(fmt::format("{}.{}", m.node, "xyz"[axis])); });
}

}  // namespace

RenderedFilm::RenderedFilm(const scene::FilmScene& film) : film_(film) {
  scene::Scene of = scene::read(film.scene.value);
  if (!of.run)
    throw hydro::InputError("the scene to be filmed asks for no run", film.scene.place,
                            "add [ask] run = { duration = \"12 s\", every = \"0.04 s\" } to it");
  of.run->of.clear();
  of.run->of_places.clear();
  for (const auto& m : film.markers)
    for (const char* axis : {"x", "y", "z"})
      if (!m.at) {
        of.run->of.push_back(fmt::format("{}.{}", m.node, axis));
        of.run->of_places.push_back(m.place);
      }
  if (of.run->of.empty())
    throw hydro::InputError("no marker moves with the run", film.place, "name the node of one: node = \"chain.node1\"");
  const Run run = simulate(of);
  if (!run.stopped.empty()) throw hydro::NumericsError(run.stopped);
  hydro::require(run.time.size() >= 6, "a run of {} samples is too short for a film", run.time.size());
  step_ = run.time[1] - run.time[0];
  duration_ = run.time.back();
  filming_.size = {film.width, film.height};
  filming_.view = view_of(film.camera, fc::Track{.time = {}, .markers = {}, .size = filming_.size});
  if (filming_.view.lens && filming_.view.lens->size != filming_.size)
    throw hydro::InputError(fmt::format("the film is {} x {} px, its lens was calibrated with {} x {} px", film.width,
                                        film.height, filming_.view.lens->size.x(), filming_.view.lens->size.y()),
                            film.place, "take the size of the calibration");
  filming_.disc_radius = film.disc_radius;
  filming_.sticker_radius = film.sticker_radius;
  if (!film.tags.empty())
    scene::placed(film.place, [&] {
      const TagReader tags(film.tags);
      for (const auto& m : film.markers) {
        hydro::require(*m.tag >= 0 && *m.tag < tags.count(), "\"{}\" has tag {}, and the tags of {} are 0 to {}",
                       m.name, *m.tag, film.tags, tags.count() - 1);
        filming_.patterns.push_back(tags.drawn(*m.tag, 1));
      }
      filming_.cell = film.tag_side / (filming_.patterns.front().width - 2);  // a white rim, a cell wide
    });
  filming_.bar_width = film.bar_width;
  for (std::size_t k = 1; k < film.markers.size(); ++k) filming_.bars.emplace_back(k - 1, k);
  filming_.exposure_s = film.exposure;
  filming_.blur_px = film.blur;
  filming_.noise = film.noise;
  filming_.fall_of_light = film.fall_of_light;
  filming_.flicker = film.flicker;
  filming_.lost = film.lost;
  filming_.seed = film.seed;
  for (const auto& m : film.markers) {
    along_.push_back(coordinate(m, run, film.camera.along()));
    up_.push_back(coordinate(m, run, 2));
  }
}

std::size_t RenderedFilm::frames() const {
  // Exposures of the first and the last frame need the run before and after them.
  return static_cast<std::size_t>(std::floor((duration_ - film_.exposure) * film_.frame_rate + 1e-9)) + 1;
}
double RenderedFilm::time(std::size_t frame) const { return static_cast<double>(frame) / film_.frame_rate; }

std::vector<Eigen::Vector2d> RenderedFilm::places(double time_s) const {
  std::vector<Eigen::Vector2d> out;
  for (std::size_t k = 0; k < along_.size(); ++k)
    out.emplace_back(between(along_[k], step_, time_s), between(up_[k], step_, time_s));
  return out;
}

fc::Light RenderedFilm::light(std::size_t frame) const {
  return fc::light_of(
      filming_, [this](double t) { return places(t); }, time(frame));
}

fc::Track RenderedFilm::truth() const {
  fc::Track out{.time = {}, .markers = {}, .in_metres = false, .size = filming_.size};
  for (const auto& m : film_.markers) out.markers.push_back({m.name, {}});
  for (std::size_t i = 0; i < frames(); ++i) {
    if (lost(i)) continue;
    out.time.push_back(time(i));
    const auto now = places(time(i));
    for (std::size_t k = 0; k < now.size(); ++k)
      out.markers[k].seen.push_back(fc::Sighting{fc::pixel_of(filming_.view, now[k])});
  }
  return out;
}

}  // namespace froude::film

namespace froude {

void render_film(const FilmArguments& a, const Console& console) {
  require_outputs(named({{"-o", a.output}, {"--truth", a.truth}}), {{"the scene", a.scene}});
  const scene::FilmScene scene = scene::read_film(a.scene);
  const film::RenderedFilm rendered(scene);
  film::FilmWriter writer(a.output, {scene.width, scene.height}, scene.frame_rate);
  Progress progress(console.err, "film", console.show_progress);
  std::size_t written = 0;
  ::fit::camera::Picture last;
  for (std::size_t i = 0; i < rendered.frames(); ++i) {
    // A camera that loses a frame shows the one before once more.
    if (!rendered.lost(i)) last = exposed(rendered.filming(), rendered.light(i), i), ++written;
    writer.add(last);
    progress.update(static_cast<double>(i + 1) / static_cast<double>(rendered.frames()));
  }
  if (a.truth)
    ::fit::camera::write_track(*a.truth, rendered.truth(), {"where the markers of a rendered film are, without error"});
  Report report;
  report.say("{} frames of {} x {} px, {} of them lost and shown as the one before", fact("frames", rendered.frames()),
             fact("width", scene.width), fact("height", scene.height), fact("lost", rendered.frames() - written));
  report.wrote(a.output).wrote(a.truth);
  tell(report, console);
}

}  // namespace froude
