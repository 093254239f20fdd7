#pragma once
/// \file  The same question to a scene with other settings: answers and how long they took. Private to apps.
#include <deque>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "compile/kept.hpp"
#include "froude/result.hpp"
#include "scene/edit.hpp"
#include "scene/scene.hpp"

namespace froude {

/// Of this process, s: what others on the machine take does not count.
double processor_s();

/// A scene with some settings.
struct Question {
  std::vector<scene::TextEdit> edits;
  /// Names the settings that make coefficients or fits of their own. What is kept for one does not serve another, so
  /// that each pays for its own.
  std::string coefficients;
};

/// What came of it, and how long it took.
struct Answer {
  std::vector<Signal> signals;  ///< of a run, or amplitudes of responses
  double step = 0;              ///< s, of a run
  /// s, least of the repeats: making the model, from coefficients and fits that are there; stepping it or solving.
  double preparing_s = std::numeric_limits<double>::infinity(), answering_s = preparing_s;
  double once_s = 0;  ///< s, of reading or making coefficients, and of fits to them
  int repeats = 0;
  std::string refused;  ///< why there is no answer

  bool is() const { return refused.empty(); }
  double time_s() const { return once_s + preparing_s + answering_s; }
};

/// Asks a scene for a run or for its RAO, and keeps answers and what served for them. The scene must live as long.
class Interview {
 public:
  Interview(const scene::Scene& scene, bool run) : scene_(scene), run_(run) {}

  std::string text_of(const Question& question) const;
  /// What was known, or the scene's answer, or why there is none; it may be stepped for `patience_s`, s.
  const Answer& ask(const Question& question, double patience_s = std::numeric_limits<double>::infinity());
  /// An answer that is known once more, for its time alone.
  void repeat(const Question& question);

 private:
  struct Coefficients {
    std::shared_ptr<compile::Kept> kept = std::make_shared<compile::Kept>();
    double once_s = 0;
  };
  bool steps(const scene::Scene& scene) const { return run_ && !scene.run->steady; }
  const Coefficients& coefficients_of(const scene::Scene& scene, const std::string& name);
  Answer answered(const std::string& text, const std::string& coefficients, double patience_s);
  Answer solved(const scene::Scene& scene, const std::shared_ptr<compile::Kept>& kept) const;

  const scene::Scene& scene_;
  bool run_;
  std::map<std::string, Answer> answers_;             // by text
  std::deque<Answer> refusals_;                       // referred to by who asked
  std::map<std::string, Coefficients> coefficients_;  // by name
};

}  // namespace froude
