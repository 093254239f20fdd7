#include "hydro/waves/synthesis/field_choice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "hydro/waves/synthesis/summed_field.hpp"
#include "synth_band.hpp"
#include "synth_table_cost.hpp"

namespace hydro::waves {
namespace {

constexpr double impossible = std::numeric_limits<double>::infinity();

// Seconds, fitted to docs/cost/synthesis.md; only their ratios matter.
double expected_sum(const HarmonicField& field, const FieldUse& use, bool vectors) {
  const auto waves = static_cast<double>(field.harmonics().size());
  const double each = vectors ? (use.elevation_only ? 0.95e-9 : 4e-9) : (use.elevation_only ? 1.5e-8 : 7e-8);
  return use.instants * waves * (0.4e-9 + use.points * each) + use.instants * 1e-7;
}

double expected_table(const HarmonicField& field, const FieldUse& use) {
  const TabulatedField::Options options{use.tolerance, use.largest_bytes, use.elevation_only};
  const auto waves = static_cast<double>(field.harmonics().size());
  const BinBand band = band_of(field);
  double bytes;
  try {
    bytes = TabulatedField::expected_bytes(field, use.box, options);
  } catch (const InputError&) {
    return impossible;  // too many levels, or too small a tolerance
  }
  if (bytes > static_cast<double>(use.largest_bytes)) return impossible;
  const double values = bytes / 8;
  const double samples = (use.box.end_s - use.box.start_s) * band.omega * 0.64 + 16, signals = values / samples;
  const double build = values * 2.5e-8 + signals * waves * std::min(table::by_product(samples), table::by_transform);
  const double rows = band.long_crested ? 1 : 16, levels = use.elevation_only ? 0 : 2.5;  // in packs
  const double one = 1e-7 + rows * 4e-8 + rows * levels * (use.points * rows > 20 ? 8e-8 : 3e-7);
  return build + use.instants * use.points * one;
}

std::array<double, 3> costs(const HarmonicField& field, const FieldUse& use) {
  require_box(use.box, field.water().depth.metres());
  require(use.instants > 0 && use.points > 0, "a field is asked at some instants and points, got {} and {}",
          use.instants, use.points);
  return {expected_sum(field, use, false), expected_sum(field, use, true), expected_table(field, use)};
}

FieldMethod least(const std::array<double, 3>& cost) {
  return static_cast<FieldMethod>(std::min_element(cost.begin(), cost.end()) - cost.begin());
}

// (W92), with the rounding of κ|x|, as a relative error of each component.
FieldError summed_bound(const HarmonicField& field, const FieldUse& use) {
  const BinBand band = band_of(field);
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  const double reach = std::hypot(std::max(std::abs(use.box.low.x()), std::abs(use.box.high.x())),
                                  std::max(std::abs(use.box.low.y()), std::abs(use.box.high.y())));
  const double relative =
      epsilon * (static_cast<double>(field.harmonics().size()) + 16) + 2 * epsilon * band.kappa * reach;
  if (use.elevation_only) return elevation_bound(field, relative);
  const double crest = sum_of(field, &Harmonic::elevation);
  return bounds(field, band, profile_heights(field, use.box, crest, band.kappa).second, relative, use.box, crest);
}

}  // namespace

std::string_view name_of(FieldMethod method) {
  constexpr std::array<std::string_view, 3> names{"sum of harmonics", "vectorised sum", "table"};
  return names[static_cast<std::size_t>(method)];
}

FieldMethod cheapest_method(const HarmonicField& field, const FieldUse& use) { return least(costs(field, use)); }

ChosenField choose_field(const HarmonicField& field, const FieldUse& use, std::optional<FieldMethod> asked) {
  const auto cost = costs(field, use);
  const FieldMethod method = asked.value_or(least(cost));
  const double expected = cost[static_cast<std::size_t>(method)];
  if (method == FieldMethod::table) {
    auto table = std::make_unique<TabulatedField>(
        field, use.box, TabulatedField::Options{use.tolerance, use.largest_bytes, use.elevation_only});
    const FieldError bound = table->error_bound();
    return {std::move(table), method, bound, expected};
  }
  if (method == FieldMethod::vector_sum)
    return {std::make_unique<SummedField>(field), method, summed_bound(field, use), expected};
  return {std::make_unique<HarmonicField>(field), method, summed_bound(field, use), expected};
}

}  // namespace hydro::waves
