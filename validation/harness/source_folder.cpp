#include "harness/case.hpp"

namespace froude::validation {

std::filesystem::path source_folder() { return FROUDE_VALIDATION_SOURCE; }

}  // namespace froude::validation
