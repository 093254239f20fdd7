/// \file  The program's malloc, counted. The address sanitizer has one of its own and calls a hook; otherwise the
///        functions stand here in front of those of the C library, which new and Eigen call too.
#include "support/allocations.hpp"

#include <cerrno>
#include <cstdlib>

namespace support {
namespace {
thread_local std::size_t asked_so_far = 0;  // of a plain type: its first use asks for no memory
}
std::size_t allocations() { return asked_so_far; }
}  // namespace support

#ifdef __SANITIZE_ADDRESS__
// As GCC's library has it; the header of it is not in every package.
extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*taken)(const volatile void*, std::size_t),
                                                         void (*released)(const volatile void*));
namespace support {
namespace {
void count_allocation(const volatile void*, std::size_t) { ++asked_so_far; }
void ignore_release(const volatile void*) {}
[[maybe_unused]] const int allocations_hooked =
    __sanitizer_install_malloc_and_free_hooks(count_allocation, ignore_release);
}  // namespace
}  // namespace support
#else
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t number, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) {
  ++support::asked_so_far;
  return __libc_malloc(size);
}
void* calloc(std::size_t number, std::size_t size) {
  ++support::asked_so_far;
  return __libc_calloc(number, size);
}
void* realloc(void* old, std::size_t size) {
  ++support::asked_so_far;
  return __libc_realloc(old, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++support::asked_so_far;
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** out, std::size_t alignment, std::size_t size) {
  ++support::asked_so_far;
  *out = __libc_memalign(alignment, size);
  return *out != nullptr ? 0 : ENOMEM;
}
}
#endif
