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
# The examples of the library for scenes, as a user builds them.
cmake -S "$source/examples/library" -B "$work/library" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$work/prefix" \
  >"$work/configure.log" 2>&1 || { cat "$work/configure.log"; exit 1; }
cmake --build "$work/library" >"$work/build.log" 2>&1 || { cat "$work/build.log"; exit 1; }
# 1/2 rho C A w^2 / k = 1/2 · 1.225 · 1.2 · 10 · 10² / 1000 = 0.735 m, from which 60 s of damping leave 1e-19.
answer=$("$work/library/sail" "$source/examples/library/sail.toml")
echo "$answer"
grep -qx 'sail: quadratic drag of the air at the point.s velocity; 1 element' <<<"$answer"
grep -qx 'raft.surge ends at 0.7350 m' <<<"$answer"
# The same with half the stiffness, the element unknown to the program itself, and a mistake in it placed.
sed 's/"1000 N\/m"/"500 N\/m"/' "$source/examples/library/sail.toml" >"$work/softer.toml"
grep -qx 'raft.surge ends at 1.4700 m' <<<"$("$work/library/sail" "$work/softer.toml")"
if "$work/prefix/bin/froude" plan "$work/softer.toml" 2>"$work/unknown.txt"; then exit 1; fi
grep -q 'unknown key "sail"' "$work/unknown.txt"
sed 's/"10 m^2"/"-10 m^2"/' "$work/softer.toml" >"$work/wrong.toml"
if "$work/library/sail" "$work/wrong.toml" 2>"$work/wrong.txt"; then exit 1; fi
grep -q 'wrong.toml:[0-9]*:[0-9]*.*area = "-10 m^2" must be positive' "$work/wrong.txt"
(cd "$work" && library/vary "$source/examples/roll.toml" body.initial.roll 10 40 >vary.txt && test -s 1.run.h5 && test -s 2.run.h5)
cat "$work/vary.txt"
[ "$(grep -c '^body.initial.roll = [14]0 deg: boat' "$work/vary.txt")" = 2 ]
"$work/prefix/bin/froude" --version
# The manual page and what shells complete by, where Debian's own look for them.
share=$work/prefix/share
grep -q '^\.TH FROUDE 1' "$share/man/man1/froude.1"
bash -c 'source "$0"; COMP_WORDS=(froude ex); COMP_CWORD=1; _froude; printf "%s\n" "${COMPREPLY[@]}"' \
  "$share/bash-completion/completions/froude" | grep -qx export
head -n 1 "$share/zsh/vendor-completions/_froude" | grep -qx '#compdef froude'
# The cases are a program of their own; installed beside froude it finds their folders in share/.
if [ -x "$work/prefix/bin/froude-validate" ]; then "$work/prefix/bin/froude" validate --list | grep '^dispersion '; fi
# Private files stay private.
if find "$work/prefix/include" -name '*.cpp' | grep -q .; then echo "sources were installed as headers"; exit 1; fi
