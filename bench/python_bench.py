#!/usr/bin/env python3
"""The table of docs/python.md: pdc beside scikit-image and pyopenvdb, from arrays to arrays, in one process.

Times are the best of several runs, the libraries in turn; processor seconds are those of all threads. Peak memory is that of a process of its own that makes the
array and contours it once, less that of one that makes the array only. Needs python3-skimage and python3-openvdb.
Usage: PYTHONPATH=build/release/python bench/python_bench.py [N]
"""

import subprocess
import sys
import time

import numpy as np


def volumes(n):
    """Arrays of n³ floats, with the level, by name; made on first use."""

    def axes():
        return np.meshgrid(*[np.linspace(-1, 1, n, dtype=np.float32)] * 3, indexing="ij", sparse=True)

    def sphere():
        x, y, z = axes()
        return np.sqrt(x * x + y * y + z * z) - np.float32(0.8)

    def box():
        x, y, z = axes()
        return np.maximum(np.maximum(abs(x), abs(y)), abs(z)) - np.float32(0.7)

    def scan():
        """Edges blurred over some three voxels, as by a scanner, with noise of a tenth of a voxel."""
        x, y, z = axes()
        waves = np.sin(9 * x) * np.cos(9 * y) + np.sin(9 * y) * np.cos(9 * z) + np.sin(9 * z) * np.cos(9 * x)
        voxels = waves * np.float32(n / 2 / 9 / 1.5)
        noise = np.random.default_rng(1).normal(0, 30, waves.shape)
        return (500 * np.tanh(voxels / 1.5) + noise).astype(np.float32)

    return {"sphere": sphere, "noisy scan": scan, "box": box}


def with_pdc(array):
    import pdc

    mesh = pdc.contour(array, 0.0)
    return mesh.vertices, mesh.quads


def with_skimage(array):
    from skimage.measure import marching_cubes

    return marching_cubes(array, 0.0)[:2]


def with_openvdb(array):
    import pyopenvdb

    grid = pyopenvdb.FloatGrid()
    grid.copyFromArray(array)
    return grid.convertToQuads(isovalue=0.0)


MAKERS = {"pdc": with_pdc, "scikit-image": with_skimage, "pyopenvdb": with_openvdb}


def peak(n, volume, maker):
    """Peak memory in MiB of a process that makes the array, and contours it if there is a maker."""
    command = [sys.executable, "-W", "ignore", __file__, "--peak", str(n), volume, maker]
    result = subprocess.run(command, check=True, capture_output=True)
    return float(result.stdout)


def measure_peak(n, volume, maker):
    array = volumes(n)[volume]()
    # What it took to make the array must not hide what contouring takes.
    open("/proc/self/clear_refs", "w").write("5")
    if maker != "none":
        MAKERS[maker](array)
    line = next(line for line in open("/proc/self/status") if line.startswith("VmHWM"))
    print(int(line.split()[1]) / 1024)


def time_function(n):
    """A sphere as a function of NumPy, contoured, and sampled on the whole lattice."""
    import pdc

    def f(points):
        return np.sqrt((points * points).sum(axis=1)) - 1

    axis = np.linspace(-1.25, 1.25, n + 1)
    works = {
        "contoured": lambda: pdc.contour(f, box=2.5, resolution=n),
        "sampled": lambda: f(np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), -1).reshape(-1, 3)),
    }
    best = dict.fromkeys(works, float("inf"))
    for _ in range(7):
        for name, work in works.items():
            begin = time.perf_counter()
            work()
            best[name] = min(best[name], time.perf_counter() - begin)
    print(f"\nA function of NumPy at {n}³: contoured in {best['contoured']:.3f} s, sampled on the lattice in "
          f"{best['sampled']:.3f} s: {best['contoured'] / best['sampled']:.1f} times.")


def main(n):
    print("| volume | library | seconds | processor seconds | vertices | faces | times pdc | peak memory, MiB |")
    print("|---|---|---|---|---|---|---|---|")
    for volume, make in volumes(n).items():
        array = make()
        best = dict.fromkeys(MAKERS, float("inf"))
        work = dict.fromkeys(MAKERS, float("inf"))
        sizes = {}
        for _ in range(5):
            for name, maker in MAKERS.items():
                begin, worked = time.perf_counter(), time.process_time()
                vertices, faces = maker(array)[:2]
                best[name] = min(best[name], time.perf_counter() - begin)
                work[name] = min(work[name], time.process_time() - worked)
                sizes[name] = len(vertices), len(faces)
                del vertices, faces
        for name in MAKERS:
            more = peak(n, volume, name) - peak(n, volume, "none")
            print(f"| {volume} | {name} | {best[name]:.3f} | {work[name]:.3f} | {sizes[name][0]} | {sizes[name][1]} "
                  f"| {best[name] / best['pdc']:.1f} | {more:.0f} |", flush=True)
    time_function(n // 2)


if __name__ == "__main__":
    if "--peak" in sys.argv:
        measure_peak(int(sys.argv[2]), *sys.argv[3:5])
    else:
        main(int(sys.argv[1]) if len(sys.argv) > 1 else 256)
