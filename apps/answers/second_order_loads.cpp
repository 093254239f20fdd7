#include "answers/second_order_loads.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "answers/sea_directions.hpp"
#include "hydro/base/error.hpp"
#include "hydro/waves/dispersion.hpp"
#include "hydro/waves/spectra/spectrum.hpp"
#include "scene/placed.hpp"

namespace froude {
namespace {

using compile::Matrices;
using hydro::potential::QuadraticTransfer;
using Complex = std::complex<double>;
using Eigen::Index;

/// ∫ f from `from` to `to` by the trapezium rule: intervals are halved from this many on until `measure` of the
/// integral changes by less than the tolerance; a smooth f is then off by a third of that. Nothing where both ends
/// meet.
template <class F, class Measure>
auto integral(double from, double to, int intervals, double tolerance, const F& f, const Measure& measure) {
  constexpr int most = 1 << 16;
  double h = (to - from) / intervals;
  auto sum = (0.5 * (f(from) + f(to))).eval();
  for (int i = 1; i < intervals; ++i) sum += f(from + i * h);
  Eigen::VectorXd before = measure((h * sum).eval());
  for (; intervals < most; intervals *= 2, h /= 2) {
    for (int i = 0; i < intervals; ++i) sum += f(from + (i + 0.5) * h);
    const Eigen::VectorXd now = measure((h / 2 * sum).eval());
    if (((now - before).cwiseAbs().array() <= tolerance * now.cwiseAbs().array()).all()) return (h / 2 * sum).eval();
    before = now;
  }
  throw hydro::NumericsError(
      fmt::format("second-order loads are not within {:g} with {} frequencies of the sea: its spectrum is too narrow",
                  tolerance, most));
}

bool have_one_heading(const std::vector<Ray>& rays) {
  return std::all_of(rays.begin(), rays.end(), [&](const Ray& r) { return r.heading == rays.front().heading; });
}

/// T of each pair of rays about the centre of gravity, as runs have it (D137).
std::vector<Matrices> of_pairs(const QuadraticTransfer& T, const std::vector<Ray>& rays, const Eigen::Vector3d& r) {
  if (have_one_heading(rays))
    return {rays.size() * rays.size(), compile::about(compile::of_heading(T, rays.front().heading), r)};
  std::vector<Matrices> out;
  for (const Ray& first : rays)
    for (const Ray& second : rays)
      out.push_back(compile::about(compile::of_two_headings(T, first.heading, second.heading), r));
  return out;
}

bool is_inside(const std::vector<double>& omega, double at) { return at >= omega.front() && at <= omega.back(); }

/// The largest force stands for forces, and the largest moment for moments.
Eigen::VectorXd largest_of_each_unit(const Eigen::VectorXd& loads) {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(2);
  for (Index i = 0; i < loads.size(); ++i) out[i % 6 / 3] = std::max(out[i % 6 / 3], std::abs(loads[i]));
  return out;
}

}  // namespace

std::vector<Ray> rays_of(const scene::RandomSea& sea, int sectors) {
  std::vector<double> headings;
  std::vector<Ray> out;
  for (const auto& waves : sea.systems) {
    const auto system = std::make_shared<const System>(system_of(waves, sectors, headings));
    for (const Direction& d : system->directions)
      out.push_back({headings[d.heading], [system, &d](double omega) {
                       return system->waves->spectrum->density(omega) * system->share(d, omega);
                     }});
  }
  return out;
}

SecondOrderLoads::SecondOrderLoads(const scene::Scene& scene, const std::vector<dynamics::RigidBody>& bodies,
                                   std::vector<Ray> rays, std::vector<std::string>& notes)
    : rays_(std::move(rays)), water_(scene.water) {
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const scene::Body& body = scene.bodies[b];
    if (!body.second_order) continue;
    scene::placed(body.second_order->place, [&] {
      add_body(body, bodies[b].rest_centre() - body.position, scene,
               compile::read_second_order_files(*body.second_order, scene.water, notes));
    });
    for (int mode = 0; mode < 6; ++mode) modes_.push_back(6 * static_cast<int>(b) + mode);
  }
  set_range(band_of(random_sea(scene)));
  set_intervals();
}

