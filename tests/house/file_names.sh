#!/usr/bin/env bash
# Sources are lower_snake, every header has its guard, and every source is in a CMakeLists.txt. Usage: file_names.sh ROOT
set -euo pipefail
cd "$1"

failures=0
complain() {
  echo "$1"
  failures=$((failures + 1))
}

while IFS= read -r file; do
  name=$(basename "$file")
  [[ "$name" =~ ^[a-z0-9]+(_[a-z0-9]+)*\.(h|cpp)$ ]] || complain "$file: not lower_snake"
  [[ "$name" == *.h && "$(grep -c '^#pragma once$' "$file")" != 1 ]] && complain "$file: no #pragma once"
  if [[ "$name" == *.cpp ]]; then
    grep -qrF "$name" --include=CMakeLists.txt "${file%%/*}" || complain "$file: in no CMakeLists.txt, so never built"
  fi
done < <(find include src apps tests -name '*.h' -o -name '*.cpp')
exit "$((failures > 0))"
