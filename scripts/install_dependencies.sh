#!/usr/bin/env bash
# Installs what Quadrille needs from Debian or Ubuntu packages; what is there already is left alone.
set -euo pipefail

packages=(
  cmake ninja-build g++ ccache
  libcgal-dev libeigen3-dev libboost-dev libboost-program-options-dev libtbb-dev
  libsuitesparse-dev libalglib-dev coinor-libcbc-dev
  # A fast BLAS that several threads may call at once, which OpenBLAS's serial package does not allow.
  libopenblas-dev
  libgmsh-dev libtet1.5-dev nlohmann-json3-dev
  libgtest-dev libbenchmark-dev
  librsvg2-bin # rsvg-convert, for pictures in PNG
)

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  echo "install_dependencies.sh: this is not a Debian or Ubuntu system. Install these packages by your own means:" >&2
  printf '  %s\n' "${packages[@]}" >&2
  exit 1
fi

missing=()
for package in "${packages[@]}"; do
  state=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$state" = installed ] || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then
  echo "dependencies: all installed"
  exit 0
fi

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "install_dependencies.sh: run this as root, or install sudo, to install: ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi

echo "dependencies: installing ${missing[*]}"
log=$(mktemp)
trap 'rm -f "$log"' EXIT
apt_get() {
  if ! "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -y "$@" >"$log" 2>&1; then
    cat "$log" >&2
    echo "install_dependencies.sh: apt-get $1 failed (see above)" >&2
    exit 1
  fi
}
apt_get update
apt_get install --no-install-recommends "${missing[@]}"
echo "dependencies: installed"
