#include "answers/response_spectra.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>

#include "answers/linear_response.hpp"
#include "answers/refined_densities.hpp"
#include "answers/sea_directions.hpp"
#include "compile/compile.hpp"
#include "compile/kept.hpp"
#include "compile/members.hpp"
#include "compile/waves.hpp"
#include "hydro/base/error.hpp"
#include "hydro/waves/spectra/spectrum.hpp"

namespace froude {
namespace {

using hydro::InputError;

void require_linear_question(const scene::Scene& scene) {
  if (!scene.rao) throw std::logic_error("spectra of responses are asked for without [ask.rao]");
  if (scene.rao->drag)
    throw InputError("[ask.rao.drag] makes drag linear for waves of one height, not for a sea", scene.rao->drag->place,
                     "leave it out: drag on members is made linear for the sea itself");
}

/// Asks for responses, turns them into densities, and puts frequencies where densities bend.
class Densities {
 public:
  Densities(const std::vector<const scene::Scene*>& seas, int sectors, const std::shared_ptr<compile::Kept>& kept)
      : scene_(*seas.front()), tolerance_(seas.front()->accuracy) {
    scene_.rao->headings.clear();
    for (scene::Body& body : scene_.bodies) body.second_order.reset();  // second_order_responses() are beside
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
    if (!compile::any_drag(scene_)) return put_frequencies(omega);
    refine_with_drag(omega);
  }

  std::vector<double> omega() const { return found_->omega(); }
  std::size_t headings() const { return scene_.rao->headings.size(); }
  const Responses& responses() const { return *first_; }
  double error() const { return found_->error(); }

  /// The density of one sea's elevation (row 0) or signal.
  hydro::signal::SpectrumPerHz spectrum(std::size_t sea, std::size_t row) const {
    return found_->spectrum(static_cast<Eigen::Index>(sea * rows() + row));
  }

  /// m₀ of everything.
  Eigen::VectorXd variances() const { return found_->moment(0); }

  std::optional<DragInSea> drag() const {
    if (!drag_) return std::nullopt;
    return by_member(scene_, *prepared_, *drag_);
  }

 private:
  void put_frequencies(const std::vector<double>& omega) {
    first_.reset();
    silent_.clear();
    found_.emplace(omega, tolerance_, [&](const std::vector<double>& more) { return at(more); });
  }

  /// Drag needs the frequencies where responses bend, which need the drag: in turns, until drag is within the accuracy.
  void refine_with_drag(const std::vector<double>& omega) {
    constexpr int most = 10;
    const auto settled = [&](const std::vector<double>& at, const Eigen::VectorXd& start) {
      auto found = sea_drag(scene_, *prepared_, systems_.front(), at, start);
      if (drag_) found.iterations += drag_->iterations;
      return found;
    };
    drag_ = settled(omega, {});
    for (int turn = 0; turn < most; ++turn) {
      put_frequencies(omega);
      const Eigen::VectorXd before = drag_->coefficient;
      drag_ = settled(found_->omega(), before);
      const double change = (drag_->coefficient - before).lpNorm<Eigen::Infinity>();
      if (change <= tolerance_ * before.lpNorm<Eigen::Infinity>()) return;
    }
    throw hydro::NumericsError(fmt::format(
        "linear drag still changes by more than the accuracy asked, {:g}, after frequencies were put anew {} "
        "times",
        tolerance_, most));
  }

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
    HowToRespond how;
    if (drag_) how.drag_of_sea = &drag_->coefficient;
    how.judge_sections = !first_;  // at the frequencies of the scene, of whose peaks errors are a share
    const Responses r = respond(scene_, *prepared_, how);
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

  scene::Scene scene_;
  double tolerance_;
  std::vector<std::vector<System>> systems_;
  std::unique_ptr<compile::Prepared> prepared_;
  std::unique_ptr<Responses> first_;  // at the frequencies of the scene
  std::vector<bool> silent_;
  std::optional<RefinedDensities> found_;
  std::optional<dynamics::frequency::SeaDrag> drag_;
};

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
                      .warnings = r.warnings(),
                      .drag = found.drag(),
                      .sections = r.sections};
  for (std::size_t s = 0; s < r.signals.size(); ++s) {
    std::string units = r.signals[s].units;
    units.resize(units.size() - std::string_view("/m").size());  // per metre of wave amplitude no more
    out.signals.push_back({r.signals[s].name, units, found.spectrum(sea, s + 1)});
  }
  for (std::string& warning : compile::wave_warnings(scene)) out.warnings.push_back(std::move(warning));
  if (random.second_order) out.notes.emplace_back("bound waves of second order are left out");
  if (out.left_out > scene.accuracy)
    out.warnings.push_back(fmt::format(
        "warning: {:.2g} % of the sea's energy lies outside the frequencies of [ask.rao], {:.4g} to {:.4g} rad/s, "
        "and has no part "
        "in responses",
        100 * out.left_out, omega.front(), omega.back()));
  return out;
}

/// Of the frequencies asked for those within the band that the scene cuts its sea to, and its ends, so that nothing
/// beyond them has a part. \throws InputError if none is
std::vector<double> within(const SeaBand& band, const scene::AskRao& asked) {
  std::vector<double> out;
  const auto [low, high] = band;
  const bool begins = low > asked.omega.front() && low<asked.omega.back(), ends = high> asked.omega.front() &&
                      high < asked.omega.back();
  if (begins) out.push_back(low);
  for (const double omega : asked.omega)
    if (omega >= low && omega <= high && (out.empty() || omega > out.back())) out.push_back(omega);
  if (ends && (out.empty() || high > out.back())) out.push_back(high);
  if (out.size() < 2)
    throw InputError(fmt::format("of the frequencies of [ask.rao], {:.4g} to {:.4g} rad/s, the sea has none: "
                                 "[waves.components] cut it to {:.4g} to {:.4g} rad/s",
                                 asked.omega.front(), asked.omega.back(), low, high),
                     asked.place, "ask for frequencies of the sea");
  return out;
}

/// Of seas whose transfer functions are the same.
std::vector<ResponseSpectra> spectra_of_seas(const std::vector<const scene::Scene*>& seas,
                                             const std::shared_ptr<compile::Kept>& kept) {
  const scene::Scene& scene = *seas.front();
  if (scene.rao->omega.size() < 2)
    throw InputError("spectra of responses need two frequencies of [ask.rao] at least", scene.rao->place,
                     "give a range, for example periods = \"3 s .. 25 s, 45 values\"");
  const std::vector<double> omega = within(band_of(random_sea(scene)), *scene.rao);
  const bool spread =
      std::any_of(seas.begin(), seas.end(), [](const scene::Scene* sea) { return has_spreading(random_sea(*sea)); });
  auto found = std::make_unique<Densities>(seas, spread ? 18 : 1, kept);
  found->refine(omega);
  double error_of_headings = 0;
  constexpr int most = 288;  // sectors
  for (int sectors = 36; spread; sectors *= 2) {
    auto finer = std::make_unique<Densities>(seas, sectors, kept);
    finer->refine(omega);
    error_of_headings = largest_change(found->variances(), finer->variances());
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

}  // namespace

std::vector<ResponseSpectra> response_spectra(const std::vector<const scene::Scene*>& seas,
                                              const std::shared_ptr<compile::Kept>& kept) {
  require_linear_question(*seas.front());
  if (!compile::any_drag(*seas.front())) return spectra_of_seas(seas, kept);
  std::vector<ResponseSpectra> out;
  for (const scene::Scene* sea : seas) out.push_back(spectra_of_seas({sea}, kept).front());
  return out;
}

}  // namespace froude
