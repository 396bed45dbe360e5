# Sourced by check.sh: clang-tidy over sources.

howl_tidy_folders=(app diagnosis estimation io model rig trial)
# Of a change the files with the most changed lines: half a minute each, two at a time.
howl_tidy_most=12

# howl_tidy FILE...: fails on a finding. It reads the commands of the preset tidy, which is configured
# but not built: they have no option that GCC alone knows.
howl_tidy() {
  [ $# -gt 0 ] || return 0
  cmake --preset tidy >/dev/null
  printf '%s\0' "$@" | xargs -0 -r -n 1 -P "$(nproc)" clang-tidy -p build-tidy --quiet
}

# The commit that a change is compared with: where it left main, or else the one before it. Fails
# where there is neither, as in a clone of depth one.
howl_change_base() {
  local main base
  for main in origin/main main; do
    if base=$(git merge-base HEAD "$main" 2>/dev/null) && [ "$base" != "$(git rev-parse HEAD)" ]; then
      echo "$base"
      return 0
    fi
  done
  git rev-parse --verify --quiet HEAD~1 2>/dev/null
}

# The sources that changed, those with the most changed lines first. A header stands for the source
# beside it.
howl_changed_sources() {
  git diff --numstat --diff-filter=d "$1" -- "${howl_tidy_folders[@]}" | sort -rn |
    awk -F '\t' '{ sub(/\.h$/, ".cc", $3); if ($3 ~ /\.cc$/ && !seen[$3]++) print $3 }' |
    while IFS= read -r source; do [ ! -f "$source" ] || echo "$source"; done
}

howl_tidy_changed() {
  local base sources
  if ! base=$(howl_change_base); then
    echo "no earlier commit is here to compare with: clang-tidy is left out" >&2
    return 0
  fi
  mapfile -t sources < <(howl_changed_sources "$base")
  if [ ${#sources[@]} -gt "$howl_tidy_most" ]; then
    echo "clang-tidy over $howl_tidy_most of ${#sources[@]} changed sources; --tidy takes all" >&2
  fi
  howl_tidy "${sources[@]:0:$howl_tidy_most}"
}
