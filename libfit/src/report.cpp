#include "fit/report.hpp"

#include <algorithm>
#include <iterator>

namespace fit {

void append(Facts& facts, Facts more) {
  facts.insert(facts.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

const FactValue* find(const Facts& facts, std::string_view name) {
  const auto at = std::find_if(facts.begin(), facts.end(), [&](const Fact& fact) { return fact.name == name; });
  return at == facts.end() ? nullptr : &at->value;
}

Facts facts_of(const Estimate& estimate) {
  const Coefficient& c = estimate.coefficient;
  Facts out{{"identifiable", c.value.has_value()},
            {"standard_error", c.standard_error},
            {"systematic_error", c.systematic_error},
            {"interval", c.interval}};
  if (c.effective_samples > 0)
    append(out, {{"interval_if_independent", c.white_interval}, {"effective_samples", c.effective_samples}});
  if (c.shift_per_degree != 0) out.emplace_back("shift_per_degree", c.shift_per_degree);
  if (c.value) out.emplace_back("value", *c.value);
  if (!c.why_not.empty()) out.emplace_back("why_not", c.why_not);
  if (estimate.profile) out.emplace_back("profile_interval", *estimate.profile);
  append(out, estimate.facts);
  return out;
}

const Estimate* Report::find(std::string_view coefficient) const {
  for (const Estimate& e : estimates)
    if (e.coefficient.name == coefficient) return &e;
  for (const Report& part : parts)
    if (const Estimate* found = part.find(coefficient)) return found;
  return nullptr;
}

}  // namespace fit
