#!/usr/bin/env bash
# Checks the layout of every source file with clang-format, and with --tidy the layers below PCL and VTK with clang-tidy.
#   scripts/lint.sh [--fix | --tidy]
set -euo pipefail

root=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.." && pwd)
cd "$root"
mapfile -t sources < <(git ls-files '*.cpp' '*.hpp')
case "${1:-}" in
  --fix) clang-format -i "${sources[@]}" ;;
  --tidy)
    cmake --preset dev -DKAPPA_VIEW=OFF -DKAPPA_PCL=OFF -DKAPPA_APPS=OFF -DKAPPA_TESTS=OFF >/dev/null
    # CMake leaves the standard out where it is the compiler's own; clang-tidy 14 has an older one.
    clang-tidy --quiet -p build/dev --extra-arg=-std=c++17 src/core/*.cpp src/mesh/*.cpp src/segment/*.cpp src/surface/*.cpp \
      src/search/*.cpp ;;
  "") clang-format --dry-run --Werror "${sources[@]}" ;;
  *)
    echo "lint.sh: unknown option $1; give --fix, --tidy or nothing" >&2
    exit 2 ;;
esac
