#!/usr/bin/env bash
# Installs what is missing, builds, and runs every test in Release, then the core, mesh, search and reader tests once
# more under AddressSanitizer and UndefinedBehaviorSanitizer.
set -euo pipefail

root=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.." && pwd)
"$root/scripts/setup.sh"
cd "$root"
jobs=$(nproc)

scripts/lint.sh
cmake --preset ci
cmake --build --preset ci --parallel "$jobs"
ctest --preset ci

cmake --preset asan-ubsan
cmake --build --preset asan-ubsan --parallel "$jobs"
ctest --preset asan-ubsan
