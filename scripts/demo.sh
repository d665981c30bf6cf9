#!/usr/bin/env bash
# Installs what is missing, builds the program, finds the regions of a simulated airborne scan and draws them.
#   scripts/demo.sh [FOLDER]     results go to FOLDER, by default demo-output in the repository
set -euo pipefail

root=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.." && pwd)
out=$(realpath -m "${1:-$root/demo-output}")
"$root/scripts/setup.sh"

cd "$root"
cmake --preset release -DKAPPA_TESTS=OFF -DKAPPA_PCL=OFF
cmake --build --preset release --parallel "$(nproc)" --target kappa_app
kappa=$root/build/release/bin/kappa
mkdir -p "$out"

scan=$root/clouds/airborne.pcd
"$kappa" segment "$scan" "$out/airborne.ply" --radius 4 --smooth 1
"$kappa" segment "$scan" "$out/airborne.csv" --radius 4 --smooth 1 --quiet
"$kappa" render "$out/airborne.ply" "$out/mean-curvature.png" --unit m --percentile 95 \
  --title "Mean curvature of a simulated airborne scan, radius 4 m"
"$kappa" render "$out/airborne.ply" "$out/labels.png" --labels \
  --title "Kinds of surface, radius 4 m"

cat <<TXT

The scan         $scan
with curvature   $out/airborne.ply   (points, normals, curvatures, label, region)
as a table       $out/airborne.csv
the regions      $out/airborne.regions.csv
mean curvature   $out/mean-curvature.png
labels           $out/labels.png
look around      $kappa view $scan --radius 4
TXT
