#!/usr/bin/env bash
# The core under AddressSanitizer and UndefinedBehaviorSanitizer, quick enough for every change: what
# extracts surfaces, estimates normals and makes operators of them. tests/nightly.sh has all the rest.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
export UBSAN_OPTIONS=print_stacktrace=1 ASAN_OPTIONS=detect_stack_use_after_return=1
jobs=$(getconf _NPROCESSORS_ONLN)
cmake --preset asan -B build/asan-core -DDSC_CORE_ONLY=ON --log-level=WARNING
cmake --build build/asan-core --parallel "$jobs"
# Errors against the truth on fine grids say nothing about memory, and take minutes here.
slow='Converge|ExtractRandom|BruteForce|TheBoundsOfClosed|RandomVolumesOfUpTo8'
exec ctest --test-dir build/asan-core --no-tests=error --output-on-failure --exclude-regex "$slow" --parallel "$jobs"
