"""Contouring: volumes to meshes, once or for several values of a parameter."""

from __future__ import annotations

import math
from collections import abc
from typing import Any, Callable, Dict, List, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._arguments import Progress, callback, number, warn, word
from ._mesh import Mesh
from ._source import GIVEN, Input, options_of, source_of


def contour(
    volume: Input,
    level: Union[None, str, float] = None,
    *,
    spacing: Any = None,
    origin: Any = None,
    affine: Optional[npt.ArrayLike] = None,
    inside: Optional[str] = None,
    grid_class: Optional[str] = None,
    sigma_normal: Union[None, str, float] = None,
    sigma: Any = None,
    weight: Any = None,
    mask: Optional[npt.ArrayLike] = None,
    attributes: Any = None,
    placement: str = "certified",
    hermite: str = "auto",
    open: bool = False,
    flood_fill: bool = False,
    triangles: bool = False,
    normals: bool = False,
    confidence: bool = False,
    rank: bool = False,
    adaptive: Union[None, str, float] = None,
    adaptive_scale: Any = None,
    nan: str = "error",
    box: Any = None,
    voxel_size: Optional[float] = None,
    resolution: Optional[int] = None,
    offset: Optional[float] = None,
    shell: Optional[float] = None,
    grid: Optional[str] = None,
    raw: Optional[str] = None,
    array: Optional[str] = None,
    series: Union[None, str, int] = None,
    volume_index: Optional[int] = None,
    channel: Optional[int] = None,
    space: Optional[str] = None,
    mesh_origin: Any = None,
    max_memory: int = 0,
    threads: int = 0,
    progress: Progress = None,
) -> Mesh:
    """The surface of a volume where its value is `level`, as a mesh that is closed, manifold and free of intersections.

    The defaults are those of the program `pdc mesh`, and so are the bytes. Work is done on threads without Python's
    lock; Ctrl-C stops it. What is odd in the data is a pdc.Warning, and so is a volume without a surface, of which the
    mesh is empty.

    Parameters
    ----------
    volume
        - An array of bool, integers or floats, shape (nx, ny, nz), indexed [x, y, z], of any strides and byte order. It
          is read where it lies, and must not change meanwhile.
        - A pdc.Volume, or the path of its file: see read_volume().
        - A pdc.Grid, or a grid of pyopenvdb or openvdb.
        - A pdc.Mesh, whose solid is meshed anew: closed, manifold, creases kept; see docs/meshes_in.md.
        - A pdc.Field, or a function of points of shape (n, 3) to values as pdc.function() takes one; needs `box`, and
          `voxel_size` or `resolution`.
        - A pdc.Scene.
        - The path of a file that the program takes: volumes, .vdb, meshes, scenes. A folder of slices is one.
    level : float or "otsu", optional
        In the volume's units. "otsu": between the two kinds of values that Otsu's method finds, for arrays and volumes.
        Default: 0 for arrays; what the program takes otherwise: 0 for level sets and fields, 0.5 for fog volumes, what
        the values of a volume or a scene say.
    spacing : float or three, optional
        For arrays: steps between values in world units. Default 1. For files of volumes: instead of the file's.
    origin : three floats, optional
        For arrays: where the first value is. Default 0, 0, 0.
    affine : array, shape (4, 4) or (3, 4), optional
        For arrays, instead of these two: takes indices to the world; may mirror and shear.
    inside : "low" or "high", optional
        Which values are inside. Default: decided from the data, see docs/defaults.md.
    grid_class : "level-set" or "fog", optional
        What the values of arrays and grids are. Default: the grid's, or as they look.
    sigma_normal : float or "auto", optional
        Standard deviation of each component of the unit normals, 0 or more; infinity trusts them not at all. Default:
        from the data, or what a scene says.
    sigma, weight : arrays or Grids like the volume, optional
        Standard deviation of each value, in its units, and how much it counts, 0 being no data. For a .vdb file names
        of its grids.
    mask : array, optional
        For arrays: False is no data.
    attributes : mapping of names to Grids, optional
        The mesh gets what they hold at its vertices, as properties of these names; see docs/attributes.md. For a .vdb
        file also a list of names of its grids, or "all".
    placement : "certified", "cell" or "free"
        Where vertices may lie; without "free" no faces intersect.
    hermite : "auto", "gradient" or "distance"
        Where planes beside creases come from, of arrays and grids.
    open : bool
        The surface ends where the data ends, instead of being closed.
    flood_fill : bool
        For grids: inactive values become inside or outside, as the active ones of a level set beside them are.
    triangles : bool
        Triangles instead of quads.
    normals, confidence, rank : bool
        Also normals, the properties "confidence" and "sigma", and the property "rank".
    adaptive : float or str, optional
        Fewer faces: no point farther than this from the full mesh or back, in world units, or in voxels as "0.1v".
    adaptive_scale : Grid, optional
        By which that distance is multiplied from place to place: 1 keeps it. For a .vdb file also the name of a grid.
    nan : "error" or "outside"
        What NaN and infinite values are.
    box : float, or pair of three floats, optional
        Where fields are looked at: two corners, or the edge of a cube about the origin. A scene has its own.
    voxel_size : float, optional
        The lattice of fields, scenes and meshes, in world units.
    resolution : int, optional
        The same as voxels along the longest side of the box. Default for meshes: 128.
    offset : float, optional
        For meshes, and for level sets in files: the surface goes outwards by this, or inwards below 0, in world units.
    shell : float, optional
        For meshes: only a wall of this thickness is left, inwards from the surface.
    grid : str, optional
        Which grid of a .vdb file.
    raw, array, series, volume_index, channel, space
        For files of volumes, as for read_volume().
    mesh_origin : three floats or "auto", optional
        Subtracted from coordinates; "auto": near the surface if that is too far out for single precision. Default 0.
    max_memory : int
        Bytes; 0 is what the machine has.
    threads : int
        0 is all. The mesh does not depend on it.
    progress : function of (stage, share), optional
        Called on the calling thread, at most 100 times a second. What it raises stops the work.

    Returns
    -------
    Mesh
        With a report as that of `pdc mesh --json`.

    Raises
    ------
    TypeError, ValueError
        For arguments of the wrong type, shape or size.
    pdc.Error
        For data that cannot be contoured: values that are not finite, files that cannot be read, too little memory.

    Examples
    --------
    >>> x, y, z = np.mgrid[:20, :20, :20]
    >>> mesh = pdc.contour(np.hypot(np.hypot(x - 9.5, y - 9.5), z - 9.5) - 7)
    >>> bool(abs(np.linalg.norm(mesh.vertices - 9.5, axis=1) - 7).max() < 0.1)
    True
    >>> part = pdc.box((2, 2, 1)) - pdc.cylinder((0, 0, -1), (0, 0, 1), 0.6)
    >>> pdc.contour(part, box=2.4, resolution=32).report["boundary_edges"]
    0
    """
    options = options_of(
        level=level,
        inside=inside,
        grid_class=grid_class,
        sigma_normal=sigma_normal,
        placement=placement,
        hermite=hermite,
        open=open,
        flood_fill=flood_fill,
        triangles=triangles,
        normals=normals,
        confidence=confidence,
        rank=rank,
        adaptive=adaptive,
        nan=nan,
        voxel_size=voxel_size,
        resolution=resolution,
        offset=offset,
        shell=shell,
        grid=grid,
        mesh_origin=mesh_origin,
        max_memory=max_memory,
        threads=threads,
    )
    given = {
        "spacing": spacing,
        "origin": origin,
        "affine": affine,
        "sigma": sigma,
        "weight": weight,
        "mask": mask,
        "attributes": attributes,
        "adaptive_scale": adaptive_scale,
        "box": box,
        "raw": raw,
        "array": array,
        "series": series,
        "volume_index": volume_index,
        "channel": channel,
        "space": space,
    }
    source, chosen = source_of(volume, given, options)
    core, report = _core.contour(source, chosen, callback(progress))
    warn(report["warnings"])
    return Mesh._of(core, report)


