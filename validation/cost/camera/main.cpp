/// \file  What the discs of a film cost: frames a second of one core, and of all, at 1280 × 720. See README.md.
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <thread>
#include <vector>

#include "fit/camera/detect.hpp"
#include "fit/camera/render.hpp"
#include "hydro/base/error.hpp"

namespace {

namespace fc = fit::camera;
constexpr int frames = 64, markers = 8;

/// Eight discs of ten pixels on a circle that turns.
std::vector<Eigen::Vector2d> places(double t) {
  std::vector<Eigen::Vector2d> out;
  for (int k = 0; k < markers; ++k)
    out.emplace_back(0.64 + 0.25 * std::cos(2 * t + 0.785 * k), -0.36 + 0.25 * std::sin(2 * t + 0.785 * k));
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
      best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    fmt::print("{} thread{}: {:.0f} frames a second\n", threads, threads == 1 ? "" : "s", frames / best);
  }
}
