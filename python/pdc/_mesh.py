"""Meshes."""

from __future__ import annotations

import os
from collections import abc
from typing import Any, Dict, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._arguments import (
    flag,
    numeric_array,
    path_text,
    warn,
)

Path = Union[str, "os.PathLike[str]"]


def _indices(name: str, value: Any, corners: int, vertices: int) -> npt.NDArray[np.uint32]:
    if value is None:
        return np.empty((0, corners), np.uint32)
    array = np.asarray(value)
    if array.size == 0:
        return np.empty((0, corners), np.uint32)
    if array.dtype.kind not in "iu":
        raise TypeError(f"{name} must hold integers, not {array.dtype}")
    if array.ndim != 2 or array.shape[1] != corners:
        raise ValueError(f"{name} must have shape (n, {corners}), not {array.shape}")
    if array.min() < 0 or array.max() >= vertices:
        wrong = array.min() if array.min() < 0 else array.max()
        raise ValueError(f"{name} must name vertices from 0 to {vertices - 1}, not {wrong}")
    return np.ascontiguousarray(array, np.uint32)


def _points(name: str, value: Any, rows: Optional[int] = None) -> npt.NDArray[np.float32]:
    array = numeric_array(name, value, 2) if np.size(value) else np.empty((0, 3))
    if array.shape[1] != 3 or (rows is not None and len(array) != rows):
        raise ValueError(f"{name} must have shape ({'n' if rows is None else rows}, 3), not {array.shape}")
    return np.ascontiguousarray(array, np.float32)


