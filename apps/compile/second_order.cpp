#include "compile/second_order.hpp"

#include <algorithm>
#include <cmath>

#include "compile/quadratic_transfer.hpp"
#include "compile/waves.hpp"
#include "dynamics/force/second_order.hpp"
#include "hydro/base/error.hpp"
#include "hydro/base/interpolation.hpp"
#include "scene/placed.hpp"

namespace froude::compile {
namespace {

using dynamics::SecondOrderLoad;
using hydro::InputError;
using hydro::potential::QuadraticTransfer;
using hydro::waves::Component;
using Method = scene::SecondOrder::Method;

/// Of real and imaginary part of s, one below the other: Re(sᵀ T s̅), and with sign −1 Re(sᵀ T s).
std::array<Eigen::MatrixXd, 6> real_forms(const Matrices& T, double sign) {
  std::array<Eigen::MatrixXd, 6> out;
  for (std::size_t mode = 0; mode < 6; ++mode) {
    out[mode].resize(2 * T[mode].rows(), 2 * T[mode].cols());
    for (Eigen::Index q = 0; q < T[mode].cols(); ++q)
      for (Eigen::Index p = 0; p < T[mode].rows(); ++p) {
        const double re = T[mode](p, q).real(), im = T[mode](p, q).imag();
        out[mode].block<2, 2>(2 * p, 2 * q) << re, sign * im, -im, sign * re;
      }
  }
  return out;
}

/// The waves of a sea within the frequencies of a file.
std::vector<std::size_t> inside(const hydro::waves::Sea& sea, const QuadraticTransfer& T, double accuracy) {
  std::vector<std::size_t> out;
  double all = 0, kept = 0;
  for (std::size_t c = 0; c < sea.components().size(); ++c) {
    const Component& wave = sea.components()[c];
    const double energy = wave.amplitude * wave.amplitude;
    all += energy;
    if (wave.omega < T.omega.front() || wave.omega > T.omega.back()) continue;
    kept += energy;
    out.push_back(c);
  }
  require_little_outside((all - kept) / all, T, accuracy);
  return out;
}

bool is_long_crested(const hydro::waves::Sea& sea) {
  return std::all_of(sea.components().begin(), sea.components().end(),
                     [&](const Component& c) { return c.heading == sea.components().front().heading; });
}

/// One body, its file and the waves.
class Loads {
 public:
  Loads(int body, const Eigen::Vector3d& origin, const Eigen::Vector3d& centre, const hydro::waves::Sea& sea,
        const StepGrid& grid, double ramp, double accuracy)
      : body_(body),
        origin_(origin),
        to_centre_(centre - origin),
        sea_(sea),
        grid_(grid),
        ramp_(ramp),
        accuracy_(accuracy) {}

  SecondOrderLoad mean(const QuadraticTransfer& T) const {
    const QuadraticTransfer equal = of_equal_waves(T);
    SecondOrderLoad out{.body = body_, .ramp_s = ramp_, .method = "mean drift, constant"};
    for (const std::size_t c : inside(sea_, T, accuracy_))
      out.mean += std::pow(sea_.components()[c].amplitude, 2) * drift(equal, sea_.components()[c]).real();
    return out;
  }

  /// T(1; 2) = ½ (T(1; 1) + T(2; 2)): Re(Σ a D e^{iωt} · conj Σ a e^{iωt}).
  SecondOrderLoad newman(const QuadraticTransfer& T) const {
    if (!is_long_crested(sea_)) refuse_newman();
    const QuadraticTransfer equal = of_equal_waves(T);
    Eigen::MatrixXcd amplitudes = Eigen::MatrixXcd::Zero(7, components());
    for (const std::size_t c : inside(sea_, T, accuracy_)) {
      const std::complex<double> a = at_origin(sea_.components()[c]);
      amplitudes.col(static_cast<Eigen::Index>(c)) << a, a * drift(equal, sea_.components()[c]).real();
    }
    return {.body = body_, .signals = complex_signals(amplitudes), .product = true, .method = "Newman's approximation"};
  }

  /// Bilinear between the frequencies and headings of the file: each wave has its share of the (up to four) points
  /// about it, and pairs of waves become pairs of points.
  SecondOrderLoad full(const QuadraticTransfer& T) const {
    const bool one_heading = is_long_crested(sea_);
    const auto frequencies = static_cast<Eigen::Index>(T.omega.size());
    const Eigen::Index headings = one_heading ? 1 : static_cast<Eigen::Index>(T.heading.size());
    Eigen::MatrixXcd amplitudes = Eigen::MatrixXcd::Zero(frequencies * headings, components());
    for (const std::size_t c : inside(sea_, T, accuracy_)) {
      const Component& wave = sea_.components()[c];
      const hydro::Stencil w = hydro::straight_stencil(T.omega, wave.omega);
      const hydro::Stencil h = one_heading ? hydro::Stencil{.first = 0, .weight = {1}} : between(T, wave.heading);
      for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t j = 0; j < 2; ++j)
          if (w.weight[i] != 0 && h.weight[j] != 0)
            amplitudes(static_cast<Eigen::Index>(h.first + j) * frequencies + static_cast<Eigen::Index>(w.first + i),
                       static_cast<Eigen::Index>(c)) = w.weight[i] * h.weight[j] * at_origin(wave);
    }
    SecondOrderLoad out{.body = body_,
                        .signals = complex_signals(amplitudes),
                        .method = fmt::format("all pairs of {} frequencies and {} headings", frequencies, headings)};
    const Matrices pairs =
        one_heading ? about(of_heading(T, sea_.components().front().heading), to_centre_) : all_pairs(T);
    out.form = real_forms(pairs, T.kind == QuadraticTransfer::Kind::sum ? -1 : 1);
    return out;
  }

