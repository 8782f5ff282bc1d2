#!/usr/bin/env python3
"""Times array to mesh: pdc (through dense_bench) beside scikit-image and OpenVDB's Python module, where installed.

Usage: dense_peers.py DENSE_BENCH [N] [REPEATS]
"""

import subprocess
import sys
import tempfile
import time

import numpy as np


def best(repeats, work):
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        result = work()
        times.append(time.perf_counter() - start)
    return min(times), result


def volumes(n):
    at = (2 * np.arange(n, dtype=np.float32) - n + 1.3) / n
    x, y, z = np.meshgrid(at, at, at, indexing="ij", sparse=True)
    r = np.sqrt(x * x + y * y + z * z)
    yield "sphere, float32", ((r - 0.7) * (n / 2)).astype(np.float32), 0.0
    noise = np.random.default_rng(1).normal(0, 40, (n, n, n))
    scan = np.where(r < 0.8, 1040, 10) + np.where(np.abs(r - 0.5) < 0.05, 800, 0) + noise
    yield "scan, uint16", np.maximum(0, scan).astype(np.uint16), 525.5


def peers():
    try:
        from skimage.measure import marching_cubes

        yield "skimage.marching_cubes", lambda v, iso: len(marching_cubes(v, iso)[0])
    except ImportError:
        print("scikit-image is not installed", file=sys.stderr)
    try:
        try:
            import pyopenvdb as vdb
        except ImportError:
            import openvdb as vdb

        def openvdb_mesh(v, iso):
            grid = vdb.FloatGrid()
            grid.copyFromArray(v.astype(np.float32, copy=False))
            return len(grid.convertToQuads(isovalue=iso)[0])

        yield "pyopenvdb", openvdb_mesh
    except ImportError:
        print("pyopenvdb is not installed", file=sys.stderr)


def main():
    program = sys.argv[1]
    n = int(sys.argv[2]) if len(sys.argv) > 2 else 256
    repeats = int(sys.argv[3]) if len(sys.argv) > 3 else 3
    for name, values, iso in volumes(n):
        with tempfile.NamedTemporaryFile(suffix=".raw") as file:
            values.tofile(file.name)
            command = [program, "--raw", file.name, "--type", str(values.dtype), "--iso", str(iso), "--size"]
            command += [str(s) for s in values.shape] + ["--repeats", str(repeats)]
            seconds, vertices = subprocess.run(command, check=True, capture_output=True, text=True).stdout.split()
        own = float(seconds)
        print(f"{name}, {n}³: pdc {1e3 * own:.1f} ms, {vertices} vertices")
        for peer, mesh in peers():
            time_of_peer, points = best(repeats, lambda: mesh(values, iso))
            print(f"  {peer}: {1e3 * time_of_peer:.1f} ms, {points} vertices, {time_of_peer / own:.1f} times as long")


if __name__ == "__main__":
    main()
