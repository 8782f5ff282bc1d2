"""A volume like those of a scanner: whole numbers, voxels higher than wide, a matrix that says where they are."""

import sys

import numpy as np

import pdc

n = 40 if "--small" in sys.argv else 160
x, y, z = np.mgrid[-1 : 1 : n * 1j, -1 : 1 : n * 1j, -1 : 1 : (n // 2) * 1j]


def soft(distance):
    """1 inside, 0 outside, blurred as by a scanner."""
    return 0.5 * (1 - np.tanh(distance * n / 4))


skull = np.abs(np.sqrt(x**2 + (y / 1.1) ** 2 + (z / 1.05) ** 2) - 0.75) - 0.06
tissue = np.sqrt(x**2 + (y / 1.1) ** 2 + (z / 1.05) ** 2) - 0.85
window = np.sqrt((x - 0.6) ** 2 + (y + 0.6) ** 2 + (z - 0.3) ** 2) - 0.5
values = -1000 + 1040 * soft(tissue) + 1100 * soft(np.maximum(skull, -window))
values += np.random.default_rng(2).normal(0, 25, values.shape)
volume = np.asfortranarray(values.astype(np.int16))  # As files of scanners lie in memory.

# Left and posterior are positive in the scanner's frame; to the frame where right and anterior are.
affine = np.diag([-200 / (n - 1), -200 / (n - 1), 200 / (n // 2 - 1), 1])
affine[:3, 3] = 100, 100, -100

bone = pdc.contour(volume, level=600, inside="high", grid_class="fog", affine=affine, triangles=True)
print(bone, "in mm:", bone.vertices.min(0), "to", bone.vertices.max(0))

bone = pdc.decimate(bone, ratio=0.2)
bone.save("bone.stl")
picture = pdc.render(bone, size=(320, 320), view=(-1, 1.2, 0.6))
pdc.write_png("ct_volume.png", picture)
