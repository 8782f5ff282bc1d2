#!/usr/bin/env bash
# Nothing includes a higher floor: looks at every #include line of include/pdc, src and apps.
# Usage: floors.sh ROOT
set -euo pipefail
cd "$1"

declare -A floor_of=([math]=0 [mesh]=1 [field]=2 [sample]=3 [extract]=4 [io]=5)
readonly ground=-1 apps=6

# The floor of a path below include/pdc or src, or of the text of an #include: by its folder; files beside the folders
# (pdc/error.h) are the ground that everything stands on.
floor() {
  local folder=${1%%/*}
  if [[ "$1" != */* ]]; then
    echo "$ground"
  elif [[ -n "${floor_of[$folder]-}" ]]; then
    echo "${floor_of[$folder]}"
  else
    echo "unknown folder '$folder' in $1" >&2
    return 1
  fi
}

failures=0
checked=0
check() {
  local file=$1 own=$2 included
  while IFS= read -r included; do
    checked=$((checked + 1))
    if (($(floor "$included") > own)); then
      echo "$file includes a higher floor: $included"
      failures=$((failures + 1))
    fi
  done < <(sed -nE 's|^ *# *include "(pdc/)?([^"]+)".*|\2|p' "$file")
}

while IFS= read -r file; do
  path=${file#include/pdc/}
  check "$file" "$(floor "${path#src/}")"
done < <(find include/pdc src -name '*.h' -o -name '*.cpp')
for file in apps/*.h apps/*.cpp; do check "$file" "$apps"; done

echo "$checked includes, $failures to a higher floor"
((failures == 0 && checked > 100))
