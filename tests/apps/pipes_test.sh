#!/usr/bin/env bash
# Standard input and output in place of files: the same bytes as with files, of each kind of input; nothing but data on standard
# output; damaged, empty and unknown input; readers that stop. Usage: pipes_test.sh PDC SCENES_DIR
set -euo pipefail
pdc=$(realpath "$1") scenes=$(realpath "$2")
scratch=$(mktemp -d)
trap 'rm -r "$scratch"' EXIT
cd "$scratch"
export TMPDIR=$scratch/tmp
mkdir tmp

fail() {
  echo "pipes: $*"
  exit 1
}

# Runs a command that has to fail in one line that holds TEXT. usage: refuse TEXT COMMAND…
refuse() {
  local text=$1 said
  shift
  said=$("$@" 2>&1 >out) && fail "no error: $*"
  [[ "$said" == *"$text"* && $(wc -l <<<"$said") == 1 ]] || fail "$*: $said"
  [[ ! -s out ]] || fail "$* wrote to standard output"
}

"$pdc" mesh "$scenes/rotated_box.yaml" box.ply --resolution 20 --quiet
"$pdc" mesh - - --format ply --resolution 20 <"$scenes/rotated_box.yaml" >piped.ply 2>said
cmp box.ply piped.ply
grep -q "^standard output: .* vertices" said || fail "no summary: $(cat said)"

# Each kind of mesh and, by way of a mesh, a grid.
for suffix in ply obj off stl ply.gz obj.gz; do
  "$pdc" smooth box.ply "smooth.$suffix" --sigma 0.1 --quiet
  "$pdc" smooth - - --sigma 0.1 --quiet --format "$suffix" <box.ply | cmp - "smooth.$suffix"
  "$pdc" info - --json - --quiet <"smooth.$suffix" | grep -q '"file": "standard input"' || fail "info of .$suffix"
done
"$pdc" grid box.ply box.vdb --mesh-to-level-set 0.2 --quiet
"$pdc" grid - - --format vdb --mesh-to-level-set 0.2 --quiet <box.ply | "$pdc" mesh - - --format .ply --quiet |
  "$pdc" decimate - small.ply --ratio 0.5 --quiet
"$pdc" mesh box.vdb of_grid.ply --quiet
"$pdc" decimate of_grid.ply expected.ply --ratio 0.5 --quiet
cmp small.ply expected.ply

refuse "nothing tells what its bytes are" "$pdc" mesh - x.ply < <(echo hello)
refuse "is empty" "$pdc" mesh - x.ply </dev/null
refuse "needs --format" "$pdc" mesh box.vdb -
refuse "not the suffix of a mesh" "$pdc" mesh box.vdb - --format xyz
refuse "No space left" bash -c '"$0" mesh box.vdb - --format ply --quiet >/dev/full' "$pdc"
refuse "standard input" "$pdc" mesh - x.ply --quiet < <(head -c 3000 box.vdb)

# A reader that stops ends the writer by its signal, and quietly.
set +e
"$pdc" mesh box.vdb - --format obj --quiet 2>said | head -c 10 >/dev/null
status=${PIPESTATUS[0]}
set -e
[[ "$status" == 141 || "$status" == 0 ]] || fail "exit status $status of a broken pipe"
[[ ! -s said ]] || fail "a broken pipe says $(cat said)"
[[ -z "$(ls tmp)" ]] || fail "left behind: $(ls tmp)"
echo "pipes: as files"
