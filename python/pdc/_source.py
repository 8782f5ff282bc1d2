"""What is contoured, and how: what callers give, checked, as the module of C++ takes it."""

from __future__ import annotations

from collections import abc
from typing import Any, Callable, Dict, List, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._arguments import (
    affine_of,
    corners_of,
    flag,
    integer,
    is_path,
    number,
    numeric_array,
    optional_number,
    path_text,
    sigma_normal as checked_sigma_normal,
    thread_count,
    triple,
    word,
)
from ._field import Field, function
from ._grid import Grid, borrowed, is_openvdb
from ._mesh import Mesh, Path
from ._scene import Scene
from ._volume import Volume, volume_options

Input = Union[
    npt.ArrayLike, Volume, Grid, Field, Mesh, Scene, Path, Callable[[npt.NDArray[np.float64]], npt.ArrayLike]
]
Source = Tuple[Any, ...]
Options = Dict[str, Any]

_MAX_VOXELS = 1 << 20
#: What belongs to volumes in memory, or is checked together with them.
GIVEN = (
    "spacing",
    "origin",
    "affine",
    "sigma",
    "weight",
    "mask",
    "attributes",
    "adaptive_scale",
    "box",
    "raw",
    "array",
    "series",
    "volume_index",
    "channel",
    "space",
)
_OF_FILES = ("raw", "array", "series", "volume_index", "channel", "space")


def options_of(**given: Any) -> Options:
    """The options that are given, checked."""
    options = dict(given)
    if given["level"] == "otsu":
        options["level"], options["otsu"] = None, True
    else:
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
    options["offset"] = optional_number("offset", given["offset"])
    options["shell"] = optional_number("shell", given["shell"], above=0)
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


def source_of(volume: Any, given: Options, options: Options) -> Tuple[Source, Options]:
    """What is contoured, and the options that go with it."""
    if is_path(volume):
        return _file_source(volume, given, options)
    _refuse(given, _OF_FILES, "files")
    chosen = {**options, **_grids_of(given)}
    if isinstance(volume, Scene):
        return _field_source(volume.field, given, chosen, volume)
    if isinstance(volume, Field):
        return _field_source(volume, given, chosen, None)
    if isinstance(volume, Mesh):
        return _mesh_source(volume, given, chosen)
    _refuse(chosen, ("offset", "shell"), "meshes and files")
    if isinstance(volume, Grid) or is_openvdb(volume):
        return _grid_source(volume, given, chosen)
    if isinstance(volume, Volume):
        return _volume_source(volume, given, chosen)
    if callable(volume) and not hasattr(volume, "__array__"):
        return _field_source(function(volume), given, chosen, None)
    return _array_source(volume, given, chosen)


def _refuse(given: Options, names: abc.Sequence[str], takers: str) -> None:
    for name in names:
        if given.get(name) is not None and given[name] is not False:
            raise ValueError(f"{name} goes with {takers} only")


def _refuse_otsu(options: Options) -> None:
    if options.get("otsu"):
        raise ValueError("level 'otsu' goes with arrays, volumes and files only")


def _handle_of(name: str, grid: Any, wanted: str = "a pdc.Grid") -> _core.Grid:
    """What the module of C++ has of a grid of pdc or OpenVDB."""
    if is_openvdb(grid):
        grid = borrowed(grid)
    if not isinstance(grid, Grid):
        raise TypeError(f"{name} must be {wanted}, not {type(grid).__name__}")
    return grid._handle


def _grids_of(given: Options) -> Options:
    """Grids whose values vertices have, or by which distances are multiplied."""
    options: Options = {}
    attributes, scale = given.get("attributes"), given.get("adaptive_scale")
    if attributes is not None:
        if not isinstance(attributes, abc.Mapping):
            raise TypeError(f"attributes must be a mapping of names to grids, not {type(attributes).__name__}")
        named = [(_name(name), _handle_of(f"attributes[{name!r}]", grid)) for name, grid in attributes.items()]
        options["attribute_grids"] = named
    if scale is not None:
        options["adaptive_scale"] = _handle_of("adaptive_scale", scale)
    return options


def _name(name: Any) -> str:
    if not isinstance(name, str) or not name:
        raise ValueError(f"names of attributes must be strings that are not empty, not {name!r}")
    return name


