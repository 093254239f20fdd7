#pragma once
/// \file  How often this thread has asked for memory: by new, by malloc, through Eigen or through a library.
#include <cstddef>

namespace support {

/// Since the thread began. A program that asks has its allocator counted (allocations.cpp).
std::size_t allocations();

}  // namespace support
