#pragma once
/// \file  Every kind of spectrum and spreading that a scene may name, declared once: its keys, and what is made of
/// them. Private to apps/scene.
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "hydro/waves/spectra/spectrum.hpp"
#include "hydro/waves/spectra/spreading.hpp"
#include "scene/record.hpp"

namespace froude::scene {

struct SpectrumKind {
  Table::Variant keys;
  std::function<std::shared_ptr<const hydro::waves::Spectrum>(const Record& sea, const Scene& scene)> build;
};
/// In the order of the reference. A further kind is a line here.
const std::vector<SpectrumKind>& spectra();
const SpectrumKind& spectrum_kind(const std::string& word);

struct SpreadingKind {
  Table::Variant keys;
  std::function<std::shared_ptr<const hydro::waves::Spreading>(const Record& spreading,
                                                               const hydro::waves::Spectrum& spectrum)>
      build;
};
const std::vector<SpreadingKind>& spreadings();
const SpreadingKind& spreading_kind(const std::string& word);

}  // namespace froude::scene
