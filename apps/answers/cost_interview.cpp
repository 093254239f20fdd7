#include "answers/cost_interview.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "answers/linear_response.hpp"
#include "answers/simulate.hpp"
#include "compile/sections.hpp"
#include "hydro/base/error.hpp"

namespace froude {
namespace {

/// Thrown out of a run that takes too long to be worth it.
struct TakesTooLong {};

/// Amplitudes in the place of complex values.
std::vector<Signal> amplitudes(const Responses& responses) {
  std::vector<Signal> out;
  for (const ComplexSignal& s : responses.signals) {
    out.push_back({s.name, s.units, s.long_name, {}});
    for (const auto& x : s.values) out.back().values.push_back(std::abs(x));
  }
  return out;
}

Answer stepped(const scene::Scene& scene, const std::shared_ptr<compile::Kept>& kept, double patience_s) {
  Answer out;
  const double begin = processor_s();
  const compile::TimeModel model = compile::time_model(scene, compile::prepare(scene, kept));
  const double prepared = processor_s();
  Run record = run_model(scene, model, [&](double) {
    if (processor_s() - prepared > patience_s) throw TakesTooLong();
  });
  if (!record.stopped.empty()) throw hydro::NumericsError(record.stopped);
  out.signals = std::move(record.signals);
  out.step = record.step;
  out.preparing_s = prepared - begin;
  out.answering_s = processor_s() - prepared;
  return out;
}

}  // namespace

double processor_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

std::string Interview::text_of(const Question& question) const {
  return scene::edited(scene_.text, scene_.file.string(), question.edits);
}

const Answer& Interview::ask(const Question& question, double patience_s) {
  Answer out;
  std::string text;
  try {
    text = text_of(question);
    if (const auto known = answers_.find(text); known != answers_.end()) return known->second;
    out = answered(text, question.coefficients, patience_s);
  } catch (const hydro::InputError& e) {
    out.refused = e.rule();
  } catch (const hydro::NumericsError& e) {
    out.refused = e.what();
  } catch (const TakesTooLong&) {
    out.refused = fmt::format("takes more than {:.2g} s", patience_s);
  }
  // A refusal is kept as well: a search of poles that ends without any takes as long as one that finds them.
  return text.empty() ? refusals_.emplace_back(std::move(out)) : answers_[text] = std::move(out);
}

void Interview::repeat(const Question& question) {
  const std::string text = text_of(question);
  Answer& known = answers_.at(text);
  const Answer again = answered(text, question.coefficients, std::numeric_limits<double>::infinity());
  known.preparing_s = std::min(known.preparing_s, again.preparing_s);
  known.answering_s = std::min(known.answering_s, again.answering_s);
  ++known.repeats;
}

/// What a first preparation takes longer than a second one is what is made once.
const Interview::Coefficients& Interview::coefficients_of(const scene::Scene& scene, const std::string& name) {
  if (const auto known = coefficients_.find(name); known != coefficients_.end()) return known->second;
  if (steps(scene)) compile::require_no_sections(scene);
  Coefficients made;
  const auto preparing_s = [&] {
    const double begin = processor_s();
    const compile::Prepared prepared = compile::prepare(scene, made.kept);
    if (steps(scene)) compile::time_model(scene, prepared);
    return processor_s() - begin;
  };
  const double first_s = preparing_s();
  made.once_s = std::max(0.0, first_s - preparing_s());
  return coefficients_.emplace(name, std::move(made)).first->second;
}

Answer Interview::answered(const std::string& text, const std::string& coefficients, double patience_s) {
  const scene::Scene scene = scene::parse(text, scene_.file);
  const Coefficients& from = coefficients_of(scene, coefficients);
  Answer out = steps(scene) ? stepped(scene, from.kept, patience_s) : solved(scene, from.kept);
  out.once_s = from.once_s;
  out.repeats = 1;
  return out;
}

Answer Interview::solved(const scene::Scene& scene, const std::shared_ptr<compile::Kept>& kept) const {
  Answer out;
  double begin = processor_s();
  const compile::Prepared prepared = compile::prepare(scene, kept);
  out.preparing_s = processor_s() - begin;
  begin = processor_s();
  out.signals = run_ ? steady_run(scene, kept).signals : amplitudes(respond(scene, prepared));
  out.answering_s = processor_s() - begin;
  return out;
}

}  // namespace froude
