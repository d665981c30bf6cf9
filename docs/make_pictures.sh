#!/usr/bin/env bash
# Makes every picture of the documents but ball.svg, which is drawn by hand.
#   docs/make_pictures.sh KAPPA [FOLDER]     KAPPA: the program, FOLDER: docs/pictures by default
# The picture of the viewer needs xvfb-run and xdotool; without them it is left as it is.
set -euo pipefail

root=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.." && pwd)
program=$(readlink -f "${1:?usage: docs/make_pictures.sh KAPPA [FOLDER]}")
out=$(realpath -m "${2:-$root/docs/pictures}")
clouds=$root/clouds
mkdir -p "$out"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

kappa() { "$program" "$@" --quiet; }
# picture NAME WIDTH,HEIGHT INPUT OPTIONS...
picture() { kappa render "$3" "$out/$1.png" --size "$2" "${@:4}"; }

airborne() {
  local scan=$clouds/airborne.pcd
  kappa curvature "$scan" mean.ply --radius 4 --smooth 1
  picture mean-curvature 1000,560 mean.ply --unit m --percentile 95 \
    --title "Mean curvature of a simulated airborne scan, radius 4 m"
  kappa segment "$scan" regions.ply --radius 6 --kappa-max 0.05 --flatness 0.1
  picture regions 1000,560 regions.ply --labels --camera 20,45 --title "Kinds of surface, radius 6 m"
  kappa curvature "$scan" radii.ply --radius 1.5,4,12
  for radius in 1.5 4 12; do
    picture "radius-$radius" 600,380 radii.ply --field "mean_curvature_r$radius" --unit m --range=-0.05,0.05 \
      --title "radius $radius m"
  done
  kappa curvature "$scan" flipped.ply --radius 4 --smooth 1 --flip
  picture flipped 600,380 flipped.ply --unit m --range=-0.03,0.03 --title "--flip"
  picture upward 600,380 mean.ply --unit m --range=-0.03,0.03 --title "normals upward"
}

houses() {
  local around="512080,5403070,512120,5403110"
  "$program" mesh "$clouds/airborne.pcd" umbrella.ply --bounds "$around" >/dev/null
  kappa curvature umbrella.ply umbrella-curvature.ply --radius 2
  picture umbrella 900,560 umbrella-curvature.ply --edges --unit m --range=-0.2,0.2
  kappa curvature "$clouds/airborne.pcd" roofs.ply --radius 1.5 --normals robust --bounds 512070,5403010,512140,5403110
  picture roofs 900,520 roofs.ply --field k_max --unit m --range=-0.3,0.3 --camera=-30,40
}

meshes() {
  kappa generate torus torus.ply --slices 36 --sides 20
  kappa curvature torus.ply torus-curvature.ply --radius 0.6
  picture directions 800,500 torus-curvature.ply --directions max --field gaussian_curvature --camera 0,60
  kappa generate goursat goursat.ply
  kappa curvature goursat.ply goursat-curvature.ply --radius 1
  picture goursat 800,500 goursat-curvature.ply
  kappa generate torus noisy.ply --slices 200 --sides 200 --noise 0.3 --no-normals --no-truth
  kappa curvature noisy.ply noisy-faces.ply --radius 0.1 --normals geometric
  kappa curvature noisy.ply noisy-auto.ply
  picture noisy-faces 600,380 noisy-faces.ply --range=-1,1 --title "radius 0.1, normals of the faces"
  picture noisy-automatic 600,380 noisy-auto.ply --range=-1,1 --title "all automatic"
}

first_steps() {
  kappa curvature "$clouds/airborne-small.ply" small.ply --radius 3
  picture first-steps 800,500 small.ply --unit m
  picture coverage 800,500 small.ply --field coverage
}

# Microseconds a ball over the faces asked for, both logarithmic, from the table of the benchmarks.
chart() {
  awk -F, '
    function x(faces) { return 80 + 130 * (log(faces / 20) / log(10)) }
    function y(us) { return 300 - 62 * (log(us / 0.5) / log(10)) }
    function text(at_x, at_y, anchor, words) {
      return sprintf("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\">%s</text>\n", at_x, at_y, anchor, words)
    }
    function line(colour, label, shift, list,   n, p, i, points, last) {
      n = split(list, p, " ")
      for (i = 1; i <= n; ++i) { split(p[i], q, ","); points = points sprintf("%.1f,%.1f ", x(q[1]), y(q[2])); last = y(q[2]) }
      printf "<polyline points=\"%s\" fill=\"none\" stroke=\"%s\" stroke-width=\"2.5\"/>\n", points, colour
      printf "%s", text(x(200000) + 8, last + shift, "start", label)
    }
    $1 == "torus" && $2 == "exact" { search = search $3 "," $5 " "; flann = flann $3 "," $6 " "; tree = tree $3 "," $7 " "; fast = fast $3 "," $8 " " }
    END {
      print "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"760\" height=\"360\" font-family=\"sans-serif\" font-size=\"13\">"
      print "<rect width=\"760\" height=\"360\" fill=\"#edf0f4\"/>"
      for (f = 20; f <= 200000; f *= 10) {
        printf "<line x1=\"%.1f\" y1=\"20\" x2=\"%.1f\" y2=\"300\" stroke=\"#c9d0da\"/>\n%s", x(f), x(f), text(x(f), 318, "middle", f)
      }
      for (us = 1; us <= 10000; us *= 10) {
        printf "<line x1=\"80\" y1=\"%.1f\" x2=\"600\" y2=\"%.1f\" stroke=\"#c9d0da\"/>\n%s", y(us), y(us), text(72, y(us) + 4, "end", us)
      }
      printf "%s%s", text(340, 342, "middle", "faces in the ball"), text(12, 14, "start", "microseconds a ball")
      line("#8a8f98", "FLANN search alone", 4, search)
      line("#b2182b", "FlannBallSum", 4, flann)
      line("#2166ac", "MeasureTree", -2, tree)
      line("#1b7837", "MeasureTree, fast", 12, fast)
      print "</svg>"
    }' "$root/experiments/results/benchmark-balls.csv" >"$out/balls.svg"
}

# The viewer saves its window itself when it gets the key c.
viewer() {
  mkdir pictures
  ln -s "$clouds/airborne.pcd" .
  "$program" view airborne.pcd --radius 4 --smooth 1 --pictures pictures >/dev/null 2>&1 &
  local pid=$! window
  sleep 15
  window=$(xdotool search --name kappa | tail -1)
  xdotool windowsize "$window" 1150 740
  sleep 5
  xdotool mousemove 700 360 click 1
  for key in h c; do
    sleep 5
    xdotool key --window "$window" "$key"
  done
  sleep 5
  kill "$pid"
  mv pictures/kappa-001.png "$out/viewer.png"
}

airborne
houses
meshes
first_steps
chart
if command -v xvfb-run >/dev/null && command -v xdotool >/dev/null; then
  export program clouds out
  xvfb-run -a -s "-screen 0 1400x900x24" bash -euo pipefail -c "$(declare -f viewer); viewer" 2>/dev/null
else
  echo "make_pictures.sh: viewer.png is left as it is, for xvfb-run or xdotool is missing" >&2
fi
ls -l "$out"
