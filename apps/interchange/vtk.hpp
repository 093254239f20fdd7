#pragma once
/// \file  Runs and fields in space for ParaView and other programs that read VTK's XML files.
#include <cstddef>
#include <filesystem>
#include <vector>

#include "view/view.hpp"

namespace froude::interchange {

/// What write_vtk() has written.
struct VtkFiles {
  std::size_t files = 0;
  double megabytes = 0;
};

/// The folder beside a collection that holds its instants: "run_vtk" of "run.pvd".
std::filesystem::path folder_of_instants(const std::filesystem::path& collection);

/// A collection (.pvd) of one unstructured grid (.vtu) for each frame and each of: bodies, as triangles with the number
/// of their body; lines, as pieces with the number of their line and their tension, N, where it is known; the surface
/// of the waves over the surroundings, with its elevation, m. Numbers are of single precision, base64. `time`: of the
/// frames, s. names.csv in the folder has
/// the names of bodies and lines by these numbers. The collection is written last; files in its folder that are of
/// other collections stay. \throws hydro::InputError if they cannot be written
VtkFiles write_vtk(const std::filesystem::path& collection, const view::View& view, const std::vector<double>& time);

/// The same of a result of `froude field`, over `instants` of one period of the wave, of unit amplitude: its surface
/// with its elevation and amplitude, m/m, without cells that have a corner where nothing is told; and where the result
/// has pressures the hulls, as triangles, with the number of their body, dynamic pressure at the instant, its
/// amplitude, and the change of hydrostatic pressure, Pa/m. The hulls stand where they are at rest. \throws
/// hydro::InputError if `result` is none of a field, or files cannot be written
VtkFiles write_field_vtk(const std::filesystem::path& collection, const std::filesystem::path& result,
                         std::size_t instants);

}  // namespace froude::interchange
