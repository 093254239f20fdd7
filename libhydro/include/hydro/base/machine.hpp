#pragma once
/// \file  Marks an inner loop to be compiled for several instruction sets, chosen when the program starts.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
/// Sums differ in the last bit between instruction sets, where one fuses a product with a sum; on one machine they are
/// the same every time.
#define FROUDE_EVERY_MACHINE __attribute__((target_clones("default", "arch=x86-64-v3")))
#define FROUDE_HAS_CLONES
#else
#define FROUDE_EVERY_MACHINE
#endif

namespace hydro {

/// The instruction set that those loops, and products of small matrices, take on this machine: "x86-64-v3, AVX2 and
/// fused products", or what the whole program was compiled for. Sums differ between them by rounding alone.
const char* instructions_of_loops();

/// Four numbers that the compiler keeps in one or two registers of the machine; may stand at any double.
typedef double Four __attribute__((vector_size(32), aligned(8), may_alias));

}  // namespace hydro
