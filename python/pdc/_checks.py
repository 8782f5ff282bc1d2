"""Facts about meshes and files."""

from __future__ import annotations

from collections import abc
from typing import Any, Dict, List

from . import _core
from ._arguments import Progress, callback, flag, path_text, thread_count
from ._mesh import Mesh, Path, _need_mesh


class Check(abc.Mapping[str, Any]):
    """What check() found: facts by name, as `pdc check --json` has them.

    Attributes
    ----------
    clean : bool
        True if there are no faults.
    faults : list of str
        The names of the facts that are faults.

    Examples
    --------
    >>> found = pdc.check(pdc.contour(pdc.sphere(1), box=2.5, resolution=16))
    >>> found, found["euler_number"], "boundary_edges" in found
    (<pdc.Check: clean>, 2, True)
    """

    __slots__ = ("_facts",)

    def __init__(self, facts: Dict[str, Any]) -> None:
        self._facts = facts

    @property
    def clean(self) -> bool:
        """True if there are no faults."""
        return not self.faults

    @property
    def faults(self) -> List[str]:
        """The names of the facts that are faults."""
        return list(self._facts["faults"])

    def __getitem__(self, name: str) -> Any:
        return self._facts[name]

    def __iter__(self) -> abc.Iterator[str]:
        return iter(self._facts)

    def __len__(self) -> int:
        return len(self._facts)

    def __repr__(self) -> str:
        found = ", ".join(f"{name} {self[name]}" for name in self.faults)
        return f"<pdc.Check: {'not clean: ' + found if found else 'clean'}>"


def check(
    mesh: Mesh,
    *,
    allow_boundary: bool = False,
    allow_empty: bool = False,
    threads: int = 0,
    progress: Progress = None,
) -> Check:
    """Whether a mesh is the oriented boundary of a solid that nowhere intersects itself; exactly decided.

    Parameters
    ----------
    mesh : Mesh
    allow_boundary, allow_empty : bool
        Edges with one face, or a mesh without faces, are no fault.
    threads : int
        0 is all.
    progress : function of (stage, share), optional

    Returns
    -------
    Check

    Examples
    --------
    >>> found = pdc.check(pdc.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]))
    >>> found.clean, found.faults, found["boundary_edges"]
    (False, ['boundary_edges'], 3)
    """
    _need_mesh(mesh)
    boundary, empty = flag("allow_boundary", allow_boundary), flag("allow_empty", allow_empty)
    return Check(_core.check(mesh._handle, boundary, empty, thread_count(threads), callback(progress)))


def info(path: Path) -> Dict[str, Any]:
    """What is in a file of meshes, volumes or grids, or a scene: what `pdc info --json` says.

    Parameters
    ----------
    path : path

    Raises
    ------
    pdc.Error
        For a file that cannot be read.

    Examples
    --------
    >>> pdc.contour(pdc.sphere(1), box=2.5, resolution=16).save("ball.ply")
    >>> pdc.info("ball.ply")["euler_number"]
    2
    """
    return _core.info(path_text("path", path))
