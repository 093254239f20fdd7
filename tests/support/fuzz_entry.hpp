#pragma once
/// \file  What libFuzzer drives: one reader. It may answer, or refuse with hydro::InputError or hydro::NumericsError;
/// any other end is a finding, as are errors of memory, undefined behaviour, and limits of time and memory
/// (scripts/fuzz).
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "hydro/base/error.hpp"

namespace froude_fuzz {

template <class Reader>
int give(Reader read, const std::uint8_t* data, std::size_t size) {
  try {
    read(std::string_view(reinterpret_cast<const char*>(data), size));
  } catch (const hydro::InputError&) {
  } catch (const hydro::NumericsError&) {
  }
  return 0;
}

}  // namespace froude_fuzz
