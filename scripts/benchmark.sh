#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
set -euo pipefail

usage() {
  cat <<'TEXT'
usage: scripts/benchmark.sh [--quick] [--install] [GROUP...]

Builds the benchmark programs (Release, into build/), runs them and writes their tables and the picture into
docs/performance.md and docs/performance.png. Best on a machine that does nothing else.

  scaling   set-up and solve on 1 and 2 ranks, memory on 1 and 4
  kernels   the parts of a V-cycle against a triad
  growth    a growth cycle against a cold set-up and solve
  race      the whole solve against CHOLMOD, one core
  windows   how windows may be combined
            no GROUP: all of them (about a quarter of an hour)

  --quick     small grids, one run each: to see that all works; the page goes to build/performance/ instead
  --install   also installs what is missing, with CHOLMOD and a tuned BLAS for the race
  -h, --help  this text

Exit status: 0 done, whatever the numbers; 1 something failed; 2 wrong option.
TEXT
}

all_groups=(scaling kernels growth race windows)
groups=() quick= install=
while (($# > 0)); do
  case $1 in
    --quick) quick=1 ;;
    --install) install=1 ;;
    -h | --help) usage; exit 0 ;;
    *)
      if [[ " ${all_groups[*]} " != *" $1 "* ]]; then
        echo "benchmark.sh: '$1' is neither an option nor one of ${all_groups[*]} (see --help)" >&2
        exit 2
      fi
      groups+=("$1") ;;
  esac
  shift
done
((${#groups[@]} > 0)) || groups=("${all_groups[@]}")

cd "$(dirname "${BASH_SOURCE[0]}")/.."
# shellcheck source=scripts/common.sh
source scripts/common.sh
[[ -z $install ]] || bash scripts/setup.sh libsuitesparse-dev libopenblas0-serial

program() { # <group>: the program it runs
  case $1 in
    growth) echo bench_growth_cycle ;;
    race) echo bench_race_cholmod ;;
    windows) echo bench_window_study ;;
    *) echo "bench_$1" ;;
  esac
}
targets=()
for group in "${groups[@]}"; do
  targets+=("$(program "$group")")
done
configure_into build >/dev/null
for target in "${targets[@]}"; do
  if ! cmake --build build --target help | grep -q "^$target[: ]"; then
    echo "benchmark.sh: $target cannot be built: a library is missing; --install adds it" >&2
    exit 1
  fi
done
build_in build --target "${targets[@]}"

if [[ -n $quick ]]; then
  runs=1 rounds=1 small=40 middle=64 large=80 seconds=0.01
else
  runs=5 rounds=5 small=160 middle=320 large=640 seconds=0.3
fi
folder=build/performance
mkdir -p "$folder"

# Each rank on a core of its own, and no yielding: as it would run on a machine of its own.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_mpi_yield_when_idle=0 OMPI_MCA_btl_vader_single_copy_mechanism=none
cores=$(nproc)
export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1
on_ranks() { # <ranks> <program> <argument>...
  local ranks=$1 placing=(--bind-to core)
  shift
  if ((ranks > cores)); then
    placing=(--oversubscribe --bind-to none --mca mpi_yield_when_idle 1)
  fi
  timeout 1200 mpirun --quiet "${placing[@]}" -n "$ranks" "$@" </dev/null
}

# Hundredths of a second of CPU time: of the whole machine, and of what this script has run.
of_machine() { awk '/^cpu / { print $2 + $3 + $4 + $7 + $8 + $9; exit }' /proc/stat; }
of_ours() { cut -d ' ' -f 14-17 /proc/$$/stat | awk '{ print $1 + $2 + $3 + $4 }'; }
now() { awk '{ print int(100 * $1) }' /proc/uptime; }

run_scaling() {
  build/bin/bench_scaling
  local round nx ranks
  for ((round = 0; round < rounds; ++round)); do
    for nx in "$small" "$large"; do
      for ranks in 1 2; do # in turn, so that a busy minute meets both
        on_ranks "$ranks" build/bin/bench_scaling "$nx" 3 "$runs"
      done
    done
  done
  on_ranks 4 build/bin/bench_scaling "$large" 3 1
}
run_kernels() {
  build/bin/bench_kernels --benchmark_format=csv --benchmark_min_time="$seconds" 2>/dev/null
}
run_growth() {
  build/bin/bench_growth_cycle
  build/bin/bench_growth_cycle "$middle" 3 2 "$runs"
  build/bin/bench_growth_cycle "$middle" 3 6 "$runs"
  build/bin/bench_growth_cycle "$middle" 50 10 "$runs"
}
run_race() {
  build/bin/bench_race_cholmod
  local nx
  for nx in "$small" "$middle" "$large"; do
    build/bin/bench_race_cholmod "$nx" 3 "$runs"
  done
  build/bin/bench_race_cholmod "$middle" 50 "$runs"
}
run_windows() {
  build/bin/bench_window_study
  local cracks
  for cracks in 1 3 50; do # a coarsest scale of 5 x 10 elements, and windows on all others
    build/bin/bench_window_study 80 "$cracks" 70 1 2 3 4 6 8 10 12
  done
}

write_facts() { # <elapsed> <used by all> <used by us>
  local compiler
  compiler=$(sed -n 's/^CMAKE_CXX_COMPILER:[A-Z]*=//p' build/CMakeCache.txt)
  echo "cores=$cores"
  echo "processor=$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1)"
  echo "cache=$(awk '{ print $1 / 1024 " MB" }' /sys/devices/system/cpu/cpu0/cache/index3/size 2>/dev/null || true)"
  echo "compiler=$("$compiler" --version | head -n 1)"
  echo "blas=$(ldd "build/bin/$(program race)" 2>/dev/null | sed -n 's/.*libbl[ai]s[^ ]* => \([^ ]*\).*/\1/p' |
    xargs -r realpath | sed 's|.*/\([^/]*/[^/]*\)$|\1|' | paste -sd+ || true)"
  echo "runs=$runs"
  echo "rounds=$rounds"
  awk -v t="$1" -v others=$(($2 - $3)) 'BEGIN { printf "others=%.2f\n", (others > 0 ? others : 0) / t }'
}

set -E
trap 'echo "benchmark.sh: FAILED: $BASH_COMMAND" >&2; exit 1' ERR
for group in "${groups[@]}"; do
  echo "--- $group"
  start=$(now) machine=$(of_machine) ours=$(of_ours)
  "run_$group" >"$folder/$group.part"
  write_facts $(($(now) - start)) $(($(of_machine) - machine)) $(($(of_ours) - ours)) >"$folder/$group.facts"
  mv "$folder/$group.part" "$folder/$group.csv"
done
page=docs/performance.md
if [[ -n $quick ]]; then
  cp "$page" "$folder/performance.md"
  page=$folder/performance.md
fi
/usr/bin/python3 scripts/benchmark_report.py "$folder" "$page" "${groups[@]}"
