#!/usr/bin/env bash
# Installs what is missing, builds to build/, runs the program.
#   ./run.sh                      fits configs/r228.yaml and lists its family
#   ./run.sh COMMAND CONFIG ...   build/howl COMMAND CONFIG ...
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$root/cmake/build.sh"
howl_install_packages
# On a new machine the first fit does not wait until all is compiled.
if [ "${1:-fit}" = fit ] && [ ! -x "$root/build/howl" ]; then
  howl_build "$root" howl_fit
  [ $# -eq 0 ] || exec "$root/build/howl_fit" "$@"
  "$root/build/howl_fit" fit "$root/configs/r228.yaml"
  howl_build "$root" howl
else
  howl_build "$root" howl
  [ $# -eq 0 ] || exec "$root/build/howl" "$@"
  "$root/build/howl" fit "$root/configs/r228.yaml"
fi
"$root/build/howl" family "$root/configs/r228.yaml"
exec "$root/build/howl" list "$root/configs/r228.yaml"
