"""An array of distances becomes a mesh: a box whose edges stay sharp, and the noise that each vertex is left with."""

import sys

import numpy as np

import pdc

small = "--small" in sys.argv  # For a quick look.
n = 24 if small else 96
step = 2 / (n - 1)
x, y, z = np.mgrid[-1 : 1 : n * 1j, -1 : 1 : n * 1j, -1 : 1 : n * 1j]

# Signed distances to a turned box, with a little noise.
turn = np.array([[0.8, -0.6, 0], [0.48, 0.64, -0.6], [0.36, 0.48, 0.8]])
q = np.abs(np.stack([x, y, z], -1) @ turn.T) - 0.55
distances = np.linalg.norm(np.maximum(q, 0), axis=-1) + np.minimum(q.max(-1), 0)
distances += np.random.default_rng(1).normal(0, 0.02 * step, distances.shape)

mesh = pdc.contour(distances, spacing=step, origin=(-1, -1, -1), confidence=True)
print(mesh, pdc.check(mesh))
print("confidence from", mesh.confidence.min(), "to", mesh.confidence.max())

mesh.save("array.ply")
picture = pdc.render(mesh, size=(320, 320), view=(1, -1.4, 0.9), edges=small)
pdc.write_png("array.png", picture)
