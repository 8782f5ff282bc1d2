"""A grid of pyopenvdb becomes a mesh, and an array a grid of pyopenvdb."""

import sys

import numpy as np

import pdc

try:
    import openvdb as vdb
except ImportError:
    import pyopenvdb as vdb

voxel = 0.05 if "--small" in sys.argv else 0.02
ball = vdb.createLevelSetSphere(radius=1.0, voxelSize=voxel)
mesh = pdc.contour(ball)
print(mesh, pdc.check(mesh))

# The values around it, cut in NumPy, and back into a grid.
grid = pdc.Grid.from_openvdb(ball)
values = grid.to_array()
lo, _ = grid.active_box
x, y, z = np.mgrid[tuple(slice(0, n) for n in values.shape)]
index = np.stack([x, y, z], -1) + lo
world = index @ grid.affine[:3, :3].T + grid.affine[:3, 3]
cut = np.maximum(values, (0.3 - np.abs(world[..., 0])).astype(values.dtype))
affine = grid.affine.copy()
affine[:3, 3] += affine[:3, :3] @ lo
halves = pdc.Grid.from_array(cut, affine=affine, background=grid.background, grid_class="level-set")
back = halves.to_openvdb()
print(type(back), back.activeVoxelCount(), "active voxels")

picture = pdc.render(pdc.contour(halves), size=(320, 320), view=(0.6, -1.4, 0.7))
pdc.write_png("openvdb_there_and_back.png", picture)
