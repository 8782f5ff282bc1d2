"""A fog becomes a solid in steps, and its surface gets the values of another grid."""

import sys

import numpy as np

import pdc

n = 32 if "--small" in sys.argv else 112
x, y, z = np.mgrid[-1 : 1 : n * 1j, -1 : 1 : n * 1j, -1 : 1 : n * 1j]
step = 2 / (n - 1)
place = dict(spacing=step, origin=(-1, -1, -1))

# Density of a cloud, full of specks, and a temperature that rises.
points = np.stack([x, y, z], -1).reshape(-1, 3)
noise = pdc.simplex_noise(seed=5, octaves=5, frequency=1.6)(points).reshape(x.shape)
density = np.clip(0.8 - 1.4 * np.sqrt(x**2 + y**2 + z**2) + 0.7 * noise, 0, None).astype(np.float32)
fog = pdc.Grid.from_array(density, grid_class="fog", **place)
temperature = pdc.Grid.from_array((z + 0.3 * noise).astype(np.float32), **place)

solid = fog.fog_to_level_set(0.3).smooth(2 * step, filter="gaussian").keep().clip([(-1, -1, -1), (1, 0.1, 1)])
for done in solid.steps:
    print(f"{done['name']} {done['parameter']}: {done['voxels_after']} active voxels")

mesh = pdc.contour(solid, attributes={"temperature": temperature})
print(mesh, mesh["temperature"].min(), "to", mesh["temperature"].max())
picture = pdc.render(mesh, size=(320, 320), view=(0.6, 1.4, 0.7), shading="temperature")
pdc.write_png("steps.png", picture)
