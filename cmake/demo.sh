#!/usr/bin/env bash
# demo.sh <program> [<volume file>]: what `bootstrap.sh demo` shows. Results go to out/.
set -euo pipefail

program=$1
input=${2:-}
out=out
mkdir -p "$out"

say() { printf '\n== %s\n' "$*"; }
run() {
  printf '$ dsc %s\n' "$*"
  "$program" "$@"
}

say "Geodesic distance on the unit sphere, voxels of edge 0.05: naive, then projected calculus"
for calculus in naive projected; do
  run geodesic shape:sphere,r=1 --gridstep 0.05 --source 0.3,0.5,0.81 --calculus "$calculus" \
    -o "$out/sphere-$calculus.ply" --report "$out/sphere-$calculus.json"
done

if [[ -n $input ]]; then
  object=("$input")
  source=(--source-vertex 0)
else
  object=(shape:goursat --gridstep 0.25)
  source=(--source 10,0,0)
fi
say "Normals and distances on ${input:-Goursat\'s surface}"
run info "${object[@]}"
run normals "${object[@]}" -o "$out/normals.ply"
run geodesic "${object[@]}" "${source[@]}" -o "$out/distance.ply" --report "$out/distance.json"

say "Written:"
ls -l "$out"/{sphere-naive,sphere-projected,normals,distance}.ply | awk '{print $5 " bytes  " $NF}'
