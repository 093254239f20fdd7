#include <malloc.h>

#include "froude/program.hpp"

int main(int argc, char** argv) {
  // Columns of long records come and go by the dozen. What the kernel takes back it must clear anew: of a fit of 1e7
  // rows that was half of the time.
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, -1);
  return froude::run_program(argc, argv);
}
