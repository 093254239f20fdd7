/// \file  What films cost: frames a second of the search for discs, and of `froude track`, at 1280 × 720. See
/// README.md.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <ostream>
#include <thread>
#include <vector>

#include "fit/camera/detect.hpp"
#include "fit/camera/render.hpp"
#include "hydro/base/error.hpp"

#ifdef FROUDE_FILMS
#include "fit/camera/track_file.hpp"
#include "froude/film/commands.hpp"
#include "froude/film/video.hpp"
#endif

namespace {

namespace fc = fit::camera;
constexpr int frames = 64, markers = 8;

/// Eight discs of ten pixels on a circle that turns once in all frames, which may follow each other again and again.
std::vector<Eigen::Vector2d> places(double t) {
  const double omega = 2 * std::numbers::pi / (0.04 * frames);
  std::vector<Eigen::Vector2d> out;
  for (int k = 0; k < markers; ++k)
    out.emplace_back(0.64 + 0.25 * std::cos(omega * t + 0.785 * k), -0.36 + 0.25 * std::sin(omega * t + 0.785 * k));
  return out;
}

fc::Filming camera() {
  fc::Filming out;
  out.view.metres_per_pixel = 1e-3;
  out.size = {1280, 720};
  out.disc_radius = 0.010;
  out.sticker_radius = 0.022;
  out.noise = 8;
  out.fall_of_light = 0.2;
  return out;
}

/// rms of both coordinates, px. \throws hydro::InputError if a disc is missed: a fast wrong answer is no result
double error_of(const fc::Filming& film, const fc::Detection& found, double t) {
  double squares = 0;
  for (const Eigen::Vector2d& place : places(t)) {
    const Eigen::Vector2d truth = pixel_of(film.view, place);
    double nearest = 1e9;
    for (const fc::Disc& d : found.discs) nearest = std::min(nearest, (d.centre.at - truth).squaredNorm());
    squares += nearest;
  }
  hydro::require(found.discs.size() == markers && squares < 0.25 * markers, "a disc was missed at {} s", t);
  return std::sqrt(squares / markers);
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void time_detection(const std::vector<fc::Picture>& pictures, const fc::DetectOptions& options) {
  for (const unsigned threads : {1u, std::max(1u, std::thread::hardware_concurrency())}) {
    double best = 1e9;
    for (int round = 0; round < 5; ++round) {
      const auto start = std::chrono::steady_clock::now();
      std::vector<std::thread> all;
      for (unsigned t = 0; t < threads; ++t)
        all.emplace_back([&, t] {
          for (std::size_t i = t; i < pictures.size(); i += threads) detect(pictures[i], options);
        });
      for (auto& thread : all) thread.join();
      best = std::min(best, seconds_since(start));
    }
    fmt::print("discs, {} thread{}: {:.0f} frames a second\n", threads, threads == 1 ? "" : "s",
               static_cast<double>(pictures.size()) / best);
  }
}

#ifdef FROUDE_FILMS
/// The whole of `froude track`, from a film of these pictures four times over to a track.
void time_track(const fc::Filming& film, const std::vector<fc::Picture>& pictures, const char* name) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / name, track = file.string() + ".csv";
  {
    froude::film::FilmWriter writer(file, film.size, 25);
    for (int i = 0; i < 4 * frames; ++i) writer.add(pictures[static_cast<std::size_t>(i % frames)]);
  }
  std::string first;
  for (const Eigen::Vector2d& place : places(0)) {
    const Eigen::Vector2d pixel = pixel_of(film.view, place);
    first += fmt::format("{}({:.0f}, {:.0f})", first.empty() ? "" : ", ", pixel.x(), pixel.y());
  }
  std::ostream nowhere(nullptr);
  double best = 1e9;
  for (int round = 0; round < 3; ++round) {
    const auto start = std::chrono::steady_clock::now();
    froude::track(
        {.film = file, .markers = fmt::to_string(markers), .radius = "6 px .. 15 px", .first = first, .output = track},
        {nowhere, nowhere});
    best = std::min(best, seconds_since(start));
  }
  const fc::Track found = fc::read_track(track, {.time = "t"});
  for (std::size_t k = 0; k < found.markers.size(); ++k)
    for (std::size_t i = 0; i < frames; ++i) {
      const auto& seen = found.markers[k].seen[i];
      const Eigen::Vector2d truth = pixel_of(film.view, places(0.04 * static_cast<double>(i))[k]);
      hydro::require(seen && (seen->at - truth).norm() < 0.5, "a disc was missed in frame {}", i + 1);
    }
  fmt::print("froude track of {} ({:.0f} kB a frame): {:.0f} frames a second\n", name,
             static_cast<double>(std::filesystem::file_size(file)) / 1000 / (4 * frames), 4 * frames / best);
  std::filesystem::remove(file);
  std::filesystem::remove(track);
}
#endif

}  // namespace

int main() {
  const fc::Filming film = camera();
  const fc::DetectOptions options{.smallest_px = 6, .largest_px = 15};
  std::vector<fc::Picture> pictures;
  for (int i = 0; i < frames; ++i)
    pictures.push_back(exposed(film, light_of(film, places, 0.04 * i), static_cast<std::uint64_t>(i)));
  double error = 0;
  for (int i = 0; i < frames; ++i)
    error = std::max(error, error_of(film, detect(pictures[static_cast<std::size_t>(i)], options), 0.04 * i));
  fmt::print("{} frames of 1280 x 720 px with {} discs, error {:.3f} px at most\n", frames, markers, error);
  time_detection(pictures, options);
#ifdef FROUDE_FILMS
  for (const char* name : {"cost_camera.mp4", "cost_camera.avi"}) time_track(film, pictures, name);
#endif
}
