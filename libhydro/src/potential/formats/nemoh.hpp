#pragma once
/// \file  Private: the parts of the NEMOH reader.
#include <Eigen/Core>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hydro/potential/coefficients.hpp"
#include "text_lines.hpp"

namespace hydro::potential {

/// What Nemoh.cal says of the case.
struct NemohCase {
  std::filesystem::path folder;
  Water water;
  Eigen::Vector2d wave_origin;                   ///< XEFF, YEFF: where the phase of the incident wave is zero, m
  std::vector<Eigen::Vector3d> reference_point;  ///< of each body: the point that its rotations and moments name
  int headings = 0;
};

/// \throws InputError with file and line: a body without the six rigid modes in their order, about one point, or with
/// loads that are not those six
NemohCase read_nemoh_case(const std::filesystem::path& cal);

/// One zone of a Tecplot file of results: rows `frequency value value …` under one title.
struct NemohZone {
  std::string title;
  int title_line;
  std::vector<int> line;                   ///< of each row
  std::vector<std::vector<double>> value;  ///< without the frequency
};

/// A file of results: every zone has the same frequencies, ω in rad/s, in the order of the file.
struct NemohTable {
  TextLines text;
  std::vector<double> omega;
  std::vector<NemohZone> zone;
};

/// Frequencies are rad/s, Hz or periods as the header says; a header of dots (Capytaine's writer) stands for rad/s.
/// \throws InputError with the line: rows of another length, zones of different frequencies or fewer rows than they
/// announce
NemohTable read_nemoh_table(const std::filesystem::path& path, std::size_t values_in_row);

/// The file of this name in one of the folders, or an empty path. Names are taken in any case.
std::filesystem::path find_nemoh_file(const NemohCase& nemoh, const std::vector<const char*>& folders,
                                      const std::string& name);

/// Centres, volumes and C from Mesh/Hydrostatics*.dat and Mesh/KH*.dat, where there are any.
void fill_nemoh_hydrostatics(Coefficients& c, const NemohCase& nemoh);

}  // namespace hydro::potential
