#!/usr/bin/env bash
# bare_debian.sh BUILD PROJECT: installs the packages of BUILD into a Debian 12 that has nothing else
# (debootstrap's minbase), and runs howl there: R228 from fit to report, compared with the stored figures,
# and the example of find_package(howl) with libhowl-dev. HOWL_BARE_DEBIAN may name a tar archive of such a
# Debian, which saves the downloading of its base; HOWL_DEBIAN_MIRROR another mirror.
# Exit status 77 (skipped), saying so, without debootstrap, without root or where no mirror answers.
set -euo pipefail
build=$1
project=$2
mirror=${HOWL_DEBIAN_MIRROR:-http://deb.debian.org/debian}
skip() {
  echo "skipped: $1"
  exit 77
}
[ "$(id -u)" -eq 0 ] || skip "only root can enter another Debian"
[ -n "${HOWL_BARE_DEBIAN:-}" ] || command -v debootstrap >/dev/null || skip "debootstrap is not installed"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
bare=$scratch/debian
mkdir "$bare"
if [ -n "${HOWL_BARE_DEBIAN:-}" ]; then
  tar -C "$bare" -xf "$HOWL_BARE_DEBIAN"
elif ! debootstrap --variant=minbase bookworm "$bare" "$mirror" >"$scratch/log" 2>&1; then
  tail -5 "$scratch/log"
  skip "debootstrap could not make a Debian 12 from $mirror"
fi
(cd "$build" && cpack -B "$scratch/made" >/dev/null)
mkdir "$bare/packages"
cp "$scratch"/made/*.deb "$bare/packages"
cp -r "$project/results/r228" "$bare/reference"
cp "$project/tests/install/in_bare_debian.sh" "$bare"
# In a space of mounts of its own, so that nothing is left mounted.
unshare --mount --propagation private bash -euc \
  'mount -t proc proc "$0/proc"; exec env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin chroot "$0" bash /in_bare_debian.sh' \
  "$bare"
