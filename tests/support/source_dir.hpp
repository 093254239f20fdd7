#pragma once
/// \file  Where the files are that tests read. Known to source_dir.cpp alone: a test that names no folder is compiled
/// to the same object in every clone, which a compiler cache then shares.
#include <filesystem>

namespace froude_test {

/// The root of the project that these tests were built from.
std::filesystem::path source_dir();

}  // namespace froude_test
