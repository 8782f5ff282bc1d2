"""Noisy points without normals become a surface, and that a solid with a part cut out."""

import sys

import numpy as np

import pdc

small = "--small" in sys.argv
n = 4000 if small else 40000
torus = pdc.torus(1, 0.4)

# Points of the volume about a torus, drawn onto it, with the noise of a scanner.
random = np.random.default_rng(4)
points = random.uniform((-1.5, -1.5, -0.5), (1.5, 1.5, 0.5), (5 * n, 3))
points = points[abs(torus(points)) < 0.1][:n]
points -= torus(points)[:, None] * torus.gradient(points)
points += random.normal(0, 0.01, points.shape)

surface = pdc.reconstruct(points, close=True)
print(surface, "of", surface.report["gaussians"], "Gaussians")
off = abs(torus(surface.vertices))
print(f"{off.mean():.4f} from the torus in the mean, the points {abs(torus(points)).mean():.4f}")

solid = pdc.mesh_field(surface) - pdc.box((2, 2, 2), center=(1, -1, 0))
mesh = pdc.contour(solid, box=[(-1.5, -1.5, -0.6), (1.5, 1.5, 0.6)], resolution=32 if small else 128)
picture = pdc.render(mesh, size=(320, 320), view=(0.8, -1.4, 1))
pdc.write_png("points.png", picture)
