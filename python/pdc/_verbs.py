"""Meshes to meshes."""

from __future__ import annotations

from typing import Any, Dict, Optional

from . import _core
from ._arguments import (
    Progress,
    callback,
    flag,
    integer,
    number,
    optional_number,
    thread_count,
    word,
)
from ._mesh import Mesh, _need_mesh

_QUADRICS = ("plane", "triangle", "probabilistic-plane", "probabilistic-triangle", "point")


def decimate(
    mesh: Mesh,
    *,
    faces: Optional[int] = None,
    ratio: Optional[float] = None,
    error: Optional[float] = None,
    weld: Optional[float] = None,
    quadric: str = "probabilistic-plane",
    placement: str = "minimizer",
    sigma_normal: Optional[float] = None,
    sigma_position: Optional[float] = None,
    sigma_property: str = "",
    memory: Optional[float] = None,
    max_turn: float = 75,
    boundary_weight: float = 10,
    lock_boundary: bool = False,
    sound: bool = False,
    fit: bool = True,
    pair_distance: Optional[float] = None,
    threads: int = 0,
    progress: Progress = None,
) -> Mesh:
    """A mesh of fewer triangles, by collapsing edges; see docs/decimation.md.

    Parameters
    ----------
    mesh : Mesh
    faces : int, optional
        Triangles at most.
    ratio : float, optional
        The same as a share of those given, above 0 and at most 1.
    error : float, optional
        No point of either surface is farther than this from the other, in world units. One of the three is needed.
    weld : float, optional
        Vertices within this distance become one first; 0: those at one place.
    quadric : "plane", "triangle", "probabilistic-plane", "probabilistic-triangle" or "point"
    placement : "minimizer" or "subset"
    sigma_normal, sigma_position : float, optional
        Noise of the unit normals; of the vertices, in mean edge lengths. Default: from the mesh.
    sigma_property : str
        The property with the noise of each vertex, such as "sigma".
    memory : float, optional
        Share of the faces given in the quadrics, 0 to 1. Default: from the mesh.
    max_turn : float
        No face turns farther in one step, in degrees.
    boundary_weight : float
        How much boundaries resist.
    lock_boundary, sound, fit : bool
        Boundaries stay; no faces come to intersect; vertices move to their least squares in the end.
    pair_distance : float, optional
        Vertices closer than this merge without an edge, too.
    threads : int
        0 is all. The mesh does not depend on it.
    progress : function of (stage, share), optional

    Returns
    -------
    Mesh

    Examples
    --------
    >>> ball = pdc.contour(pdc.sphere(1), box=2.5, resolution=24)
    >>> len(pdc.decimate(ball, faces=200).faces) <= 200
    True
    """
    if faces is None and ratio is None and error is None:
        raise ValueError("faces, ratio or error must be given")
    if pair_distance is not None and (sound or error is not None):
        raise ValueError(f"pair_distance excludes {'sound' if sound else 'error'}")
    share = optional_number("ratio", ratio, above=0)
    if share is not None and share > 1:
        raise ValueError(f"ratio must be at most 1, not {ratio!r}")
    turn = number("max_turn", max_turn, above=0)
    if turn > 90:
        raise ValueError(f"max_turn must be at most 90 degrees, not {max_turn!r}")
    if memory is not None and not 0 <= number("memory", memory) <= 1:
        raise ValueError(f"memory must be from 0 to 1, not {memory!r}")
    return _changed(
        _core.decimate,
        mesh,
        progress,
        faces=None if faces is None else integer("faces", faces, 0, 2**63 - 1),
        ratio=share,
        error=optional_number("error", error, above=0),
        weld=optional_number("weld", weld, at_least=0),
        quadric=word("quadric", quadric, _QUADRICS),
        placement=word("placement", placement, ("minimizer", "subset")),
        sigma_normal=optional_number("sigma_normal", sigma_normal, at_least=0),
        sigma_position=optional_number("sigma_position", sigma_position, at_least=0),
        sigma_property=sigma_property,
        memory=memory,
        max_turn=turn,
        boundary_weight=number("boundary_weight", boundary_weight, at_least=0),
        lock_boundary=flag("lock_boundary", lock_boundary),
        sound=flag("sound", sound),
        fit=flag("fit", fit),
        pair_distance=optional_number("pair_distance", pair_distance, above=0),
        threads=thread_count(threads),
    )


def cluster(
    mesh: Mesh,
    cell: float,
    *,
    quadric: str = "probabilistic-plane",
    sigma_normal: float = 0.05,
    sigma_position: float = 0.005,
    weld: Optional[float] = None,
    free: bool = False,
    clean: bool = False,
    threads: int = 0,
    progress: Progress = None,
) -> Mesh:
    """A mesh with one vertex for each cell of a lattice, fast and rough.

    Parameters
    ----------
    mesh : Mesh
    cell : float
        The edge of the cells, in world units.
    quadric, weld
        As for decimate().
    sigma_normal, sigma_position : float
        Noise of the unit normals; of the vertices, in cells.
    free : bool
        Vertices may leave their cells.
    clean : bool
        Folded and duplicate faces are dropped.
    threads, progress
        As for decimate().

    Returns
    -------
    Mesh

    Examples
    --------
    >>> ball = pdc.contour(pdc.sphere(1), box=2.5, resolution=24)
    >>> len(pdc.cluster(ball, 0.5).vertices) < len(ball.vertices)
    True
    """
    return _changed(
        _core.cluster,
        mesh,
        progress,
        cell=number("cell", cell, above=0),
        quadric=word("quadric", quadric, _QUADRICS),
        sigma_normal=number("sigma_normal", sigma_normal, at_least=0),
        sigma_position=number("sigma_position", sigma_position, at_least=0),
        weld=optional_number("weld", weld, at_least=0),
        free=flag("free", free),
        clean=flag("clean", clean),
        threads=thread_count(threads),
    )


