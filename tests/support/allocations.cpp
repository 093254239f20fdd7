/// \file  The program's malloc, counted. The address sanitizer has one of its own and calls a hook; otherwise the
///        functions stand here in front of those of the C library, which new and Eigen call too.
#include "support/allocations.hpp"

#include <cerrno>
#include <cstdlib>

namespace {
thread_local std::size_t count = 0;  // of a plain type: its first use asks for no memory
}

std::size_t support::allocations() { return count; }

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/allocator_interface.h>
namespace {
void taken(const volatile void*, std::size_t) { ++count; }
void given_back(const volatile void*) {}
[[maybe_unused]] const int hooked = __sanitizer_install_malloc_and_free_hooks(taken, given_back);
}  // namespace
#else
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t number, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) {
  ++count;
  return __libc_malloc(size);
}
void* calloc(std::size_t number, std::size_t size) {
  ++count;
  return __libc_calloc(number, size);
}
void* realloc(void* old, std::size_t size) {
  ++count;
  return __libc_realloc(old, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++count;
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** out, std::size_t alignment, std::size_t size) {
  ++count;
  *out = __libc_memalign(alignment, size);
  return *out != nullptr ? 0 : ENOMEM;
}
}
#endif
