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

sanitized=(core_test mesh_test scale_test measure_tree_test search_test io_test filter_test las_test las_fuzz_smoke)
cmake --preset asan-ubsan
cmake --build --preset asan-ubsan --parallel "$jobs" --target "${sanitized[@]}"
ctest --preset asan-ubsan --parallel "$jobs" --tests-regex "^($(IFS='|'; echo "${sanitized[*]}"))\$"
