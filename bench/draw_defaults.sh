#!/usr/bin/env bash
# Draws the pictures of docs/defaults.md. usage: bench/draw_defaults.sh DATA (the folder of the .vdb files); needs
# build/release with PDC_BUILD_BENCH.
set -euo pipefail
cd "$(dirname "$0")/.."
data=$1 pdc=build/release/apps/pdc meshes=build/release/bench/peer_meshes
scratch=$(mktemp -d)
trap 'rm -r "$scratch"' EXIT

draw() {
  local name=$1 input=$2
  shift 2
  "$meshes" "$input" "$scratch/pdc.ply" "$scratch/vtm.ply"
  for peer in pdc vtm; do
    "$pdc" render "$scratch/$peer.ply" "docs/pictures/defaults_${name}_$peer.png" --size 360x360 "$@"
  done
}

draw smoke "$data/ovdb_smoke.vdb" --view front
draw droplets droplets
draw sphere sphere_10
draw icosahedron "$data/ovdb_icosahedron.vdb"
draw fandisk "$data/derived_fandisk_ls_half_mask.vdb"
draw scan "$data/derived_bunny_ls_f32_blosc.vdb" --view 0.3,0.4,1