void SecondOrderLoads::add_body(const scene::Body& body, const Eigen::Vector3d& to_centre, const scene::Scene& scene,
                                const compile::SecondOrderFiles& files) {
  using Method = scene::SecondOrder::Method;
  const Method method = body.second_order->method;
  const scene::RandomSea& sea = random_sea(scene);
  OfBody of;
  of.origin = body.position;
  of.omega = files.difference.omega;
  of.newman = method == Method::newman;
  if (of.newman && !have_one_heading(rays_)) compile::refuse_newman();
  compile::require_little_outside(share_outside(sea, of.omega.front(), of.omega.back()), files.difference,
                                  scene.accuracy);
  const QuadraticTransfer equal = compile::of_equal_waves(files.difference);
  if (method == Method::full)
    of.pairs = of_pairs(files.difference, rays_, to_centre);
  else
    for (const Ray& ray : rays_) of.equal.push_back(compile::about(compile::of_heading(equal, ray.heading), to_centre));
  if (files.sum) {
    of.sum_omega = files.sum->omega;
    compile::require_little_outside(share_outside(sea, of.sum_omega.front(), of.sum_omega.back()), *files.sum,
                                    scene.accuracy);
    of.sum_pairs = of_pairs(*files.sum, rays_, to_centre);
  }
  bodies_.push_back(std::move(of));
}

void SecondOrderLoads::set_range(const SeaBand& band) {
  low_ = bodies_.front().omega.front(), high_ = bodies_.front().omega.back();
  for (const OfBody& body : bodies_)
    for (const auto* omega : {&body.omega, &body.sum_omega})
      if (!omega->empty()) {
        low_ = std::min(low_, omega->front());
        high_ = std::max(high_, omega->back());
      }
  low_ = std::max(low_, band.low);
  high_ = std::min(high_, band.high);
}

// No integral begins with intervals that miss the peak of the sea.
void SecondOrderLoads::set_intervals() {
  constexpr int most = 1 << 14;
  constexpr double enough = 1e-3;
  const auto energy = [&](int n) {
    const double h = (high_ - low_) / n;
    double sum = (all_rays(low_) + all_rays(high_)) / 2;
    for (int i = 1; i < n; ++i) sum += all_rays(low_ + i * h);
    return h * sum;
  };
  const double right = energy(most);
  while (intervals_ < most && std::abs(energy(intervals_) - right) > enough * right) intervals_ *= 2;
}

bool SecondOrderLoads::has(Pairs pairs) const {
  return std::any_of(bodies_.begin(), bodies_.end(), [&](const OfBody& b) {
    return pairs == Pairs::sums ? !b.sum_pairs.empty() : b.newman || !b.pairs.empty();
  });
}

double SecondOrderLoads::lowest(Pairs pairs) const { return pairs == Pairs::sums ? 2 * low_ : 0; }
double SecondOrderLoads::highest(Pairs pairs) const { return pairs == Pairs::sums ? 2 * high_ : high_ - low_; }

double SecondOrderLoads::all_rays(double omega) const {
  double out = 0;
  for (const Ray& ray : rays_) out += ray.density(omega);
  return out;
}

/// T of a body at two waves, with the phases of their ways to it; straight between the frequencies of its file.
void SecondOrderLoads::add_pair(const OfBody& body, Pairs kind, const Wave& a, const Wave& b,
                                Eigen::Ref<Load> out) const {
  const bool sums = kind == Pairs::sums;
  const std::vector<double>& omega = sums ? body.sum_omega : body.omega;
  if (omega.empty() || !is_inside(omega, a.omega) || !is_inside(omega, b.omega)) return;
  const auto way = [&](const Wave& w) {
    const double beta = rays_[w.ray].heading;
    return w.k * (body.origin.x() * std::cos(beta) + body.origin.y() * std::sin(beta));
  };
  const Complex phase = std::polar(1.0, -way(a) + (sums ? -1 : 1) * way(b));
  const hydro::Stencil p = hydro::straight_stencil(omega, a.omega), q = hydro::straight_stencil(omega, b.omega);
  const std::vector<Matrices>& pairs = sums ? body.sum_pairs : body.pairs;
  for (std::size_t i = 0; i < 2; ++i) {
    const auto row = static_cast<Index>(p.first + i), equal = static_cast<Index>(q.first + i);
    for (std::size_t mode = 0; mode < 6; ++mode) {
      Complex& load = out[static_cast<Index>(mode)];
      for (std::size_t j = 0; j < 2 && !pairs.empty() && p.weight[i] != 0; ++j)
        if (q.weight[j] != 0)
          load += phase * p.weight[i] * q.weight[j] *
                  pairs[a.ray * rays_.size() + b.ray][mode](row, static_cast<Index>(q.first + j));
      if (sums || !body.newman) continue;
      if (p.weight[i] != 0) load += 0.5 * phase * p.weight[i] * body.equal[a.ray][mode](row, 0).real();
      if (q.weight[i] != 0) load += 0.5 * phase * q.weight[i] * body.equal[b.ray][mode](equal, 0).real();
    }
  }
}