class Mesh:
    """An indexed surface of quads and triangles that does not change.

    Arrays are read-only views of the mesh's own memory, which lives as long as any of them. Faces are counter-clockwise
    seen from outside. A quad (a, b, c, d) stands for the triangles (a, b, c) and (a, c, d).

    Parameters
    ----------
    vertices : array, shape (n, 3)
        Coordinates, kept in single precision.
    triangles, quads : array of integers, shape (k, 3) and (m, 4), optional
        Numbers of vertices, from 0 on.
    normals : array, shape (n, 3), optional
        A unit vector for each vertex.
    properties : mapping of names to arrays, shape (n,) or (n, c) with c from 2 to 4, optional
        What else is known of each vertex. Types are kept: integers of 8 to 32 bits, and floats of 32 and 64.

    Raises
    ------
    TypeError, ValueError
        For arrays of another type or shape, or that name vertices that are not there.

    Examples
    --------
    >>> corners = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
    >>> tetrahedron = pdc.Mesh(corners, [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
    >>> tetrahedron.triangles.dtype, tetrahedron.vertices.flags.writeable
    (dtype('uint32'), False)
    """

    __slots__ = ("_handle", "_report", "_faces", "_properties", "__weakref__")
    _handle: _core.Mesh
    _report: Dict[str, Any]

    def __init__(
        self,
        vertices: npt.ArrayLike,
        triangles: Optional[npt.ArrayLike] = None,
        quads: Optional[npt.ArrayLike] = None,
        *,
        normals: Optional[npt.ArrayLike] = None,
        properties: Optional[abc.Mapping[str, npt.ArrayLike]] = None,
    ) -> None:
        points = _points("vertices", vertices)
        n = len(points)
        directions = np.empty((0, 3), np.float32) if normals is None else _points("normals", normals, n)
        core = _core.Mesh(points, _indices("quads", quads, 4, n), _indices("triangles", triangles, 3, n), directions)
        for name, values in (properties or {}).items():
            array = np.ascontiguousarray(values)
            if array.ndim not in (1, 2) or len(array) != n or (array.ndim == 2 and not 1 <= array.shape[1] <= 4):
                raise ValueError(f"property '{name}' must have shape ({n},) or ({n}, 1 to 4), not {array.shape}")
            core = core.with_property(name, array)
        self._set(core, {})

    def _set(self, core: _core.Mesh, report: Dict[str, Any]) -> None:
        self._handle = core
        self._report = report
        self._faces: Optional[npt.NDArray[np.uint32]] = None
        self._properties: Optional[Dict[str, npt.NDArray[Any]]] = None

    @classmethod
    def _of(cls, core: _core.Mesh, report: Dict[str, Any]) -> Mesh:
        mesh = cls.__new__(cls)
        mesh._set(core, report)
        return mesh

    @property
    def vertices(self) -> npt.NDArray[np.float32]:
        """Coordinates, shape (n, 3), in world units less `origin`."""
        return self._handle.vertices

    @property
    def quads(self) -> npt.NDArray[np.uint32]:
        """Numbers of the vertices of each quad, shape (m, 4)."""
        return self._handle.quads

    @property
    def triangles(self) -> npt.NDArray[np.uint32]:
        """Numbers of the vertices of each face that is a triangle, shape (k, 3). See `faces` for all as triangles."""
        return self._handle.triangles

    @property
    def faces(self) -> npt.NDArray[np.uint32]:
        """All faces as triangles, shape (2 m + k, 3): two of each quad, then the triangles."""
        if self._faces is None:
            self._faces = self._handle.faces
        return self._faces

    @property
    def normals(self) -> Optional[npt.NDArray[np.float32]]:
        """A unit vector for each vertex, shape (n, 3), or None."""
        normals = self._handle.normals
        return normals if len(normals) == len(self.vertices) else None

    @property
    def properties(self) -> Dict[str, npt.NDArray[Any]]:
        """What else is known of each vertex, by name."""
        if self._properties is None:
            self._properties = self._handle.properties
        return dict(self._properties)

    def __getitem__(self, name: str) -> npt.NDArray[Any]:
        """The property of that name. Raises KeyError where there is none."""
        return self.properties[name]

    def _property(self, name: str) -> npt.NDArray[Any]:
        try:
            return self.properties[name]
        except KeyError:
            raise AttributeError(f"the vertices have no property '{name}'") from None

    @property
    def confidence(self) -> npt.NDArray[np.float32]:
        """From 0 to 1 for each vertex, of a mesh that was made with confidence=True."""
        return self._property("confidence")

    @property
    def sigma(self) -> npt.NDArray[np.float32]:
        """Standard deviation of each vertex along its normal, in world units, made with confidence=True."""
        return self._property("sigma")

    @property
    def rank(self) -> npt.NDArray[np.uint8]:
        """1 on flat parts, 2 on edges, 3 at corners, made with rank=True."""
        return self._property("rank")

    @property
    def origin(self) -> npt.NDArray[np.float64]:
        """What `vertices` are relative to; zero unless the mesh is far away."""
        return self._handle.origin

    @property
    def report(self) -> Dict[str, Any]:
        """What the function that made the mesh did; of contour() that of `pdc mesh --json`. Empty for other meshes."""
        return self._report

    def save(self, path: Path, *, ascii: bool = False, double: bool = False) -> None:
        """Write the mesh to a .ply, .obj, .off or .stl file, which appears when it is complete.

        The frame and the unit of the volume that it was contoured from stand in the file.

        Parameters
        ----------
        path : path
            Its suffix says the format. Only .ply holds properties.
        ascii : bool
            .ply and .stl as text.
        double : bool
            World coordinates in double precision, in a .ply or .obj.

        Raises
        ------
        pdc.Error
            If the file cannot be written.

        Examples
        --------
        >>> pdc.contour(pdc.sphere(1), box=2.5, resolution=16).save("ball.ply")
        """
        of = self._report.get("volume") or {}
        frame = of.get("space", ""), of.get("unit", "")
        self._handle.save(path_text("path", path), flag("ascii", ascii), flag("double", double), *frame)

    def to_trimesh(self) -> Any:
        """The mesh as a trimesh.Trimesh, properties as vertex attributes. Needs trimesh."""
        import trimesh

        properties = self.properties
        return trimesh.Trimesh(
            np.array(self.vertices) + self.origin,
            np.array(self.faces, np.int64),
            vertex_normals=self.normals,
            vertex_attributes=properties,
            process=False,
        )

    def to_pyvista(self) -> Any:
        """The mesh as a pyvista.PolyData, quads as quads, properties as point data. Needs pyvista."""
        import pyvista

        faces = [
            np.hstack([np.full((len(part), 1), part.shape[1], np.int64), part]).ravel()
            for part in (self.quads, self.triangles)
        ]
        data = pyvista.PolyData(np.array(self.vertices) + self.origin, np.concatenate(faces))
        for name, values in self.properties.items():
            data.point_data[name] = values
        return data

    def _repr_png_(self) -> Optional[bytes]:
        if not len(self.faces):
            return None
        from ._render import render

        return _core.encode_png(render(self, size=(480, 480)))

    def __repr__(self) -> str:
        parts = [f"{len(self.vertices)} vertices"]
        parts += [f"{len(self.quads)} quads"] if len(self.quads) else []
        parts += [f"{len(self.triangles)} triangles"] if len(self.triangles) or not len(self.quads) else []
        parts += [f"properties {', '.join(self.properties)}"] if self.properties else []
        return f"<pdc.Mesh: {', '.join(parts)}>"


def read_mesh(path: Path) -> Mesh:
    """Read a .ply, .obj, .off or .stl file.

    Faces with more than four corners become triangles. Vertices of .stl are welded by exact position. Oddities in the
    file are warnings.

    Parameters
    ----------
    path : path

    Returns
    -------
    Mesh

    Raises
    ------
    pdc.Error
        For a file that is missing, damaged or of another kind.

    Examples
    --------
    >>> pdc.contour(pdc.sphere(1), box=2.5, resolution=16).save("ball.ply")
    >>> pdc.read_mesh("ball.ply").quads.shape[1]
    4
    """
    core, lines = _core.read_mesh(path_text("path", path))
    warn(lines)
    return Mesh._of(core, {})


def _need_mesh(mesh: Any) -> None:
    if not isinstance(mesh, Mesh):
        raise TypeError(f"mesh must be a pdc.Mesh, not {type(mesh).__name__}; pdc.Mesh(vertices, triangles) makes one")
