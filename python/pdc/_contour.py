"""Contouring: volumes to meshes, once or for several values of a parameter."""

from __future__ import annotations

import math
from collections import abc
from typing import Any, Callable, Dict, List, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._arguments import (
    Progress,
    affine_of,
    callback,
    flag,
    integer,
    number,
    numeric_array,
    optional_number,
    path_text,
    sigma_normal as checked_sigma_normal,
    thread_count,
    triple,
    warn,
    word,
)
from ._field import Field, function
from ._grid import Grid, borrowed, is_openvdb
from ._mesh import Mesh, Path
from ._scene import Scene

Volume = Union[npt.ArrayLike, Grid, Field, Scene, Path, Callable[[npt.NDArray[np.float64]], npt.ArrayLike]]
_MAX_VOXELS = 1 << 20


def contour(
    volume: Volume,
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
    placement: str = "certified",
    hermite: str = "auto",
    open: bool = False,
    flood_fill: bool = False,
    triangles: bool = False,
    normals: bool = False,
    confidence: bool = False,
    rank: bool = False,
    adaptive: Union[None, str, float] = None,
    nan: str = "error",
    box: Any = None,
    voxel_size: Optional[float] = None,
    resolution: Optional[int] = None,
    grid: Optional[str] = None,
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
        - A pdc.Grid, or a grid of pyopenvdb or openvdb.
        - A pdc.Field, or a function of points of shape (n, 3) to values as pdc.function() takes one; needs `box`, and
          `voxel_size` or `resolution`.
        - A pdc.Scene, or the path of a file that the program takes.
    level : float or "otsu", optional
        In the volume's units. "otsu": between the two kinds of values that Otsu's method finds, for arrays. Default: 0
        for arrays; what the program takes otherwise: 0 for level sets and fields, 0.5 for fog volumes, what a scene
        says.
    spacing : float or three, optional
        For arrays: steps between values in world units. Default 1.
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
    nan : "error" or "outside"
        What NaN and infinite values are.
    box : float, or pair of three floats, optional
        Where fields are looked at: two corners, or the edge of a cube about the origin. A scene has its own.
    voxel_size : float, optional
        The lattice of fields and scenes, in world units.
    resolution : int, optional
        The same as voxels along the longest side of the box.
    grid : str, optional
        Which grid of a .vdb file.
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
    options = _options(
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
        "box": box,
    }
    source, chosen = _source(volume, given, options)
    core, report = _core.contour(source, chosen, callback(progress))
    warn(report["warnings"])
    return Mesh._of(core, report)


def _options(**given: Any) -> Dict[str, Any]:
    """The options that are given, checked."""
    options = dict(given)
    if given["level"] != "otsu":
        options["level"] = optional_number("level", given["level"])
    for name, words in (
        ("inside", ("low", "high")),
        ("grid_class", ("level-set", "fog")),
        ("placement", ("certified", "cell", "free")),
        ("hermite", ("auto", "gradient", "distance")),
        ("nan", ("error", "outside")),
    ):
        if given[name] is not None:
            options[name] = word(name, given[name], words)
    options["sigma_normal"] = checked_sigma_normal(given["sigma_normal"])
    for name in ("open", "flood_fill", "triangles", "normals", "confidence", "rank"):
        options[name] = flag(name, given[name])
    options["adaptive"] = _adaptive(given["adaptive"])
    options["voxel_size"] = optional_number("voxel_size", given["voxel_size"], above=0)
    if given["resolution"] is not None:
        options["resolution"] = integer("resolution", given["resolution"], 1, _MAX_VOXELS)
        if given["voxel_size"] is not None:
            raise ValueError("voxel_size excludes resolution")
    if given["mesh_origin"] is not None and given["mesh_origin"] != "auto":
        options["mesh_origin"] = triple("mesh_origin", given["mesh_origin"])
    options["max_memory"] = integer("max_memory", given["max_memory"], 0, 2**63 - 1)
    options["threads"] = thread_count(given["threads"])
    return {name: value for name, value in options.items() if value is not None}


def _adaptive(value: Any) -> Optional[Tuple[float, bool]]:
    if value is None:
        return None
    in_voxels = isinstance(value, str) and value.endswith("v")
    try:
        length = float(value[:-1] if in_voxels else value)
    except ValueError:
        raise ValueError(f"adaptive must be a length, or voxels as '0.1v', not {value!r}") from None
    return number("adaptive", length, above=0), in_voxels


Source = Tuple[Any, ...]
_Given = Dict[str, Any]


def _source(volume: Any, given: _Given, options: Dict[str, Any]) -> Tuple[Source, Dict[str, Any]]:
    """What is contoured, as the module of C++ takes it."""
    if isinstance(volume, Scene):
        return _field_source(volume.field, given, options, volume)
    if isinstance(volume, Field):
        return _field_source(volume, given, options, None)
    if isinstance(volume, Grid) or is_openvdb(volume):
        return _grid_source(volume, given, options)
    if isinstance(volume, (str, bytes)) or hasattr(volume, "__fspath__"):
        return _file_source(volume, given, options)
    if callable(volume) and not hasattr(volume, "__array__"):
        return _field_source(function(volume), given, options, None)
    return _array_source(volume, given, options)


def _refuse(given: _Given, names: abc.Sequence[str], takers: str) -> None:
    for name in names:
        if given.get(name) is not None and given[name] is not False:
            raise ValueError(f"{name} goes with {takers} only")


def _array_source(volume: Any, given: _Given, options: Dict[str, Any]) -> Tuple[Source, Dict[str, Any]]:
    _refuse({**given, **options}, ("box", "voxel_size", "resolution"), "fields and scenes")
    _refuse(options, ("grid", "flood_fill"), "grids")
    values = numeric_array("volume", volume)
    companions: List[Any] = []
    for name in ("sigma", "weight", "mask"):
        companion = given[name]
        if companion is not None:
            companion = numeric_array(name, companion)
            if companion.shape != values.shape:
                raise ValueError(f"{name} must have the volume's shape {values.shape}, not {companion.shape}")
        companions.append(companion)
    matrix = affine_of(given["spacing"], given["origin"], given["affine"])
    chosen: Dict[str, Any] = {"level": 0.0, **options}
    if chosen["level"] == "otsu":
        # The program's own choice where a volume is no level set.
        del chosen["level"]
        chosen.setdefault("grid_class", "fog")
    return ("array", values, matrix, *companions), chosen


def _refuse_otsu(options: Dict[str, Any]) -> None:
    if options.get("level") == "otsu":
        raise ValueError("level 'otsu' goes with arrays only")


def _grid_source(volume: Any, given: _Given, options: Dict[str, Any]) -> Tuple[Source, Dict[str, Any]]:
    _refuse_otsu(options)
    _refuse(given, ("spacing", "origin", "affine", "mask"), "arrays")
    _refuse({**given, **options}, ("box", "voxel_size", "resolution"), "fields and scenes")
    _refuse(options, ("grid",), ".vdb files")
    cores = []
    for name, grid in (("volume", volume), ("sigma", given["sigma"]), ("weight", given["weight"])):
        if is_openvdb(grid):
            grid = borrowed(grid)
        if grid is not None and not isinstance(grid, Grid):
            raise TypeError(f"{name} must be a pdc.Grid as the volume is, not {type(grid).__name__}")
        cores.append(None if grid is None else grid._handle)
    return ("grid", *cores), options


def _file_source(volume: Any, given: _Given, options: Dict[str, Any]) -> Tuple[Source, Dict[str, Any]]:
    _refuse_otsu(options)
    _refuse(given, ("spacing", "origin", "affine", "mask", "box"), "volumes in memory")
    names = {}
    for name in ("sigma", "weight"):
        if given[name] is not None:
            if not isinstance(given[name], str):
                raise TypeError(f"{name} must be the name of a grid of the file, not {type(given[name]).__name__}")
            names[f"{name}_grid"] = given[name]
    return ("file", path_text("volume", volume)), {**options, **names}


def _field_source(
    field: Field, given: _Given, options: Dict[str, Any], scene: Optional[Scene]
) -> Tuple[Source, Dict[str, Any]]:
    _refuse_otsu(options)
    _refuse(given, ("spacing", "origin", "affine", "mask"), "arrays")
    _refuse(given, ("sigma", "weight"), "arrays and grids")
    _refuse(options, ("inside", "grid_class", "flood_fill"), "arrays and grids")
    if options.get("hermite", "auto") != "auto":
        raise ValueError("hermite goes with arrays and grids only")
    chosen = dict(options)
    box = given["box"]
    if scene is not None:
        box = scene.box if box is None else box
        chosen.setdefault("level", scene.level)
        if scene._nan == "outside":
            chosen["nan"] = "outside"
        if "resolution" not in chosen:
            chosen.setdefault("voxel_size", scene.voxel_size)
    if box is None:
        raise ValueError("box must be given for a field: two corners, or the edge of a cube about the origin")
    lo, hi = _corners(box)
    if "resolution" in chosen:
        chosen["voxel_size"] = max(h - l for l, h in zip(lo, hi)) / chosen.pop("resolution")
    if "voxel_size" not in chosen:
        raise ValueError("voxel_size or resolution must be given for a field")
    return ("field", field._handle, (*lo, *hi), None if scene is None else scene.sigma_normal), chosen


def _corners(box: Any) -> Tuple[Any, Any]:
    if np.ndim(box) == 0:
        half = number("box", box, above=0) / 2
        return (-half,) * 3, (half,) * 3
    if len(box) != 2:
        raise ValueError(f"box must be two corners, or the edge of a cube about the origin, not {box!r}")
    lo, hi = triple("box[0]", box[0]), triple("box[1]", box[1])
    for axis, low, high in zip("xyz", lo, hi):
        if not low < high:
            raise ValueError(f"box must not be empty: it goes from {low:g} to {high:g} along {axis}")
    return lo, hi


def sweep(
    volume: Volume,
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
    given = {name: options.pop(name, None) for name in _GIVEN}
    unknown = set(options) - set(_DEFAULTS)
    if unknown:
        raise TypeError(f"sweep() got an unexpected argument '{sorted(unknown)[0]}'")
    source, chosen = _source(volume, given, _options(**{**_DEFAULTS, **options}))
    report, cores = _core.sweep(source, parameter, checked, chosen, callback(progress))
    return (report, [Mesh._of(core, {}) for core in cores]) if meshes else report


_GIVEN = ("spacing", "origin", "affine", "sigma", "weight", "mask", "box")
_DEFAULTS: Dict[str, Any] = {
    name: default
    for name, default in (contour.__kwdefaults__ or {}).items()
    if name not in _GIVEN and name != "progress"
}
_DEFAULTS["level"] = None


def _swept(parameter: str, i: int, value: Any) -> float:
    name = f"values[{i}]"
    if parameter == "sigma_normal":
        return number(name, value, at_least=0, infinite=True)
    if parameter == "voxel_size":
        return number(name, value, above=0)
    return number(name, value, at_least=0 if parameter == "adaptive" else -math.inf)
