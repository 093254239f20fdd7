#pragma once
/// \file  Private to the commands that answer scenes: what they share in naming results.
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "froude/commands.hpp"
#include "froude/report.hpp"
#include "froude/result.hpp"
#include "scene/scene.hpp"

namespace froude {

/// The path of the result asked for, or the scene's name with `ending` in the current folder. All that the command will
/// write is checked before it computes (outputs.hpp), `tables` of options of its own too. \throws hydro::InputError
Path checked_output(const SceneArguments& arguments, const std::string& ending,
                    const std::vector<std::pair<std::string, std::optional<Path>>>& tables = {});

/// \throws hydro::InputError if the scene does not ask for this, saying how to
void require_asked(bool asked, const scene::Scene& scene, const std::string& what, const std::string& example);

/// How far the signals of a run, or responses, are off, and what that leaves to say.
template <class Answer>
Report error_of(const Answer& answer) {
  const ErrorEstimate& e = answer.error;
  Report out;
  if (const std::string told = answer.accuracy(); !told.empty()) out.say("{}", told);
  out.keep("asked", e.asked);
  if (!e.missing.empty()) return out.keep("not_estimated", e.missing);
  for (std::size_t i = 0; i < answer.signals.size() && !e.sources.empty(); ++i) {
    Report one;
    one.keep("signal", answer.signals[i].name).keep("total", e.total(i));
    for (const auto& source : e.sources) one.keep(source.name, source.of_signal[i]);
    for (const auto& lost : e.unpredictable)
      if (lost.signal == i)
        one.keep("predictable_until_s", lost.until)
            .keep("deviation_beyond", lost.deviation)
            .keep("scatter_of_deviation", lost.scatter);
    out.one_of("signals", one);
  }
  return out;
}

}  // namespace froude
