#!/usr/bin/env bash
# Times a sequence of equal frames beside as many runs of their own, in turn, and compares the bytes.
# Usage: sequence_bench.sh PDC FILE.vdb [FRAMES] [OPTION OF pdc mesh …]
set -euo pipefail
readonly pdc=$(readlink -f "$1") file=$(readlink -f "$2") frames=${3:-20}
options=("${@:4}")
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
cd "$folder"
mkdir together alone
for i in $(seq "$frames"); do cp "$file" "$(printf 'in.%04d.vdb' "$i")"; done

seconds() {
  local begin=$EPOCHREALTIME
  "$@"
  echo "$EPOCHREALTIME $begin" | awk '{printf "%.2f", $1 - $2}'
}
together() { "$pdc" mesh in.%04d.vdb together/out.%04d.ply --frames "1-$frames" --quiet "${options[@]}"; }
alone() {
  local i
  for i in $(seq "$frames"); do
    "$pdc" mesh "$(printf 'in.%04d.vdb' "$i")" "$(printf 'alone/out.%04d.ply' "$i")" --quiet "${options[@]}"
  done
}

for round in 1 2 3; do
  one=$(seconds alone)
  all=$(seconds together)
  awk -v one="$one" -v all="$all" -v frames="$frames" \
    'BEGIN {printf "%d frames: %.2f s as a sequence, %.2f s alone, %.2f of that\n", frames, all, one, all / one}'
done
diff -r together alone
echo "equal bytes"
