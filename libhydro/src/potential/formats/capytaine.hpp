#pragma once
/// \file  Private: how Capytaine names degrees of freedom.
#include <filesystem>
#include <string>
#include <vector>

namespace hydro::potential {

/// Bodies in the order of their first appearance, and where each of the 6N modes stands in the file's list.
struct CapytaineDofs {
  std::vector<std::string> body;           ///< "" for the one body of labels without a prefix
  std::vector<std::size_t> index_in_file;  ///< of surge, sway, … yaw of each body in turn
};

/// Reads labels `Heave` or `<body>__Heave`, in any case.
/// \throws InputError for a label that is no rigid-body mode, one that is there twice, or a mode that is missing
CapytaineDofs order_dofs(const std::vector<std::string>& labels, const std::filesystem::path& file,
                         const std::string& axis);

}  // namespace hydro::potential
