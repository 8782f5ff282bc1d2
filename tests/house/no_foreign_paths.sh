#!/usr/bin/env bash
# No file mentions an absolute path of somebody's own machine. Usage: no_foreign_paths.sh ROOT
set -euo pipefail
cd "$1"

# The brackets keep this file from finding itself.
readonly forbidden='(^|[^[:alnum:]_.~-])/(wor[k]|roo[t]|hom[e]|User[s]|tm[p]/build)(/|$|[^[:alnum:]_-])'
found=$(grep -rIlE "$forbidden" --exclude-dir=.git --exclude=.git --exclude-dir=build --exclude-dir=out . || true)
if [[ -n "$found" ]]; then
  echo "absolute paths of a machine in:"
  grep -nE "$forbidden" $found
  exit 1
fi
