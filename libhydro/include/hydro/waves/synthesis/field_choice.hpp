#pragma once
/// \file  The cheapest way to evaluate a sum of harmonics, for a stated use.
#include <memory>
#include <optional>
#include <string_view>

#include "hydro/waves/synthesis/tabulated_field.hpp"

namespace hydro::waves {

enum class FieldMethod {
  harmonics,   ///< HarmonicField: standard functions, one wave after the other; the reference
  vector_sum,  ///< SummedField: the same sum, eight waves at a time
  table        ///< TabulatedField
};
std::string_view name_of(FieldMethod method);

/// What a field will be asked. The box bounds where the points may go; leaving it is an error with a table only.
struct FieldUse {
  FieldBox box;
  double instants, points;      ///< instants at which it is asked, and points at each
  bool elevation_only = false;  ///< nobody will ask for velocities
  double tolerance = 1e-10;     ///< of each component, as in TabulatedField::Options
  std::size_t largest_bytes = std::size_t{2} << 30;
};

struct ChosenField {
  std::unique_ptr<const WaveField> field;
  FieldMethod method;
  FieldError error_bound;
  double expected_s;  ///< by the cost model, building included, for one core of about 2022
};

/// That with the least expected time. A table that would not fit into the memory allowed, or whose tolerance cannot be
/// reached, is passed over. \throws InputError if the use is not sensible
FieldMethod cheapest_method(const HarmonicField& field, const FieldUse& use);

/// Takes cheapest_method(), or the one asked for. \throws InputError if the use is not sensible, or what TabulatedField
/// throws if a table was asked for
ChosenField choose_field(const HarmonicField& field, const FieldUse& use, std::optional<FieldMethod> method = {});

}  // namespace hydro::waves
