# SPDX-License-Identifier: BSD-3-Clause
# shellcheck shell=bash
# What run.sh and test.sh share. To be sourced, after cd to the top of the project.

# Jobs for the build: one per core, but no more than memory allows (about 1.5 GB each).
jobs_of_machine() {
  local cores available
  cores=$(nproc)
  available=$(awk '/^MemAvailable:/ { print int($2 / 1500000) }' /proc/meminfo 2>/dev/null || true)
  if [[ -n $available ]] && ((available < cores)); then
    cores=$((available > 0 ? available : 1))
  fi
  echo "$cores"
}

# configure_into <folder> [<cmake argument>...]
configure_into() {
  local folder=$1 cache=$1/CMakeCache.txt
  shift
  local arguments=(-S . -B "$folder" -DCMAKE_BUILD_TYPE=Release "$@")
  if [[ -f $cache ]] && ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$(pwd -P)" "$cache"; then
    arguments+=(--fresh)  # the project was moved or copied with its build folder
  fi
  if command -v ninja >/dev/null && { [[ ! -f $cache ]] || [[ ${arguments[-1]} == --fresh ]]; }; then
    arguments+=(-G Ninja)
  fi
  cmake "${arguments[@]}" </dev/null
}

# build_in <folder> [<cmake --build argument>...]
build_in() {
  local folder=$1
  shift
  cmake --build "$folder" --parallel "$(jobs_of_machine)" "$@" </dev/null
}
