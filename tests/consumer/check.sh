#!/usr/bin/env bash
# check.sh BUILD SOURCE: installs BUILD into a fresh folder, builds the ten-line program of this folder against what was
# installed and nothing else, and runs it and the installed froude.
set -euo pipefail
build=$1 source=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cmake --install "$build" --prefix "$work/prefix" >"$work/install.log"
cmake -S "$source/tests/consumer" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$work/prefix" \
  >"$work/configure.log" 2>&1 || { cat "$work/configure.log"; exit 1; }
cmake --build "$work/build" >"$work/build.log" 2>&1 || { cat "$work/build.log"; exit 1; }

# λ = 79.98 m for T = 8 s in 14 m of water, from ω² = g k tanh kh solved by hand to four digits.
answer=$("$work/build/consumer" "8 s" "14 m")
echo "$answer"
[ "$answer" = "wavelength 79.98 m" ]
"$work/prefix/bin/froude" --version
# The cases are a program of their own; installed beside froude it finds their folders in share/.
if [ -x "$work/prefix/bin/froude-validate" ]; then "$work/prefix/bin/froude" validate --list | grep '^dispersion '; fi
# Private files stay private.
if find "$work/prefix/include" -name '*.cpp' | grep -q .; then echo "sources were installed as headers"; exit 1; fi
