#!/usr/bin/env bash
# Every name in ctest's list can be read, typed and filtered by. Usage: test_names.sh BUILD_FOLDER
set -euo pipefail

names=$(ctest --test-dir "$1" -N | sed -nE 's/^ *Test +#[0-9]+: //p')
if bad=$(grep -E -e '-byte object|[^A-Za-z0-9_./<> -]' <<<"$names"); then
  echo "names that nobody can read:"
  echo "$bad"
  exit 1
fi
count=$(wc -l <<<"$names")
echo "$count names"
((count > 20))
