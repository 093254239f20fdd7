#pragma once
/// \file  Marks an inner loop to be compiled for several instruction sets, chosen when the program starts.
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
/// Sums differ in the last bit between instruction sets, where one fuses a product with a sum; on one machine they are
/// the same every time.
#define FROUDE_EVERY_MACHINE __attribute__((target_clones("default", "arch=x86-64-v3")))
#else
#define FROUDE_EVERY_MACHINE
#endif

namespace hydro {

/// Four numbers that the compiler keeps in one or two registers of the machine; may stand at any double.
typedef double Four __attribute__((vector_size(32), aligned(8), may_alias));

}  // namespace hydro
