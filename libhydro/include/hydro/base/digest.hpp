#pragma once
/// \file  By which bytes are known again.
#include <cstdint>
#include <cstring>
#include <string_view>

namespace hydro {

/// Bits of all bytes, so mixed that one that is changed changes half of them. No guard against malice.
inline std::uint64_t digest(std::string_view bytes) {
  std::uint64_t h = 0x9e3779b97f4a7c15 ^ bytes.size();
  for (std::size_t at = 0; at < bytes.size(); at += sizeof h) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + at, bytes.size() - at < sizeof word ? bytes.size() - at : sizeof word);
    h = (h ^ word) * 0xff51afd7ed558ccd;
    h ^= h >> 32U;
  }
  return h;
}

}  // namespace hydro
