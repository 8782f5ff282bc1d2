#!/usr/bin/env bash
# Meshes through `pdc mesh` and through `vdb_tool -mesh2ls -ls2mesh` of OpenVDB, on lattices of the same voxels: a table
# of time, distances both ways, creases, volume and soundness. usage: bench/mesh_input_eval.sh DATA (a folder of
# meshes); needs build/release with mesh_creases, and vdb_tool.
set -euo pipefail
cd "$(dirname "$0")/.."
data=$1 pdc=build/release/apps/pdc creases=build/release/bench/mesh_creases
scratch=$(mktemp -d)
trap 'rm -r "$scratch"' EXIT

# Seconds of a command, the least of three runs.
seconds() {
  local best=1e9 i
  for i in 1 2 3; do
    best=$(python3 -c 'import subprocess, sys, time
begin = time.perf_counter()
subprocess.run(sys.argv[2:], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
print(min(float(sys.argv[1]), time.perf_counter() - begin))' "$best" "$@")
  done
  echo "$best"
}

# vdb_tool reads no .off.
as_obj() {
  awk 'NR == 1 { next } /^#/ || NF == 0 { next } !counts { counts = 1; vertices = $1; next }
       seen < vertices { print "v", $1, $2, $3; ++seen; next }
       { print "f", $2 + 1, $3 + 1, $4 + 1 }' "$1" >"$2"
}

# NAME VOXEL SECONDS MESH GIVEN: a row of the table.
row() {
  local sound=no
  "$pdc" check "$4" --quiet >/dev/null 2>&1 && sound=yes
  "$pdc" info "$4" --reference "$5" --samples 200000 --quiet --json "$scratch/facts.json" >/dev/null
  "$pdc" info "$5" --quiet --json "$scratch/given.json" >/dev/null
  local crease
  read -r crease _ < <("$creases" "$5" "$4" "$2")
  python3 - "$1" "$2" "$3" "$sound" "$crease" "$scratch/facts.json" "$scratch/given.json" <<'PYTHON'
import json, sys
name, voxel, seconds, sound, crease = sys.argv[1], float(sys.argv[2]), float(sys.argv[3]), *sys.argv[4:6]
facts, given = (json.load(open(path)) for path in sys.argv[6:])
there, back = facts["reference"]["to_reference"], facts["reference"]["from_reference"]
closed = given["boundary_edges"] == given["non_manifold_edges"] == 0
volume = f'{100 * (abs(facts["volume"]) / abs(given["volume"]) - 1):+.3f} %' if closed else "-"
print(f'| {name} | {seconds:.2f} | {max(there["rms"], back["rms"]) / voxel:.4f} | '
      f'{max(there["largest"], back["largest"]) / voxel:.2f} | {crease} | {volume} | {sound} |')
PYTHON
}

echo "| mesh, voxels, by | seconds | RMS distance | largest distance | creases | volume | sound |"
echo "|---|---|---|---|---|---|---|"
for name in fandisk_13k.off cgal_joint.off wingnut_cad.obj cad_angle_block.stl cad_featuretype.stl \
  cad_cycloidal_assembly.ply stanford_bun_zipper_res2.ply plane_holes.obj cgal_elephant-with-holes.off; do
  given=$data/$name
  peer=$given
  if [[ "$name" == *.off ]]; then
    peer=$scratch/given.obj
    as_obj "$given" "$peer"
  fi
  for voxels in 64 128; do
    took=$(seconds "$pdc" mesh "$given" "$scratch/pdc.ply" --resolution "$voxels" --quiet --json "$scratch/report.json")
    voxel=$(python3 -c 'import json, sys; print(json.load(open(sys.argv[1]))["mesh"]["voxel_size"])' "$scratch/report.json")
    row "$name, $voxels, pdc" "$voxel" "$took" "$scratch/pdc.ply" "$given"
    if ! vdb_tool -read "$peer" -mesh2ls "voxel=$voxel" -ls2mesh -write "$scratch/vdb.ply" >/dev/null 2>&1; then
      echo "| $name, $voxels, vdb_tool | does not read it | | | | | |"
      continue
    fi
    took=$(seconds vdb_tool -read "$peer" -mesh2ls "voxel=$voxel" -ls2mesh -write "$scratch/vdb.ply")
    row "$name, $voxels, vdb_tool" "$voxel" "$took" "$scratch/vdb.ply" "$given"
  done
done
