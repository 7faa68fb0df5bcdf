#!/usr/bin/env bash
# figures.sh <program>: measures the README's table of figures and writes it there. Voxel data is
# taken from the folder DSC_TEST_DATA where that is set; without it the table has shapes only.
set -euo pipefail
export LC_ALL=C

program=$1
readme=README.md
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# number <report.json> <object> <key>
number() {
  tr -d ' \n' <"$1" | sed -n "s/.*\"$2\":{[^}]*\"$3\":\([^,}]*\).*/\1/p"
}

# row <name> <argument of dsc geodesic>…
row() {
  local name=$1 report=$work/report.json naive=$work/naive.json error='' wrong=''
  shift
  "$program" geodesic "$@" --quiet -o "$work/out.ply" --report "$report"
  if [[ $(number "$report" error mean) ]]; then
    "$program" geodesic "$@" --quiet -o "$work/out.ply" --report "$naive" --calculus naive
    wrong=$(printf '%.2f' "$(number "$naive" error mean)")
    error=$(printf '%.4f (%.4f)' "$(number "$report" error mean)" "$(number "$report" error max)")
  fi
  local memory
  memory=$(tr -d ' \n' <"$report" | sed -n 's/.*"peak_memory_bytes":\([0-9]*\).*/\1/p')
  local stages=()
  local stage
  for stage in read extract normals; do stages+=("$(number "$report" timings_s "$stage")"); done
  printf '| %s | %s | %.2f | %.2f | %.2f | %.2f | %d | %s | %s |\n' "$name" \
    "$(number "$report" surface faces)" \
    "$(awk "BEGIN {print ${stages[0]} + ${stages[1]}}")" "${stages[2]}" \
    "$(awk "BEGIN {print $(number "$report" timings_s assemble) + $(number "$report" timings_s factorize) + $(number "$report" timings_s solve)}")" \
    "$(number "$report" timings_s total)" $((memory / 1000000)) "${error:-–}" "${wrong:-–}"
}

table() {
  echo
  echo '| surface | faces | read, extract (s) | normals (s) | distances (s) | all (s) | memory (MB) | error, mean (max) | naive |'
  echo '| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |'
  local h size file
  for h in 0.1 0.05 0.025 0.01 0.0033; do
    row "unit sphere, h = $h" shape:sphere --gridstep "$h" --source 0.3,0.5,0.81
  done
  for size in 64 128 256 512; do
    file=${DSC_TEST_DATA:-}/spot-$size.vol
    if [[ -r $file ]]; then row "spot, ${size}³ voxels" "$file" --source-vertex 0; fi
  done
  echo
  printf 'Measured with %s cores of an %s.\n' "$(getconf _NPROCESSORS_ONLN)" \
    "$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -1)"
}

grep -q '^<!-- figures: begin' "$readme" && grep -q '^<!-- figures: end' "$readme"
table >"$work/table"
awk -v table="$work/table" '
  /^<!-- figures: end/ {while ((getline line < table) > 0) print line; print ""; inside = 0}
  !inside {print}
  /^<!-- figures: begin/ {inside = 1}' "$readme" >"$work/readme"
cp "$work/readme" "$readme"
sed -n '/^<!-- figures: begin/,/^<!-- figures: end/p' "$readme"
