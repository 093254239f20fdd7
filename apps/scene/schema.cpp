#include "scene/schema.hpp"

#include <utility>

#include "hydro/base/types.hpp"

namespace froude::scene {

namespace dim = hydro::dim;

Key text(std::string name, std::string meaning) {
  return {.name = std::move(name), .holds = Holds::text, .meaning = std::move(meaning)};
}
Key name_key(std::string fallback, std::string meaning) {
  Key key{.name = "name", .holds = Holds::name, .meaning = std::move(meaning)};
  if (!fallback.empty())
    key.or_default(std::move(fallback), "with a number, counted over the file, to tell them apart");
  return key;
}
Key texts(std::string name, std::string meaning) {
  return {.name = std::move(name), .holds = Holds::texts, .meaning = std::move(meaning)};
}
Key modes(std::string name, std::string meaning) {
  return texts(std::move(name), std::move(meaning)).one_of({hydro::mode_names.begin(), hydro::mode_names.end()});
}
Key number(std::string name, std::string meaning) {
  return {.name = std::move(name), .holds = Holds::number, .meaning = std::move(meaning)};
}
Key integer(std::string name, std::string meaning) {
  return {.name = std::move(name), .holds = Holds::integer, .meaning = std::move(meaning)};
}
Key effect(std::string name, std::string meaning) {
  Key key{.name = std::move(name), .holds = Holds::effect, .meaning = std::move(meaning)};
  return key.optional();
}
Key quantity(std::string name, const hydro::Dimension& dimension, std::string meaning) {
  return {.name = std::move(name), .holds = Holds::quantity, .dimension = dimension, .meaning = std::move(meaning)};
}
Key positive(std::string name, const hydro::Dimension& dimension, std::string meaning) {
  return quantity(std::move(name), dimension, std::move(meaning)).positive();
}
Key vector(std::string name, const hydro::Dimension& dimension, std::string meaning) {
  return {.name = std::move(name), .holds = Holds::vector, .dimension = dimension, .meaning = std::move(meaning)};
}
Key points(std::string name, std::string meaning) {
  return {.name = std::move(name), .holds = Holds::points, .dimension = dim::length, .meaning = std::move(meaning)};
}
Key ends(std::string name, std::string meaning) {
  return {.name = std::move(name), .holds = Holds::ends, .dimension = dim::length, .meaning = std::move(meaning)};
}
Key direction(std::string name, std::string meaning) {
  return {.name = std::move(name), .holds = Holds::direction, .meaning = std::move(meaning), .words = {"x", "y", "z"}};
}
Key range(std::string name, const hydro::Dimension& dimension, std::string meaning) {
  return {.name = std::move(name), .holds = Holds::range, .dimension = dimension, .meaning = std::move(meaning)};
}
Key values(std::string name, const hydro::Dimension& dimension, std::string meaning) {
  return {.name = std::move(name), .holds = Holds::values, .dimension = dimension, .meaning = std::move(meaning)};
}
Key scalars(std::string name, std::string meaning) {
  return {.name = std::move(name), .holds = Holds::scalars, .meaning = std::move(meaning)};
}
Key inner_table(std::string name, const Table& inner) {
  return {.name = std::move(name), .holds = Holds::table, .meaning = inner.meaning, .inner = &inner};
}
Key inner_tables(std::string name, const Table& inner) {
  return {.name = std::move(name), .holds = Holds::tables, .meaning = inner.meaning, .inner = &inner};
}

std::string si_unit(const hydro::Dimension& dimension) {
  const std::pair<hydro::Dimension, const char*> usual[] = {
      {dim::stiffness, "N/m"},
      {dim::damping, "N s/m"},
      {dim::force, "N"},
      {dim::moment, "N m"},
      {dim::pressure, "Pa"},
      {dim::rotational_stiffness, "N m/rad"},
      {dim::force / dim::angle, "N/rad"},
      {dim::inertia, "kg m^2"},
      {dim::rotational_damping, "N m s/rad"},
      {dim::force / dim::angular_velocity, "N s/rad"},
      {dim::stiffness / dim::area, "N/m^3"},
      {dim::rotational_stiffness / (dim::angle * dim::angle), "N m/rad^3"},
      {dim::moment / (dim::angular_velocity * dim::angular_velocity), "N m s^2/rad^2"}};
  for (const auto& [known, unit] : usual)
    if (known == dimension) return unit;
  return dimension.si();
}

std::string_view rule_of(Limit limit) {
  switch (limit) {
    case Limit::none:
      return "";
    case Limit::positive:
      return "must be positive";
    case Limit::not_negative:
      return "must not be negative";
    case Limit::at_least_one:
      return "must be at least 1";
    case Limit::fraction:
      return "must lie from 0 to 1";
    case Limit::open_fraction:
      return "must lie between 0 and 1";
  }
  return "";
}

bool keeps(Limit limit, double value) {
  switch (limit) {
    case Limit::none:
      return true;
    case Limit::positive:
      return value > 0;
    case Limit::not_negative:
      return value >= 0;
    case Limit::at_least_one:
      return value >= 1;
    case Limit::fraction:
      return value >= 0 && value <= 1;
    case Limit::open_fraction:
      return value > 0 && value < 1;
  }
  return false;
}

}  // namespace froude::scene
