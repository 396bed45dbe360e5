#!/usr/bin/env bash
# Builds everything and runs every test; ends with the test runner's summary.
#   ./check.sh           what must pass before a change goes in
#   ./check.sh --tidy    the same, with clang-tidy over every source file (slow)
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source "$root/cmake/build.sh"
howl_install_packages
# A browser tests the report's page; without one that test skips, saying so.
howl_install_packages "${howl_browser_packages[@]}" ||
  echo "no browser could be installed: the report's page is not tested" >&2
# The Python package is tested where these are; without them its test skips, saying so.
howl_install_packages "${howl_python_packages[@]}" ||
  echo "the Python package is not tested" >&2
howl_install_packages "${howl_docs_packages[@]}" ||
  echo "mkdocs could not be installed: the site made of docs/ is not tested" >&2
# Tests of measured records and practice rigs read the folders that HOWL_DATA and
# HOWL_PRACTICE name (docs/development.md); where one is not set, its tests skip, saying so.
cd "$root"
find . -path './build*' -prune -o \( -name '*.h' -o -name '*.cc' \) -print0 |
  xargs -0 clang-format --dry-run -Werror
howl_build "$root" all
if [ "${1:-}" = --tidy ]; then
  find . \( -path './build*' -o -path ./tests -o -path ./bench \) -prune -o -name '*.cc' -print0 |
    xargs -0 -n 4 -P "$(nproc)" clang-tidy -p build --quiet
fi
cd "$root/build"
exec ctest --output-on-failure --timeout 300 -j "$(nproc)" -LE long
