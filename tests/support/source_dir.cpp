#include "support/source_dir.hpp"

namespace froude_test {

std::filesystem::path source_dir() { return FROUDE_SOURCE_DIR; }

}  // namespace froude_test
