#include "responses.hpp"

#include <cmath>
#include <cstdlib>

#include "hydro/base/error.hpp"

namespace hydro::potential {
namespace {

namespace fs = std::filesystem;

/// Bodies move with long waves: up with the surface, and along β a quarter of a period later (P25).
/// \throws InputError if they go the other way
void require_our_time_factor(const RaoTable& rao, const fs::path& path) {
  double sum = 0;
  for (std::size_t h = 0; h < rao.heading.size(); ++h) {
    double along = 0;
    for (std::size_t i = 0; i < rao.mode.size(); ++i) {
      const std::complex<double> motion = rao.motion[h](static_cast<Eigen::Index>(i), 0);
      const int kind = rao.mode[i] % 6;
      constexpr double with_the_water = 0.25;  // as for loads (P21)
      if (kind == 2 && std::abs(motion - 1.0) > with_the_water) return;
      if (kind == 0) along += motion.imag() * std::cos(rao.heading[h]);
      if (kind == 1) along += motion.imag() * std::sin(rao.heading[h]);
    }
    constexpr double rounding = 1e-3;  // of the wave's amplitude: across the modes that are given nothing moves
    if (along < -rounding) return;     // a time factor turns the motions of every heading round
    sum += along;
  }
  if (sum <= 0) return;
  throw InputError(
      "the phases are of the other time factor, or headings are where waves come from: in the longest waves the bodies "
      "move against the water",
      {.file = path.string()}, "write the motions for e^(+iωt) and headings as where waves go, as WAMIT does");
}

void refuse_wamit_options(const ReadOptions& options, const fs::path& path) {
  if (options.ulen || options.iperout)
    throw InputError("ULEN and IPEROUT belong to files of WAMIT; this is one of VERES", {.file = path.string()},
                     "leave them out");
}

}  // namespace

ResponseKind response_kind(const fs::path& path) {
  const std::string extension = path.extension().string();
  if (extension == ".4" || extension == ".re1") return ResponseKind::rao;
  if (extension == ".7" || extension == ".8" || extension == ".9" || extension == ".re2") return ResponseKind::drift;
  for (const char* quadratic : {".10d", ".10s", ".11d", ".11s", ".12d", ".12s"})
    if (extension == quadratic) return ResponseKind::quadratic;
  return ResponseKind::none;
}

RaoTable read_rao(const fs::path& path, const ReadOptions& options) {
  if (response_kind(path) != ResponseKind::rao)
    throw InputError("not a file of motions", {.file = path.string()},
                     "give a .4 file of WAMIT or a .re1 file of VERES");
  const bool is_veres = path.extension() == ".re1";
  if (is_veres) refuse_wamit_options(options, path);
  RaoTable rao = is_veres ? read_veres_rao(path) : read_wamit_rao(path, options);
  require_our_time_factor(rao, path);
  return rao;
}

DriftForces read_drift(const fs::path& path, const ReadOptions& options) {
  if (response_kind(path) != ResponseKind::drift)
    throw InputError("not a file of mean drift", {.file = path.string()},
                     "give a .7, .8 or .9 file of WAMIT or a .re2 file of VERES");
  if (path.extension() != ".re2") return read_wamit_drift(path, options);
  refuse_wamit_options(options, path);
  return read_veres_drift(path);
}

}  // namespace hydro::potential
