#pragma once
/// \file  Where outside reference data lie; tests skip when they are absent.
#include <cstdlib>
#include <filesystem>
#include <string>

#include "support/source_dir.hpp"

namespace froude_test {

/// The file below FROUDE_REFERENCE_DATA, or below ../shared/data beside the project. It may not exist.
inline std::filesystem::path reference_data(const std::string& relative) {
  const char* folder = std::getenv("FROUDE_REFERENCE_DATA");
  return (folder != nullptr ? std::filesystem::path(folder) : source_dir() / "../shared/data") / relative;
}

}  // namespace froude_test

/// Use at the start of a test: defines the path `name`, or skips.
#define FROUDE_REQUIRE_DATA(name, relative)                                 \
  const std::filesystem::path name = froude_test::reference_data(relative); \
  if (!std::filesystem::exists(name)) GTEST_SKIP() << "skipped, no data: " << name
