#!/usr/bin/env bash
# pictures.sh <program>: draws the pictures of the README into docs/pictures. Spot is drawn where the
# folder DSC_TEST_DATA has its voxels; the others need nothing but the program.
set -euo pipefail
export LC_ALL=C

program=$1
out=docs/pictures
mkdir -p "$out"

# draw <name> <argument of dsc>…
draw() {
  local name=$1
  shift
  "$program" "$@" --quiet -o "$out/$name.png"
  printf '%s: %d bytes\n' "$out/$name.png" "$(stat -c %s "$out/$name.png")"
}

# From behind, where the errors have added up.
sphere=(geodesic shape:sphere --gridstep 0.02 --source -0.3,0.8,-0.5 --isolines 20 --range 1.2,3.4
  --picture-size 450,380)
draw sphere-naive "${sphere[@]}" --calculus naive
draw sphere-projected "${sphere[@]}"
draw curvature curvature shape:goursat --gridstep 0.15 --estimator laplacian --diffuse 0.1 --isolines 8 \
  --picture-size 500,420
draw gradient gradient shape:torus,R=2,r=0.7 --gridstep 0.05 --radius 0.3 --function 'sin(2*x)+z' \
  --glyphs 200 --view 30,40 --picture-size 500,420
spot=${DSC_TEST_DATA:-}/spot-256.vol
if [[ -r $spot ]]; then
  draw spot geodesic "$spot" --source-vertex 0 --up y --view 215,15 --isolines 20 --picture-size 500,420
fi
