"""Scene files."""

from __future__ import annotations

from typing import Any, Optional, Tuple

from . import _core
from ._arguments import Triple, path_text, warn
from ._field import Field
from ._mesh import Path


class Scene:
    """An implicit scene: a field, where it is looked at, and how finely. scene() reads one.

    Attributes
    ----------
    name : str
        A title; empty without one.
    field : Field
    box : pair of three numbers
        Two corners, in world units.
    voxel_size : float
        World units.
    level : float
        The surface is where the field has this value.
    sigma_normal : float or None
        Noise of the normals that the file says.

    Examples
    --------
    >>> text = "name: ball\\nbox: [[-1, -1, -1], [1, 1, 1]]\\nresolution: 20\\nshape: {sphere: {radius: 0.8}}"
    >>> _ = open("ball.yaml", "w").write(text)
    >>> ball = pdc.scene("ball.yaml")
    >>> ball, ball.box[0], ball.field([[0, 0, 0]])
    (<pdc.Scene: ball, voxels of 0.1>, (-1.0, -1.0, -1.0), array([-0.8]))
    """

    __slots__ = ("name", "field", "box", "voxel_size", "level", "sigma_normal", "_nan")

    def __init__(self, field: Field, box: Tuple[Triple, Triple], voxel_size: float) -> None:
        self.name: str = ""
        self.field = field
        self.box = box
        self.voxel_size = voxel_size
        self.level: float = 0
        self.sigma_normal: Optional[float] = None
        self._nan: str = "error"

    def __repr__(self) -> str:
        return f"<pdc.Scene: {self.name or 'without a name'}, voxels of {self.voxel_size:g}>"


def scene(path: Path) -> Scene:
    """Read a scene file (.yaml).

    Parameters
    ----------
    path : path

    Returns
    -------
    Scene

    Raises
    ------
    pdc.Error
        With line and column, for anything that is not exactly right.

    Examples
    --------
    >>> text = "box: [[-1, -1, -1], [1, 1, 1]]\\nresolution: 20\\nshape: {sphere: {radius: 0.8}}"
    >>> _ = open("ball.yaml", "w").write(text)
    >>> pdc.scene("ball.yaml").voxel_size
    0.1
    """
    said: Any = _core.read_scene(path_text("path", path))
    warn(said["warnings"])
    result = Scene(Field._of(said["field"]), (said["lo"], said["hi"]), said["voxel_size"])
    result.name = said["name"]
    result.level = said["level"]
    result.sigma_normal = said["sigma_normal"]
    result._nan = said["nan"]
    return result
