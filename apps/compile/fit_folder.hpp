#pragma once
/// \file  Private to apps: fitted poles that outlive the program, in a folder of files.
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "compile/kept.hpp"

namespace froude::compile {

/// Fits of radiation memory by what they were fitted to. An entry holds all of its data, which are compared number by
/// number, and what says which program fitted them; an entry that was cut short, written over or made by another
/// program is as good as none. Entries are put there whole, so that programs may use one folder at once. A folder that
/// cannot be read or written holds nothing: no call throws for it.
class FitFolder {
 public:
  static constexpr std::uintmax_t usual_bytes = std::uintmax_t{256} << 20U;

  /// Nothing is made or opened yet. `most_bytes`: of all entries together; those longest unused make room.
  explicit FitFolder(std::filesystem::path folder, std::uintmax_t most_bytes = usual_bytes)
      : folder_(std::move(folder)), most_bytes_(most_bytes) {}

  const std::filesystem::path& path() const { return folder_; }
  /// The fit of these data to this tolerance, to the bit as it was kept.
  std::optional<hydro::radiation::RationalFit> find(const SymmetricData& data, double tolerance) const;
  void keep(const SymmetricData& data, double tolerance, const hydro::radiation::RationalFit& fit) const;

 private:
  std::filesystem::path file_of(const std::string& key) const;
  void make_room() const;

  std::filesystem::path folder_;
  std::uintmax_t most_bytes_;
};

/// That of this process; none until it is set.
std::optional<FitFolder> fit_folder();
void set_fit_folder(std::optional<FitFolder> folder);

}  // namespace froude::compile
