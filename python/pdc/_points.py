"""Points to Gaussians, and to surfaces."""

from __future__ import annotations

from typing import Any, Dict, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._arguments import (
    Progress,
    callback,
    flag,
    integer,
    is_path,
    number,
    numeric_array,
    optional_number,
    path_text,
    thread_count,
    warn,
)
from ._mesh import Mesh, Path

Points = Union[npt.ArrayLike, Path]


def mixture(
    points: Points,
    *,
    normals: Optional[npt.ArrayLike] = None,
    sigma: Optional[npt.ArrayLike] = None,
    colours: Optional[npt.ArrayLike] = None,
    sigma0: Optional[float] = None,
    alpha: float = 2,
    levels: int = 2,
    iterations: int = 1,
    threads: int = 0,
    progress: Progress = None,
) -> Mesh:
    """A few Gaussians that say how likely a point of the surface is anywhere; see docs/reconstruction.md.

    Parameters
    ----------
    points : array of integers or floats, shape (n, 3), or path
        Of any strides, in any order, in world units; or a file that the program reads: .ply, .xyz, .pts, .txt, .pcd,
        .vdb.
    normals : array, shape (n, 3), optional
        For arrays: directions away from the solid, of any length; 0, 0, 0 where it is not known.
    sigma : array, shape (n,), optional
        For arrays: the standard deviation of each point along each axis, in world units.
    colours : array of uint8, shape (n, 3), optional
        For arrays: red, green and blue of each point.
    sigma0 : float, optional
        Standard deviation of the Gaussian about each point, in world units; larger is smoother. Default: from the
        spacing of the points.
    alpha : float
        Gaussians merge up to a divergence of alpha² / 2.
    levels : int
        At most how many times they merge, 0 to 100.
    iterations : int
        Steps of expectation and maximisation in a level, 1 to 1000.
    threads : int
        0 is all. The result does not depend on it, nor on the order of the points.
    progress : function of (stage, share), optional

    Returns
    -------
    Mesh
        Without faces: means are the vertices, covariances and weights properties.

    Raises
    ------
    TypeError, ValueError
        For arrays of the wrong type or shape.
    pdc.Error
        For points that are not finite, files that cannot be read, too little memory.

    Examples
    --------
    >>> points = np.random.default_rng(1).normal(size=(2000, 3))
    >>> points /= np.linalg.norm(points, axis=1)[:, None]
    >>> gaussians = pdc.mixture(points)
    >>> 20 < len(gaussians.vertices) < 1000, round(float(gaussians["weight"].sum()), 6)
    (True, 1.0)
    """
    options = _mixture_options(sigma0, alpha, levels, iterations, threads)
    core, report = _core.mixture(_source(points, normals, sigma, colours), options, callback(progress))
    warn(report["warnings"])
    return Mesh._of(core, report)


