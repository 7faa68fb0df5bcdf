#!/usr/bin/env bash
# From a fresh clone to a result, with one command. On Debian 12 it installs what is missing; git
# and ca-certificates, for the clone, are all that must be there before.
#
#   ./cmake/bootstrap.sh demo [FILE]   builds the program and shows its main job, on FILE (voxels, also
#                                      of OpenVDB, a medical image or a folder of its slices) or on a built-in
#                                      shape; the results are in out/
#   ./cmake/bootstrap.sh atlas         the same on two atlases of the brain, all their regions at
#                                      once; needs another 60 MB of packages, for ITK
#   ./cmake/bootstrap.sh test          builds everything, runs every test
#   ./cmake/bootstrap.sh figures       builds the program, measures the README's table of figures
#                                      anew and writes it there; real voxels from DSC_TEST_DATA
#   ./cmake/bootstrap.sh pictures      builds the program and draws the pictures of the README anew, in
#                                      docs/pictures; spot needs the voxels of DSC_TEST_DATA
#   ./cmake/bootstrap.sh benchmarks [--quick]
#                                      measures every stage and whole jobs against what the machine can
#                                      do and rewrites tests/benchmarks/RESULTS.md, in a quarter of an
#                                      hour; --quick prints what small surfaces take, in two minutes
#   ./cmake/bootstrap.sh packages      builds the program and the library and makes Debian packages of
#                                      them, build/release/*.deb
#   ./cmake/bootstrap.sh docs          makes the pages for readers of the code, build/docs/html/index.html
set -euo pipefail

usage() {
  sed -n '5,21s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2
  exit 2
}

say() { printf '== %s\n' "$*"; }

# Library packages, by their names in Debian. Tools are looked for in PATH first.
library_packages=(libeigen3-dev libopenmesh-dev zlib1g-dev libexpat1-dev libmetis-dev libmuparser-dev libfmt-dev libspectra-dev
  libtbb-dev libcli11-dev nlohmann-json3-dev libjs-three)
picture_packages=(libembree-dev libpng-dev)
image_packages=(libinsighttoolkit5-dev)
vdb_packages=(libopenvdb-dev libboost-dev)
benchmark_packages=(libbenchmark-dev)
docs_packages=(libjs-mathjax)
test_packages=(libgtest-dev "${benchmark_packages[@]}" libsuitesparse-dev libopenblas-dev libcgal-dev "${image_packages[@]}" "${vdb_packages[@]}" "${picture_packages[@]}" mricron-data chromium)

# Prints the packages of its arguments and of the tools that this system does not have.
missing_packages() {
  command -v cmake >/dev/null || echo cmake
  if [[ $mode != docs ]]; then
    command -v cc >/dev/null || echo gcc
    command -v c++ >/dev/null || echo g++
    command -v ninja >/dev/null || echo ninja-build
  fi
  [[ $mode != test && $mode != docs ]] || command -v doxygen >/dev/null || echo doxygen
  [[ $mode != test ]] || command -v python3 >/dev/null || echo python3
  [[ $mode != packages ]] || command -v file >/dev/null || echo file
  [[ $mode != packages ]] || command -v dpkg-shlibdeps >/dev/null || echo dpkg-dev
  [[ $mode != test ]] || command -v clang-tidy >/dev/null || echo clang-tidy
  [[ $mode != test ]] || command -v node >/dev/null || echo nodejs
  local package
  for package in "$@"; do
    [[ $(dpkg-query --show --showformat '${db:Status-Status}' "$package" 2>/dev/null) == installed ]] ||
      echo "$package"
  done
}

