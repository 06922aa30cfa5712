#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Checks that the sources are formatted as .clang-format says; --fix formats them in place.
# Exit status: 0 yes, 1 no, 77 clang-format 14 is not installed (another version breaks lines differently).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

tool=
for candidate in clang-format-14 clang-format; do
  if "$candidate" --version 2>/dev/null | grep -q 'version 14\.'; then
    tool=$candidate
    break
  fi
done
if [[ -z $tool ]]; then
  echo "clang-format 14 is not installed: not checked"
  exit 77
fi

folders=(core parallel io drivers tests benchmarks)
if git rev-parse --is-inside-work-tree >/dev/null 2>&1; then
  mapfile -d '' files < <(git ls-files -z -- "${folders[@]/%//*.hpp}" "${folders[@]/%//*.cpp}")
else
  mapfile -d '' files < <(find "${folders[@]}" \( -name '*.hpp' -o -name '*.cpp' \) -print0 | sort -z)
fi
if ((${#files[@]} == 0)); then
  echo "no sources found"
  exit 1
fi

if [[ ${1:-} == --fix ]]; then
  "$tool" -i "${files[@]}"
else
  "$tool" --dry-run --Werror "${files[@]}"
fi
echo "${#files[@]} files"
