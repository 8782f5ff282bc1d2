#!/usr/bin/env bash
# The installed package can be imported, without the build. Usage: installed_test.sh BUILD PYTHON FOLDER_BELOW_PREFIX
set -euo pipefail
readonly build=$1 python=$2 folder=$3

prefix=$(mktemp -d)
trap 'rm -rf "$prefix"' EXIT
cmake --install "$build" --prefix "$prefix" --component python >/dev/null
cd "$prefix"
PYTHONPATH="$prefix/$folder" PYTHONDONTWRITEBYTECODE=1 "$python" - "$prefix" <<'EOF'
import sys

import pdc

assert pdc.__file__.startswith(sys.argv[1]), pdc.__file__
mesh = pdc.contour(pdc.sphere(1), box=2.5, resolution=16)
assert pdc.check(mesh).clean
print(pdc.__version__, mesh)
EOF
test -f "$prefix/$folder/pdc/py.typed" -a -f "$prefix/$folder/pdc/_core.pyi"