def smooth(
    mesh: Mesh,
    *,
    sigma: Optional[float] = None,
    sigma_property: str = "",
    iterations: int = 10,
    normalise_area: bool = False,
    plain: bool = False,
    lock_boundary: bool = False,
    threads: int = 0,
    progress: Progress = None,
) -> Mesh:
    """The mesh with its vertices moved so that noise goes and creases stay; see docs/smoothing.md.

    Parameters
    ----------
    mesh : Mesh
        An oriented manifold, with boundary or not.
    sigma : float, optional
        Noise of each coordinate of the vertices, in mean edge lengths. Default: what the surface has around each.
    sigma_property : str
        The property that has it instead, in world units, such as "sigma".
    iterations : int
        How often quadrics are averaged, 0 to 1000.
    normalise_area, plain, lock_boundary : bool
        Faces count alike; averages across creases, too; boundaries stay.
    threads, progress
        As for decimate().

    Returns
    -------
    Mesh

    Examples
    --------
    >>> ball = pdc.contour(pdc.sphere(1), box=2.5, resolution=24)
    >>> pdc.smooth(ball, sigma=0.1).quads.shape == ball.quads.shape
    True
    """
    return _changed(
        _core.smooth,
        mesh,
        progress,
        sigma=optional_number("sigma", sigma, at_least=0),
        sigma_property=sigma_property,
        iterations=integer("iterations", iterations, 0, 1000),
        normalise_area=flag("normalise_area", normalise_area),
        plain=flag("plain", plain),
        lock_boundary=flag("lock_boundary", lock_boundary),
        threads=thread_count(threads),
    )


def subdivide(
    mesh: Mesh,
    levels: int = 2,
    *,
    scheme: str = "loop",
    weights: str = "loop",
    covariance: Optional[str] = "faces",
    bias: Optional[float] = None,
    absolute_bias: Optional[float] = None,
    sigma_normal: Optional[float] = None,
    crease_angle: Optional[float] = None,
    limit: bool = False,
    normals: bool = False,
    curvature: bool = False,
    keep_covariances: bool = False,
    threads: int = 0,
    progress: Progress = None,
) -> Mesh:
    """The mesh refined into a smooth surface of Gaussians; see docs/subdivision.md.

    Parameters
    ----------
    mesh : Mesh
        An oriented manifold, with boundary or not.
    levels : int
        How many times faces are split, 1 to 31.
    scheme : "loop" or "catmull-clark"
    weights : "loop" or "warren"
        Whose, in Loop's scheme.
    covariance : "faces", "vertices", "normals", "properties" or None
        What makes the Gaussians; None is the linear scheme.
    bias, absolute_bias : float, optional
        Added to covariances of faces and vertices: a share of the largest eigenvalue (0.05), or world units squared.
    sigma_normal : float, optional
        Noise of the unit normals, for "normals" (0.1).
    crease_angle : float, optional
        Edges whose faces turn by more stay sharp, in degrees.
    limit, normals, curvature, keep_covariances : bool
        Vertices go to the limit surface; with its normals; with its curvature; the covariances as properties.
    threads, progress
        As for decimate().

    Returns
    -------
    Mesh

    Examples
    --------
    >>> cube = pdc.contour(pdc.box(1.5), box=2, resolution=4, triangles=True)
    >>> len(pdc.subdivide(cube, 1).triangles) == 4 * len(cube.triangles)
    True
    """
    if covariance is None and keep_covariances:
        raise ValueError("keep_covariances needs covariances")
    if bias is not None and absolute_bias is not None:
        raise ValueError("bias excludes absolute_bias")
    kinds = ("faces", "vertices", "normals", "properties")
    angle = optional_number("crease_angle", crease_angle, above=0)
    if angle is not None and angle > 180:
        raise ValueError(f"crease_angle must be at most 180 degrees, not {crease_angle!r}")
    return _changed(
        _core.subdivide,
        mesh,
        progress,
        levels=integer("levels", levels, 1, 31),
        scheme=word("scheme", scheme, ("loop", "catmull-clark")),
        weights=word("weights", weights, ("loop", "warren")),
        covariance=None if covariance is None else word("covariance", covariance, kinds),
        bias=optional_number("bias", bias, above=0),
        absolute_bias=optional_number("absolute_bias", absolute_bias, above=0),
        sigma_normal=optional_number("sigma_normal", sigma_normal, above=0),
        crease_angle=angle,
        limit=flag("limit", limit),
        normals=flag("normals", normals),
        curvature=flag("curvature", curvature),
        keep_covariances=flag("keep_covariances", keep_covariances),
        threads=thread_count(threads),
    )


def _changed(verb: Any, mesh: Mesh, progress: Progress, **options: Any) -> Mesh:
    _need_mesh(mesh)
    given: Dict[str, Any] = {name: value for name, value in options.items() if value is not None}
    core, report = verb(mesh._handle, given, callback(progress))
    return Mesh._of(core, report)
