#!/usr/bin/env bash
# run.sh <folder of the programs> [--full]: runs every experiment and rewrites RESULTS.md. Meshes and
# curves go to out/experiments. Real voxels come from DSC_TEST_DATA and the package mricron-data,
# where they are.
set -euo pipefail
export LC_ALL=C

programs=$1
shift
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
out=$here/../../out/experiments
results=$(mktemp)
trap 'rm -f "$results"' EXIT

brain=$(dpkg-query --listfiles mricron-data 2>/dev/null | grep '/aal.nii.gz$' || true)
run() {
  local program=$programs/$1
  shift
  [[ -x $program ]] || { echo "$program is not built; figure 7 needs DSC_WITH_CGAL=ON" >&2; return; }
  local begin=$SECONDS
  "$program" "$@" --out "$out"
  printf '\n%s: %d s.\n\n' "$(basename "$program")" $((SECONDS - begin))
}

{
  echo '# The experiments of the paper'
  echo
  echo 'Written by the target `experiments` (`cmake --build --preset release --target experiments`).'
  echo 'Normals are integral invariants with r = 3 h^(1/2), λ = 0.25, unless it is said otherwise.'
  echo
  for figure in 3_gradient 4_laplacian 5_spectrum 6_mean_curvature 7_distances 8_half_sphere; do
    run figure_$figure "$@"
  done
  run figure_9_triple_junction "$@" ${brain:+"$brain"}
  spot=${DSC_TEST_DATA:-}/spot-256.vol
  data=()
  [[ ! -r $spot ]] || data+=("$spot")
  [[ -z $brain ]] || data+=("$brain")
  run figure_10_complex_object "$@" "${data[@]}"
} | tee "$results"
cp "$results" "$here/RESULTS.md"
