#pragma once
/// \file  A folder in which a test's process keeps what is dear to make.
#include <filesystem>

#include "froude/kept_fits.hpp"

namespace support {

/// That is the folder of the process while it lives.
struct KeptFolder {
  explicit KeptFolder(const std::filesystem::path& path) { froude::keep_fits_in(path); }
  ~KeptFolder() { froude::keep_fits_in({}); }
  KeptFolder(const KeptFolder&) = delete;
  KeptFolder& operator=(const KeptFolder&) = delete;
};

}  // namespace support
