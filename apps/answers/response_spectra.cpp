#include "answers/response_spectra.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <stdexcept>

#include "answers/linear_response.hpp"
#include "compile/compile.hpp"
#include "compile/kept.hpp"
#include "hydro/base/error.hpp"
#include "hydro/waves/spectra/spectrum.hpp"
#include "hydro/waves/spectra/spreading.hpp"

namespace froude {
namespace {

using hydro::Angle, hydro::InputError;
constexpr double two_pi = 2 * std::numbers::pi;

const scene::RandomSea& random_sea(const scene::Scene& scene) {
  if (!scene.waves)
    throw InputError("spectra of responses need a sea, but the scene has no waves", {.file = scene.file.string()},
                     "add a [waves] table with a spectrum, such as kind = \"jonswap\"");
  const auto* sea = std::get_if<scene::RandomSea>(&scene.waves->kind);
  if (!sea)
    throw InputError("spectra of responses need a random sea, which these waves are not", scene.waves->place,
                     "choose a kind with a spectrum, such as \"jonswap\"");
  if (sea->crest)
    throw InputError("a sea with a crest put in has no spectrum that tells its responses", scene.waves->place,
                     "leave the crest out, or step a run");
  return *sea;
}

void require_linear_question(const scene::Scene& scene) {
  if (!scene.rao) throw std::logic_error("spectra of responses are asked for without [ask.rao]");
  if (scene.rao->drag)
    throw InputError("[ask.rao.drag] makes drag linear for waves of one height, not for a sea", scene.rao->drag->place,
                     "leave it out: drag has then no part, which notes tell; or step a run");
}

/// A heading of the sea and which share of a frequency's energy goes along it.
struct Direction {
  std::size_t heading;  // of all that responses are computed for
  double from, to;      // from the mean heading, rad: of the sector whose energy goes there
};

/// A wave system, its energy cut into sectors of equal energy at its peak.
struct System {
  const scene::WaveSystem* waves;
  std::vector<Direction> directions;

  double share(const Direction& d, double omega) const {
    if (!waves->spreading) return 1;
    const auto below = [&](double angle) { return waves->spreading->share_below(Angle::from_radians(angle), omega); };
    return below(d.to) - below(d.from);
  }
};

/// The number of a heading, a new one if none is the same but for rounding.
std::size_t number_of(double heading, std::vector<double>& headings) {
  const auto at =
      std::find_if(headings.begin(), headings.end(), [&](double h) { return std::abs(h - heading) < 1e-9; });
  if (at == headings.end()) {
    headings.push_back(heading);
    return headings.size() - 1;
  }
  return static_cast<std::size_t>(at - headings.begin());
}

System system_of(const scene::WaveSystem& waves, int sectors, std::vector<double>& headings) {
  System out{&waves, {}};
  if (!waves.spreading) {
    out.directions.push_back({number_of(waves.heading.radians(), headings), 0, 0});
    return out;
  }
  const auto quantile = [&](double share) {
    return waves.spreading->quantile(share, waves.spectrum->peak_omega()).radians();
  };
  for (int i = 0; i < sectors; ++i) {
    const double middle = std::remainder(waves.heading.radians() + quantile((i + 0.5) / sectors), two_pi);
    out.directions.push_back({number_of(middle, headings), i == 0 ? -std::numbers::pi : quantile(1.0 * i / sectors),
                              i + 1 == sectors ? std::numbers::pi : quantile((i + 1.0) / sectors)});
  }
  return out;
}

/// Squares of transfer functions and densities of what they make, at one frequency.
struct Column {
  double omega;
  Eigen::VectorXd density;  // per rad/s; sea by sea the elevation, then every signal
};

/// Asks for responses, turns them into densities, and puts frequencies where densities bend.
class Densities {
 public:
  Densities(const std::vector<const scene::Scene*>& seas, int sectors, const std::shared_ptr<compile::Kept>& kept)
      : scene_(*seas.front()), tolerance_(seas.front()->accuracy) {
    scene_.rao->headings.clear();
    for (const scene::Scene* sea : seas) {
      systems_.emplace_back();
      for (const auto& waves : random_sea(*sea).systems)
        systems_.back().push_back(system_of(waves, sectors, scene_.rao->headings));
    }
    scene_.rao->headings_place = scene_.waves->place;
    prepared_ = std::make_unique<compile::Prepared>(compile::prepare(scene_, kept));
  }

  /// From these frequencies on. \throws hydro::NumericsError
  void refine(const std::vector<double>& omega) {
    columns_ = at(omega);
    std::vector<double> lower_ends(omega.begin(), omega.end() - 1);
    constexpr int most = 24;  // halvings: a peak a millionth as wide as the spacing asked for is found
    error_ = 0;
    for (int round = 0; !lower_ends.empty(); ++round) {
      if (round == most)
        throw hydro::NumericsError(fmt::format(
            "a response near {:.6g} rad/s is too sharp: its spectrum changes by more than the accuracy asked, {:g}, "
            "however closely frequencies stand; a motion without damping has no spectrum",
            lower_ends.front(), tolerance_));
      lower_ends = halve(lower_ends);
    }
  }

