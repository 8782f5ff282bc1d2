"""OpenVDB grids."""

from __future__ import annotations

from typing import Any, Dict, Optional, Tuple

import numpy as np
import numpy.typing as npt

from . import _core
from ._arguments import (
    Progress,
    affine_of,
    callback,
    number,
    numeric_array,
    path_text,
    thread_count,
    warn,
    word,
)
from ._grid_steps import GridSteps
from ._mesh import Mesh, Path, _need_mesh

_CLASSES = {None: "unknown", "level-set": "level set", "fog": "fog volume"}
_TYPES = {"float": "FloatGrid", "bool": "BoolGrid", "double": "DoubleGrid", "int32": "Int32Grid", "int64": "Int64Grid"}
_MODULES = ("pyopenvdb", "openvdb")
Index = Tuple[int, int, int]


class Grid(GridSteps):
    """A sparse grid of OpenVDB that does not change. Methods called from_... and read_grid() make one.

    Steps such as clip() and smooth() make further ones: see docs/grids.md. Those carry on where their surface is and
    which values are inside, to other steps and to contour().

    Examples
    --------
    >>> a = np.full((8, 8, 8), 1.0, np.float32); a[2:6, 2:6, 2:6] = -1
    >>> grid = pdc.Grid.from_array(a, spacing=0.5, background=1, grid_class="level-set")
    >>> grid.active_voxels, grid.value_type, grid.active_box
    (64, 'float', ((2, 2, 2), (5, 5, 5)))
    """

    __slots__ = ("_handle", "_steps")
    _handle: _core.Grid
    _steps: Tuple[Dict[str, Any], ...]

    def __init__(self) -> None:
        raise TypeError("grids are made by pdc.read_grid(), pdc.Grid.from_array() and their like")

    @classmethod
    def _of(cls, core: _core.Grid, steps: Tuple[Dict[str, Any], ...] = ()) -> Grid:
        grid = cls.__new__(cls)
        grid._handle = core
        grid._steps = steps
        return grid

    @classmethod
    def from_array(
        cls,
        array: npt.ArrayLike,
        *,
        spacing: Any = None,
        origin: Any = None,
        affine: Optional[npt.ArrayLike] = None,
        background: float = 0,
        grid_class: Optional[str] = None,
    ) -> Grid:
        """A grid of the values of an array that are not the background's.

        Parameters
        ----------
        array : array of bool, integers or floats, shape (nx, ny, nz)
            In any order. Values are kept as float, double, int32, int64 or bool, whichever holds them.
        spacing, origin, affine
            As for contour().
        background : float
            The value everywhere else. For signed distances: the band's width.
        grid_class : "level-set", "fog" or None
            None: as the values look, when they are contoured.

        Examples
        --------
        >>> pdc.Grid.from_array(np.ones((2, 3, 4), np.uint8)).value_type
        'int32'
        """
        given = numeric_array("array", array)
        kept: Any = np.float32 if given.dtype.kind == "f" else given.dtype
        if given.dtype.kind == "f" and given.dtype.itemsize == 8:
            kept = np.float64
        elif given.dtype.kind in "iu":
            if given.dtype == np.uint64 and int(given.max()) >= 2**63:
                raise ValueError(f"array must hold integers below 2^63, not {given.max()}")
            kept = np.int32 if np.can_cast(given.dtype, np.int32) else np.int64
        elif given.dtype.kind == "b":
            kept = np.bool_
        values = np.ascontiguousarray(given, kept)
        chosen = None if grid_class is None else word("grid_class", grid_class, ("level-set", "fog"))
        outside = number("background", background)
        return cls._of(_core.grid_from_array(values, affine_of(spacing, origin, affine), outside, _CLASSES[chosen]))

    @classmethod
    def from_openvdb(cls, grid: Any) -> Grid:
        """A copy of a grid of the module pyopenvdb or openvdb, through the stream that it is pickled as.

        Examples
        --------
        >>> pyopenvdb = pytest.importorskip("pyopenvdb")
        >>> pdc.Grid.from_openvdb(pyopenvdb.createLevelSetSphere(5.0)).grid_class
        'level set'
        """
        if not is_openvdb(grid):
            raise TypeError(f"grid must be a grid of pyopenvdb or openvdb, not {type(grid).__name__}")
        return cls._of(_core.grid_from_bytes(grid.__getstate__()[1]))

    @classmethod
    def from_mesh(
        cls,
        mesh: Mesh,
        voxel_size: float,
        *,
        half_width: Optional[float] = None,
        threads: int = 0,
        progress: Progress = None,
    ) -> Grid:
        """The level set of a mesh, which should be closed.

        Parameters
        ----------
        mesh : Mesh
        voxel_size : float
            World units.
        half_width : float, optional
            Of the band on each side, in world units, at least a voxel. Default: three voxels.
        threads, progress
            As for contour().

        Examples
        --------
        >>> ball = pdc.contour(pdc.sphere(1), box=2.5, resolution=24)
        >>> grid = pdc.Grid.from_mesh(ball, 0.1)
        >>> grid.grid_class, bool(abs(grid.background - 0.3) < 1e-6)
        ('level set', True)
        """
        _need_mesh(mesh)
        edge = number("voxel_size", voxel_size, above=0)
        width = 0.0 if half_width is None else number("half_width", half_width, at_least=edge)
        core, steps, lines = _core.grid_from_mesh(mesh._handle, edge, width, thread_count(threads), callback(progress))
        warn(lines)
        return cls._of(core, tuple(steps))

    def to_openvdb(self) -> Any:
        """A copy as a grid of the module openvdb or pyopenvdb, whichever is there.

        Raises ImportError where neither is, and TypeError where it has no such type.
        """
        module = _openvdb_module()
        name = _TYPES.get(self.value_type, "")
        if not hasattr(module, name):
            raise TypeError(f"{module.__name__} has no grids of type {self.value_type}")
        grid = getattr(module, name)()
        state: Tuple[Dict[str, Any], bytes] = ({}, self._handle.to_bytes())
        grid.__setstate__(state)
        return grid

    def to_array(self, box: Optional[Tuple[Index, Index]] = None) -> npt.NDArray[Any]:
        """The values in a box of index space, two inclusive corners; by default that of the active voxels.

        Examples
        --------
        >>> grid = pdc.Grid.from_array(np.arange(24, dtype=np.float32).reshape(2, 3, 4), background=-1)
        >>> grid.to_array().shape
        (2, 3, 4)
        """
        chosen = self.active_box if box is None else box
        if chosen is None:
            raise ValueError("box must be given for a grid without active voxels")
        lo, hi = (tuple(int(i) for i in corner) for corner in chosen)
        if len(lo) != 3 or len(hi) != 3 or any(h < l for l, h in zip(lo, hi)):
            raise ValueError(f"box must be two corners of three indices, the first nowhere larger, not {chosen}")
        result: npt.NDArray[Any] = self._handle.to_array(lo, hi)
        return result

    @property
    def name(self) -> str:
        """Its name in files; may be empty."""
        return self._handle.name

    @property
    def value_type(self) -> str:
        """ "float", "double", "int32", "int64", "bool", or another type of OpenVDB."""
        return self._handle.value_type

    @property
    def grid_class(self) -> str:
        """ "level set", "fog volume" or "unknown"."""
        return self._handle.grid_class

    @property
    def active_voxels(self) -> int:
        """Their number."""
        return self._handle.active_voxels

    @property
    def active_box(self) -> Optional[Tuple[Index, Index]]:
        """The smallest and largest indices of active voxels, or None."""
        return self._handle.active_box

    @property
    def background(self) -> float:
        """The value where nothing is stored."""
        return self._handle.background

    @property
    def affine(self) -> npt.NDArray[np.float64]:
        """The matrix, shape (4, 4), from indices to the world. Raises pdc.Error for a frustum."""
        return self._handle.affine

    @property
    def steps(self) -> Tuple[Dict[str, Any], ...]:
        """What made it of another grid or a mesh, one after the other, as `pdc grid --json` has it."""
        return self._steps

    def save(self, path: Path) -> None:
        """Write the grid to a .vdb file, which appears when it is complete. Raises pdc.Error."""
        self._handle.save(path_text("path", path))

    def __repr__(self) -> str:
        return f"<pdc.Grid: {self.name!r}, {self.value_type}, {self.grid_class}, {self.active_voxels} active voxels>"


