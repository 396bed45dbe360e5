#!/usr/bin/env bash
# check_install.sh SOURCE BUILD: installs BUILD into a folder of its own, then builds and runs a
# project against it with find_package(howl).
set -euo pipefail
source_folder=$1
build_folder=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cmake --install "$build_folder" --prefix "$scratch/prefix" >/dev/null
"$scratch/prefix/bin/howl" --version
configure() {
  cmake -S "$source_folder/tests/install" -B "$scratch/$1" -G Ninja -DHOWL_CONSUMER_LANGUAGES="$2" \
    -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$scratch/prefix" >/dev/null
}
configure with_c "C;CXX"
configure build CXX
cmake --build "$scratch/build"
"$scratch/build/consumer"