def _arrays_of(given: Options, shape: Tuple[int, ...]) -> Tuple[Any, ...]:
    """The arrays that go with each value."""
    companions: List[Any] = []
    for name in ("sigma", "weight", "mask"):
        companion = given[name]
        if companion is not None:
            companion = numeric_array(name, companion)
            if companion.shape != shape:
                raise ValueError(f"{name} must have the volume's shape {shape}, not {companion.shape}")
        companions.append(companion)
    return tuple(companions)


def _refuse_for_values(given: Options, options: Options) -> None:
    _refuse({**given, **options}, ("box", "voxel_size", "resolution"), "fields, scenes and meshes")
    _refuse(options, ("grid", "flood_fill"), "grids")


def _array_source(volume: Any, given: Options, options: Options) -> Tuple[Source, Options]:
    _refuse_for_values(given, options)
    values = numeric_array("volume", volume)
    matrix = affine_of(given["spacing"], given["origin"], given["affine"])
    chosen = options if options.get("otsu") else {"level": 0.0, **options}
    return ("array", values, matrix, _arrays_of(given, values.shape)), chosen


def _volume_source(volume: Volume, given: Options, options: Options) -> Tuple[Source, Options]:
    _refuse(given, ("spacing", "origin", "affine"), "arrays")
    _refuse_for_values(given, options)
    return ("volume", volume._handle, _arrays_of(given, volume.shape)), options


def _grid_source(volume: Any, given: Options, options: Options) -> Tuple[Source, Options]:
    _refuse_otsu(options)
    _refuse(given, ("spacing", "origin", "affine", "mask"), "arrays")
    _refuse({**given, **options}, ("box", "voxel_size", "resolution"), "fields, scenes and meshes")
    _refuse(options, ("grid",), ".vdb files")
    companions: List[Optional[_core.Grid]] = []
    for name in ("sigma", "weight"):
        grid = given[name]
        companions.append(None if grid is None else _handle_of(name, grid, "a pdc.Grid as the volume is"))
    return ("grid", _handle_of("volume", volume), *companions), options


def _mesh_source(volume: Mesh, given: Options, options: Options) -> Tuple[Source, Options]:
    _refuse_otsu(options)
    _refuse(given, ("spacing", "origin", "affine", "mask"), "arrays")
    _refuse(given, ("sigma", "weight"), "arrays and grids")
    _refuse(options, ("inside", "grid_class", "flood_fill"), "arrays and grids")
    _refuse({**given, **options}, ("level", "open", "box"), "volumes and fields")
    _refuse(options, ("grid",), ".vdb files")
    if options.get("hermite", "auto") != "auto":
        raise ValueError("hermite goes with arrays and grids only")
    return ("mesh", volume._handle), options


def _file_source(volume: Any, given: Options, options: Options) -> Tuple[Source, Options]:
    _refuse(given, ("origin", "affine", "mask", "box"), "volumes in memory")
    chosen = {**options, **volume_options(**{name: given[name] for name in ("spacing", *_OF_FILES)})}
    for name, key in (("sigma", "sigma_grid"), ("weight", "weight_grid")):
        if given[name] is not None:
            if not isinstance(given[name], str):
                raise TypeError(f"{name} must be the name of a grid of the file, not {type(given[name]).__name__}")
            chosen[key] = given[name]
    attributes, scale = given["attributes"], given["adaptive_scale"]
    if isinstance(scale, str):
        chosen["adaptive_grid"], scale = scale, None
    if isinstance(attributes, str):
        chosen["all_attributes"], attributes = word("attributes", attributes, ("all",)) == "all", None
    elif isinstance(attributes, abc.Sequence):
        chosen["attributes"], attributes = [_name(name) for name in attributes], None
    chosen.update(_grids_of({"attributes": attributes, "adaptive_scale": scale}))
    return ("file", path_text("volume", volume)), chosen


def _field_source(
    field: Field, given: Options, options: Options, scene: Optional[Scene]
) -> Tuple[Source, Options]:
    _refuse_otsu(options)
    _refuse(given, ("spacing", "origin", "affine", "mask"), "arrays")
    _refuse(given, ("sigma", "weight"), "arrays and grids")
    _refuse(options, ("inside", "grid_class", "flood_fill"), "arrays and grids")
    _refuse(options, ("offset", "shell"), "meshes and files")
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
    lo, hi = corners_of("box", box)
    if "resolution" in chosen:
        chosen["voxel_size"] = max(h - l for l, h in zip(lo, hi)) / chosen.pop("resolution")
    if "voxel_size" not in chosen:
        raise ValueError("voxel_size or resolution must be given for a field")
    return ("field", field._handle, (*lo, *hi), None if scene is None else scene.sigma_normal), chosen
