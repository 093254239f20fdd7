#include "harness/case.hpp"

#ifdef FROUDE_FILMS
#include <unistd.h>

#include <Eigen/LU>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <ostream>

#include "answers/fit_models.hpp"
#include "answers/fit_scene.hpp"
#include "answers/scene_runs.hpp"
#include "fit/camera/track_file.hpp"
#include "fit/simulated.hpp"
#include "froude/film/commands.hpp"
#include "froude/film/rendered.hpp"
#include "harness/damping_tally.hpp"
#endif

namespace froude::validation::huijgen_damping_id {

#ifndef FROUDE_FILMS

Outcome outcome(const Folders&) {
  throw MissingData("this build has no OpenCV, which reads and writes films: `scripts/setup camera` installs it");
}

#else

namespace {

namespace fc = ::fit::camera;
namespace fs = std::filesystem;

constexpr double b_l = 0.002, b_q = 0.001;  // of dropper.toml
constexpr int seeds = 100;

/// A folder for films and tracks, gone at the end.
struct Scratch {
  fs::path path = fs::temp_directory_path() / fmt::format("froude-huijgen-damping-id-{}", ::getpid());
  Scratch() { fs::create_directories(path); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch() {
    std::error_code left;
    fs::remove_all(path, left);
  }
};

/// The whole way of one seed: film, track, fit.
class Route {
 public:
  explicit Route(const Folders& folders)
      : rendered_(scene::read_film(folders.own() / "film.toml")), truth_(rendered_.truth()) {
    for (const char* file : {"fit.toml", "lens.toml", "dropper.toml"})
      fs::copy_file(folders.own() / file, scratch_.path / file, fs::copy_options::overwrite_existing);
    for (std::size_t i = 0; i < rendered_.frames(); ++i) light_.push_back(rendered_.light(i));
  }

  ::fit::SimulationFit fitted(std::uint64_t seed, const ::fit::SimulationFit* begin) {
    write_film(seed);
    track_film();
    const scene::FitScene scene = scene::read_fit(scratch_.path / "fit.toml");
    const auto& model = scene.model<scene::MotionModel>();
    MeasuredRun run = MeasuredRun::read(scene, model, model.records.at(0));
    ::fit::SimulationProblem p;
    for (const auto& q : model.parameters) p.parameters.push_back(q.number);
    for (std::size_t w = 0; w < run.first.size(); ++w) {
      p.measured.emplace_back(run.values.middleRows(run.first[w], run.rows(w)));
      const auto from = run.whitening.begin() + run.first[w];
      p.whitening.emplace_back(from, from + run.rows(w));
    }
    p.deviations = run.deviations;
    p.periods.assign(p.deviations.size(), 2 * std::numbers::pi);
    if (begin == nullptr) {
      model_ = model;
      run_ = std::move(run);
      runs_ = std::make_unique<SceneRuns>(*model_, *run_);
    }
    // Where windows begin belongs to the runs that handed them on: those of the first film serve all.
    p.begin = begin;
    return ::fit::fit_simulation(*runs_, p);
  }

  double rms() const { return std::sqrt(squares_ / found_); }
  double over_covariance() const { return distance_ / found_ / 2; }
  double share_found() const { return found_ / asked_; }

 private:
  void write_film(std::uint64_t seed) const;
  void track_film();
  void compare();

  Scratch scratch_;
  film::RenderedFilm rendered_;
  fc::Track truth_;
  std::vector<fc::Light> light_;
  std::optional<scene::MotionModel> model_;
  std::optional<MeasuredRun> run_;
  std::unique_ptr<SceneRuns> runs_;
  double squares_ = 0, distance_ = 0, found_ = 0, asked_ = 0;
};

void Route::write_film(std::uint64_t seed) const {
  fc::Filming filming = rendered_.filming();
  filming.seed = seed;
  film::FilmWriter writer(scratch_.path / "film.avi", filming.size, 25);
  for (std::size_t i = 0; i < light_.size(); ++i) writer.add(exposed(filming, light_[i], i));
}

void Route::track_film() {
  std::string first, names;
  for (const fc::Marker& m : truth_.markers) {
    names += (names.empty() ? "" : ", ") + m.name;
    first += fmt::format("{}({:.0f}, {:.0f})", first.empty() ? "" : ", ", m.seen[0]->at.x(), m.seen[0]->at.y());
  }
  // A link of 0.15 m is 117.7 to 119.2 pixels long, as the lens bends it.
  std::vector<std::string> links;
  for (std::size_t k = 1; k < truth_.markers.size(); ++k)
    links.push_back(fmt::format("{} {} 118.5 px 0.5 px", truth_.markers[k - 1].name, truth_.markers[k].name));
  std::ostream nowhere(nullptr);
  track({.film = scratch_.path / "film.avi",
         .markers = names,
         .radius = "2 px .. 7 px",
         .contrast = 80,
         .first = first,
         .lengths = links,
         .output = scratch_.path / "track.csv"},
        {nowhere, nowhere});
  compare();
}

/// The track against the places that were filmed.
void Route::compare() {
  const fc::Track track = fc::read_track(scratch_.path / "track.csv", {.time = "t"});
  for (std::size_t k = 0; k < track.markers.size(); ++k)
    for (std::size_t i = 0; i < track.frames(); ++i, ++asked_) {
      const auto& s = track.markers[k].seen[i];
      if (!s) continue;
      const Eigen::Vector2d e = s->at - truth_.markers[k].seen[i]->at;
      squares_ += e.squaredNorm();
      distance_ += e.dot(s->covariance.inverse() * e);
      ++found_;
    }
}

}  // namespace

Outcome outcome(const Folders& folders) {
  Route route(folders);
  DampingTally tally{
      .b_l = b_l, .b_q = b_q, .estimates = {"b_q against b_l, 100 films", {}, {}, false, true}, .drawn_in = 1e3};
  ::fit::SimulationFit first;
  for (int seed = 1; seed <= seeds; ++seed) {
    auto f = route.fitted(static_cast<std::uint64_t>(seed), seed == 1 ? nullptr : &first);
    tally.add(f.parameters[0], f.parameters[1]);
    if (seed == 1) first = std::move(f);
  }
  return {
      .numbers = {{"share of seeds with b_l and b_q both in their intervals of 95 %", tally.both / seeds, ""},
                  {"share of seeds with b_l in its interval of 95 %", tally.linear / seeds, ""},
                  {"share of seeds with b_q in its interval of 95 %", tally.quadratic / seeds, ""},
                  {"mean half-width of the interval of b_l, of b_l", tally.half_linear / seeds, ""},
                  {"mean half-width of the interval of b_q, of b_q", tally.half_quadratic / seeds, ""},
                  {"mean error of b_l, of its standard error", tally.error / seeds, ""},
                  {"rms error of places in the tracks", route.rms(), "px"},
                  {"mean of squared errors of places over their covariances, of 2", route.over_covariance(), ""},
                  {"share of markers found", route.share_found(), ""},
                  {"seeds", seeds, ""}},
      .pictures = {{"estimates",
                    "Both dampings from 100 films of the same motion; the truth is at 2 g/s and 1 g/m.",
                    {.title = "Damping of the model dropper, from films",
                     .panels = {{.x = {"b_l", "g/s"},
                                 .y = {"b_q", "g/m"},
                                 .series = {tally.estimates, {"truth", {1e3 * b_l}, {1e3 * b_q}, false, true}}}}}}}};
}

#endif

}  // namespace froude::validation::huijgen_damping_id