def sweep(
    volume: Input,
    parameter: str,
    values: abc.Sequence[float],
    *,
    meshes: bool = False,
    progress: Progress = None,
    **options: Any,
) -> Union[Dict[str, Any], Tuple[Dict[str, Any], List[Mesh]]]:
    """Contour a volume for several values of a parameter, and measure the meshes.

    Fields and scenes are their own truth: distances to the surface and of its creases are measured. Where σn is swept,
    one is recommended.

    Parameters
    ----------
    volume
        As for contour().
    parameter : "sigma_normal", "level", "voxel_size" or "adaptive"
        The last in voxels, 0 being the full mesh.
    values : sequence of float
    meshes : bool
        Return the meshes, too.
    progress : function of (stage, share), optional
    **options
        As for contour(). sigma_normal is 0.05 where nothing is said.

    Returns
    -------
    dict, or dict and list of Mesh
        As the `sweep.json` of `pdc sweep`; lengths in voxels.

    Examples
    --------
    >>> report = pdc.sweep(pdc.box(1.3), "sigma_normal", [0, 0.1, math.inf], box=2, resolution=12)
    >>> [step["sigma_n"] for step in report["steps"]]
    [0, 0.1, 'inf']
    """
    word("parameter", parameter, ("sigma_normal", "level", "voxel_size", "adaptive"))
    checked = [_swept(parameter, i, value) for i, value in enumerate(values)]
    if not checked:
        raise ValueError("values must not be empty")
    if options.get(parameter) is not None:
        raise ValueError(f"{parameter} is what is swept")
    if parameter == "voxel_size":
        options["voxel_size"] = checked[0]
    given = {name: options.pop(name, None) for name in GIVEN}
    if given["attributes"] is not None:
        raise TypeError("sweep() got an unexpected argument 'attributes'")
    if given["adaptive_scale"] is not None and parameter in ("level", "voxel_size"):
        raise ValueError("adaptive_scale goes with sweeps of sigma_normal and adaptive only")
    unknown = set(options) - set(_DEFAULTS)
    if unknown:
        raise TypeError(f"sweep() got an unexpected argument '{sorted(unknown)[0]}'")
    source, chosen = source_of(volume, given, options_of(**{**_DEFAULTS, **options}))
    report, cores = _core.sweep(source, parameter, checked, chosen, callback(progress))
    return (report, [Mesh._of(core, {}) for core in cores]) if meshes else report


_DEFAULTS: Dict[str, Any] = {
    name: default
    for name, default in (contour.__kwdefaults__ or {}).items()
    if name not in GIVEN and name != "progress"
}
_DEFAULTS["level"] = None


def _swept(parameter: str, i: int, value: Any) -> float:
    name = f"values[{i}]"
    if parameter == "sigma_normal":
        return number(name, value, at_least=0, infinite=True)
    if parameter == "voxel_size":
        return number(name, value, above=0)
    return number(name, value, at_least=0 if parameter == "adaptive" else -math.inf)
