#include "froude/fit/report.hpp"

#include <cmath>
#include <type_traits>
#include <variant>
#include <vector>

#include "froude/fit_facts.hpp"

namespace froude {
namespace {

using ::fit::Coefficient;
using ::fit::Estimate;

template <class T>
constexpr bool is_list_of_values =
    std::is_same_v<T, std::vector<::fit::Interval>> || std::is_same_v<T, std::vector<::fit::Facts>>;

/// Numbers, words and lists of them are told as they are.
template <class T>
Json tree_of(const T& value) {
  if constexpr (std::is_same_v<T, ::fit::Interval>) {
    return {value.low, value.high};
  } else if constexpr (std::is_same_v<T, ::fit::Facts>) {
    Json out = Json::object();
    for (const auto& [name, is] : value) out[name] = std::visit([](const auto& v) { return tree_of(v); }, is);
    return out;
  } else if constexpr (is_list_of_values<T>) {
    Json out = Json::array();
    for (const auto& one : value) out.push_back(tree_of(one));
    return out;
  } else {
    return value;
  }
}

void keep(const ::fit::Fact& fact, Report& report) {
  report.keep(fact.name, std::visit([](const auto& value) { return tree_of(value); }, fact.value));
}

std::string line_of(const Estimate& e, double confidence) {
  const Coefficient& c = e.coefficient;
  const auto& [low, high] = c.interval;
  const std::string interval = fmt::format("{:g} % interval {:.5g} to {:.5g}", 100 * confidence, low, high);
  if (c.value)
    return fmt::format("  {:<10} {:.5g}{}{}, {}{}", c.name, *c.value, e.unit.empty() ? "" : " ", e.unit, interval,
                       e.more);
  return fmt::format("  {:<10} not identifiable: {}{}{}", c.name, c.why_not,
                     std::isfinite(high - low) ? "; " + interval : "", e.more);
}

Report told(const Estimate& e, double confidence) {
  Report out;
  if (!e.in_words) out.say("{}", line_of(e, confidence));
  if (e.profile)
    out.say("  {:<10} by profile likelihood {:.5g} to {:.5g}", e.coefficient.name, e.profile->low, e.profile->high);
  for (const ::fit::Fact& fact : facts_of(e)) keep(fact, out);
  return out;
}

}  // namespace

Report told(const ::fit::Report& fit, double confidence) {
  Report out, estimates;
  if (!fit.heading.empty()) out.say("{}", fit.heading);
  for (const ::fit::Fact& fact : fit.facts) keep(fact, out);
  for (const Estimate& e : fit.estimates)
    estimates.part(e.key.empty() ? e.coefficient.name : e.key, told(e, confidence));
  out.part(fit.group, estimates);
  for (const std::string& remark : fit.remarks) out.say("  {}", remark);
  if (fit.refused && !fit.refused->best_point.empty())
    out.say("  best point found, not accepted: {}", fmt::join(fit.refused->best_point, ", "));
  if (fit.steps) out.sentences("steps", "  {}", *fit.steps);
  if (fit.steps || !fit.cautions.empty()) out.sentences("cautions", "  caution: {}", fit.cautions);
  for (const ::fit::Report& part : fit.parts)
    if (part.one_of_many)
      out.one_of(part.key, told(part, confidence));
    else
      out.part(part.key, told(part, confidence));
  return out;
}

Json facts_of_fit(const ::fit::Report& fit, double confidence) { return told(fit, confidence).tree(); }

}  // namespace froude