  std::vector<double> omega() const {
    std::vector<double> out;
    for (const Column& c : columns_) out.push_back(c.omega);
    return out;
  }
  std::size_t headings() const { return scene_.rao->headings.size(); }
  const Responses& responses() const { return *first_; }
  double error() const { return error_; }

  /// The density of one sea's elevation (row 0) or signal.
  hydro::signal::SpectrumPerHz spectrum(std::size_t sea, std::size_t row) const {
    hydro::signal::SpectrumPerRadS out;
    for (const Column& c : columns_) {
      out.omega.push_back(c.omega);
      out.density.push_back(c.density(static_cast<Eigen::Index>(sea * rows() + row)));
    }
    return hydro::signal::per_hz(out);
  }

  /// m₀ of everything.
  Eigen::VectorXd variances() const { return moment(0); }

 private:
  std::size_t rows() const { return first_->signals.size() + 1; }

  /// Signals whose largest response is rounding against that of others with the same unit.
  void find_silent(const Responses& r) {
    std::map<std::string, double> largest;
    std::vector<double> of_signal;
    for (const auto& s : r.signals) {
      double top = 0;
      for (const auto& v : s.values) top = std::max(top, std::abs(v));
      of_signal.push_back(top);
      largest[s.units] = std::max(largest[s.units], top);
    }
    constexpr double rounding = 1e-9;
    for (std::size_t s = 0; s < of_signal.size(); ++s)
      silent_.push_back(of_signal[s] <= rounding * largest[r.signals[s].units]);
  }

  std::vector<Column> at(const std::vector<double>& omega) {
    scene_.rao->omega = omega;
    const Responses r = respond(scene_, *prepared_);
    if (!first_) {
      first_ = std::make_unique<Responses>(r);
      find_silent(r);
    }
    std::vector<Column> out;
    for (std::size_t w = 0; w < omega.size(); ++w) {
      Column column{omega[w], Eigen::VectorXd::Zero(static_cast<Eigen::Index>(systems_.size() * rows()))};
      for (std::size_t sea = 0; sea < systems_.size(); ++sea)
        for (const System& system : systems_[sea]) add(system, r, w, sea, column);
      out.push_back(std::move(column));
    }
    return out;
  }

  /// ∫ S(ω) D(θ; ω) |H(ω, θ)|² dθ of one system, (Q8).
  void add(const System& system, const Responses& r, std::size_t w, std::size_t sea, Column& column) const {
    const auto first = static_cast<Eigen::Index>(sea * rows());
    const double density = system.waves->spectrum->density(column.omega);
    for (const Direction& d : system.directions) {
      const double part = density * system.share(d, column.omega);
      column.density(first) += part;
      for (std::size_t s = 0; s < r.signals.size(); ++s)
        if (!silent_[s])
          column.density(first + 1 + static_cast<Eigen::Index>(s)) +=
              part * std::norm(r.signals[s].values[d.heading * r.omega.size() + w]);
    }
  }

  Eigen::VectorXd moment(int order) const {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(columns_.front().density.size());
    const auto integrand = [&](const Column& c) { return Eigen::VectorXd(std::pow(c.omega, order) * c.density); };
    for (std::size_t i = 0; i + 1 < columns_.size(); ++i)
      sum += (integrand(columns_[i]) + integrand(columns_[i + 1])) / 2 * (columns_[i + 1].omega - columns_[i].omega);
    return sum;
  }

  /// Puts a frequency into the middle of each of these intervals. \return the lower ends of those halves that have to
  /// be halved again: by Simpson's rule their share of the error is above that of their width
  std::vector<double> halve(const std::vector<double>& lower_ends) {
    std::vector<std::size_t> intervals;
    std::vector<double> middles;
    for (std::size_t i = 0, next = 0; i + 1 < columns_.size() && next < lower_ends.size(); ++i)
      if (columns_[i].omega == lower_ends[next]) {
        intervals.push_back(i);
        middles.push_back((columns_[i].omega + columns_[i + 1].omega) / 2);
        ++next;
      }
    const std::vector<Column> found = at(middles);
    const double range = columns_.back().omega - columns_.front().omega;
    const std::array orders{0, 2, 4};
    std::array<Eigen::VectorXd, 3> moments;
    for (std::size_t n = 0; n < orders.size(); ++n) moments[n] = moment(orders[n]);
    std::vector<double> again;
    for (std::size_t k = 0; k < intervals.size(); ++k) {
      const Column &low = columns_[intervals[k]], &high = columns_[intervals[k] + 1], &middle = found[k];
      const double width = high.omega - low.omega;
      double worst = 0;
      for (std::size_t n = 0; n < orders.size(); ++n) {
        const auto power = [&](double omega) { return std::pow(omega, orders[n]); };
        const Eigen::VectorXd bend = power(middle.omega) * middle.density -
                                     (power(low.omega) * low.density + power(high.omega) * high.density) / 2;
        for (Eigen::Index row = 0; row < bend.size(); ++row)
          if (moments[n](row) > 0) worst = std::max(worst, std::abs(bend(row)) * width * (2.0 / 3) / moments[n](row));
      }
      // A middle that is put in leaves a quarter of the error of a smooth density.
      if (worst > tolerance_ * width / range) {
        again.push_back(low.omega);
        again.push_back(middle.omega);
      } else {
        error_ += worst / 4;
      }
    }
    for (const Column& c : found) columns_.push_back(c);
    std::sort(columns_.begin(), columns_.end(), [](const Column& a, const Column& b) { return a.omega < b.omega; });
    return again;
  }

