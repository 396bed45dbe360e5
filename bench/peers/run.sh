#!/bin/sh
# Makes a virtual environment with the peers, as pinned in requirements.txt, and runs every comparison:
#
#   bench/peers/run.sh BUILD/howl [options of run.py, as --out DIR or --quick]
#
# HOWL_PEERS_VENV: where the environment is made (default: bench/peers/venv). A peer that cannot be
# installed is left out, and the table says so. jitcdde compiles, and needs a C compiler.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
if [ $# -lt 1 ]; then
  echo "run.sh: expected the program, as build/howl" >&2
  exit 2
fi
howl=$1
shift
venv=${HOWL_PEERS_VENV:-$here/venv}
[ -x "$venv/bin/python" ] || python3 -m venv "$venv"
grep -v -e '^#' -e '^$' "$here/requirements.txt" | while read -r peer; do
  "$venv/bin/pip" install --quiet --disable-pip-version-check "$peer" </dev/null ||
    echo "could not be installed: $peer" >&2
done
exec "$venv/bin/python" "$here/run.py" --howl "$howl" "$@"
