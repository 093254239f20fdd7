#include "subject.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>

#include "hydro/waves/synthesis/field_choice.hpp"
#include "hydro/waves/synthesis/summed_field.hpp"
#include "hydro/waves/synthesis/synthesis.hpp"

namespace froude::cost {
namespace {

using namespace hydro::waves;
using Extended = long double;
constexpr double two_pi = 2 * std::numbers::pi;
constexpr double end_s = dt_s * static_cast<double>(steps);
const FieldBox box{0, end_s, {-8, -8, -9}, {8, 8, 3}};

double time_of(std::size_t step) { return dt_s * static_cast<double>(step); }

Eigen::Vector3d fixed_place(std::size_t point) { return place(point, 0); }

const HarmonicField& plain_field() {
  static const HarmonicField field = linear_field(sea());
  return field;
}

/// Answers kept for the guard: `rows` for each point, one column a step; as many steps as run() may be asked for.
std::shared_ptr<Eigen::MatrixXd> kept_answers(std::size_t rows, std::size_t points) {
  return std::make_shared<Eigen::MatrixXd>(static_cast<Eigen::Index>(rows * points),
                                           static_cast<Eigen::Index>(steps_at_most(points)));
}

Method from_series(std::size_t points, SeriesMethod how) {
  const auto kept = std::make_shared<Synthesis>();
  Eigen::MatrixXcd c(static_cast<Eigen::Index>(points), static_cast<Eigen::Index>(components));
  for (std::size_t p = 0; p < points; ++p)
    for (std::size_t j = 0; j < components; ++j) {
      const Component& w = sea().components()[j];
      c(static_cast<Eigen::Index>(p), static_cast<Eigen::Index>(j)) =
          std::polar(w.amplitude, w.phase) * elevation_transfer(w, fixed_place(p).x(), fixed_place(p).y());
    }
  const double size = c.row(0).cwiseAbs().sum();
  return {.name = std::string(name_of(how)),
          .at_once = true,
          .build = [] {},
          .run =
              [kept, c, how](std::size_t, std::size_t) {
                *kept = synthesise(sea(), {dt_s, steps}, c, how);
              },
          .answer =
              [kept](std::size_t p, std::size_t n) {
                return Eigen::Vector4d(kept->series(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(p)), 0, 0,
                                       0);
              },
          .stated_error = [kept, size] { return kept->report.relative_error * size; }};
}

// The loop that everybody writes first, with what does not change from step to step taken out of it.
struct PlainWave {
  double omega, kx, ky, amplitude, phase;
};
const std::vector<PlainWave>& plain_waves() {
  static const std::vector<PlainWave> waves = [] {
    std::vector<PlainWave> out;
    for (const Component& w : sea().components())
      out.push_back({w.omega, w.k * std::cos(w.heading), w.k * std::sin(w.heading), w.amplitude, w.phase});
    return out;
  }();
  return waves;
}
double plain_elevation(double t, double x, double y) {
  double sum = 0;
  for (const PlainWave& w : plain_waves()) sum += w.amplitude * std::cos(w.omega * t - w.kx * x - w.ky * y + w.phase);
  return sum;
}

// ζ by any function of an instant and many places.
template <class Elevations>
Method from_elevations(std::string name, std::size_t points, bool moving, Elevations elevations,
                       std::function<void()> build, std::function<double()> stated) {
  const auto kept = kept_answers(1, points);
  const auto run = [=](std::size_t from, std::size_t to) {
    std::vector<Eigen::Vector2d> at(points);
    for (std::size_t n = from; n < to; ++n) {
      for (std::size_t p = 0; p < points; ++p) at[p] = (moving ? place(p, n) : fixed_place(p)).head<2>();
      elevations(time_of(n), std::span<const Eigen::Vector2d>(at),
                 std::span<double>(kept->col(static_cast<Eigen::Index>(n)).data(), points));
    }
  };
  return {.name = std::move(name),
          .at_once = false,
          .build = std::move(build),
          .run = run,
          .answer =
              [kept](std::size_t p, std::size_t n) {
                return Eigen::Vector4d((*kept)(static_cast<Eigen::Index>(p), static_cast<Eigen::Index>(n)), 0, 0, 0);
              },
          .stated_error = std::move(stated)};
}

std::vector<Method> elevation_methods(std::size_t points, bool moving) {
  const auto nothing = [] { return std::nan(""); };
  std::vector<Method> out;
  const auto plain = [](double t, std::span<const Eigen::Vector2d> at, std::span<double> zeta) {
    for (std::size_t p = 0; p < at.size(); ++p) zeta[p] = plain_elevation(t, at[p].x(), at[p].y());
  };
  out.push_back(from_elevations(
      "std::cos", points, moving, plain, [] {}, nothing));
  const auto fast = std::make_shared<std::unique_ptr<SummedField>>();
  out.push_back(from_elevations(
      "vectorised cosine", points, moving,
      [fast](double t, std::span<const Eigen::Vector2d> at, std::span<double> zeta) {
        (*fast)->elevations(t, at, zeta);
      },
      [fast] { *fast = std::make_unique<SummedField>(plain_field()); }, nothing));
  if (!moving) {
    for (const auto how : {SeriesMethod::blocked_phasors, SeriesMethod::nonuniform_fft, SeriesMethod::decimated,
                           SeriesMethod::inverse_fft})
      out.push_back(from_series(points, how));
    return out;
  }
  const auto table = std::make_shared<std::unique_ptr<TabulatedField>>();
  out.push_back(from_elevations(
      "table", points, moving,
      [table](double t, std::span<const Eigen::Vector2d> at, std::span<double> zeta) {
        (*table)->elevations(t, at, zeta);
      },
      [table] {
        *table = std::make_unique<TabulatedField>(plain_field(), box, TabulatedField::Options{.elevation_only = true});
      },
      [table] { return (*table)->error_bound().elevation; }));
  return out;
}

Method from_field(std::string name, std::size_t points, FieldMethod how) {
  const auto chosen = std::make_shared<ChosenField>();
  const auto kept = kept_answers(4, points);
  const auto build = [=] {
    *chosen = choose_field(plain_field(), {.box = box, .instants = steps, .points = static_cast<double>(points)}, how);
  };
  const auto run = [=](std::size_t from, std::size_t to) {
    std::vector<Eigen::Vector3d> at(points);
    std::vector<Kinematics> found(points);
    for (std::size_t n = from; n < to; ++n) {
      for (std::size_t p = 0; p < points; ++p) at[p] = place(p, n);
      chosen->field->at(time_of(n), at, found);
      for (std::size_t p = 0; p < points; ++p)
        kept->block<4, 1>(4 * static_cast<Eigen::Index>(p), static_cast<Eigen::Index>(n)) << found[p].elevation,
            found[p].velocity;
    }
  };
  return {.name = std::move(name),
          .at_once = false,
          .build = build,
          .run = run,
          .answer = [kept](std::size_t p, std::size_t n) -> Eigen::Vector4d {
            return kept->block<4, 1>(4 * static_cast<Eigen::Index>(p), static_cast<Eigen::Index>(n));
          },
          .stated_error = [=] { return how == FieldMethod::table ? chosen->error_bound.velocity : std::nan(""); }};
}

// ζ and velocity in deep water with Wheeler's stretching, term by term in extended precision.
Eigen::Vector4d reference(Extended t, const Eigen::Vector3d& p) {
  const auto angle = [&](const Component& w) {
    const Extended along =
        static_cast<Extended>(p.x()) * std::cos(w.heading) + static_cast<Extended>(p.y()) * std::sin(w.heading);
    return w.omega * t - w.k * along + w.phase;
  };
  Extended zeta = 0, speed = 0, up = 0;
  for (const Component& w : sea().components()) zeta += w.amplitude * std::cos(angle(w));
  const Extended z = std::min<Extended>(p.z() - zeta, 0);
  for (const Component& w : sea().components()) {
    const Extended size = static_cast<Extended>(w.amplitude) * w.omega * std::exp(w.k * z);
    speed += size * std::cos(angle(w));
    up -= size * std::sin(angle(w));
  }
  const double heading = sea().components()[0].heading, along = static_cast<double>(speed);
  return {static_cast<double>(zeta), along * std::cos(heading), along * std::sin(heading), static_cast<double>(up)};
}

}  // namespace

const hydro::waves::Sea& sea() {
  static const Sea one = Sea::irregular(
      Jonswap(3, 9, 3.3), {FftGrid{end_s}, 0.2, 0.2 + static_cast<double>(components) * two_pi / end_s, /*seed=*/7},
      {hydro::Angle::from_degrees(30)}, hydro::Water{});
  return one;
}

Eigen::Vector3d place(std::size_t point, std::size_t step) {
  const double t = time_of(step), phase = 0.61803398875 * static_cast<double>(point);
  return {8 * std::sin(0.05 * t + 2 * phase), 8 * std::sin(0.03 * t + 3 * phase),
          -4 + 3 * std::sin(0.6 * t + 5 * phase)};
}

std::size_t steps_at_most(std::size_t points) { return std::min(steps, 2000000 / points); }

std::string title_of(Wanted wanted) {
  switch (wanted) {
    case Wanted::fixed_elevation:
      return "Elevation at fixed points";
    case Wanted::moving_elevation:
      return "Elevation at moving points";
    default:
      return "Kinematics at moving points";
  }
}

std::vector<Method> methods(Wanted wanted, std::size_t points) {
  if (wanted != Wanted::moving_kinematics) return elevation_methods(points, wanted == Wanted::moving_elevation);
  return {from_field("std::cos, std::exp", points, FieldMethod::harmonics),
          from_field("vectorised sum", points, FieldMethod::vector_sum),
          from_field("table", points, FieldMethod::table)};
}

double guarded_error(const Method& method, Wanted wanted, std::size_t points, std::size_t steps_made) {
  double variance = 0, worst = 0;
  for (const Component& w : sea().components()) {
    const double size = w.amplitude * (wanted == Wanted::moving_kinematics ? w.omega : 1);
    variance += size * size / 2;
  }
  constexpr std::size_t samples = 60;
  for (std::size_t i = 0; i < samples; ++i) {
    const std::size_t step = (steps_made - 1) * i / (samples - 1), point = (i * 37) % points;
    // A series is made for the exact multiples of the step, a field is asked at a rounded instant.
    const Extended t = method.at_once ? static_cast<Extended>(dt_s) * static_cast<Extended>(step) : time_of(step);
    const Eigen::Vector3d p = wanted == Wanted::fixed_elevation ? fixed_place(point) : place(point, step);
    const Eigen::Vector4d error = method.answer(point, step) - reference(t, p);
    worst = std::max(worst, wanted == Wanted::moving_kinematics ? error.tail<3>().norm() : std::abs(error[0]));
  }
  const double stated = method.stated_error(), rms = std::sqrt(variance);
  const double allowed = std::isnan(stated) ? 1e-9 * rms : stated;
  if (!(worst <= allowed))
    throw std::runtime_error(
        fmt::format("{}, {}: off by {:.2g}, at most {:.2g} allowed", title_of(wanted), method.name, worst, allowed));
  return worst / rms;
}

}  // namespace froude::cost