 private:
  Eigen::Index components() const { return static_cast<Eigen::Index>(sea_.components().size()); }

  /// a e^{iφ} at the body's origin.
  std::complex<double> at_origin(const Component& c) const {
    return elevation_at_origin(c) * hydro::waves::elevation_transfer(c, origin_.x(), origin_.y());
  }

  /// T(ω, β; ω, β) of equal waves about the centre of gravity, N/m² and N m/m².
  Eigen::Matrix<std::complex<double>, 6, 1> drift(const QuadraticTransfer& T, const Component& wave) const {
    const hydro::Stencil w = hydro::straight_stencil(T.omega, wave.omega);
    const Matrices m = about(of_heading(T, wave.heading), to_centre_);
    Eigen::Matrix<std::complex<double>, 6, 1> out;
    for (std::size_t mode = 0; mode < 6; ++mode)
      out.row(static_cast<Eigen::Index>(mode)) =
          hydro::combined(w, T.omega.size(), [&](std::size_t k) { return m[mode].row(static_cast<Eigen::Index>(k)); });
    return out;
  }

  Matrices all_pairs(const QuadraticTransfer& T) const {
    const auto n = static_cast<Eigen::Index>(T.omega.size()), all = n * static_cast<Eigen::Index>(T.heading.size());
    Matrices out;
    for (auto& m : out) m = Eigen::MatrixXcd::Zero(all, all);
    for (std::size_t h1 = 0; h1 < T.heading.size(); ++h1)
      for (std::size_t h2 = 0; h2 < T.heading.size(); ++h2) {
        const Matrices of = about(of_pair(T, h1, h2), to_centre_);
        for (std::size_t mode = 0; mode < 6; ++mode)
          out[mode].block(static_cast<Eigen::Index>(h1) * n, static_cast<Eigen::Index>(h2) * n, n, n) = of[mode];
      }
    return out;
  }

  dynamics::WaveSignals complex_signals(const Eigen::MatrixXcd& amplitudes) const {
    const std::complex<double> i(0, 1);
    Eigen::MatrixXcd parts(2 * amplitudes.rows(), amplitudes.cols());
    for (Eigen::Index p = 0; p < amplitudes.rows(); ++p) {
      parts.row(2 * p) = amplitudes.row(p);
      parts.row(2 * p + 1) = -i * amplitudes.row(p);  // the imaginary part as the real one of another signal
    }
    return signals(sea_, parts, grid_, ramp_);
  }

  int body_;
  Eigen::Vector3d origin_, to_centre_;
  const hydro::waves::Sea& sea_;
  StepGrid grid_;
  double ramp_, accuracy_;
};

}  // namespace

void add_second_order(const scene::Scene& scene, const std::vector<dynamics::RigidBody>& bodies,
                      const hydro::waves::Sea* sea, const StepGrid& grid, std::vector<std::string>& notes,
                      std::vector<std::unique_ptr<const dynamics::ForceKind>>& forces) {
  std::vector<SecondOrderLoad> loads;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    if (!scene.bodies[b].second_order || !scene.waves) continue;
    const scene::SecondOrder& asked = *scene.bodies[b].second_order;
    if (scene.current_place)
      throw hydro::InputError(
          fmt::format(
              "second-order loads on \"{}\" are those of still water: a current changes drift by much of itself",
              scene.bodies[b].name),
          asked.place, "leave `second_order` out, or take [current] out");
    if (sea == nullptr)
      throw InputError("second-order loads are for waves that are a sum of linear ones", asked.place,
                       "take regular waves of linear theory, a sea or a list");
    const Loads of(static_cast<int>(b), scene.bodies[b].position, bodies[b].rest_centre(), *sea, grid,
                   scene.waves->ramp, scene.accuracy);
    scene::placed(asked.place, [&] {
      const SecondOrderFiles files = read_second_order_files(asked, scene.water, notes);
      loads.push_back(asked.method == Method::mean     ? of.mean(files.difference)
                      : asked.method == Method::newman ? of.newman(files.difference)
                                                       : of.full(files.difference));
      if (files.sum) loads.push_back(of.full(*files.sum));
    });
  }
  if (!loads.empty()) forces.push_back(std::make_unique<dynamics::SecondOrderKind>(std::move(loads)));
}

}  // namespace froude::compile
