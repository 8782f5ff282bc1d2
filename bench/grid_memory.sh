#!/usr/bin/env bash
# Peak memory of steps on grids, in grids: what a process takes with a step over what it takes to read the grid and
# write it again, less what a tiny grid takes. Also on a box of 500 voxels. Usage: grid_memory.sh PDC [FILE.vdb …]
set -euo pipefail
pdc=$(readlink -f "$1")
readonly pdc
files=()
for file in "${@:2}"; do files+=("$(readlink -f "$file")"); done
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
cd "$folder"

# Vertices and quads of the box from 0 to $1 along each axis.
box() {
  local x y z
  for x in 0 "$1"; do for y in 0 "$1"; do for z in 0 "$1"; do echo "v $x $y $z"; done; done; done
  printf 'f %s\n' '1 2 4 3' '5 7 8 6' '1 5 6 2' '3 4 8 7' '1 3 7 5' '2 6 8 4'
}

# Kilobytes at the peak.
peak() { /usr/bin/time -f %M "$pdc" "$@" --quiet 2>&1 >/dev/null | tail -1; }

box 8 >tiny.obj
box 500 >box500.obj
for name in tiny box500; do "$pdc" grid "$name.obj" "$name.vdb" --mesh-to-level-set 1 --quiet; done
program=$(peak grid tiny.vdb out.vdb)

echo '| grid | MB | clip | resample | smooth | keep | all four | all four, then the mesh |'
echo '|---|---|---|---|---|---|---|---|'
for file in box500.vdb "${files[@]}"; do
  once=$(peak grid "$file" out.vdb)
  voxel=$("$pdc" info "$file" | awk '/voxel size/ {print $3; exit}')
  middle=$("$pdc" info "$file" | awk -v h="$voxel" '/index lo/ {a = $3} /index hi/ {print h * (a + $3) / 2; exit}')
  clip=(--clip "$middle,-1e6,-1e6,1e6,1e6,1e6")
  resample=(--resample "$(awk -v h="$voxel" 'BEGIN {print 1.25 * h}')")
  smooth=(--smooth "gaussian:$(awk -v h="$voxel" 'BEGIN {print 1.25 * h}')")
  keep=(--keep largest)
  all=("${clip[@]}" "${resample[@]}" "${smooth[@]}" "${keep[@]}")
  row="| $(basename "$file" .vdb) | $(((once - program) / 1000)) |"
  grids() { awk -v p="$1" -v o="$once" -v b="$program" 'BEGIN {printf " %.1f |", (p - b) / (o - b)}'; }
  row+=$(grids "$(peak grid "$file" out.vdb "${clip[@]}")")
  row+=$(grids "$(peak grid "$file" out.vdb "${resample[@]}")")
  row+=$(grids "$(peak grid "$file" out.vdb "${smooth[@]}")")
  row+=$(grids "$(peak grid "$file" out.vdb "${keep[@]}")")
  row+=$(grids "$(peak grid "$file" out.vdb "${all[@]}")")
  row+=$(grids "$(peak mesh "$file" out.ply "${all[@]}")")
  echo "$row"
done
