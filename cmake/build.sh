# Sourced by run.sh and check.sh: what a fresh Debian 12 machine needs, and how to build.

# What compiles howl, and what cpack makes packages with.
howl_build_packages=(g++ cmake ninja-build pkg-config dpkg-dev file
  libeigen3-dev libceres-dev libgoogle-glog-dev libgflags-dev libyaml-cpp-dev
  libtbb-dev libboost-dev nlohmann-json3-dev libvalijson-dev
  libmatio-dev libhdf5-dev zlib1g-dev libssl-dev)

# What a report draws its figures with.
howl_run_packages=(gnuplot-nox)

# What check.sh needs besides.
howl_check_packages=(clang-format clang-tidy python3 libmpfi-dev libgtest-dev libgmock-dev
  libbenchmark-dev)

# For the test that drives a report's page in a real browser, which is skipped without them.
howl_browser_packages=(chromium chromium-driver python3-selenium)
# For the test that builds the site from docs/, which is skipped without them (12 MB to fetch).
howl_docs_packages=(mkdocs mkdocs-material)

# For the tests of manual pages, of completion and of the packages; each is skipped without its tool.
howl_install_test_packages=(mandoc zsh fish lintian)

# For the tests of the Python package; its figures and some formats of files need the later ones.
howl_python_packages=(python3-pytest python3-numpy python3-pandas python3-yaml
  python3-matplotlib python3-scipy)

# Installs the packages that are missing of those that run the program and of those named as arguments,
# quietly and without asking; asks no server when none is.
howl_install_packages() {
  local wanted=("${howl_build_packages[@]}" "${howl_run_packages[@]}" "$@")
  local missing=() package
  for package in "${wanted[@]}"; do
    if ! dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed'; then
      missing+=("$package")
    fi
  done
  [ ${#missing[@]} -eq 0 ] && return 0
  echo "installing: ${missing[*]}" >&2
  local as_root=()
  [ "$(id -u)" -eq 0 ] || as_root=(sudo)
  local log
  log=$(mktemp)
  if ! { "${as_root[@]}" apt-get update -qq &&
         DEBIAN_FRONTEND=noninteractive "${as_root[@]}" apt-get install -y -qq \
           --no-install-recommends "${missing[@]}"; } >"$log" 2>&1; then
    cat "$log" >&2
    echo "could not install: ${missing[*]}" >&2
    return 1
  fi
  rm -f "$log"
}

# howl_build ROOT TARGET: configures ROOT/build and builds TARGET. Says on standard error what it does;
# on a terminal the compiler's count runs along, elsewhere it is silent unless something is wrong.
howl_build() {
  local root=$1 target=$2 log
  log=$(mktemp)
  local tests=OFF minutes=7
  case $target in
    all) tests=ON minutes=10 ;;
    howl_fit) minutes=3 ;;
  esac
  [ -e "$root/build/$target" ] || [ -e "$root/build/howl" ] ||
    echo "compiling $target to build/: on two cores some $minutes minutes the first time" >&2
  if ! cmake -S "$root" -B "$root/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON \
       -DHOWL_BUILD_TESTS=$tests -DHOWL_BUILD_BENCH=$tests >"$log" 2>&1; then
    cat "$log" >&2
    return 1
  fi
  if [ -t 2 ]; then
    cmake --build "$root/build" --target "$target" >&2 || return 1
  elif ! cmake --build "$root/build" --target "$target" >"$log" 2>&1; then
    cat "$log" >&2
    return 1
  fi
  rm -f "$log"
}
