#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs the Debian packages that the project needs and that are missing: as root, or through sudo
# where that works without a password; otherwise prints the one line to ask an administrator for.
# Removes nothing. CDCA_SETUP=skip leaves the machine as it is.
#
# usage: setup.sh [PACKAGE...]   more packages that are wanted
set -euo pipefail

if [[ ${CDCA_SETUP:-} == skip ]]; then
  exit 0
fi
if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  echo "set-up: this is no Debian system; going on with what is installed. scripts/setup.sh lists what is needed." >&2
  exit 0
fi

# The names of all installed packages, each between newlines.
read_installed() {
  installed=$'\n'$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' | sed -n 's/^installed //p')$'\n'
}
is_installed() {
  [[ $installed == *$'\n'"$1"$'\n'* ]]
}

read_installed
packages=(
  g++ cmake ninja-build git python3                    # to build
  libopenmpi-dev openmpi-bin libmetis-dev libeigen3-dev libblis-serial-dev libhdf5-openmpi-dev zlib1g-dev
  libtomlplusplus-dev libmuparser-dev libcli11-dev libfmt-dev libspdlog-dev nlohmann-json3-dev
  python3-matplotlib python3-numpy python3-h5py        # pictures
  libgtest-dev libbenchmark-dev clang-format-14        # tests
  "$@"
)

# VTK comes with ParaView, or alone. The Python sides of the two exclude each other: keep what is there.
paraview=(paraview-dev xvfb xauth libgl1-mesa-dri)
if is_installed python3-vtk9; then
  if is_installed paraview-dev; then packages+=("${paraview[@]}"); else packages+=(libvtk9-dev); fi
elif is_installed libvtk9-dev && ! is_installed paraview-dev; then
  packages+=(libvtk9-dev)
else
  packages+=("${paraview[@]}" python3-paraview)
fi

missing=()
for package in "${packages[@]}"; do
  is_installed "$package" || missing+=("$package")
done
if ((${#missing[@]} == 0)); then
  echo "set-up: all ${#packages[@]} packages are installed"
  exit 0
fi

install=(apt-get -o DPkg::Lock::Timeout=300 install -y --no-install-recommends --no-remove "${missing[@]}")
if ((EUID == 0)); then
  as_root=(env DEBIAN_FRONTEND=noninteractive)
elif command -v sudo >/dev/null && sudo -n true 2>/dev/null; then
  as_root=(sudo -n env DEBIAN_FRONTEND=noninteractive)
else
  echo "set-up: ${#missing[@]} packages are missing. Please ask an administrator to run, as root:" >&2
  echo "apt-get update && apt-get install -y --no-install-recommends --no-remove ${missing[*]}" >&2
  exit 1
fi

echo "set-up: installing ${#missing[@]} packages (on a bare system this takes some minutes): ${missing[*]}"
log=$(mktemp)
trap 'rm -f "$log"' EXIT
quietly() {  # apt's long report is shown only when it fails
  if ! "$@" >"$log" 2>&1 </dev/null; then
    cat "$log" >&2
    echo "set-up: FAILED: $*" >&2
    exit 1
  fi
}
start=$SECONDS
quietly "${as_root[@]}" apt-get -o DPkg::Lock::Timeout=300 update
quietly "${as_root[@]}" "${install[@]}"
read_installed
for package in "${missing[@]}"; do
  if ! is_installed "$package"; then
    echo "set-up: FAILED: $package is still not installed" >&2
    exit 1
  fi
done
echo "set-up: done in $((SECONDS - start)) s"
