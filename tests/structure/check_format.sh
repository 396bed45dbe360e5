#!/usr/bin/env bash
# Every header and source as .clang-format says; names the lines that are not.
set -euo pipefail
cd "$1"
find . -path './build*' -prune -o \( -name '*.h' -o -name '*.cc' \) -print0 |
  xargs -0 clang-format --dry-run -Werror
