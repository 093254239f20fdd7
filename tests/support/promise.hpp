#pragma once
/// \file  A scene run as the program chooses, and judged by runs that are much finer: is the accuracy asked kept?
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "answers/simulate.hpp"
#include "compile/kept.hpp"
#include "hydro/base/error.hpp"
#include "support/left_to_the_program.hpp"
#include "support/run_errors.hpp"

namespace support {

struct Subject {
  std::string name, text;
  std::filesystem::path file;  ///< beside which the text finds its data
  double longest;              ///< s of it that are run
};

/// Runs of one subject, which share coefficients and poles.
class Runs {
 public:
  explicit Runs(const Subject& subject) : subject_(subject), kept_(std::make_shared<froude::compile::Kept>()) {}

  const Subject& subject() const { return subject_; }
  froude::scene::Scene read(double accuracy, const Finer& finer = {}) const {
    const std::string text = left_to_the_program(subject_.text, accuracy, subject_.longest);
    return refined(froude::scene::parse(text, subject_.file), finer);
  }
  /// To its end. \throws hydro::InputError where it is refused, hydro::NumericsError where it stops before
  froude::Run of(const froude::scene::Scene& scene) const {
    froude::Run out = froude::simulate(scene, {}, {}, kept_);
    if (!out.stopped.empty()) throw hydro::NumericsError(out.stopped);
    return out;
  }
  /// Whatever its error is estimated to be.
  froude::Run accepted(double accuracy, const Finer& finer) const {
    froude::scene::Scene scene = read(accuracy, finer);
    scene.solve.accept_error = true;
    return of(scene);
  }

 private:
  const Subject& subject_;
  std::shared_ptr<froude::compile::Kept> kept_;
};

/// A run that is much finer in all that is approximated, and one whose step is twice as long, by the program's own
/// method: by what they differ the first is not sure.
struct Reference {
  froude::Run run, second;
  std::string method;
  std::optional<froude::scene::Scene> cut;  ///< whose lines have three segments for each of its own; empty: no lines
};

inline std::optional<froude::scene::Scene> cut_in_three(froude::scene::Scene scene) {
  return froude::scene::approximates_lines(scene) ? std::optional(std::move(scene)) : std::nullopt;
}

/// Ten times finer than `finest`, s, by another method where one takes the scene, with components and pieces for the
/// highest accuracy that its data allow. \throws hydro::NumericsError if there is none
inline Reference reference(const Runs& runs, double finest) {
  // Coefficients of cylinders would be computed anew for a higher accuracy, and take minutes.
  const double highest = runs.subject().text.find(".cylinders]") != std::string::npos ? 1e-3 : 1e-4;
  std::string why;
  for (const double accuracy : {1e-4, 1e-3, 1e-2, 1e-1})
    for (const char* method : {"energy_momentum", "generalized_alpha", ""}) {
      if (accuracy < highest) continue;
      Finer finer{.step = finest / 10, .integrator = {}, .memory = true, .links = true};
      if (*method) finer.integrator = method;
      try {
        froude::Run first = runs.accepted(accuracy, finer);
        finer.integrator.reset();
        finer.step = finest / 5;
        froude::Run second = runs.accepted(accuracy, finer);
        return {std::move(first), std::move(second), *method ? method : "as the scene says",
                cut_in_three(runs.read(accuracy))};
      } catch (const std::runtime_error& e) {
        why += fmt::format("\n{} at {}: {}", method, accuracy, e.what());
      }
    }
  throw hydro::NumericsError("no reference for " + runs.subject().name + why);
}

/// The signal whose error is largest.
struct Judgement {
  double error = 0, unsure = 0;  ///< relative; by how much the references differ in it, up to the same time
  std::size_t signal = 0;
  double until = std::numeric_limits<double>::infinity();  ///< s, up to which the references agree in all signals
};

/// Up to which time, s, a run says that a signal can be predicted.
inline double predicted_until(const froude::Run& run, std::size_t signal) {
  for (const auto& lost : run.error.unpredictable)
    if (lost.signal == signal) return lost.until;
  return std::numeric_limits<double>::infinity();
}

/// Signals are judged for as long as the references differ by less than a fifth of the accuracy asked, and the run says
/// that they can be predicted.
inline Judgement judge(const froude::Run& run, const Reference& reference, double accuracy) {
  const auto size = sizes(run);
  Judgement out;
  for (std::size_t i = 0; i < run.signals.size(); ++i) {
    const auto& signal = run.signals[i];
    if (signal.name.find("residual") != std::string::npos) continue;  // an error itself
    const std::string name = reference.cut ? name_where_cut(*reference.cut, signal.name) : signal.name;
    const auto &first = reference.run.signal(name), &second = reference.second.signal(name);
    const std::size_t judged = agreed(first, second, size[i].rms, accuracy / 5);
    out.until = std::min(out.until, judged > 0 ? run.time[judged - 1] : 0);
    const auto predicted =
        std::upper_bound(run.time.begin(), run.time.end(), predicted_until(run, i)) - run.time.begin();
    const std::size_t count = std::min(judged, static_cast<std::size_t>(predicted));
    const double error = relative_error(signal.values, first, size[i], count);
    if (error < out.error) continue;
    out.error = error;
    out.unsure = relative_error(second, first, size[i], count);
    out.signal = i;
  }
  return out;
}

/// Of a run that was refused: true if a step like the reference's, and all else as the program chooses it, does not
/// keep the accuracy either, or if the references themselves do not agree to the end.
inline bool is_out_of_reach(const Runs& runs, const Reference& reference, double accuracy) {
  try {
    const froude::Run fine = runs.accepted(accuracy, {.step = reference.run.step});
    const Judgement j = judge(fine, reference, accuracy);
    return j.error > accuracy || j.until < fine.time.back();
  } catch (const std::runtime_error&) {
    return true;  // there is no such run
  }
}

}  // namespace support
