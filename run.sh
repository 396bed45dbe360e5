#!/usr/bin/env bash
# Installs what is missing, builds to build/, runs the program.
#   ./run.sh                      fits configs/r228.yaml and lists its family
#   ./run.sh COMMAND CONFIG ...   build/howl COMMAND CONFIG ...
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$root/cmake/build.sh"
howl_install_packages
howl_build "$root" howl
if [ $# -gt 0 ]; then
  exec "$root/build/howl" "$@"
fi
"$root/build/howl" fit "$root/configs/r228.yaml"
"$root/build/howl" family "$root/configs/r228.yaml"
exec "$root/build/howl" list "$root/configs/r228.yaml"
