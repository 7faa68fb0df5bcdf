#!/usr/bin/env bash
# demo.sh <program> [<volume file>]: what `bootstrap.sh demo` shows. Results go to out/.
set -euo pipefail
export LC_ALL=C

program=$1
input=${2:-}
out=out
mkdir -p "$out"

say() { printf '\n== %s\n' "$*"; }
run() {
  printf '\n$ dsc %s\n' "$*"
  "$program" "$@"
}
# error_of <report.json> <norm>: a number of the report's object "error".
error_of() {
  tr -d ' \n' <"$1" | sed -n "s/.*\"error\":{[^}]*\"$2\":\([^,}]*\).*/\1/p"
}

say "Geodesic distance on the unit sphere, gridstep 0.05"
for calculus in naive projected; do
  run geodesic shape:sphere,r=1 --gridstep 0.05 --source 0.3,0.5,0.81 --calculus "$calculus" \
    -o "$out/sphere-$calculus.ply" -o "$out/sphere-$calculus.png" --report "$out/sphere-$calculus.json"
done

if [[ -n $input ]]; then
  name=$input
  object=("$input")
  source=(--source-vertex 0)
else
  name="Goursat's surface, a built-in shape"
  object=(shape:goursat --gridstep 0.25)
  source=(--source 0,0,10)
fi
say "Normals and distances: $name"
run normals "${object[@]}" -o "$out/normals.ply" -o "$out/normals.png" --report "$out/normals.json"
run geodesic "${object[@]}" "${source[@]}" -o "$out/distance.ply" -o "$out/distance.png" \
  -o "$out/distance.html" --report "$out/distance.json"

say "Error of the distance on the unit sphere, against the great circle"
printf '%-12s %10s %10s\n' calculus mean max
for calculus in naive projected; do
  report=$out/sphere-$calculus.json
  printf '%-12s %10.4f %10.4f\n' "$calculus" "$(error_of "$report" mean)" "$(error_of "$report" max)"
done

say "In $out/"
(cd "$out" && wc -c sphere-{naive,projected}.{ply,png} {normals,distance}.{ply,png} distance.html | sed '$d')
