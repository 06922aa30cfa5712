#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
set -euo pipefail

usage() {
  cat <<'TEXT'
usage: scripts/test.sh [--all]

Installs what is missing, builds with warnings as errors (into build/) and runs the tests through CTest,
the MPI ones on 1, 2, 3 and 4 ranks; then configures core alone, without MPI (into build-core/).

  --all       also the tests labelled "slow"; and builds core alone and runs its tests
  -h, --help  this text

Exit status: 0 all passed, 1 something failed, 2 wrong option.
TEXT
}

skip=slow
case "${1:-}" in
  "") ;;
  --all) skip= ;;
  -h | --help) usage; exit 0 ;;
  *) echo "test.sh: unknown option '$1' (see --help)" >&2; exit 2 ;;
esac

cd "$(dirname "${BASH_SOURCE[0]}")/.."
# shellcheck source=scripts/common.sh
source scripts/common.sh

failed=()
times=()
# step <name> <command>...: runs it, keeps its time, and its name if it fails.
step() {
  local name=$1 start=$SECONDS
  shift
  echo "--- $name"
  "$@" || failed+=("$name")
  times+=("$name $((SECONDS - start)) s")
}
summary() {
  local text
  text=$(printf '%s, ' "${times[@]}")
  if ((${#failed[@]} > 0)); then
    echo "test.sh: FAILED (${failed[*]}) after $SECONDS s: ${text%, }"
    exit 1
  fi
  echo "test.sh: all passed in $SECONDS s: ${text%, }"
}
# needed <name> <command>...: a step without which nothing else makes sense.
needed() {
  step "$@"
  if ((${#failed[@]} > 0)); then
    summary
  fi
}
# configure, build <folder> [<cmake argument>...]
configure() {
  configure_into "$@" -DCDCA_WARNINGS_AS_ERRORS=ON -DBUILD_TESTING=ON
}
build() {
  configure "$@" && build_in "$1"
}
# run_tests <folder> [<label to leave out>...]
run_tests() {
  local folder=$1 labels
  shift
  labels=$(IFS='|'; echo "$*")
  ctest --test-dir "$folder" --output-on-failure --no-tests=error -j "$(nproc)" \
    ${labels:+-LE "^($labels)\$"} </dev/null
}

needed set-up bash scripts/setup.sh
needed build build build
step tests run_tests build ${skip:+"$skip"}
if [[ -n $skip ]]; then
  # its objects would be those of the build above, where core and its tests are linked without MPI
  step core-only-configuration configure build-core -DCDCA_WITH_MPI=OFF
else
  step core-only-build build build-core -DCDCA_WITH_MPI=OFF
  step core-only-tests run_tests build-core house
fi
summary
