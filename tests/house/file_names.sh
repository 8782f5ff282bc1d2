#!/usr/bin/env bash
# Sources are lower_snake, every header has its guard, and every source is in a CMakeLists.txt. Usage: file_names.sh ROOT
set -euo pipefail
cd "$1"

complaints=$(
  find include src apps python tests \( -name '*.h' -o -name '*.cpp' \) |
    grep -vE '/[a-z0-9]+(_[a-z0-9]+)*\.(h|cpp)$' | sed 's/$/: not lower_snake/'
  grep -rLx --include='*.h' '#pragma once' include src apps python tests | sed 's/$/: no #pragma once/'
  for folder in src apps python tests; do
    built=$(find "$folder" -name CMakeLists.txt -exec cat {} +)
    while IFS= read -r source; do
      [[ "$built" == *[/\ ]"${source##*/}"* ]] || echo "$source: in no CMakeLists.txt, so never built"
    done < <(find "$folder" -name '*.cpp')
  done
) || true
[[ -z "$complaints" ]] || { echo "$complaints"; exit 1; }
