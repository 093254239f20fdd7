#pragma once
/// \file  Private to apps: fitted poles that outlive the program, in a folder of files.
#include <cstdint>
#include <filesystem>
#include <optional>
#include <utility>

#include "compile/kept.hpp"
#include "compile/kept_files.hpp"

namespace froude::compile {

/// Fits of radiation memory by what they were fitted to and by which program, in files of a folder (KeptFiles).
class FitFolder {
 public:
  explicit FitFolder(std::filesystem::path folder, std::uintmax_t most_bytes = KeptFiles::usual_bytes)
      : files_(std::move(folder), most_bytes) {}

  const std::filesystem::path& path() const { return files_.path(); }
  /// What else is kept in that folder.
  const KeptFiles& files() const { return files_; }
  /// The fit of these data to this tolerance, to the bit as it was kept.
  std::optional<hydro::radiation::RationalFit> find(const SymmetricData& data, double tolerance) const;
  void keep(const SymmetricData& data, double tolerance, const hydro::radiation::RationalFit& fit) const;

 private:
  KeptFiles files_;
};

/// That of this process; none until it is set.
std::optional<FitFolder> fit_folder();
void set_fit_folder(std::optional<FitFolder> folder);

}  // namespace froude::compile
