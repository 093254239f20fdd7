// One reader under libFuzzer, named by FROUDE_FUZZ_READER when this file is compiled.
#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>

#include "container.hpp"
#include "hydro/base/units.hpp"
#include "hydro/hydrostatics/mesh.hpp"
#include "hydro/io/csv.hpp"
#include "hydro/potential/coefficients.hpp"
#include "support/fuzz_entry.hpp"

namespace {

using namespace froude_fuzz;

void require_finite(bool finite, const char* what) {
  if (!finite) throw std::logic_error(std::string(what) + " is not finite, and was not refused");
}

[[maybe_unused]] void units(std::string_view text) {
  const std::string_view line = text.substr(0, text.find('\n'));
  const auto quantity = [&] { require_finite(std::isfinite(hydro::parse_quantity(line).si), "a quantity"); };
  const auto vectors = [&] {
    for (const auto& v : hydro::parse_vectors(line, hydro::dim::length)) require_finite(v.allFinite(), "a vector");
  };
  const auto range = [&] { (void)hydro::parse_range(line, hydro::dim::time); };
  const auto tried = [](const auto& parse) {
    try {
      parse();
    } catch (const hydro::InputError&) {
    }
  };
  tried(quantity), tried(vectors), tried(range);
}

[[maybe_unused]] void csv(std::string_view text) {
  const auto table = hydro::io::CsvTable::parse(text, "table.csv");
  for (const std::string& name : table.names())
    if (!table.is_text(name))
      for (const double value : table.column(name)) require_finite(std::isfinite(value), "a cell");
}

[[maybe_unused]] void mesh(std::string_view bytes) {
  // The first byte tells the format, which in files the ending of the name tells.
  constexpr const char* names[] = {"x.stl", "x.obj", "x.gdf"};
  if (bytes.empty()) return;
  const auto format = static_cast<unsigned char>(bytes.front()) % std::size(names);
  const auto mesh = hydro::hydrostatics::parse_mesh(bytes.substr(1), names[format]);
  for (const auto& corner : mesh.vertices) require_finite(corner.allFinite(), "a corner");
}

/// Files of coefficients; what is read is checked by the reader itself.
[[maybe_unused]] void coefficients(std::string_view bytes) {
  hydro::potential::ReadOptions options{.density = 1025, .gravity = 9.81, .depth = hydro::WaterDepth::from_metres(60)};
  const Unpacked files(bytes);
  (void)hydro::potential::read(files.first(), options);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return give(FROUDE_FUZZ_READER, data, size);
}
