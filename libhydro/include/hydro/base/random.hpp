#pragma once
/// \file  Counter-based random numbers: number i of stream s is a pure function of (seed, s, i).
///
/// The same on every machine, thread and rank, in any order; a longer series begins with the shorter one.
/// Generator: Philox-4x32 with ten rounds (Salmon, Moraes, Dror & Shaw 2011, "Parallel random numbers: as easy as
/// 1, 2, 3", SC11, section 4.3); tests hold its published known answers.
#include <array>
#include <cstdint>

namespace hydro {

/// One Philox-4x32-10 block: 128 random bits from a 128-bit counter and a 64-bit key.
std::array<std::uint32_t, 4> philox4x32(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key);

/// A stream of independent numbers indexed by position.
class RandomStream {
 public:
  /// `stream` separates uses of one seed, so that phases and noise never share numbers.
  RandomStream(std::uint64_t seed, std::uint64_t stream) : seed_(seed), stream_(stream) {}

  double uniform(std::uint64_t index) const;  ///< in [0, 1), 53 bits
  double normal(std::uint64_t index) const;   ///< mean 0, variance 1 (Box–Muller on one block)

 private:
  std::uint64_t seed_, stream_;
};

}  // namespace hydro
