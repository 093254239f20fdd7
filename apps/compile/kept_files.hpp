#pragma once
/// \file  Private to apps: answers that outlive the program, in a folder of files.
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace froude::compile {

/// Answers by all that decides on every bit of them. An entry holds the whole of that, which is compared byte by byte;
/// an entry that was cut short or written over is as good as none. Entries are put there whole, so that programs may
/// use one folder at once. A folder that cannot be read or written holds nothing: no call throws for it.
class KeptFiles {
 public:
  static constexpr std::uintmax_t usual_bytes = std::uintmax_t{256} << 20U;

  /// Nothing is made or opened yet. `most_bytes`: of all entries together; those longest unused make room.
  explicit KeptFiles(std::filesystem::path folder, std::uintmax_t most_bytes = usual_bytes)
      : folder_(std::move(folder)), most_bytes_(most_bytes) {}

  const std::filesystem::path& path() const { return folder_; }
  /// The bytes that were kept by this key in a file with this extension, one of ".fit" and ".coefficients".
  std::optional<std::string> find(const std::string& key, const char* extension) const;
  void keep(const std::string& key, const std::string& answer, const char* extension) const;

 private:
  std::filesystem::path file_of(const std::string& key, const char* extension) const;
  void make_room() const;

  std::filesystem::path folder_;
  std::uintmax_t most_bytes_;
};

/// What of this program and machine decides on bits: a digest of the sources that make an answer, the compiler, and the
/// instructions that kernels choose from.
std::string maker(const char* answer, const char* sources);

}  // namespace froude::compile
