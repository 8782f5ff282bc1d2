"""Steps on grids before they are contoured."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Dict, Optional, cast

from . import _core
from ._arguments import (
    callback,
    corners_of,
    flag,
    integer,
    number,
    optional_number,
    thread_count,
    warn,
    word,
)

if TYPE_CHECKING:
    from ._grid import Grid

_MEANING = {"inside": ("low", "high"), "grid_class": ("level-set", "fog"), "nan": ("error", "outside")}


class GridSteps:
    """What can be done to a grid: each method gives a new one. Lengths are in world units.

    Each takes, by name, `level`, `inside`, `grid_class`, `flood_fill` and `nan`, which say how the grid is read, as for
    contour() (a grid that steps made is known already), `threads` and `progress`. Raises pdc.Error for what the step
    does not take: grids of integers, fog volumes where it needs a level set, voxels that are no cubes.
    """

    __slots__ = ()

    def fog_to_level_set(self, level: float = 0.5, **reading: Any) -> Grid:
        """The level set of a fog volume's surface at `level`, whose surface is at 0.

        Examples
        --------
        >>> fog = pdc.Grid.from_array(np.pad(np.ones((8, 8, 8), np.float32), 3), grid_class="fog")
        >>> fog.fog_to_level_set(0.5).grid_class
        'level set'
        """
        value = number("level", level)
        return self._step({"fog_to_level_set": value}, {**reading, "level": value})

    def clip(self, box: Any = None, *, mask: Optional[Grid] = None, closed: bool = True, **reading: Any) -> Grid:
        """What is in a box, two corners or the edge of a cube about the origin, or within the active voxels of a mask.

        A level set that a box cuts is closed there, unless `closed` is False.

        Examples
        --------
        >>> ball = pdc.Grid.from_mesh(pdc.contour(pdc.sphere(1), box=2.5, resolution=24), 0.1)
        >>> bool(pdc.contour(ball.clip([(-2, -2, 0), (2, 2, 2)])).vertices[:, 2].min() > -0.01)
        True
        """
        if (box is None) == (mask is None):
            raise ValueError("clip needs a box or a mask, and not both")
        step: Dict[str, Any] = {"closed": flag("closed", closed)}
        if mask is None:
            lo, hi = corners_of("box", box)
            step["clip_box"] = (*lo, *hi)
        else:
            step["clip_mask"] = _handle("mask", mask)
        return self._step(step, reading)

    def resample(self, voxel_size: float, *, method: str = "best", **reading: Any) -> Grid:
        """On voxels of another size, which are cubes.

        `method` is "contour", which keeps creases and makes a level set; "linear", "quadratic"; or "best", which is the
        first for level sets and the second for fog volumes.

        Examples
        --------
        >>> ball = pdc.Grid.from_mesh(pdc.contour(pdc.sphere(1), box=2.5, resolution=24), 0.1)
        >>> round(float(ball.resample(0.2).affine[0, 0]), 6)
        0.2
        """
        method = word("method", method, ("best", "contour", "linear", "quadratic"))
        return self._step({"resample": number("voxel_size", voxel_size, above=0), "method": method}, reading)

    def smooth(self, radius: float, *, filter: str = "mean", **reading: Any) -> Grid:
        """Values filtered over a radius by "mean", "gaussian", "median", or "curvature", which is for level sets only.

        Examples
        --------
        >>> ball = pdc.Grid.from_mesh(pdc.contour(pdc.sphere(1), box=2.5, resolution=24), 0.1)
        >>> [step["parameter"] for step in ball.smooth(0.1, filter="gaussian").steps]
        ['0.1', 'gaussian:0.1']
        """
        filter = word("filter", filter, ("mean", "gaussian", "median", "curvature"))
        return self._step({"smooth": number("radius", radius, above=0), "filter": filter}, reading)

    def offset(self, distance: float, **reading: Any) -> Grid:
        """A level set whose surface went outwards, or inwards below 0.

        Examples
        --------
        >>> ball = pdc.Grid.from_mesh(pdc.contour(pdc.sphere(1), box=2.5, resolution=24), 0.1)
        >>> bool(abs(pdc.contour(ball.offset(0.5)).vertices[:, 0].max() - 1.5) < 0.02)
        True
        """
        return self._step({"offset": number("distance", distance)}, reading)

    def open_close(self, distance: float, **reading: Any) -> Grid:
        """A level set without what is thinner than twice the distance: solid first, then gaps.

        Examples
        --------
        >>> part = pdc.sphere(1) | pdc.cylinder((0, 0, 0), (0, 0, 1.8), 0.1)
        >>> grid = pdc.Grid.from_mesh(pdc.contour(part, box=4, resolution=64), 0.0625)
        >>> bool(pdc.contour(grid.open_close(0.2)).vertices[:, 2].max() < 1.1)
        True
        """
        return self._step({"open_close": number("distance", distance, above=0)}, reading)

    def union(self, *others: Grid, **reading: Any) -> Grid:
        """A level set with the solids of others, on this one's lattice.

        Examples
        --------
        >>> shapes = [pdc.sphere(0.5), pdc.box(0.5, center=(1.5, 0, 0))]
        >>> a, b = (pdc.Grid.from_mesh(pdc.contour(s, box=4, resolution=40), 0.1) for s in shapes)
        >>> a.union(b).active_voxels > a.active_voxels
        True
        """
        return self._combine("union", others, reading)

    def intersect(self, *others: Grid, **reading: Any) -> Grid:
        """A level set of what is in the others, too.

        Examples
        --------
        >>> shapes = [pdc.sphere(1), pdc.box(2, center=(1, 0, 0))]
        >>> a, b = (pdc.Grid.from_mesh(pdc.contour(s, box=5, resolution=50), 0.1) for s in shapes)
        >>> bool(pdc.contour(a.intersect(b)).vertices[:, 0].min() > -0.01)
        True
        """
        return self._combine("intersect", others, reading)

    def subtract(self, *others: Grid, **reading: Any) -> Grid:
        """A level set of what is in none of the others.

        Examples
        --------
        >>> shapes = [pdc.sphere(1), pdc.box(2, center=(1, 0, 0))]
        >>> a, b = (pdc.Grid.from_mesh(pdc.contour(s, box=5, resolution=50), 0.1) for s in shapes)
        >>> bool(pdc.contour(a.subtract(b)).vertices[:, 0].max() < 0.01)
        True
        """
        return self._combine("subtract", others, reading)

    def keep(self, most: Optional[int] = None, *, above: Optional[int] = None, **reading: Any) -> Grid:
        """The `most` largest parts of the solid, or those of more voxels than `above`, or both; by default the largest.

        Examples
        --------
        >>> a = np.pad(np.ones((6, 6, 6), np.float32), 3); a[0, 0, 0] = 1
        >>> pdc.Grid.from_array(a, grid_class="fog").keep().steps[0]["parts_before"]
        2
        """
        if most is None and above is None:
            most = 1
        step = {
            "most": None if most is None else integer("most", most, 1, 2**63 - 1),
            "above": None if above is None else integer("above", above, 1, 2**63 - 1),
        }
        return self._step(step, reading)

    def fill_cavities(self, **reading: Any) -> Grid:
        """A solid without cavities.

        Examples
        --------
        >>> a = np.pad(np.ones((6, 6, 6), np.float32), 3); a[5, 5, 5] = 0
        >>> pdc.Grid.from_array(a, grid_class="fog").fill_cavities().steps[0]["parts_before"]
        1
        """
        return self._step({"fill_cavities": True}, reading)

    def _combine(self, kind: str, others: Any, reading: Dict[str, Any]) -> Grid:
        if not others:
            raise ValueError(f"{kind} needs another grid")
        return self._step({"combine": kind}, reading, [_handle("others", other) for other in others], depth=5)

    def _step(self, step: Dict[str, Any], reading: Dict[str, Any], others: Any = (), depth: int = 4) -> Grid:
        grid = cast("Grid", self)
        progress = callback(reading.pop("progress", None))
        step["threads"] = thread_count(reading.pop("threads", 0))
        core, steps, lines = _core.grid_steps(grid._handle, {**step, **_reading(reading)}, list(others), progress)
        warn(lines, depth)
        return grid._of(core, (*grid.steps, *steps))


def _reading(given: Dict[str, Any]) -> Dict[str, Any]:
    """How a grid is said to be read, checked."""
    options: Dict[str, Any] = {}
    for name, value in given.items():
        if name == "level":
            options[name] = optional_number(name, value)
        elif name == "flood_fill":
            options[name] = flag(name, value)
        elif name in _MEANING:
            options[name] = None if value is None else word(name, value, _MEANING[name])
        else:
            raise TypeError(f"a step on grids got an unexpected argument '{name}'")
    return options


def _handle(name: str, grid: Any) -> _core.Grid:
    if not isinstance(grid, GridSteps):
        raise TypeError(f"{name} must be pdc.Grid, not {type(grid).__name__}")
    return cast("Grid", grid)._handle
