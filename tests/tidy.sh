#!/usr/bin/env bash
# clang-tidy, with the checks of .clang-tidy as errors, on the sources of the library and the program
# that a change touches.
#
#   tests/tidy.sh [BASE]    since the commit BASE; without, since this branch left origin's main, or
#                           since the day before its last commit where it has not
#   tests/tidy.sh --all     all sources, and clang's static analyzer on them; takes an hour
#
# Each source by itself, whatever others a build compiles it with: a missing include is an error here.
# Where there is no clang-tidy or no history, it says so and leaves well alone.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
say() { printf '== clang-tidy: %s\n' "$*"; }
command -v clang-tidy >/dev/null || { say "skipped, it is not installed"; exit 0; }
git rev-parse --verify --quiet HEAD >/dev/null || { say "skipped, there is no git history"; exit 0; }

checks=()
most=${DSC_TIDY_MOST:-24}  # minutes, not hours, on the day of a large change
if [[ ${1:-} == --all ]]; then
  checks=('--checks=clang-analyzer-*')
  most=100000
  mapfile -t chosen < <(git ls-files -- 'libdsc/*.cpp')
  since="all"
else
  base=${1:-}
  if [[ -z $base ]]; then
    base=$(git merge-base HEAD origin/main 2>/dev/null || true)
    if [[ -z $base || $base == "$(git rev-parse HEAD)" ]]; then
      base=$(git rev-list -1 --before=$(($(git log -1 --format=%ct) - 86400)) HEAD)
    fi
    [[ -n $base ]] || { say "skipped, there is no commit to compare with"; exit 0; }
  fi
  # What is not committed yet, then the latest first.
  mapfile -t chosen < <({ git diff --name-only HEAD -- 'libdsc/*.cpp'; git log --name-only --format= "$base"..HEAD -- 'libdsc/*.cpp'; } |
    awk '$0 != "" && !seen[$0]++')
  since="changed since ${base:0:12}"
fi

cmake --preset dev -B build/tidy -DCMAKE_UNITY_BUILD=OFF -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON --log-level=ERROR >/dev/null
known=()  # what this build does not have, clang-tidy cannot read
for file in "${chosen[@]}"; do
  if [[ -f $file ]] && grep --quiet --fixed-strings "/$file\"" build/tidy/compile_commands.json; then known+=("$file"); fi
done
((${#known[@]} > 0)) || { say "no source is $since"; exit 0; }
say "${#known[@]} sources: $since"
if ((${#known[@]} > most)); then
  say "of them the $most latest; DSC_TIDY_MOST sets another number"
  known=("${known[@]:0:most}")
fi
printf '%s\0' "${known[@]}" |
  xargs -0 -n 1 -P "$(getconf _NPROCESSORS_ONLN)" clang-tidy -p build/tidy --quiet --warnings-as-errors='*' \
    --extra-arg=-Wno-unknown-warning-option "${checks[@]}" \
    2> >(grep --invert-match 'warnings generated' >&2 || true)
say "nothing found"
