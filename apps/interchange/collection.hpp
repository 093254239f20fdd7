#pragma once
/// \file  Private to interchange: a collection of grids over instants, as ParaView opens it.
#include <filesystem>
#include <string>
#include <vector>

#include "interchange/grid.hpp"
#include "interchange/vtk.hpp"

namespace froude::interchange {

/// What is drawn as one kind of cell, with its values at any frame.
class Part {
 public:
  virtual ~Part() = default;
  virtual std::string name() const = 0;
  virtual std::vector<std::string> names() const { return {}; }  ///< of what its cells are numbered by, from 1
  virtual Grid at(std::size_t frame) const = 0;
};

/// One .vtu for each part and frame in folder_of_instants(), names.csv of all numbers, and the collection last. `time`:
/// of the frames, s. \throws hydro::InputError if they cannot be written
VtkFiles write_collection(const std::filesystem::path& collection, const std::vector<const Part*>& parts,
                          const std::vector<double>& time);

}  // namespace froude::interchange
