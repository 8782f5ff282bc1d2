"""Pictures of meshes."""

from __future__ import annotations

from typing import Any, Dict, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._arguments import (
    Progress,
    callback,
    flag,
    integer,
    number,
    path_text,
    thread_count,
    triple,
)
from ._mesh import Mesh, Path, _need_mesh

_MAX_SIDE = 8192


def render(
    mesh: Mesh,
    *,
    view: Any = "iso",
    size: Any = (1024, 1024),
    shading: Any = "clay",
    range: Any = None,
    edges: bool = False,
    threads: int = 0,
    progress: Progress = None,
) -> npt.NDArray[np.uint8]:
    """Draw a mesh, without a display.

    Dark lines mark outlines and creases; back faces are reddish.

    Parameters
    ----------
    mesh : Mesh
    view : str or three numbers
        "iso", "front", "back", "left", "right", "top", "bottom", or the direction to the viewer. z is up.
    size : two integers
        Width and height in pixels, 1 to 8192.
    shading : str or array, shape (n,)
        "clay"; "normal"; the name of a property of the vertices, of vectors their lengths; or a number for each vertex.
    range : two numbers, optional
        Which values are dark blue and yellow. Default: 0 and 1 for "confidence", else the least and the largest.
    edges : bool
        The mesh's edges over it.
    threads : int
        0 is all. The picture does not depend on it.
    progress : function of (stage, share), optional

    Returns
    -------
    array of uint8, shape (height, width, 3)
        sRGB, rows from the top.

    Raises
    ------
    pdc.Error
        For a mesh without faces.

    Examples
    --------
    >>> picture = pdc.render(pdc.contour(pdc.sphere(1), box=2.5, resolution=16), size=(64, 48))
    >>> picture.shape
    (48, 64, 3)
    """
    _need_mesh(mesh)
    width, height = (integer(f"size[{i}]", side, 1, _MAX_SIDE) for i, side in enumerate(size))
    options: Dict[str, Any] = {
        "width": width,
        "height": height,
        "edges": flag("edges", edges),
        "threads": thread_count(threads),
        "view": view if isinstance(view, str) else triple("view", view),
        "normals": isinstance(shading, str) and shading == "normal",
        "low": 0.0,
        "high": 1.0,
    }
    values = None
    if not (isinstance(shading, str) and shading in ("clay", "normal")):
        values = _shading_values(mesh, shading)
        options["low"], options["high"] = _limits(values, range, isinstance(shading, str) and shading == "confidence")
    return _core.render(mesh._handle, options, values, callback(progress))


def write_png(path: Path, picture: npt.ArrayLike) -> None:
    """Write a picture to a .png file, which appears when it is complete.

    Parameters
    ----------
    path : path
    picture : array of uint8, shape (height, width, 3)
        As render() gives it.

    Raises
    ------
    pdc.Error
        If the file cannot be written.

    Examples
    --------
    >>> pdc.write_png("grey.png", np.full((4, 6, 3), 128, np.uint8))
    """
    pixels = np.asarray(picture)
    if pixels.dtype != np.uint8:
        raise TypeError(f"picture must hold uint8, not {pixels.dtype}")
    if pixels.ndim != 3 or pixels.shape[2] != 3 or not pixels.size:
        raise ValueError(f"picture must have shape (height, width, 3), not {pixels.shape}")
    _core.write_png(np.ascontiguousarray(pixels), path_text("path", path))


def _shading_values(mesh: Mesh, shading: Any) -> npt.NDArray[np.float32]:
    if isinstance(shading, str):
        if shading not in mesh.properties:
            known = ", ".join(["clay", "normal", *mesh.properties])
            raise ValueError(f"shading must be one of {known}, not {shading!r}")
        shading = mesh[shading]
    values = np.asarray(shading)
    if values.ndim == 2:
        values = np.sqrt((values.astype(float) ** 2).sum(1))
    if values.shape != (len(mesh.vertices),):
        raise ValueError(f"shading must have a number for each of {len(mesh.vertices)} vertices, not {values.shape}")
    return np.ascontiguousarray(values, np.float32)


def _limits(values: npt.NDArray[np.float32], range: Any, confidence: bool) -> Any:
    if range is not None:
        low, high = range
        return number("range[0]", low), number("range[1]", high)
    finite = values[np.isfinite(values)]
    if confidence or not len(finite):
        return 0.0, 1.0
    return float(finite.min()), float(finite.max())
