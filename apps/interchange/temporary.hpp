#pragma once
/// \file  A folder for a library that writes files of its own.
#include <stdlib.h>

#include <cerrno>
#include <filesystem>
#include <string>
#include <system_error>

#include "hydro/base/error.hpp"

namespace froude::interchange {

/// Made among the system's temporary files, and removed with all that is in it.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "froude.XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr)
      throw hydro::InputError("cannot make a folder for temporary files: " + std::generic_category().message(errno),
                              {.file = name}, "TMPDIR names another folder");
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code failed;
    std::filesystem::remove_all(path_, failed);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace froude::interchange