def reconstruct(
    points: Points,
    *,
    normals: Optional[npt.ArrayLike] = None,
    sigma: Optional[npt.ArrayLike] = None,
    colours: Optional[npt.ArrayLike] = None,
    sigma0: Optional[float] = None,
    alpha: float = 2,
    levels: int = 2,
    iterations: int = 1,
    overlap: float = 0.15,
    close: bool = False,
    subdivide: int = 1,
    voxel_size: Optional[float] = None,
    covariance_mesh: bool = False,
    threads: int = 0,
    progress: Progress = None,
) -> Union[Mesh, Tuple[Mesh, Mesh]]:
    """A surface from points, which need no normals; see docs/reconstruction.md.

    Parameters
    ----------
    points, normals, sigma, colours, sigma0, alpha, levels, iterations
        As for mixture().
    overlap : float
        Gaussians are joined if their Bhattacharyya coefficient is at least this, between 0 and 1.
    close : bool
        Close all boundaries.
    subdivide : int
        How many times triangles are split into four, 0 to 10.
    voxel_size : float, optional
        Close the surface, and contour its distances with voxels of this size: closed, manifold, free of intersections.
    covariance_mesh : bool
        Return the mesh of Gaussians that was subdivided, too.
    threads, progress
        As for mixture().

    Returns
    -------
    Mesh, or two of them
        With a report as that of `pdc reconstruct --json`.

    Raises
    ------
    TypeError, ValueError, pdc.Error
        As mixture() does; pdc.Error where no three Gaussians overlap.

    Examples
    --------
    >>> points = np.random.default_rng(1).normal(size=(2000, 3))
    >>> points /= np.linalg.norm(points, axis=1)[:, None]
    >>> ball = pdc.reconstruct(points, close=True)
    >>> bool(abs(np.linalg.norm(ball.vertices, axis=1) - 1).max() < 0.1), ball.report["mixture"]["points"]
    (True, 2000)
    """
    options = _mixture_options(sigma0, alpha, levels, iterations, threads)
    options["overlap"] = number("overlap", overlap, above=0)
    if options["overlap"] >= 1:
        raise ValueError(f"overlap must be below 1, not {overlap!r}")
    options["close"] = flag("close", close)
    options["subdivide"] = integer("subdivide", subdivide, 0, 10)
    options["voxel_size"] = optional_number("voxel_size", voxel_size, above=0)
    both = flag("covariance_mesh", covariance_mesh)
    source = _source(points, normals, sigma, colours)
    core, report, control = _core.reconstruct(source, options, callback(progress))
    warn(report["warnings"])
    mesh = Mesh._of(core, report)
    return (mesh, Mesh._of(control, {})) if both else mesh


def _mixture_options(sigma0: Any, alpha: Any, levels: Any, iterations: Any, threads: Any) -> Dict[str, Any]:
    return {
        "sigma0": optional_number("sigma0", sigma0, above=0),
        "alpha": number("alpha", alpha, above=0),
        "levels": integer("levels", levels, 0, 100),
        "iterations": integer("iterations", iterations, 1, 1000),
        "threads": thread_count(threads),
    }


def _source(points: Any, normals: Any, sigma: Any, colours: Any) -> Tuple[Any, ...]:
    """Where points come from, as the module of C++ takes it."""
    if is_path(points):
        for name, value in (("normals", normals), ("sigma", sigma), ("colours", colours)):
            if value is not None:
                raise ValueError(f"{name} goes with arrays of points only")
        return ("file", path_text("points", points))
    places = _rows("points", points, None).astype(np.float64, "C")
    n = len(places)
    directions = None if normals is None else _unit(_rows("normals", normals, n))
    deviations = None if sigma is None else np.ascontiguousarray(_each("sigma", sigma, n), np.float32)
    shades = None if colours is None else _rows("colours", colours, n)
    if shades is not None and shades.dtype != np.uint8:
        raise TypeError(f"colours must hold uint8, not {shades.dtype}")
    return ("arrays", places, directions, deviations, None if shades is None else np.ascontiguousarray(shades))


def _rows(name: str, value: Any, rows: Optional[int]) -> npt.NDArray[Any]:
    array = numeric_array(name, value, 2)
    if array.shape[1] != 3 or (rows is not None and len(array) != rows):
        raise ValueError(f"{name} must have shape ({'n' if rows is None else rows}, 3), not {array.shape}")
    return array


def _each(name: str, value: Any, rows: int) -> npt.NDArray[Any]:
    array = numeric_array(name, value, 1)
    if len(array) != rows:
        raise ValueError(f"{name} must have a number for each of {rows} points, not {len(array)}")
    return array


def _unit(directions: npt.NDArray[Any]) -> npt.NDArray[np.float32]:
    """Of unit length, or zero."""
    wide = directions.astype(np.float64)
    lengths = np.linalg.norm(wide, axis=1, keepdims=True)
    return np.ascontiguousarray(wide / np.where(lengths == 0, 1, lengths), np.float32)
