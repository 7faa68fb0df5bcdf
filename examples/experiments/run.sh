#!/usr/bin/env bash
# run.sh <folder of the programs> [--full]: runs every experiment and rewrites RESULTS.md. Meshes,
# curves and what each program says go to out/experiments; a program that has run to its end with
# the same arguments since it was built is not run again. Real voxels come from DSC_TEST_DATA and the
# package mricron-data, where they are.
set -euo pipefail
export LC_ALL=C

programs=$1
shift
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
out=$here/../../out/experiments
mkdir -p "$out"
results=$(mktemp)
trap 'rm -f "$results" "$out"/*.part' EXIT

brain=$(dpkg-query --listfiles mricron-data 2>/dev/null | grep '/aal.nii.gz$' || true)
if [[ -n $brain && ! -x ${DSC_IMAGE_READER:-$programs/dsc-image-reader} ]]; then
  echo "$brain is left out: reading it needs DSC_WITH_ITK=ON" >&2
  brain=
fi
run() {
  local name=$1 program=$programs/$1
  shift
  [[ -x $program ]] || { echo "$program is not built; figure 7 needs DSC_WITH_CGAL=ON" >&2; return; }
  local said=$out/$name.md call=$out/$name.call
  if [[ ! $said -nt $program || $(cat "$call" 2>/dev/null) != "$*" ]]; then
    local begin=$SECONDS
    "$program" "$@" --out "$out" > "$said.part"
    printf '\n%s: %d s.\n\n' "$name" $((SECONDS - begin)) >> "$said.part"
    mv "$said.part" "$said"
    echo "$*" > "$call"
  fi
  cat "$said"
}

{
  echo '# The experiments of the paper'
  echo
  echo 'Written by the target `experiments` (`cmake --preset release -DDSC_WITH_CGAL=ON`, then'
  echo '`cmake --build --preset release --target experiments`), files by each program to'
  echo '`out/experiments`. Normals are integral invariants with r = 3 h^(1/2), from one ball centred on'
  echo 'the surfel, and λ = 0.25, unless it is said otherwise. Rows and columns "DGtal" are what that'
  echo "library's own program reaches on the same work (June 2026; normals from two balls, centred on"
  echo 'the voxels on both sides of the surfel).'
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
