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
# Measured records and practice rigs are optional: the tests that read them skip, saying so,
# where these folders are absent.
if [ -d "$root/../shared/realdata" ]; then
  export HOWL_DATA=${HOWL_DATA:-$(cd "$root/../shared/realdata" && pwd)}
fi
if [ -d "$root/../shared/practice" ]; then
  export HOWL_PRACTICE=${HOWL_PRACTICE:-$(cd "$root/../shared/practice" && pwd)}
fi
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
