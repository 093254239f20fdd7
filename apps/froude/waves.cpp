/// \file  `froude waves make`: what the water does at the probes of a scene, as time series.
#include "answers/answers.hpp"
#include "answers/picture.hpp"
#include "froude/progress.hpp"
#include "froude/report.hpp"
#include "froude/scene_result.hpp"
#include "froude/series.hpp"

namespace froude {
namespace {

Report report_of(const scene::Scene& scene, const WaterSeries& series, const Path& file) {
  const std::size_t probes = scene.probes.size();
  Report out;
  out.say("{}: {:.6g} s from {:.6g} s, {} samples at {} probe{}, by {}", scene.file.filename().string(),
          fact("duration_s", scene.ask_waves->duration), fact("from_s", scene.ask_waves->from),
          fact("samples", series.time.size()), fact("probes", probes), probes == 1 ? "" : "s",
          fact("method", series.method));
  add_series(out, series.signals);
  return out.sentences("notes", "note: {}", series.notes).say("wrote {}", fact("file", file.string()));
}

}  // namespace

void waves_make(const SceneArguments& arguments, const Console& console) {
  const scene::Scene scene = scene::read(arguments.scene);
  require_asked(scene.ask_waves.has_value(), scene, "waves", "waves = { duration = \"600 s\", every = \"0.1 s\" }");
  const Path file = checked_output(arguments, ".waves.h5");
  Progress progress(console.err, "waves", console.show_progress);
  const WaterSeries series = water_series(scene, [&](double done) { progress.update(done); });
  series.write(file);
  if (arguments.csv) write_series_csv(*arguments.csv, series.time, series.signals);
  if (arguments.picture)
    plot::write_picture(
        *arguments.picture,
        series_figure(
            scene.title.empty() ? "Waves" : scene.title, series.time, series.signals,
            {{"m", "elevation"}, {"m/s", "velocity"}, {"m/s^2", "acceleration"}, {"Pa", "dynamic pressure"}}));
  tell(report_of(scene, series, file), console);
}

}  // namespace froude
