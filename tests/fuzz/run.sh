#!/usr/bin/env bash
# The long runs: each fuzzer, one after another, 10^7 executions, in the build of the preset fuzz
# (clang, AddressSanitizer and UndefinedBehaviorSanitizer; Debian: clang, libclang-rt-14-dev).
#
#   tests/fuzz/run.sh [TARGET…] [-- LIBFUZZER OPTION…]
#
# Without a TARGET, all. What libFuzzer finds interesting is kept in build/fuzz/runs/TARGET and is
# where the next run begins; what it finds wrong comes to build/fuzz/runs/TARGET-…; the output goes to
# build/fuzz/runs/TARGET.log. Ends with 1 where anything was found.
#
# Timeouts are of the clock on the wall: on a machine that does much else beside, say -- -timeout=60.
# DSC_FUZZ_BIN names a folder with fuzzers built before, DSC_FUZZ_RUNS one for the results.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

# Longest input in bytes: what holds every kind of line or chunk twice.
declare -A longest=([vol]=320 [longvol]=320 [npy]=320 [raw]=96 [vox]=256 [vti]=768 [off]=320 [obj]=320 [ply]=640 [stl]=512
  [om]=1024 [expression]=96 [shape]=128)
targets=()
while (($# > 0)) && [[ $1 != -- ]]; do
  [[ -n ${longest[$1]:-} ]] || { echo "run.sh: $1 is no target; there are ${!longest[*]}" >&2; exit 2; }
  targets+=("$1")
  shift
done
[[ ${1:-} != -- ]] || shift
((${#targets[@]})) || targets=(raw npy longvol vol off obj stl vox vti ply expression shape om)

# Freed memory is kept for a while, so that its use is seen; the default of 256 MB costs time only here.
export ASAN_OPTIONS=quarantine_size_mb=16${ASAN_OPTIONS:+:$ASAN_OPTIONS}
runs=${DSC_FUZZ_RUNS:-$PWD/build/fuzz/runs}
bin=${DSC_FUZZ_BIN:-}
if [[ -z $bin ]]; then
  cmake --preset fuzz --log-level=WARNING
  cmake --build --preset fuzz --parallel "$(getconf _NPROCESSORS_ONLN)"
  bin=build/fuzz/bin
fi
failed=()
for target in "${targets[@]}"; do
  mkdir -p "$runs/$target"
  options=(-runs=10000000 -max_len="${longest[$target]}" -timeout=5 -rss_limit_mb=2048 -malloc_limit_mb=64
    -print_final_stats=1 -artifact_prefix="$runs/$target-")
  [[ ! -f tests/fuzz/$target.dict ]] || options+=(-dict="tests/fuzz/$target.dict")
  start=$SECONDS
  result=passed
  "$bin/fuzz_$target" "${options[@]}" "$@" "$runs/$target" "tests/fuzz/corpus/$target" >"$runs/$target.log" 2>&1 ||
    { result=FAILED; failed+=("$target"); }
  covered=$(grep -o 'cov: [0-9]*' "$runs/$target.log" | tail -1)
  count=$(grep -o 'number_of_executed_units: [0-9]*' "$runs/$target.log" | tail -1)
  echo "== fuzz: $target $result, ${count##*: } executions, ${covered##*: } edges, $((SECONDS - start)) s"
done
((${#failed[@]} == 0))
