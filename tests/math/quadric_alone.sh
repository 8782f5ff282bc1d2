#!/usr/bin/env bash
# The header of quadrics alone, in a source of one line: it must compile with nothing but an include path, without warnings,
# and pull in nothing but its own floor and the standard library.
# usage: quadric_alone.sh COMPILER INCLUDE_DIR
set -euo pipefail

compile() { echo '#include <pdc/math/quadric.h>' | "$1" -std=c++20 -Wall -Wextra -Werror -x c++ -I "$2" "${@:3}" -; }

compile "$1" "$2" -fsyntax-only
# The preprocessor's line markers name every file that was read.
foreign=$(compile "$1" "$2" -E | grep -o '^# [0-9]* "[^"]*"' | cut -d'"' -f2 | sort -u | grep -v /pdc/math/ |
  grep -e /pdc/ -e /openvdb/ -e /tbb/ -e /Eigen/ -e /OpenMesh/ -e /fmt/ -e /boost/ || true)
if [[ -n "$foreign" ]]; then
  echo "pdc/math/quadric.h includes"
  echo "$foreign"
  exit 1
fi
