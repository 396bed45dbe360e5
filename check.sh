#!/usr/bin/env bash
# Builds everything and runs every test; ends with the test runner's summary.
#   ./check.sh                  what must pass before a change goes in
#   ./check.sh --tidy-changed   the same, with clang-tidy over the sources that a change touches
#   ./check.sh --tidy           the same, with clang-tidy over every source file (an hour)
#   ./check.sh --sanitize       the same, then the quick tests under the address and undefined
#                               behaviour sanitizers (an hour)
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
also=${1:-}
case $also in
  '' | --tidy | --tidy-changed | --sanitize) ;;
  *)
    echo "check.sh: $also: expected --tidy, --tidy-changed, --sanitize or nothing" >&2
    exit 2
    ;;
esac
source "$root/cmake/build.sh"
source "$root/cmake/tidy.sh"
howl_install_packages "${howl_check_packages[@]}"
# A browser tests the report's page; without one that test skips, saying so.
howl_install_packages "${howl_browser_packages[@]}" ||
  echo "no browser could be installed: the report's page is not tested" >&2
# The Python package is tested where these are; without them its test skips, saying so.
howl_install_packages "${howl_python_packages[@]}" ||
  echo "the Python package is not tested" >&2
howl_install_packages "${howl_docs_packages[@]}" ||
  echo "mkdocs could not be installed: the site made of docs/ is not tested" >&2
howl_install_packages "${howl_install_test_packages[@]}" ||
  echo "manual pages, completion or packages are tested in part" >&2
# Tests of measured records and practice rigs read the folders that HOWL_DATA and
# HOWL_PRACTICE name (docs/development.md); where one is not set, its tests skip, saying so.
cd "$root"
tests/structure/check_format.sh "$root"  # A test as well; here it fails before the build.
howl_build "$root" all
case $also in
  --tidy)
    mapfile -d '' -t sources < <(find "${howl_tidy_folders[@]}" -name '*.cc' -print0)
    howl_tidy "${sources[@]}"
    ;;
  --tidy-changed) howl_tidy_changed ;;
esac
if [ "$also" = --sanitize ]; then
  (cd build && ctest --output-on-failure --timeout 300 -j "$(nproc)" -LE long)
  cmake --preset sanitize >/dev/null
  cmake --build --preset sanitize
  exec ctest --preset sanitize -j "$(nproc)"
fi
cd "$root/build"
exec ctest --output-on-failure --timeout 300 -j "$(nproc)" -LE long
