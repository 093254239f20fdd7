#pragma once
/// \file  Where outside reference data lie; tests skip when they are absent.
#include <cstdlib>
#include <filesystem>
#include <string>

namespace froude_test {

/// The file below FROUDE_REFERENCE_DATA, or below the folder fixed when the tests were configured. It may not exist.
inline std::filesystem::path reference_data(const std::string& relative) {
  const char* folder = std::getenv("FROUDE_REFERENCE_DATA");
  return std::filesystem::path(folder != nullptr ? folder : FROUDE_REFERENCE_DATA_DEFAULT) / relative;
}

}  // namespace froude_test

/// Use at the start of a test: defines the path `name`, or skips.
#define FROUDE_REQUIRE_DATA(name, relative)                                 \
  const std::filesystem::path name = froude_test::reference_data(relative); \
  if (!std::filesystem::exists(name)) GTEST_SKIP() << "skipped, no data: " << name
