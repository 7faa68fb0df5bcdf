#!/usr/bin/env bash
# atlas.sh <program>: what `bootstrap.sh atlas` shows, on the atlases of Debian's mricron-data.
# Results go to out/.
set -euo pipefail
export LC_ALL=C

program=$1
folder=/usr/share/mricron/templates
out=out
mkdir -p "$out"

say() { printf '\n== %s\n' "$*"; }
run() {
  printf '\n$ dsc %s\n' "$*"
  "$program" "$@"
}
# value <report.json> <key>: the first number of that name.
value() { sed -n "s/^ *\"$2\": *\([-0-9.e+]*\),*$/\1/p" "$1" | head -n 1; }

declare -A atlas=([aal]=$folder/aal.nii.gz
  [harvard-oxford]=$folder/HarvardOxford-cort-maxprob-thr0-1mm.nii.gz)

say "The whole brain as one surface (AAL)"
run normals "${atlas[aal]}" -o "$out/brain-normals.vtp" --report "$out/brain-normals.json"
run curvature "${atlas[aal]}" -o "$out/brain-curvature.vtp" \
  -o "$out/brain-curvature.png" --range -0.4,0.4 --view -60,20 --report "$out/brain-curvature.json"
run geodesic "${atlas[aal]}" --source 0,-60,40 -o "$out/brain-distance.vtp" \
  --report "$out/brain-distance.json"

say "Every interface between two regions, and distances that cross their junctions"
for name in aal harvard-oxford; do
  run geodesic "${atlas[$name]}" --labels all --source 0,-60,40 \
    -o "$out/$name-distance.vtp" -o "$out/$name-distance.png" --view -60,20 --report "$out/$name-distance.json"
done

say "Its regions, drawn"
run surface "${atlas[aal]}" --labels all --view -60,20 -o "$out/aal-regions.png"

say "The atlases"
printf '%-15s %8s %8s %10s %10s %10s\n' atlas regions faces junctions 'time, s' 'memory, MB'
for name in aal harvard-oxford; do
  report=$out/$name-distance.json
  printf '%-15s %8s %8s %10s %10.1f %10.0f\n' "$name" "$(value "$report" labels)" \
    "$(value "$report" faces)" "$(value "$report" junction_edges)" "$(value "$report" total)" \
    "$(value "$report" peak_memory_bytes | awk '{print $1 / 1e6}')"
done
