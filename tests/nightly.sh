#!/usr/bin/env bash
# What takes too long for every change: all tests under sanitizers, the small ones under valgrind, and
# the long runs. What came out last is recorded in tests/RELIABILITY.md.
#
#   tests/nightly.sh [PART…] [-- CTEST OPTION…]
#
#   asan       every test under AddressSanitizer and UndefinedBehaviorSanitizer, CHOLMOD, ITK, OpenVDB and CGAL too
#   tsan       every test under ThreadSanitizer, parallel loops on std::thread
#   plain      every test of a build without anything optional, each source compiled by itself
#   tidy       clang-tidy and clang's static analyzer on every source
#   valgrind   the small tests of the optimised build under memcheck
#   fuzz       every reader under libFuzzer, 10^7 executions each (tests/fuzz/run.sh); needs clang
#   long       DSC_LONG_TESTS=1: 100 000 random volumes, 1000 killed runs, 500 interrupted
#              ones, images cut at every byte
#
# Without a PART, all. Debian: libasan8, libubsan1, libtsan2 (with gcc), valgrind, clang.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
if [[ -z ${DSC_TEST_DATA:-} && -d ../shared/data ]]; then
  DSC_TEST_DATA=$(cd ../shared/data && pwd)
  export DSC_TEST_DATA
fi
parts=()
while (($# > 0)) && [[ $1 != -- ]]; do
  parts+=("$1")
  shift
done
[[ ${1:-} != -- ]] || shift
((${#parts[@]})) || parts=(plain tidy asan tsan valgrind fuzz long)
jobs=$(getconf _NPROCESSORS_ONLN)
ctest_options=("$@")

build() {  # <preset> [<cmake option>…]
  local preset=$1
  shift
  cmake --preset "$preset" --log-level=WARNING "$@"
  cmake --build --preset "$preset" --parallel "$jobs"
}

test_all() {  # <preset> [<ctest option>…]
  local preset=$1
  shift
  ctest --preset "$preset" --no-tests=error --parallel "$jobs" --timeout 1500 "$@" "${ctest_options[@]}"
}

run_asan() {
  build asan -DDSC_WITH_CHOLMOD=ON -DDSC_WITH_ITK=ON -DDSC_WITH_OPENVDB=ON -DDSC_WITH_CGAL=ON
  # Leaks of other libraries' globals are not ours; an allocation too large is an exception, as it is
  # without the sanitizer.
  ASAN_OPTIONS=allocator_may_return_null=1:detect_stack_use_after_return=1 UBSAN_OPTIONS=print_stacktrace=1 \
    test_all asan
}

run_tsan() {
  build tsan
  TSAN_OPTIONS=halt_on_error=1:second_deadlock_stack=1 test_all tsan
}

run_plain() {
  local without=()
  for part in CHOLMOD ITK OPENVDB CGAL PICTURES PAGE; do without+=("-DDSC_WITH_$part=OFF"); done
  cmake --preset dev -B build/plain -DCMAKE_UNITY_BUILD=OFF -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON "${without[@]}" \
    --log-level=WARNING
  cmake --build build/plain --parallel "$jobs"
  ctest --test-dir build/plain --no-tests=error --output-on-failure --parallel "$jobs" "${ctest_options[@]}"
}

run_tidy() { tests/tidy.sh --all; }

run_valgrind() {
  build dev
  local layer
  # Large grids say nothing more about memory, and take hours here; valgrind has no 80-bit numbers and
  # is not the program that its children look beside.
  local -A filters=(
    [base]='*' [voxels]='*-*Converge*:*Bounds*' [surface]='BorderCases.One*:BorderCases.Rows*:Extract.*-*Threads*'
    [normals]='*Refuse*:*Tiny*:Smallest*:Trivial*-*Converge*:*Threads*' [calculus]='*-*Threads*:*Converge*:*SameBits*:DegenerateFaces.Keep*'
    [solve]='*SmallestSystems*:*BadInput*:*Refuse*:Wide*:Dirichlet*:Components*:HostileSystems.Right*-Wide.Adds*'
    [io]='*Reader*:*Writer*:AtomicFile.The*:AtomicFile.Links*:ResultFiles.*-*Limits*:*Large*:*Slabs*:Images*:Readers.*'
    [algorithms]='*AreRefused*:*EveryVertexASource*:*ComponentsWithout*')
  for layer in base voxels surface normals calculus solve io algorithms; do
    [[ -z ${DSC_VALGRIND_LAYERS:-} || " $DSC_VALGRIND_LAYERS " == *" $layer "* ]] || continue
    echo "== valgrind: $layer"
    valgrind --quiet --error-exitcode=9 --leak-check=full --show-leak-kinds=definite --errors-for-leak-kinds=definite \
      "build/dev/bin/test_$layer" --gtest_brief=1 --gtest_filter="${filters[$layer]}"
  done
}

run_fuzz() { tests/fuzz/run.sh; }

run_long() {
  build dev
  DSC_LONG_TESTS=1 test_all dev --tests-regex \
    'ExtractRandom|RandomVolumesOfUpTo8|Killed|Interrupt|GeodesicConvergence|Truncated|CutImages|Vdb'
}

failed=()
for part in "${parts[@]}"; do
  case $part in
    plain | tidy | asan | tsan | valgrind | fuzz | long) ;;
    *)
      sed -n '5,16p' "${BASH_SOURCE[0]}" >&2
      exit 2
      ;;
  esac
  start=$SECONDS
  set +e
  (set -e; "run_$part")  # not in a condition, where bash would go on after errors
  code=$?
  set -e
  result=passed
  ((code == 0)) || { result=FAILED; failed+=("$part"); }
  echo "== nightly: $part $result in $((SECONDS - start)) s"
done
((${#failed[@]} == 0))
