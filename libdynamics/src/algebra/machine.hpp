#pragma once
/// \file  Marks an inner loop to be compiled for several instruction sets, chosen when the program starts. Not
/// installed.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define FROUDE_EVERY_MACHINE __attribute__((target_clones("default", "arch=x86-64-v3")))
#else
#define FROUDE_EVERY_MACHINE
#endif

namespace dynamics {

/// Four numbers that stand beside each other in memory, wherever they begin.
typedef double Four __attribute__((vector_size(32), aligned(8), may_alias));

}  // namespace dynamics
