#pragma once
/// \file  What a table must resolve: frequencies, wavenumbers, heights; and what its error comes to (W96), (W98).
#include <utility>

#include "hydro/waves/synthesis/tabulated_field.hpp"
#include "synth_chebyshev.hpp"

namespace hydro::waves {

/// Largest frequency and wavenumber of a field, and the one direction of its waves if they have one.
struct BinBand {
  double omega = 0, kappa = 0;
  bool long_crested = true;
  Eigen::Vector2d along{1, 0};
};
BinBand band_of(const HarmonicField& field);

/// \throws InputError if the box is empty, not finite or reaches below the bed
void require_box(const FieldBox& box, double depth);

/// Σ|E| or Σ|Φ|, and the standard deviation of the elevation, m.
double sum_of(const HarmonicField& field, std::complex<double> Harmonic::*member);
double rms_elevation(const HarmonicField& field);

/// Polynomials for all heights at which the profile may be read for points in the box, when no crest is higher than
/// `crest`.
VerticalBasis vertical_basis(const HarmonicField& field, const FieldBox& box, const BinBand& band, double crest,
                             double tolerance);

/// Bounds of a field whose components have this relative error. The first leaves all but the elevation NaN.
FieldError elevation_bound(const HarmonicField& field, double relative);
FieldError bounds(const HarmonicField& field, const BinBand& band, double top, double relative, const FieldBox& box,
                  double crest);

/// Heights [bottom, top] of vertical_basis.
std::pair<double, double> profile_heights(const HarmonicField& field, const FieldBox& box, double crest, double kappa);

}  // namespace hydro::waves
