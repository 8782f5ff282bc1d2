#!/usr/bin/env bash
# Files of options: the same bytes as with the options themselves; what is given besides comes first; what was given is written; bad
# files are an error of one line. Usage: options_file_test.sh PDC SCENES_DIR
set -euo pipefail
pdc=$(realpath "$1") scene=$(realpath "$2")/rotated_box.yaml
scratch=$(mktemp -d)
trap 'rm -r "$scratch"' EXIT
cd "$scratch"

fail() {
  echo "options: $*"
  exit 1
}

# usage: refuse TEXT FILE-CONTENT
refuse() {
  local said
  printf '%b' "$2" >bad.yaml
  said=$("$pdc" mesh "$scene" no.ply --options bad.yaml 2>&1) && fail "no error: $2"
  [[ "$said" == "pdc: bad.yaml"*"$1"* && $(wc -l <<<"$said") == 1 ]] || fail "$2: $said"
  [[ ! -e no.ply ]] || fail "$2: a mesh was written"
}

"$pdc" mesh "$scene" a.ply --resolution 16 --sigma-n 0.1 --triangles --save-options saved.yaml --json a.json --quiet
[[ "$(cat saved.yaml)" == $'# Options of pdc mesh\nsigma-n: 0.1\ntriangles: true\nresolution: 16' ]] || fail "$(cat saved.yaml)"
"$pdc" mesh "$scene" b.ply --options saved.yaml --quiet
cmp a.ply b.ply
grep -A4 '"options"' a.json | tr -d ' \n' | grep -q '"options":{"sigma-n":"0.1","triangles":"true","resolution":"16"}' ||
  fail "$(cat a.json)"

"$pdc" mesh "$scene" c.ply --options=saved.yaml --resolution 12 --quiet --save-options again.yaml
"$pdc" mesh "$scene" d.ply --resolution 12 --sigma-n 0.1 --triangles --quiet
cmp c.ply d.ply
grep -q "resolution: 12" again.yaml || fail "$(cat again.yaml)"

printf 'sigma-n: [0.05, 0.1]\nvoxel-size: 0.2\nquiet: true\n' >sweep.yaml
"$pdc" sweep "$scene" sweep --options sweep.yaml
[[ "$(cut -d, -f1 sweep/sweep.csv | tr '\n' ' ')" == "sigma_n 0.05 0.1 " ]] || fail "$(cat sweep/sweep.csv)"

refuse "did you mean '--sigma-n'" 'sigma: 2\n'
refuse ":2: triangles is true or false" 'quiet: true\ntriangles: maybe\n'
refuse "is a value or a list of values" 'resolution: {a: 1}\n'
refuse "is not a map" '- 1\n'
refuse "end of sequence" 'resolution: [1\n'
said=$("$pdc" mesh "$scene" no.ply --options missing.yaml 2>&1) && fail "no error for a missing file"
[[ "$said" == "pdc: missing.yaml: cannot be opened" ]] || fail "$said"
echo "options: as on the command line"
