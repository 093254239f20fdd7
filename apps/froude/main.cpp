#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>

#include "froude/program.hpp"

namespace {

/// Has the heap grow once by so much that nearly all of a process is there, and asks for it in pages of 2 MB: the
/// kernel clears one where it would clear 512, one by one, as they are touched. What is not touched takes no memory.
/// Where there is no such room, or there are no such pages, all is as it was.
void ask_for_huge_pages() {
  constexpr int usual_room = 128 << 10, room = 256 << 20, page = 2 << 20;
  const auto from = reinterpret_cast<std::uintptr_t>(sbrk(0));
  mallopt(M_TOP_PAD, room);
  // More than is left of the heap that was made before main(); volatile, or a compiler would leave it out.
  void* volatile grown = std::malloc(page);
  const auto to = reinterpret_cast<std::uintptr_t>(sbrk(0));
  std::free(grown);
  mallopt(M_TOP_PAD, usual_room);
  const std::uintptr_t whole = (from + page - 1) / page * page;
  if (to > whole) madvise(reinterpret_cast<void*>(whole), to - whole, MADV_HUGEPAGE);
}

}  // namespace

int main(int argc, char** argv) {
  // Columns of long records come and go by the dozen. What the kernel takes back it must clear anew: of a fit of 1e7
  // rows that was half of the time.
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, -1);
  ask_for_huge_pages();
  return froude::run_program(argc, argv);
}
