#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
set -euo pipefail

usage() {
  cat <<'TEXT'
usage: scripts/run.sh [CASE.toml] [-n RANKS] [-- CDCA_ARGUMENT...]

Installs what is missing, builds (Release, into build/) and runs a case under mpirun.
Results go to results/<case name>/ in the project's folder.

  CASE.toml        the case file; default examples/two_cracks.toml
  -n, --np RANKS   number of MPI ranks; default 2
  -h, --help       this text
  --               what follows goes to "cdca run" as it is

Exit status: that of cdca (0 done, 2 input wrong, 3 did not converge, 4 I/O failed); 1 set-up or build failed.
TEXT
}

fail() {
  echo "run.sh: $1" >&2
  exit 2
}

case_file=
ranks=2
extra=()
while (($# > 0)); do
  case $1 in
    -h | --help) usage; exit 0 ;;
    -n | --np)
      (($# >= 2)) || fail "$1 needs the number of ranks"
      ranks=$2
      shift ;;
    -n[0-9]*) ranks=${1#-n} ;;
    --) shift; extra=("$@"); break ;;
    -*) fail "unknown option '$1' (arguments for cdca go after --; see --help)" ;;
    *)
      [[ -z $case_file ]] || fail "one case at a time: '$case_file' and '$1'"
      [[ -n $1 ]] || fail "the name of the case file is empty"
      case_file=$1 ;;
  esac
  shift
done
[[ $ranks =~ ^[1-9][0-9]*$ ]] || fail "the number of ranks must be a whole number from 1, not '$ranks'"

top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)
case_file=${case_file:-$top/examples/two_cracks.toml}
if [[ ! -f $case_file && $case_file != /* && -f $top/$case_file ]]; then
  case_file=$top/$case_file
fi
[[ -f $case_file ]] || fail "there is no case file '$case_file'"
case_file=$(realpath "$case_file")
name=$(basename "$case_file")
name=${name%.toml}

cd "$top"
# shellcheck source=scripts/common.sh
source scripts/common.sh
bash scripts/setup.sh
configure_into build
build_in build --target cdca

# Works as root, in containers, beside other runs and with more ranks than cores; own settings win.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_rmaps_base_oversubscribe="${OMPI_MCA_rmaps_base_oversubscribe:-1}"
export PRTE_MCA_rmaps_default_mapping_policy="${PRTE_MCA_rmaps_default_mapping_policy:-:oversubscribe}"
export OMPI_MCA_hwloc_base_binding_policy="${OMPI_MCA_hwloc_base_binding_policy:-none}"
export OMPI_MCA_btl_vader_single_copy_mechanism="${OMPI_MCA_btl_vader_single_copy_mechanism:-none}"
if ((ranks > $(nproc))); then
  export OMPI_MCA_mpi_yield_when_idle="${OMPI_MCA_mpi_yield_when_idle:-1}"
fi

results=results/$name
mkdir -p "$results"
started=$(mktemp)
trap 'rm -f "$started"' EXIT
status=0
mpirun --quiet -n "$ranks" build/bin/cdca run "$case_file" -o "$results/" "${extra[@]}" </dev/null || status=$?

written() { find "$results" -maxdepth 1 -name "$1" -newer "$started" | sort; }
echo
if ((status != 0)); then
  echo "cdca ended with status $status"
fi
echo "Results:   $top/$results/"
written '*.png' | sed "s|^|Picture:   $top/|"
written 'fields.pvd' | sed "s|^|ParaView:  $top/|"
exit "$status"
