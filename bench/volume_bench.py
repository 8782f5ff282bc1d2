#!/usr/bin/env python3
"""Files of dense volumes to meshes: time and memory of `pdc mesh`, next to decompressing the file and contouring a level set
of as many vertices, and next to scikit-image, each a process of its own. Needs numpy, nibabel, tifffile and skimage, and
OpenVDB's Python module for the level set.

Usage: volume_bench.py PDC FOLDER [N] [REPEATS]; FOLDER has to hold some ten times N³ bytes.
"""

import gzip
import json
import math
import multiprocessing
import os
import pathlib
import subprocess
import sys
import time

import numpy as np

ISO = 520.0

SKIMAGE = """
import sys, numpy
from skimage.measure import marching_cubes
path = sys.argv[1]
if path.endswith(".npy"):
    values = numpy.load(path, mmap_mode="r")
elif path.endswith(".tif"):
    import tifffile
    values = tifffile.imread(path)
else:
    import nibabel
    values = numpy.asarray(nibabel.load(path).dataobj)
marching_cubes(values, 520.0)
"""


def scan(n):
    """A head of shells with a pattern like spongy bone, and noise of a tenth of the contrast."""
    at = ((2 * np.arange(n) - n + 1.3) / n).astype(np.float32)
    x, y, z = np.meshgrid(at, at, at, indexing="ij", sparse=True)
    r = np.sqrt(x * x + 1.2 * y * y + z * z)
    values = np.where(r < 0.8, 1040, 10).astype(np.float32)
    sponge = np.sin(25 * x) * np.cos(25 * y) + np.sin(25 * y) * np.cos(25 * z) + np.sin(25 * z) * np.cos(25 * x)
    values = np.where((r < 0.55) & (sponge < 0), 10, values)
    values += np.random.default_rng(1).normal(0, 60, values.shape).astype(np.float32)
    return np.maximum(0, values).astype(np.uint16)


def write_files(folder, n):
    """The files; those that are there already are taken."""
    names = ["scan.nii.gz", "scan.nii", "scan.nrrd", "scan_gzip.nrrd", "scan.npy", "scan.tif"]
    paths = [folder / name for name in names]
    if all(path.exists() for path in paths):
        return paths
    values = scan(n)
    import nibabel
    import tifffile

    image = nibabel.Nifti1Image(values, np.diag([0.5, 0.5, 0.5, 1]))
    nibabel.save(image, paths[0])
    nibabel.save(image, paths[1])
    data = values.tobytes("F")
    for path, encoding in ((paths[2], "raw"), (paths[3], "gzip")):
        header = f"NRRD0004\ntype: uint16\ndimension: 3\nsizes: {n} {n} {n}\nspacings: 0.5 0.5 0.5\nendian: little\n"
        packed = gzip.compress(data, 6) if encoding == "gzip" else data
        path.write_bytes(f"{header}encoding: {encoding}\n\n".encode() + packed)
    np.save(paths[4], values)
    tifffile.imwrite(paths[5], values.T, photometric="minisblack")
    return paths


def run(command, repeats):
    """Least seconds and most memory in MiB; a child's most is no less than what this process held when it began."""
    seconds, memory = math.inf, 0
    for _ in range(repeats):
        begin = time.perf_counter()
        child = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        _, status, usage = os.wait4(child.pid, 0)
        if status != 0:
            raise SystemExit(f"{' '.join(command)}: status {status}")
        seconds = min(seconds, time.perf_counter() - begin)
        memory = max(memory, usage.ru_maxrss / 1024)
    return seconds, memory


def mesh(pdc, path, repeats, *options):
    out, report = path.parent / "out.ply", path.parent / "report.json"
    command = [pdc, "mesh", str(path), str(out), "--quiet", "--json", str(report), *options]
    seconds, memory = run(command, repeats)
    facts = json.loads(report.read_text())
    return seconds, memory, facts["vertices"], out.stat().st_size


def level_set_seconds(pdc, folder, vertices, repeats):
    """Seconds that a level set of a sphere with as many vertices takes to contour and write."""
    try:
        import pyopenvdb as vdb
    except ImportError:
        import openvdb as vdb
    path = folder / "sphere.vdb"
    vdb.write(str(path), grids=[vdb.createLevelSetSphere(radius=math.sqrt(vertices / (6 * math.pi)), voxelSize=1.0)])
    return mesh(pdc, path, repeats)


def main():
    pdc, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    n = int(sys.argv[3]) if len(sys.argv) > 3 else 512
    repeats = int(sys.argv[4]) if len(sys.argv) > 4 else 3
    values_mib = 2 * n**3 / 2**20
    # In a process of its own, so that what it holds does not count below.
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        files = pool.apply(write_files, (folder, n))
    level_set = None
    print(f"{n}³ values of 16 bits, {values_mib:.0f} MiB")
    print("| file | seconds | decompressing | level set | ratio | scikit-image | ratio | peak, MiB | values and mesh, MiB | scikit-image, MiB |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    for path in files:
        seconds, memory, vertices, mesh_bytes = mesh(pdc, path, repeats, "--iso", str(ISO))
        if level_set is None:
            level_set = level_set_seconds(pdc, folder, vertices, repeats)[0]
        packed = path.name.endswith("gz") or "gzip" in path.name
        # Of .nrrd, gzip passes over nothing: what it reads is the .nii.gz, of the same values.
        gz = path if path.name.endswith(".gz") else folder / "scan.nii.gz"
        unpack = run(["gzip", "-dc", str(gz)], repeats)[0] if packed else 0
        row = f"| {path.name} | {seconds:.2f} | {unpack:.2f} | {level_set:.2f} | {seconds / (unpack + level_set):.2f} "
        if path.suffix == ".nrrd":
            row += "| - | - "
            peer_memory = "-"
        else:
            peer, peer_memory = run([sys.executable, "-c", SKIMAGE, str(path)], 1)
            row += f"| {peer:.2f} | {peer / seconds:.1f} "
            peer_memory = f"{peer_memory:.0f}"
        print(f"{row}| {memory:.0f} | {values_mib + mesh_bytes / 2**20:.0f} | {peer_memory} |", flush=True)
    print(f"{vertices} vertices")


if __name__ == "__main__":
    main()