SecondOrderLoads::Load SecondOrderLoads::of_pair(Pairs kind, const Wave& a, const Wave& b) const {
  Load out = Load::Zero(static_cast<Index>(modes_.size()));
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    add_pair(bodies_[i], kind, a, b, out.segment(6 * static_cast<Index>(i), 6));
  return out;
}

SecondOrderLoads::Load SecondOrderLoads::of_equal_waves(std::size_t ray, double omega) const {
  const Wave wave{ray, omega, 0};
  Load out = of_pair(Pairs::differences, wave, wave);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const OfBody& body = bodies_[i];
    if (body.newman || !body.pairs.empty() || !is_inside(body.omega, omega)) continue;
    const hydro::Stencil w = hydro::straight_stencil(body.omega, omega);
    for (std::size_t j = 0; j < 2; ++j)
      for (std::size_t mode = 0; mode < 6 && w.weight[j] != 0; ++mode)
        out[static_cast<Index>(6 * i + mode)] +=
            w.weight[j] * body.equal[ray][mode](static_cast<Index>(w.first + j), 0).real();
  }
  return out;
}

Eigen::VectorXd SecondOrderLoads::mean(double tolerance) const {
  const auto loads = [&](double omega) {
    Eigen::VectorXd out = Eigen::VectorXd::Zero(static_cast<Index>(modes_.size()));
    for (std::size_t r = 0; r < rays_.size(); ++r) out += 2 * rays_[r].density(omega) * of_equal_waves(r, omega).real();
    return out;
  };
  return integral(low_, high_, intervals_, tolerance, loads, largest_of_each_unit);
}

/// 8 Σ S(ω₁) S(ω₂) T T* over the directions of two waves.
Eigen::MatrixXcd SecondOrderLoads::density_of(Pairs kind, double first, double second) const {
  const auto n = static_cast<Index>(modes_.size());
  Eigen::MatrixXcd out = Eigen::MatrixXcd::Zero(n, n);
  std::vector<double> of_second;
  for (const Ray& ray : rays_) of_second.push_back(ray.density(second));
  const bool one_body = bodies_.size() == 1;  // then the ways of the waves change nothing
  const double k1 = one_body ? 0 : hydro::waves::wavenumber(first, water_),
               k2 = one_body ? 0 : hydro::waves::wavenumber(second, water_);
  for (std::size_t r1 = 0; r1 < rays_.size(); ++r1) {
    const double density = rays_[r1].density(first);
    for (std::size_t r2 = 0; r2 < rays_.size(); ++r2) {
      const double weight = 8 * density * of_second[r2];
      if (weight == 0) continue;
      const Load T = of_pair(kind, {r1, first, k1}, {r2, second, k2});
      out += weight * T * T.adjoint();
    }
  }
  return out;
}

Eigen::MatrixXcd SecondOrderLoads::spectrum(Pairs pairs, double omega, double tolerance, const Measure& measure) const {
  if (pairs == Pairs::differences)
    return integral(
        low_, high_ - omega, intervals_, tolerance,
        [&](double lower) { return density_of(pairs, lower + omega, lower); }, measure);
  // Each pair once: the lower frequency is up to half the sum.
  return integral(
      std::max(low_, omega - high_), omega / 2, intervals_, tolerance,
      [&](double lower) { return density_of(pairs, std::min(high_, omega - lower), lower); }, measure);
}

double SecondOrderLoads::share_above(Pairs pairs, double omega) const {
  const int n = 4 * intervals_;
  const double h = (high_ - low_) / n;
  std::vector<double> energy;
  for (int i = 0; i < n; ++i) energy.push_back(h * all_rays(low_ + (i + 0.5) * h));
  double all = 0, above = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double at = pairs == Pairs::sums ? 2 * low_ + (i + j + 1) * h : std::abs(i - j) * h;
      const double pair = energy[static_cast<std::size_t>(i)] * energy[static_cast<std::size_t>(j)];
      all += pair;
      if (at > omega) above += pair;
    }
  return above / all;
}

}  // namespace froude
