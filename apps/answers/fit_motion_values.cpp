#include "answers/fit_motion_values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iterator>
#include <optional>

#include "hydro/base/error.hpp"
#include "hydro/base/units.hpp"
#include "hydro/io/atomic_file.hpp"
#include "scene/document.hpp"
#include "scene/placed.hpp"

namespace froude::scene {
namespace {

using ::fit::motion::Parameter;
using hydro::InputError;

/// A table [parameter.name] of a fit.
struct WrittenParameter {
  std::string key, record, unit;
  std::optional<double> value;
  hydro::Place place;
};

std::string text_of(const Node& table, const char* key) {
  const auto* entry = table.find(key);
  return entry == nullptr ? std::string() : entry->value.text;
}

std::vector<WrittenParameter> parameters_of(const std::filesystem::path& file) {
  const Node root = parse_document(hydro::io::read_text(file), file.string());
  const auto* tables = root.find("parameter");
  if (tables == nullptr || !tables->value.is(Node::Type::table))
    throw InputError("this file has no tables [parameter.…]", {.file = file.string()},
                     "name what `froude fit -o` wrote of a fit of kind \"motion\"");
  std::vector<WrittenParameter> out;
  for (const auto& [name, place, table] : tables->value.entries) {
    WrittenParameter one{text_of(table, "key"), text_of(table, "record"), text_of(table, "unit"), {}, table.place};
    if (const auto* value = table.find("value")) one.value = value->value.number;
    out.push_back(std::move(one));
  }
  return out;
}

const WrittenParameter* find(const std::vector<WrittenParameter>& all, const Parameter& p) {
  for (const auto& one : all)
    if (one.record == p.record && one.key == (p.record.empty() ? p.number.name : p.path)) return &one;
  return nullptr;
}

/// In the unit of the scene.
double value_of(const WrittenParameter& written, const Parameter& p) {
  if (!written.value)
    throw InputError(fmt::format("\"{}\" has no value: the fit could not tell it", p.number.name), written.place,
                     "take it out of the parameters, so that the scene's own number is used");
  return placed(written.place, [&] {
    const hydro::Unit has = hydro::parse_unit(written.unit), needs = hydro::parse_unit(p.unit);
    hydro::require(hydro::compatible(has.dimension, needs.dimension), "\"{}\" is in {}, and in {} in the scene",
                   p.number.name, written.unit, p.unit);
    return *written.value * has.factor / needs.factor;
  });
}

}  // namespace

GivenValues first_values(const ::fit::motion::Problem& problem) {
  GivenValues out{Eigen::VectorXd(std::ssize(problem.parameters)), {}};
  for (const Parameter& p : problem.parameters) {
    out.at[std::ssize(out.from)] = p.number.first;
    out.from.emplace_back("where a fit would begin");
  }
  return out;
}

GivenValues values_of_fit(const ::fit::motion::Problem& problem, const std::filesystem::path& file) {
  const std::vector<WrittenParameter> written = parameters_of(file);
  GivenValues out = first_values(problem);
  for (std::size_t k = 0; k < problem.parameters.size(); ++k) {
    const Parameter& p = problem.parameters[k];
    const WrittenParameter* one = find(written, p);
    if (one == nullptr && !p.record.empty()) continue;  // of a record that the fit did not have
    if (one == nullptr) {
      std::vector<std::string> keys;
      for (const auto& w : written) keys.push_back(w.key);
      throw InputError(fmt::format("this fit has no \"{}\"; it has {}", p.number.name, fmt::join(keys, ", ")),
                       {.file = file.string()}, "take it out of the parameters, or name another fit");
    }
    out.at[static_cast<Eigen::Index>(k)] = value_of(*one, p);
    out.from[k] = file.filename().string();
  }
  return out;
}

}  // namespace froude::scene
