#!/usr/bin/env bash
# Prints the SHA-256 of what a build of pdc makes of all scenes and grids, with all kinds of options: two builds that
# print the same lines behave the same. Usage: hash_outputs.sh PROGRAM [FOLDER_OF_DATA]
set -euo pipefail
pdc=$(readlink -f "$1")
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.."
readonly pdc data=${2:-../shared/data}

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

show() { printf '%s  %s\n' "$(sha256sum <"$1" | cut -d ' ' -f 1)" "$2"; }

# Contours one input into a mesh of one suffix. What is refused counts too.
contour() {
  local suffix=$1 input=$2 out="$scratch/out.$1"
  shift 2
  "$pdc" mesh "$input" "$out" --quiet "$@" 2>"$scratch/err" || sed "s|$scratch||g" "$scratch/err" >"$out"
  show "$out" "$(basename "$input") .$suffix $*"
  rm -f "$out"
}

scenes=(scenes/*.yaml)
grids=(tests/data/*.vdb "$data"/vdb/*.vdb)
for input in "${scenes[@]}" "${grids[@]}"; do contour ply "$input"; done
for input in "${scenes[@]:0:4}" tests/data/*.vdb; do
  contour ply "$input" --placement free --normals
  contour obj "$input" --placement cell --triangles
  contour ply "$input" --confidence --rank --sigma-n auto
  contour off "$input" --sigma-n 0
  contour stl "$input" --sigma-n inf --triangles
  contour ply "$input" --open --ascii --confidence --rank
done
for input in "${grids[@]:1:6}"; do
  contour ply "$input" --hermite gradient --sigma-n auto --confidence
  contour ply "$input" --hermite distance --rank --threads 1
done
contour ply scenes/csg.yaml --resolution 40
"$pdc" mesh scenes/csg.yaml "$scratch/rated.ply" --confidence --rank --quiet
for options in "--shading normal --edges" "--shading confidence" "--view top"; do
  # shellcheck disable=SC2086
  "$pdc" render "$scratch/rated.ply" "$scratch/picture.png" $options --size 200x160 --quiet
  show "$scratch/picture.png" "csg.yaml .png $options"
done
for command in info check; do
  (cd "$scratch" && "$pdc" $command rated.ply --json report.json) >/dev/null || true
  show "$scratch/report.json" "csg.yaml $command"
done
"$pdc" sweep scenes/csg.yaml "$scratch/sweep" --sigma-n 0,0.1 --voxel-size 0.08 --meshes --quiet
for mesh in "$scratch"/sweep/*.ply; do show "$mesh" "csg.yaml sweep $(basename "$mesh")"; done
