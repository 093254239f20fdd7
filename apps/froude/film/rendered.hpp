#pragma once
/// \file  A film of a run before it is in a file: its light, frame by frame, and where its markers are.
#include <cstddef>
#include <vector>

#include "answers/film.hpp"
#include "fit/camera/render.hpp"
#include "fit/camera/track.hpp"

namespace froude::film {

/// The scene is run once. Between the run's samples places are polynomials of degree 5 (F102).
class RenderedFilm {
 public:
  /// \throws hydro::InputError for a scene that asks for no run, a node without signals, a camera whose lens is of
  /// another size; hydro::NumericsError where the run stops
  explicit RenderedFilm(const scene::FilmScene& film);

  std::size_t frames() const;
  double time(std::size_t frame) const;  ///< s, of the middle of its exposure, from the run's start
  bool lost(std::size_t frame) const { return frame > 0 && ::fit::camera::is_lost(filming_, frame); }
  std::vector<Eigen::Vector2d> places(double time_s) const;  ///< m, in the plane of motion
  ::fit::camera::Light light(std::size_t frame) const;
  /// Pixels of all markers in the frames that are not lost, without errors.
  ::fit::camera::Track truth() const;
  const ::fit::camera::Filming& filming() const { return filming_; }

 private:
  scene::FilmScene film_;
  ::fit::camera::Filming filming_;
  double step_ = 0, duration_ = 0;               // s, of the run's samples and of the whole
  std::vector<std::vector<double>> along_, up_;  // of each marker
};

}  // namespace froude::film
