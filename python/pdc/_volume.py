"""Dense volumes from files."""

from __future__ import annotations

from typing import Any, Dict, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._arguments import Progress, callback, integer, path_text, triple, warn, word
from ._mesh import Path


class Volume:
    """A dense volume from a file, with what the file says of it. read_volume() reads one.

    It is an array to NumPy, and a volume to contour(), which reads it where it lies. What is not compressed stays in the
    file, which must not change meanwhile.

    Attributes
    ----------
    values : array, shape (nx, ny, nz), indexed [x, y, z]
        In their units: what is stored, read-only and without a copy, where slope is 1 and intercept 0; else
        slope · stored + intercept in double precision.
    stored : array
        A read-only view of the numbers in the file.
    slope, intercept : float
    affine : array, shape (4, 4)
        From indices to the world: the first value is at its last column.
    spacing : three floats
        From value to value along each axis, in world units.
    spacing_known : bool
        False where the file does not say, and 1 was taken.
    space : str
        "RAS", "LPS", or what else the file calls its frame; may be empty.
    unit : str
        Of lengths, such as "mm"; may be empty.
    format, encoding, orientation : str
        Such as "NIfTI-1"; "raw", "deflate", "text" or "decoded"; what the affine was taken from.

    Examples
    --------
    >>> np.save("ramp.npy", np.arange(24, dtype=">i2").reshape(2, 3, 4))
    >>> ramp = pdc.read_volume("ramp.npy", spacing=0.5)
    >>> ramp, ramp.spacing, np.asarray(ramp).sum()
    (<pdc.Volume: npy, int16, 2 x 3 x 4>, (0.5, 0.5, 0.5), 276)
    """

    __slots__ = ("_handle", "_values")
    _handle: _core.Volume
    _values: Optional[npt.NDArray[Any]]

    def __init__(self) -> None:
        raise TypeError("volumes are made by pdc.read_volume()")

    @classmethod
    def _of(cls, core: _core.Volume) -> Volume:
        volume = cls.__new__(cls)
        volume._handle = core
        volume._values = None
        return volume

    @property
    def stored(self) -> npt.NDArray[Any]:
        """A read-only view of the numbers in the file."""
        return self._handle.stored

    @property
    def slope(self) -> float:
        """What stored numbers are multiplied with."""
        return self._handle.slope

    @property
    def intercept(self) -> float:
        """What is added to them then."""
        return self._handle.intercept

    @property
    def values(self) -> npt.NDArray[Any]:
        """The values in their units."""
        if self._values is None:
            scaled = self.slope != 1 or self.intercept != 0
            self._values = self.slope * self.stored.astype(np.float64) + self.intercept if scaled else self.stored
        return self._values

    def __array__(self, dtype: Any = None, copy: Optional[bool] = None) -> npt.NDArray[Any]:
        array: npt.NDArray[Any] = self.values if dtype is None else self.values.astype(dtype, copy=False)
        return array.copy() if copy else array

    @property
    def shape(self) -> Tuple[int, int, int]:
        """How many values along x, y and z."""
        x, y, z = self.stored.shape
        return (x, y, z)

    @property
    def affine(self) -> npt.NDArray[np.float64]:
        """The matrix, shape (4, 4), from indices to the world."""
        return self._handle.affine

    @property
    def spacing(self) -> Tuple[float, float, float]:
        """From value to value along each axis, in world units."""
        x, y, z = np.linalg.norm(self.affine[:3, :3], axis=0).tolist()
        return (x, y, z)

    @property
    def spacing_known(self) -> bool:
        """False where the file does not say, and 1 was taken."""
        return self._handle.spacing_known

    @property
    def space(self) -> str:
        """The world's frame, such as "RAS"; may be empty."""
        return self._handle.space

    @property
    def unit(self) -> str:
        """Of lengths; may be empty."""
        return self._handle.unit

    @property
    def format(self) -> str:
        """Such as "NIfTI-1"."""
        return self._handle.format

    @property
    def encoding(self) -> str:
        """ "raw", "deflate", "text", or "decoded" by a library."""
        return self._handle.encoding

    @property
    def orientation(self) -> str:
        """What the affine was taken from; may be empty."""
        return self._handle.orientation

    def __repr__(self) -> str:
        x, y, z = self.shape
        return f"<pdc.Volume: {self.format}, {self.stored.dtype.name}, {x} x {y} x {z}>"


def read_volume(
    path: Path,
    *,
    raw: Optional[str] = None,
    array: Optional[str] = None,
    series: Union[None, str, int] = None,
    volume_index: Optional[int] = None,
    channel: Optional[int] = None,
    spacing: Any = None,
    space: Optional[str] = None,
    progress: Progress = None,
) -> Volume:
    """Read a dense volume: NIfTI, NRRD, MetaImage, .npy, .npz, Inrimage, TIFF, DICOM, or a folder of the last two.

    Parameters
    ----------
    path : path
    raw : str, optional
        The file has no header: its sizes, x fastest, the type, "le" or "be", and bytes to skip, "256x256x128:u16be:512".
    array : str, optional
        Which array of an .npz, if several have three dimensions.
    series : str or int, optional
        Which series of DICOM files: its UID, or its place from 1 on.
    volume_index : int, optional
        Which volume, from 0 on, if there are several in time.
    channel : int, optional
        Which value, from 0 on, if points have several.
    spacing : float or three, optional
        From value to value, in world units, instead of the file's.
    space : "file", "ras" or "lps", optional
        The frame of the world. Default: the file's.
    progress : function of (stage, share), optional

    Returns
    -------
    Volume

    Raises
    ------
    pdc.Error
        For a file that cannot be read, or whose values are no real numbers.

    Examples
    --------
    >>> with open("grey.raw", "wb") as file:
    ...     _ = file.write(bytes(range(60)))
    >>> pdc.read_volume("grey.raw", raw="3x4x5:u8", spacing=1).stored[2, 0, 1]
    14
    """
    options = volume_options(raw, array, series, volume_index, channel, spacing, space)
    volume = Volume._of(_core.read_volume(path_text("path", path), options, callback(progress)))
    warn(volume._handle.warnings)
    return volume


def volume_options(
    raw: Any, array: Any, series: Any, volume_index: Any, channel: Any, spacing: Any, space: Any
) -> Dict[str, Any]:
    """How to read the file of a dense volume, checked; without what is not said."""
    options: Dict[str, Any] = {}
    for name, text in (("raw", raw), ("array", array)):
        if text is not None and not isinstance(text, str):
            raise TypeError(f"{name} must be a str, not {type(text).__name__}")
        options[name] = text
    if series is not None:
        options["series"] = series if isinstance(series, str) else str(integer("series", series, 1, 2**31 - 1))
    for name, index in (("volume_index", volume_index), ("channel", channel)):
        options[name] = None if index is None else integer(name, index, 0, 2**63 - 1)
    if spacing is not None:
        options["spacing"] = triple("spacing", [spacing] * 3 if np.ndim(spacing) == 0 else spacing, above=0)
    if space is not None:
        options["space"] = word("space", space, ("file", "ras", "lps"))
    return {name: value for name, value in options.items() if value is not None}
