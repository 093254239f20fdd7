#pragma once
/// \file  What accuracy costs: the settings of a scene's own approximations, each with its error and its time.
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace froude {

/// How far an answer x is from the reference r, as a share of what the reference has of the same kind.
enum class ErrorMeasure {
  rms,        ///< of a run: rms of x − r over rms of r
  deviation,  ///< of a run: standard deviations
  extreme,    ///< of a run: largest |x|
  range,      ///< of a run: from least to largest, such as the tension range of a line
  peak,       ///< of responses: largest amplitude over frequencies
};
inline constexpr std::size_t error_measures = 5;
/// "rms", "deviation", …
std::string name_of(ErrorMeasure measure);

/// The error of the signal that is worst.
struct WorstSignal {
  double error = 0;  ///< relative
  std::string signal;
};
/// By measure; those that do not apply to an answer are 0 without a signal.
using CostErrors = std::array<WorstSignal, error_measures>;

/// One setting and what it costs.
struct CostRung {
  std::string approximation;  ///< "step", "memory", …; "together": several at once
  std::string setting;        ///< "0.05 s"
  CostErrors error = {};      ///< of the whole answer, against the reference
  WorstSignal alone = {};     ///< of this approximation by itself: against its own finest, all others as in the scene
  /// s, processor time, least of the repeats: making the model, what is made once (reading or solving for coefficients,
  /// fitting a memory) included; stepping it or solving.
  double preparing_s = 0, answering_s = 0;
  int repeats = 0;
  bool as_scene = false;     ///< what the scene does by itself
  bool on_front = false;     ///< nothing cheaper is as accurate
  std::string refused = {};  ///< why there is no answer with it; then it has no numbers
  std::string scene = {};    ///< the text of the scene with this setting

  double time_s() const { return preparing_s + answering_s; }
};

/// Seas of other components are other realisations: standard deviations, means over several seeds, are compared.
struct CostOfComponents {
  std::string setting;
  double error;      ///< of the standard deviation, against the finest; of the signal that is worst
  double by_chance;  ///< standard error of that, from the scatter of the seeds
  std::string signal;
  double answering_s;  ///< of one seed
};

/// What the answer to one ask costs.
struct AnswerCost {
  std::string ask;          ///< "run", "rao"
  ErrorMeasure measure;     ///< by which the front and the choice go
  std::string reference;    ///< the settings of the reference
  WorstSignal uncertainty;  ///< of the reference: by how much its next finest settings differ from it
  std::vector<CostRung> rungs;
  std::vector<CostOfComponents> components;
  std::optional<std::size_t> chosen;  ///< the cheapest within the tolerance asked for, if there is one
  /// Set where a run cannot be predicted and one of its length leaves more than the tolerance to chance: so much, by
  /// which two of the finest settings differ. `chosen` is then the cheapest that differs by no more.
  std::optional<double> by_chance = {};
  std::vector<std::string> notes;  ///< what was left as it is and why

  /// The least error of all; the rungs are not empty.
  const CostRung& most_accurate() const;
};

struct Cost {
  std::vector<AnswerCost> answers;
  std::vector<std::string> notes;
  /// The scene with the settings chosen for each answer, if each has one; its comments kept.
  std::optional<std::string> scene;
};

struct CostOptions {
  std::optional<double> tolerance = {};      ///< of the error, relative
  ErrorMeasure measure = ErrorMeasure::rms;  ///< of runs; responses go by their peaks
  /// s of processor time, of each answer: spent on repeats, and again on seas of other components
  double repeat_for_s = 15;
};

}  // namespace froude
