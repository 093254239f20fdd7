#pragma once
/// \file  Spectra that somebody measured or computed: tables of S over ω, and the estimate from a record (W40).
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "hydro/signal/welch.hpp"
#include "hydro/waves/spectra/spectrum.hpp"

namespace hydro::waves {

/// Straight lines between the points of a table; moments are those of the lines, exact but for rounding. S = 0 below
/// the first point. Beyond the last S = 0 too, unless a tail is asked for: S(ω_last) (ω_last/ω)^p.
class TabulatedSpectrum final : public PanelSpectrum {
 public:
  /// \param omega       rad/s, increasing, >= 0, at least two
  /// \param density     m² s/rad, >= 0, as many; not all zero
  /// \param tail_power  p > 1 of the tail beyond the last point
  /// \throws InputError naming the first point that is wrong
  TabulatedSpectrum(std::vector<double> omega, std::vector<double> density, std::optional<double> tail_power = {});

  /// From a CSV file with a column "frequency" or "omega" (Hz or rad/s) and a column "density" (m^2/Hz or m^2 s/rad,
  /// …): the units in the header decide, and nothing is off by 2π. \throws InputError with line and column
  static TabulatedSpectrum read(const std::filesystem::path& csv, std::optional<double> tail_power = {});

  /// Welch's estimate from an evenly sampled elevation (m), cut to the band, without its point at zero frequency. The
  /// variance outside the band is left out. \throws InputError as signal::welch() and for a band with fewer than two
  /// points
  static TabulatedSpectrum of_record(std::span<const double> elevation, double step_s,
                                     const signal::WelchOptions& options, const signal::Band& band);

  double peak_omega() const override { return peak_omega_; }
  const std::vector<double>& omega() const noexcept { return omega_; }        ///< rad/s
  const std::vector<double>& densities() const noexcept { return density_; }  ///< m² s/rad

 private:
  double shape(double u) const override;
  std::vector<double> omega_, density_;
  double peak_omega_;
};

}  // namespace hydro::waves
