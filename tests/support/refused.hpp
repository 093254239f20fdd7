#pragma once
/// \file  What somebody is told whose input is refused.
#include <string>

#include "hydro/base/error.hpp"

namespace support {

/// The whole message with which `call` refuses its input.
template <class Call>
std::string refused(Call call) {
  try {
    call();
  } catch (const hydro::InputError& e) {
    return e.what();
  }
  return "nothing was refused";
}

}  // namespace support
