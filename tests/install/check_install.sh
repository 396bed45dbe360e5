#!/usr/bin/env bash
# check_install.sh SOURCE BUILD: installs BUILD into a folder of its own, then builds and runs a
# project against it with find_package(howl). The project includes every header that was installed.
set -euo pipefail
source_folder=$1
build_folder=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cmake --install "$build_folder" --prefix "$scratch/prefix" >/dev/null
"$scratch/prefix/bin/howl" --version
cmake -S "$source_folder/tests/install" -B "$scratch/build" -G Ninja \
  -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$scratch/prefix" >/dev/null
cmake --build "$scratch/build"
"$scratch/build/consumer"