  scene::Scene scene_;
  double tolerance_, error_ = 0;
  std::vector<std::vector<System>> systems_;
  std::unique_ptr<compile::Prepared> prepared_;
  std::unique_ptr<Responses> first_;  // at the frequencies of the scene
  std::vector<bool> silent_;
  std::vector<Column> columns_;
};

bool has_spreading(const std::vector<const scene::Scene*>& seas) {
  return std::any_of(seas.begin(), seas.end(), [](const scene::Scene* scene) {
    const auto& systems = random_sea(*scene).systems;
    return std::any_of(systems.begin(), systems.end(), [](const auto& s) { return s.spreading != nullptr; });
  });
}

/// The largest relative change of what is not zero.
double change(const Eigen::VectorXd& before, const Eigen::VectorXd& now) {
  double out = 0;
  for (Eigen::Index i = 0; i < now.size(); ++i)
    if (now(i) > 0) out = std::max(out, std::abs(now(i) - before(i)) / now(i));
  return out;
}

double share_outside(const scene::RandomSea& sea, double low, double high) {
  double all = 0, inside = 0;
  for (const auto& system : sea.systems) {
    all += system.spectrum->moment(0);
    inside += system.spectrum->energy(low, high);
  }
  return std::max(0.0, 1 - inside / all);
}

ResponseSpectra answer_of(const scene::Scene& scene, std::size_t sea, const Densities& found,
                          double error_of_headings) {
  const Responses& r = found.responses();
  const std::vector<double> omega = found.omega();
  const scene::RandomSea& random = random_sea(scene);
  ResponseSpectra out{.sea = found.spectrum(sea, 0),
                      .left_out = share_outside(random, omega.front(), omega.back()),
                      .headings = found.headings(),
                      .error = found.error() + error_of_headings,
                      .signals = {},
                      .notes = r.notes,
                      .warnings = r.warnings()};
  for (std::size_t s = 0; s < r.signals.size(); ++s) {
    std::string units = r.signals[s].units;
    units.resize(units.size() - std::string_view("/m").size());  // per metre of wave amplitude no more
    out.signals.push_back({r.signals[s].name, units, found.spectrum(sea, s + 1)});
  }
  if (random.second_order) out.notes.emplace_back("bound waves of second order are left out");
  if (out.left_out > scene.accuracy)
    out.warnings.push_back(
        fmt::format("{:.2g} % of the sea's energy lies outside the frequencies of [ask.rao], {:.4g} to {:.4g} rad/s, "
                    "and has no part "
                    "in responses",
                    100 * out.left_out, omega.front(), omega.back()));
  return out;
}

}  // namespace

std::vector<ResponseSpectra> response_spectra(const std::vector<const scene::Scene*>& seas) {
  require_linear_question(*seas.front());
  const scene::Scene& scene = *seas.front();
  if (scene.rao->omega.size() < 2)
    throw InputError("spectra of responses need two frequencies of [ask.rao] at least", scene.rao->place,
                     "give a range, for example periods = \"3 s .. 25 s, 45 values\"");
  const bool spread = has_spreading(seas);
  const auto kept = std::make_shared<compile::Kept>();
  auto found = std::make_unique<Densities>(seas, spread ? 18 : 1, kept);
  found->refine(scene.rao->omega);
  double error_of_headings = 0;
  constexpr int most = 288;  // sectors
  for (int sectors = 36; spread; sectors *= 2) {
    auto finer = std::make_unique<Densities>(seas, sectors, kept);
    finer->refine(scene.rao->omega);
    error_of_headings = change(found->variances(), finer->variances());
    found = std::move(finer);
    if (error_of_headings < scene.accuracy / 2) break;
    if (sectors == most)
      throw hydro::NumericsError(
          fmt::format("responses of a sea with spreading change by {:.2g} from {} headings to {}, more than the "
                      "accuracy asked, {:g}",
                      error_of_headings, most / 2, most, scene.accuracy));
  }
  std::vector<ResponseSpectra> out;
  for (std::size_t i = 0; i < seas.size(); ++i) out.push_back(answer_of(*seas[i], i, *found, error_of_headings));
  return out;
}

}  // namespace froude