def borrowed(grid: Any) -> Grid:
    """A grid of OpenVDB's own module as it lies in memory where that can be, else a copy."""
    try:
        from . import _openvdb
    except ImportError:
        return Grid.from_openvdb(grid)
    lent = _openvdb.share(grid)
    return Grid.from_openvdb(grid) if lent is None else Grid._of(_core.grid_from_capsule(lent))


def is_openvdb(grid: Any) -> bool:
    """Whether this is a grid of OpenVDB's own module."""
    return type(grid).__module__.split(".")[0] in _MODULES and hasattr(grid, "__getstate__")


def _openvdb_module() -> Any:
    import importlib

    for name in reversed(_MODULES):
        try:
            return importlib.import_module(name)
        except ImportError:
            pass
    raise ImportError("neither the module openvdb nor pyopenvdb is there")


def read_grid(path: Path, name: Optional[str] = None) -> Grid:
    """Read a grid from a .vdb file.

    Parameters
    ----------
    path : path
    name : str, optional
        Which one, if the file has several; "name[1]" where some share a name.

    Returns
    -------
    Grid

    Raises
    ------
    pdc.Error
        For a file that is missing or damaged, and a name that is not there.

    Examples
    --------
    >>> pdc.Grid.from_array(np.eye(4, dtype=np.float32)[None]).save("eye.vdb")
    >>> pdc.read_grid("eye.vdb").active_voxels
    4
    """
    return Grid._of(_core.read_grid(path_text("path", path), name or ""))
