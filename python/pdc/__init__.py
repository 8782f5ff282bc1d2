"""Volumes to meshes by probabilistic dual contouring.

Arrays, volumes, OpenVDB grids, implicit functions, meshes, points and scenes in; quads or triangles out, with sharp edges and corners where
the volume has them.

>>> import numpy as np, pdc
>>> x, y, z = np.mgrid[-1:1:40j, -1:1:40j, -1:1:40j]
>>> mesh = pdc.contour(np.sqrt(x**2 + y**2 + z**2) - 0.7, spacing=2 / 39, origin=(-1, -1, -1))
>>> pdc.check(mesh).clean
True
"""

from . import _core
from ._arguments import Warning
from ._checks import Check, check, info
from ._contour import contour, sweep
from ._core import Error
from ._field import (
    Field,
    box,
    capped_cone,
    capsule,
    cylinder,
    difference,
    ellipsoid,
    formula,
    function,
    gyroid,
    intersection,
    mesh_field,
    plane,
    rounded_box,
    simplex_noise,
    sphere,
    torus,
    union,
)
from ._grid import Grid, read_grid
from ._mesh import Mesh, read_mesh
from ._points import mixture, reconstruct
from ._render import render, write_png
from ._scene import Scene, scene
from ._verbs import cluster, decimate, smooth, subdivide
from ._volume import Volume, read_volume

__version__: str = _core.version
Error.__module__ = "pdc"
Error.__doc__ = """Data or a request that cannot be served, in one line: what, the value, the limit.

Examples
--------
>>> try:
...     pdc.read_mesh("missing.ply")
... except pdc.Error as error:
...     print(error)
missing.ply: cannot be read: No such file or directory
"""

__all__ = [
    "Check",
    "Error",
    "Field",
    "Grid",
    "Mesh",
    "Scene",
    "Volume",
    "Warning",
    "box",
    "capped_cone",
    "capsule",
    "check",
    "cluster",
    "contour",
    "cylinder",
    "decimate",
    "difference",
    "ellipsoid",
    "formula",
    "function",
    "gyroid",
    "info",
    "intersection",
    "mesh_field",
    "mixture",
    "plane",
    "read_grid",
    "read_mesh",
    "read_volume",
    "reconstruct",
    "render",
    "rounded_box",
    "scene",
    "simplex_noise",
    "smooth",
    "sphere",
    "subdivide",
    "sweep",
    "torus",
    "union",
    "write_png",
]