install_missing() {
  if ! command -v apt-get >/dev/null; then
    say "This system has no apt-get. libdsc needs a C and a C++20 compiler, CMake 3.25, Ninja and"
    printf '     %s\n' 'Eigen 3.4' 'OpenMesh' 'zlib' 'Expat' 'METIS' 'muParser' 'fmt' 'Spectra' 'oneTBB' 'CLI11' \
      'nlohmann-json' 'three.js r111'
    [[ $mode != test ]] || printf '     %s\n' 'GoogleTest' 'Python 3' 'CHOLMOD, of SuiteSparse' 'OpenBLAS' 'CGAL 5.5' 'Chromium' 'Node.js'
    [[ $mode != test && $mode != docs ]] || printf '     %s\n' 'doxygen 1.9.4'
    [[ " $* " != *mathjax* ]] || printf '     %s\n' 'MathJax 2, in /usr/share/javascript/mathjax (the pages alone need no more than these two and CMake)'
    [[ $mode != test && $mode != benchmarks ]] || printf '     %s\n' 'Google Benchmark'
    [[ " $* " != *libembree* ]] || printf '     %s\n' 'Embree 3' 'libpng 1.6'
    [[ " $* " != *insighttoolkit* ]] || printf '     %s\n' 'ITK 5'
    [[ " $* " != *openvdb* ]] || printf '     %s\n' 'OpenVDB 10, with the headers of Boost'
    say "Going on with what is there."
    return
  fi
  local missing
  mapfile -t missing < <(missing_packages "$@")
  ((${#missing[@]})) || return 0
  say "Installing: ${missing[*]}"
  local as_root=()
  if ((EUID != 0)); then
    if ! command -v sudo >/dev/null; then
      say "Neither root nor sudo: let root run" >&2
      echo "apt-get install --no-install-recommends ${missing[*]}" >&2
      exit 1
    fi
    as_root=(sudo)
  fi
  local apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq
    -o Acquire::Retries=3 -o DPkg::Lock::Timeout=300 -o Dpkg::Use-Pty=0)
  "${apt[@]}" update
  "${apt[@]}" install --yes --no-install-recommends "${missing[@]}" </dev/null >/dev/null
}

# One compiler a core, as far as memory goes: Eigen's templates take about 1 GB each.
build_jobs() {
  local cores memory
  cores=$(getconf _NPROCESSORS_ONLN 2>/dev/null || echo 1)
  memory=$(awk '/^MemAvailable:/ {print int($2 / 1000000)}' /proc/meminfo 2>/dev/null || true)
  ((${memory:-$cores} >= cores)) || cores=$((memory > 1 ? memory : 1))
  echo "$cores"
}

# configure_and_build <preset> [<cmake option>…]
configure_and_build() {
  local preset=$1
  shift
  say "Configuring build/$preset"
  cmake --preset "$preset" "$@" --log-level=WARNING
  say "Building"
  cmake --build --preset "$preset" --parallel "$(build_jobs)"
}

# build_program [<cmake option>…]: the program and the library, as users run them.
build_program() { configure_and_build release -DDSC_BUILD_TESTS=OFF -DDSC_BUILD_EXAMPLES=OFF "$@"; }

(($# >= 1)) || usage
mode=$1
shift
case $mode in
  demo)
    (($# <= 1)) || usage
    input=
    if (($# == 1)); then
      [[ -r $1 && (-f $1 || -d $1) ]] || { echo "bootstrap.sh: $1: no such file" >&2; exit 2; }
      input=$(realpath -- "$1")
    fi
    cd "$(dirname "${BASH_SOURCE[0]}")/.."
    packages=("${library_packages[@]}" "${picture_packages[@]}")
    with_readers=()
    case ${input,,} in
      *.nii | *.nii.gz | *.nrrd | *.nhdr | *.mha | *.mhd | *.tif | *.tiff) with_readers=(-DDSC_WITH_ITK=ON) ;;
      *.vdb) with_readers=(-DDSC_WITH_OPENVDB=ON) ;;
    esac
    [[ ! -d $input ]] || with_readers=(-DDSC_WITH_ITK=ON)
    [[ ${with_readers[*]} != *ITK* ]] || packages+=("${image_packages[@]}")
    [[ ${with_readers[*]} != *OPENVDB* ]] || packages+=("${vdb_packages[@]}")
    install_missing "${packages[@]}"
    build_program -DDSC_WITH_PICTURES=ON "${with_readers[@]}"
    exec ./cmake/demo.sh build/release/bin/dsc ${input:+"$input"}
    ;;
  atlas)
    (($# == 0)) || usage
    cd "$(dirname "${BASH_SOURCE[0]}")/.."
    install_missing "${library_packages[@]}" "${image_packages[@]}" "${picture_packages[@]}" mricron-data
    build_program -DDSC_WITH_PICTURES=ON -DDSC_WITH_ITK=ON
    exec ./cmake/atlas.sh build/release/bin/dsc
    ;;
  test)
    (($# == 0)) || usage
    cd "$(dirname "${BASH_SOURCE[0]}")/.."
    install_missing "${library_packages[@]}" "${test_packages[@]}"
    configure_and_build dev
    say "Testing"
    exec ctest --preset dev --no-tests=error --output-on-failure -j2
    ;;
  figures)
    (($# == 0)) || usage
    cd "$(dirname "${BASH_SOURCE[0]}")/.."
    install_missing "${library_packages[@]}"
    build_program
    exec ./cmake/figures.sh build/release/bin/dsc
    ;;
  pictures)
    (($# == 0)) || usage
    cd "$(dirname "${BASH_SOURCE[0]}")/.."
    install_missing "${library_packages[@]}" "${picture_packages[@]}"
    build_program -DDSC_WITH_PICTURES=ON
    exec ./cmake/pictures.sh build/release/bin/dsc
    ;;
  packages)
    (($# == 0)) || usage
    cd "$(dirname "${BASH_SOURCE[0]}")/.."
    install_missing "${library_packages[@]}" "${picture_packages[@]}"
    build_program -DDSC_WITH_PICTURES=ON
    cd build/release
    exec cpack
    ;;
  benchmarks)
    (($# == 0)) || [[ $# == 1 && $1 == --quick ]] || usage
    cd "$(dirname "${BASH_SOURCE[0]}")/.."
    install_missing "${library_packages[@]}" "${benchmark_packages[@]}"
    build_program -DDSC_BUILD_BENCHMARKS=ON
    bin=build/release/bin
    exec "$bin/dsc_benchmark_report" "$@" "$bin/dsc_benchmarks" "$bin/dsc" tests/benchmarks
    ;;
  docs)
    (($# == 0)) || usage
    cd "$(dirname "${BASH_SOURCE[0]}")/.."
    install_missing "${docs_packages[@]}"
    command -v doxygen >/dev/null || { echo "bootstrap.sh: docs need doxygen" >&2; exit 1; }
    exec cmake -DDOXYGEN="$(command -v doxygen)" -DMATHJAX=/usr/share/javascript/mathjax -DROOT="$PWD" \
      -DOUTPUT="$PWD/build/docs" -P docs/doxygen.cmake
    ;;
  *) usage ;;
esac
