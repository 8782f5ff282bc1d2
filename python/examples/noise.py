"""What sigma_normal does: noise with a ball cut out, for several values, measured and side by side."""

import sys

import numpy as np

import pdc

resolution = 24 if "--small" in sys.argv else 64
field = pdc.difference(
    pdc.sphere(1) & pdc.simplex_noise(seed=7, octaves=5, frequency=1.5, amplitude=0.4).offset(0.15),
    pdc.sphere(0.7, center=(0.6, -0.6, 0.4)),
)
sigmas = [0, 0.1, 0.25, np.inf]
report, meshes = pdc.sweep(field, "sigma_normal", sigmas, box=2.2, resolution=resolution, placement="free", meshes=True)
for step in report["steps"]:
    print(f"sigma_normal {step['sigma_n']}: vertices {step['vertex_rms']:.3f} voxels off, "
          f"{step['self_intersections']} pairs of triangles intersect")
print(report["reason"])

pictures = [pdc.render(mesh, size=(240, 240), view=(1, -1, 0.7)) for mesh in meshes]
pdc.write_png("noise.png", np.concatenate(pictures, axis=1))
