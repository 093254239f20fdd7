#pragma once
/// \file  A place for the files of a test: tests run side by side, each in a process of its own.
#include <unistd.h>

#include <filesystem>
#include <string>

namespace support {

/// A folder of this process alone, gone when it ends.
inline const std::filesystem::path& scratch_folder() {
  struct Folder {
    std::filesystem::path path = std::filesystem::temp_directory_path() / ("froude_test_" + std::to_string(::getpid()));
    Folder() { std::filesystem::create_directories(path); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    ~Folder() {
      std::error_code left;
      std::filesystem::remove_all(path, left);
    }
  };
  static const Folder folder;
  return folder.path;
}

}  // namespace support
