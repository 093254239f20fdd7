#pragma once
/// \file  Coefficients put on disk in Froude's own format and in three that other programs read.
///
/// Every writer checks what it is given (Coefficients::validate), writes each file whole or not at all, and returns one
/// sentence for each thing that the format cannot carry or that had to be changed for it; nothing is lost in silence.
#include <filesystem>
#include <string>
#include <vector>

#include "hydro/potential/coefficients.hpp"

namespace hydro::potential {

/// Froude's own format: HDF5 that is also valid netCDF-4, everything in SI and in convention (P1)-(P3). Loses nothing:
/// reading gives back the same bits. The list returned is therefore always empty.
/// \throws InputError if the coefficients are not valid or the file cannot be written
std::vector<std::string> write_froude(const Coefficients& coefficients, const std::filesystem::path& path);

/// BEMIO .h5 for WEC-Sim and programs like it, normalised as (P10). BEMIO's coefficients are about the centre of
/// gravity: where the reference point is another one they are moved there by (P4), and a sentence says so. \throws
/// InputError as write_froude
std::vector<std::string> write_bemio(const Coefficients& coefficients, const std::filesystem::path& path);

/// netCDF-4 in the layout of Capytaine's datasets, e^{−iωt} (P7), limits as omega = 0 and inf: for programs that read
/// Capytaine, and for xarray. Bodies without a name of their own get one (and a sentence). \throws InputError as
/// write_froude
std::vector<std::string> write_capytaine(const Coefficients& coefficients, const std::filesystem::path& path);

/// WAMIT numeric files stem.1, stem.3 (if there is excitation) and stem.hst (if there is a restoring matrix), IPEROUT =
/// 1, no header line, 17 significant digits, normalised by (P8) with ULEN = `ulen` metres. \throws InputError as
/// write_froude, and if a file of the set stands there already that would not be replaced
std::vector<std::string> write_wamit(const Coefficients& coefficients, const std::filesystem::path& stem,
                                     double ulen = 1.0);

}  // namespace hydro::potential
