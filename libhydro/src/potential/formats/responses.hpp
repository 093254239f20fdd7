#pragma once
/// \file  Private: the readers behind read_rao and read_drift.
#include "hydro/potential/formats/responses.hpp"

namespace hydro::potential {

RaoTable read_wamit_rao(const std::filesystem::path& path, const ReadOptions& options);
DriftForces read_wamit_drift(const std::filesystem::path& path, const ReadOptions& options);
RaoTable read_veres_rao(const std::filesystem::path& path);       ///< .re1
DriftForces read_veres_drift(const std::filesystem::path& path);  ///< .re2

}  // namespace hydro::potential
