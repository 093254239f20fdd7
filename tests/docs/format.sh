#!/usr/bin/env bash
# format.sh ROOT: every C++ file stands as clang-format 14 would write it. Exit status 77 (skipped) where that is missing.
set -euo pipefail
cd "$1"
if ! command -v clang-format-14 >/dev/null; then
  echo "skipped, no clang-format-14"
  exit 77
fi
find libhydro libdynamics libfit apps tests validation -name '*.hpp' -print0 -o -name '*.cpp' -print0 |
  xargs -0 clang-format-14 --style=file --dry-run --Werror
