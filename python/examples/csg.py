"""Solids put together, with a function of NumPy among them."""

import sys

import numpy as np

import pdc

resolution = 32 if "--small" in sys.argv else 128


def waves(points):
    """The space below a wavy surface."""
    return points[:, 2] - 0.35 - 0.08 * np.sin(6 * points[:, 0]) * np.cos(6 * points[:, 1])


def slope(points):
    """The gradient of waves()."""
    x, y, _ = points.T
    return np.stack([-0.48 * np.cos(6 * x) * np.cos(6 * y), 0.48 * np.sin(6 * x) * np.sin(6 * y), np.ones_like(x)], -1)


block = pdc.rounded_box((2, 2, 1.4), 0.1) & pdc.function(waves, gradient=slope, lipschitz=1.3)
hole = pdc.cylinder((0, 0, -1), (0, 0, 1), 0.28)
holes = hole | hole.translate((0.55, 0.55, 0))
part = block - holes - pdc.capsule((-1.2, 0, 0), (1.2, 0, 0), 0.15)

mesh = pdc.contour(part, box=[(-1.1, -1.1, -0.8), (1.1, 1.1, 0.8)], resolution=resolution)
print(mesh, pdc.check(mesh))
mesh.save("csg.ply")
picture = pdc.render(mesh, size=(320, 320), view=(1, -1.4, 1.1))
pdc.write_png("csg.png", picture)
