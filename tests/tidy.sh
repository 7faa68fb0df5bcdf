#!/usr/bin/env bash
# clang-tidy, with the checks of .clang-tidy as errors, on the sources of the library and the program
# that a change touches.
#
#   tests/tidy.sh [BASE]    since the commit BASE; without, since this branch left origin's main, or
#                           since the commit before where it has not
#
# Where there is no clang-tidy or no history, it says so and leaves well alone.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
say() { printf '== clang-tidy: %s\n' "$*"; }
command -v clang-tidy >/dev/null || { say "skipped, it is not installed"; exit 0; }
git rev-parse --verify --quiet HEAD >/dev/null || { say "skipped, there is no git history"; exit 0; }
base=${1:-}
if [[ -z $base ]]; then
  base=$(git merge-base HEAD origin/main 2>/dev/null || true)
  [[ -n $base && $base != "$(git rev-parse HEAD)" ]] || base=$(git rev-parse --verify --quiet 'HEAD^' || true)
  [[ -n $base ]] || { say "skipped, there is no commit to compare with"; exit 0; }
fi
mapfile -t changed < <(git diff --name-only --diff-filter=d "$base" -- 'libdsc/*.cpp')
# Each source by itself, whatever others the builds compile it with: a missing include is an error here.
cmake --preset dev -B build/tidy -DCMAKE_UNITY_BUILD=OFF -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON --log-level=WARNING >/dev/null
known=()  # what this build does not have, clang-tidy cannot read
for file in "${changed[@]}"; do
  if grep --quiet --fixed-strings "/$file\"" build/tidy/compile_commands.json; then known+=("$file"); fi
done
((${#known[@]} > 0)) || { say "no source changed since ${base:0:12}"; exit 0; }
most=${DSC_TIDY_MOST:-24}  # minutes, not hours, on the day of a large change
if ((${#known[@]} > most)); then
  say "the first $most of ${#known[@]} changed sources; DSC_TIDY_MOST sets another number"
  known=("${known[@]:0:most}")
fi
say "${#known[@]} sources changed since ${base:0:12}"
printf '%s\0' "${known[@]}" |
  xargs -0 -n 1 -P "$(getconf _NPROCESSORS_ONLN)" clang-tidy -p build/tidy --quiet --warnings-as-errors='*' --extra-arg=-Wno-unknown-warning-option
