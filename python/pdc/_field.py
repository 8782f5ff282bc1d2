"""Implicit functions: shapes, their combinations, and functions of Python."""

from __future__ import annotations

from typing import Any, Callable, List, Optional

import numpy as np
import numpy.typing as npt

from . import _core
from ._arguments import Progress, callback, integer, number, numeric_array, optional_number, triple
from ._mesh import Mesh, _need_mesh

_AXES = {"x": 0, "y": 1, "z": 2}


class Field:
    """A function of space, negative inside: what scenes are made of, and as they are.

    Functions of this module make fields. ``a | b`` unites, ``a & b`` intersects, ``a - b`` subtracts, ``~a`` swaps
    inside and outside; the functions union(), intersection() and difference() do so with any number, and with fillets.
    Fields do not change. Lengths are in world units.

    Examples
    --------
    >>> part = pdc.box(size=(2, 2, 1)) - pdc.cylinder((0, 0, -1), (0, 0, 1), 0.6)
    >>> part([[0, 0, 0], [0.8, 0.8, 0]]) < 0
    array([False,  True])
    """

    __slots__ = ("_handle",)
    _handle: _core.Field

    def __init__(self) -> None:
        raise TypeError("fields are made by functions such as pdc.sphere() and pdc.function()")

    @classmethod
    def _of(cls, core: _core.Field) -> Field:
        field = cls.__new__(cls)
        field._handle = core
        return field

    def __call__(self, points: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """The values at points of shape (n, 3)."""
        return self._handle.values(_points(points))

    def gradient(self, points: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """The gradients at points of shape (n, 3), of that shape, in value per world unit."""
        return self._handle.gradients(_points(points))

    def __or__(self, other: Field) -> Field:
        return union(self, other) if isinstance(other, Field) else NotImplemented

    def __and__(self, other: Field) -> Field:
        return intersection(self, other) if isinstance(other, Field) else NotImplemented

    def __sub__(self, other: Field) -> Field:
        return difference(self, other) if isinstance(other, Field) else NotImplemented

    def __invert__(self) -> Field:
        return Field._of(_core.complement(self._handle))

    def offset(self, distance: float) -> Field:
        """Grown by a distance, or shrunk by a negative one."""
        return Field._of(_core.offset(self._handle, number("distance", distance)))

    def shell(self, thickness: float) -> Field:
        """The skin about the surface, of that thickness."""
        return Field._of(_core.shell(self._handle, number("thickness", thickness, above=0)))

    def translate(self, by: Any) -> Field:
        """Moved by a vector."""
        return Field._of(_core.translate(self._handle, triple("by", by)))

    def rotate(self, degrees: float, axis: Any = (0, 0, 1)) -> Field:
        """Turned about an axis through the origin, right-handed."""
        return Field._of(_core.rotate(self._handle, triple("axis", axis), number("degrees", degrees)))

    def scale(self, factor: Any) -> Field:
        """Scaled about the origin by a number, or by three along the axes, all above 0."""
        if np.ndim(factor) == 0:
            return Field._of(_core.scale(self._handle, number("factor", factor, above=0)))
        return Field._of(_core.scale_axes(self._handle, triple("factor", factor, above=0)))

    def mirror(self, axis: str) -> Field:
        """The half above 0 along an axis, "x", "y" or "z", on both sides."""
        if axis not in _AXES:
            raise ValueError(f"axis must be 'x', 'y' or 'z', not {axis!r}")
        return Field._of(_core.mirror(self._handle, _AXES[axis]))

    def repeat(self, period: Any, count: Any = (0, 0, 0)) -> Field:
        """Copies at multiples of `period`, where that is not 0; `count` in each direction, 0 being any number."""
        counts = [integer(f"count[{i}]", n, 0, 2**31 - 1) for i, n in enumerate(count)]
        if len(counts) != 3:
            raise ValueError(f"count must be three numbers, not {len(counts)}")
        return Field._of(_core.repeat(self._handle, triple("period", period), (counts[0], counts[1], counts[2])))


def _points(points: npt.ArrayLike) -> npt.NDArray[np.float64]:
    array = numeric_array("points", points, 2)
    if array.shape[1] != 3:
        raise ValueError(f"points must have shape (n, 3), not {array.shape}")
    return np.ascontiguousarray(array, np.float64)


def _operands(fields: Any) -> List[_core.Field]:
    for field in fields:
        if not isinstance(field, Field):
            raise TypeError(f"fields must be pdc.Field, not {type(field).__name__}")
    return [field._handle for field in fields]


def union(*fields: Field, smooth: Optional[float] = None) -> Field:
    """All that is in any of the fields.

    Parameters
    ----------
    *fields : Field
        One or more.
    smooth : float, optional
        Radius of a fillet, above 0.

    Examples
    --------
    >>> pdc.union(pdc.sphere(1), pdc.sphere(1, center=(1, 0, 0)), smooth=0.2)([[0.5, 0, 0]]) < 0
    array([ True])
    """
    return Field._of(_core.unite(_operands(fields), optional_number("smooth", smooth, above=0)))


def intersection(*fields: Field, smooth: Optional[float] = None) -> Field:
    """All that is in each of the fields; `smooth` as for union().

    Examples
    --------
    >>> pdc.intersection(pdc.sphere(1), pdc.plane((0, 0, 1)))([[0, 0, 0.5]]) < 0
    array([False])
    """
    return Field._of(_core.intersect(_operands(fields), optional_number("smooth", smooth, above=0)))


def difference(*fields: Field, smooth: Optional[float] = None) -> Field:
    """All that is in the first field and in none of the others; `smooth` as for union().

    Examples
    --------
    >>> pdc.difference(pdc.sphere(1), pdc.sphere(0.5))([[0, 0, 0]]) < 0
    array([False])
    """
    return Field._of(_core.subtract(_operands(fields), optional_number("smooth", smooth, above=0)))


def sphere(radius: float, center: Any = (0, 0, 0)) -> Field:
    """A ball.

    Examples
    --------
    >>> pdc.sphere(2)([[0, 0, 0]])
    array([-2.])
    """
    return Field._of(_core.sphere(triple("center", center), number("radius", radius, above=0)))


def box(size: Any, center: Any = (0, 0, 0)) -> Field:
    """An axis-aligned box by the lengths of its edges, one number for a cube.

    Examples
    --------
    >>> pdc.box(2)([[0, 0, 3]])
    array([2.])
    """
    return Field._of(_core.box(triple("center", center), _size(size)))


def rounded_box(size: Any, radius: float, center: Any = (0, 0, 0)) -> Field:
    """A box of that outer size with rounded edges; the radius is at most half of the shortest one.

    Examples
    --------
    >>> pdc.rounded_box(2, 0.5)([[0, 0, 3]])
    array([2.])
    """
    return Field._of(_core.rounded_box(triple("center", center), _size(size), number("radius", radius, above=0)))


def _size(size: Any) -> Any:
    return triple("size", [size] * 3 if np.ndim(size) == 0 else size, above=0)


def plane(normal: Any, point: Any = (0, 0, 0)) -> Field:
    """The half-space behind a plane through a point, of which the normal points away.

    Examples
    --------
    >>> pdc.plane((0, 0, 1))([[0, 0, -3]])
    array([-3.])
    """
    return Field._of(_core.plane(triple("point", point), triple("normal", normal)))


def cylinder(start: Any, end: Any, radius: float) -> Field:
    """A solid cylinder with flat ends at two points.

    Examples
    --------
    >>> pdc.cylinder((0, 0, -1), (0, 0, 1), 0.5)([[0, 0, 0]])
    array([-0.5])
    """
    return Field._of(_core.cylinder(triple("start", start), triple("end", end), number("radius", radius, above=0)))


def capped_cone(start: Any, end: Any, radius_start: float, radius_end: float) -> Field:
    """A cone frustum with flat ends at two points; one radius may be 0.

    Examples
    --------
    >>> pdc.capped_cone((0, 0, 0), (0, 0, 2), 1, 0)([[0, 0, 1]]) < 0
    array([ True])
    """
    radii = number("radius_start", radius_start, at_least=0), number("radius_end", radius_end, at_least=0)
    return Field._of(_core.capped_cone(triple("start", start), triple("end", end), *radii))


def torus(radius: float, tube: float, center: Any = (0, 0, 0), axis: Any = (0, 0, 1)) -> Field:
    """A torus: `radius` from its centre to the middle of the tube, whose own radius is `tube`.

    Examples
    --------
    >>> pdc.torus(2, 0.5)([[2, 0, 0]])
    array([-0.5])
    """
    radii = number("radius", radius, above=0), number("tube", tube, above=0)
    return Field._of(_core.torus(triple("center", center), triple("axis", axis), *radii))


def capsule(start: Any, end: Any, radius: float) -> Field:
    """All points within a radius of the segment between two points.

    Examples
    --------
    >>> pdc.capsule((0, 0, 0), (0, 0, 1), 0.5)([[0, 0, 2]])
    array([0.5])
    """
    return Field._of(_core.capsule(triple("start", start), triple("end", end), number("radius", radius, above=0)))


def ellipsoid(semi_axes: Any, center: Any = (0, 0, 0)) -> Field:
    """An ellipsoid; its values are distances to first order.

    Examples
    --------
    >>> pdc.ellipsoid((1, 2, 3))([[0, 2, 0]])
    array([-0.])
    """
    return Field._of(_core.ellipsoid(triple("center", center), triple("semi_axes", semi_axes, above=0)))


def gyroid(period: float, thickness: float = 0) -> Field:
    """A gyroid sheet; of thickness 0 the solid on one side of it.

    Examples
    --------
    >>> pdc.gyroid(1, 0.3)([[0, 0, 0]]) < 0
    array([ True])
    """
    return Field._of(_core.gyroid(number("period", period, above=0), number("thickness", thickness, at_least=0)))


def simplex_noise(
    seed: int = 0,
    *,
    octaves: int = 4,
    frequency: float = 1,
    gain: float = 0.5,
    lacunarity: float = 2,
    amplitude: float = 1,
) -> Field:
    """Fractal noise of 1 to 16 octaves, the first within the amplitude; the same on every machine.

    Examples
    --------
    >>> abs(pdc.simplex_noise(seed=3, octaves=1)([[0.3, 0.1, 0.2]])) <= 1
    array([ True])
    """
    return Field._of(
        _core.simplex_noise(
            integer("seed", seed, 0, 2**32 - 1),
            integer("octaves", octaves, 1, 16),
            number("frequency", frequency, above=0),
            number("gain", gain, above=0),
            number("lacunarity", lacunarity, above=0),
            number("amplitude", amplitude, at_least=0),
        )
    )


def mesh_field(mesh: Mesh, *, progress: Progress = None) -> Field:
    """The signed distance from a mesh in world units, negative inside: where it goes around more than half a time.

    For a closed mesh that does not intersect itself these are exact distances; holes of others are closed.

    Parameters
    ----------
    mesh : Mesh
    progress : function of (stage, share), optional

    Raises
    ------
    pdc.Error
        For a mesh without a triangle.

    Examples
    --------
    >>> cube = pdc.contour(pdc.box(2), box=2.5, resolution=20)
    >>> pdc.mesh_field(cube)([[0, 0, 0], [0, 0, 3]]).round(3)
    array([-1.,  2.])
    """
    _need_mesh(mesh)
    return Field._of(_core.mesh_field(mesh._handle, callback(progress)))


def formula(expression: str, *, lipschitz: Optional[float] = None) -> Field:
    """A formula in x, y and z, in muParser's syntax.

    Parameters
    ----------
    expression : str
    lipschitz : float, optional
        A promise that values differ by no more than this times the distance, with which nothing is missed and little
        is looked at. Without it parts smaller than four voxels may be missed.

    Raises
    ------
    pdc.Error
        For a formula that cannot be read, with the place.

    Examples
    --------
    >>> pdc.formula("sqrt(x^2 + y^2 + z^2) - 1", lipschitz=1)([[0, 0, 0]])
    array([-1.])
    """
    if not isinstance(expression, str):
        raise TypeError(f"expression must be a str, not {type(expression).__name__}")
    return Field._of(_core.formula(expression, optional_number("lipschitz", lipschitz, above=0)))


def function(
    f: Callable[[npt.NDArray[np.float64]], npt.ArrayLike],
    *,
    gradient: Optional[Callable[[npt.NDArray[np.float64]], npt.ArrayLike]] = None,
    lipschitz: Optional[float] = None,
) -> Field:
    """A Python function as a field.

    Parameters
    ----------
    f : function of an array of shape (n, 3) to one of shape (n,)
        Negative inside, NaN where there is no value. It is called with up to 1,792 points at a time, from several threads
        in turn, and must depend on each point alone. What it raises passes through.
    gradient : function of an array of shape (n, 3) to one of shape (n, 3), optional
        In value per world unit. Without it each gradient takes six more values.
    lipschitz : float, optional
        As for formula().

    Examples
    --------
    >>> ball = pdc.function(lambda p: np.linalg.norm(p, axis=1) - 1, lipschitz=1)
    >>> len(pdc.contour(ball, box=2.5, resolution=16).vertices) > 100
    True
    """
    for name, given in (("f", f), ("gradient", gradient)):
        if not callable(given) and (name == "f" or given is not None):
            raise TypeError(f"{name} must be a function, not {type(given).__name__}")
    return Field._of(_core.function(f, gradient, optional_number("lipschitz", lipschitz, above=0)))
