#!/usr/bin/env bash
# Nothing includes a higher floor: looks at every #include line of include/pdc, src and apps.
# Usage: floors.sh ROOT
set -euo pipefail
cd "$1"

declare -A floor_of=([math]=0 [mesh]=1 [field]=2 [sample]=3 [extract]=4 [render]=4 [io]=5)
readonly ground=-1 apps=6

# Sets `floor` to that of a path below include/pdc or src, or of the text of an #include: by its folder; files beside the
# folders (pdc/error.h) are the ground that everything stands on.
find_floor() {
  local folder=${1%%/*}
  if [[ "$1" != */* ]]; then
    floor=$ground
  elif [[ -n "${floor_of[$folder]-}" ]]; then
    floor=${floor_of[$folder]}
  else
    echo "unknown folder '$folder' in $1"
    exit 1
  fi
}

failures=0
checked=0
while IFS=: read -r file line; do
  [[ "$line" =~ \"(pdc/)?([^\"]+)\" ]] || continue
  included=${BASH_REMATCH[2]}
  path=${file#include/pdc/}
  if [[ "$file" == apps/* ]]; then
    own=$apps
  else
    find_floor "${path#src/}"
    own=$floor
  fi
  find_floor "$included"
  checked=$((checked + 1))
  if ((floor > own)); then
    echo "$file includes a higher floor: $included"
    failures=$((failures + 1))
  fi
done < <(grep -rE --include='*.h' --include='*.cpp' '^ *# *include "' include/pdc src apps)

echo "$checked includes, $failures to a higher floor"
((failures == 0 && checked > 100))
