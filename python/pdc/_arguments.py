"""What callers give, checked: each mistake is a line that names the argument, the value and the limit."""

from __future__ import annotations

import math
import operator
import warnings
from collections import abc
from typing import Any, Callable, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

Progress = Optional[Callable[[str, float], object]]
Triple = Tuple[float, float, float]


class Warning(UserWarning):
    """What pdc found odd in the data, such as a volume without a surface.

    Examples
    --------
    >>> import warnings
    >>> with warnings.catch_warnings():
    ...     warnings.simplefilter("error", pdc.Warning)
    ...     pdc.contour(np.ones((4, 4, 4)), 2)
    Traceback (most recent call last):
    ...
    pdc.Warning: the volume has no surface at level 2; the mesh is empty
    """


Warning.__module__ = "pdc"


def warn(lines: abc.Iterable[str], level: int = 3) -> None:
    """Warns of each line in the name of whoever called the public function."""
    for line in lines:
        warnings.warn(line, Warning, stacklevel=level)


def number(name: str, value: Any, *, at_least: float = -math.inf, above: float = -math.inf,
           infinite: bool = False) -> float:
    """A real number within limits."""
    try:
        result = float(value)
    except (TypeError, ValueError):
        raise TypeError(f"{name} must be a number, not {type(value).__name__}") from None
    limit = f" >= {at_least:g}" if at_least > -math.inf else f" > {above:g}" if above > -math.inf else ""
    if math.isnan(result) or (math.isinf(result) and not infinite) or result < at_least or result <= above != -math.inf:
        raise ValueError(f"{name} must be a{'' if infinite else ' finite'} number{limit}, not {value!r}")
    return result


def optional_number(name: str, value: Any, **limits: Any) -> Optional[float]:
    """A number, or None."""
    return None if value is None else number(name, value, **limits)


def integer(name: str, value: Any, low: int, high: int) -> int:
    """A whole number from low to high."""
    try:
        result = operator.index(value)
    except TypeError:
        raise TypeError(f"{name} must be a whole number, not {type(value).__name__}") from None
    if not low <= result <= high:
        raise ValueError(f"{name} must be from {low} to {high}, not {result}")
    return result


def thread_count(value: Any) -> int:
    """How many threads; 0 is all."""
    return integer("threads", value, 0, 4096)


def triple(name: str, value: Any, *, above: float = -math.inf) -> Triple:
    """Three finite numbers."""
    try:
        items = list(value)
    except TypeError:
        raise TypeError(f"{name} must be three numbers, not {type(value).__name__}") from None
    if len(items) != 3:
        raise ValueError(f"{name} must be three numbers, not {len(items)}")
    x, y, z = (number(f"{name}[{i}]", item, above=above) for i, item in enumerate(items))
    return (x, y, z)


def corners_of(name: str, box: Any) -> Tuple[Triple, Triple]:
    """Two corners of a box, or the edge of a cube about the origin."""
    if np.ndim(box) == 0:
        half = number(name, box, above=0) / 2
        return (-half, -half, -half), (half, half, half)
    if len(box) != 2:
        raise ValueError(f"{name} must be two corners, or the edge of a cube about the origin, not {box!r}")
    lo, hi = triple(f"{name}[0]", box[0]), triple(f"{name}[1]", box[1])
    for axis, low, high in zip("xyz", lo, hi):
        if not low < high:
            raise ValueError(f"{name} must not be empty: it goes from {low:g} to {high:g} along {axis}")
    return lo, hi


def callback(progress: Any) -> Progress:
    """A function that hears of progress, or None."""
    if progress is not None and not callable(progress):
        raise TypeError(f"progress must be a function of (stage, share) or None, not {type(progress).__name__}")
    return progress  # type: ignore[no-any-return]


def numeric_array(name: str, value: Any, ndim: int = 3) -> npt.NDArray[Any]:
    """An array of real numbers with so many dimensions, as it lies in memory."""
    if isinstance(value, np.ma.MaskedArray):
        raise TypeError(f"{name} is a masked array; give its data and mask=~{name}.mask")
    array = np.asarray(value)
    if array.dtype.kind not in "biuf" or array.dtype.itemsize > 8:
        raise TypeError(f"{name} must hold bool, integers or floats of at most 64 bits, not {array.dtype}")
    if array.ndim != ndim:
        raise ValueError(f"{name} must have {ndim} dimensions, not {array.ndim}: its shape is {array.shape}")
    if array.size == 0:
        raise ValueError(f"{name} must not be empty: its shape is {array.shape}")
    return array


def affine_of(spacing: Any, origin: Any, affine: Any) -> npt.NDArray[np.float64]:
    """The 4 × 4 matrix from indices to the world."""
    if affine is not None:
        for name, value in (("spacing", spacing), ("origin", origin)):
            if value is not None:
                raise ValueError(f"affine excludes {name}: it says where the voxels are")
        matrix = np.asarray(affine)
        if matrix.dtype.kind not in "biuf":
            raise TypeError(f"affine must hold real numbers, not {matrix.dtype}")
        if matrix.shape not in ((3, 4), (4, 4)):
            raise ValueError(f"affine must have shape (4, 4) or (3, 4), not {matrix.shape}")
        result = np.eye(4)
        result[: matrix.shape[0]] = matrix
        if not np.isfinite(result).all():
            raise ValueError("affine must hold finite numbers")
        if not np.array_equal(result[3], (0, 0, 0, 1)):
            raise ValueError(f"the last row of affine must be 0, 0, 0, 1, not {result[3].tolist()}")
        if np.linalg.matrix_rank(result[:3, :3]) < 3:
            raise ValueError("affine must not be singular")
        return result
    result = np.eye(4)
    if spacing is not None:
        steps = [spacing] * 3 if np.ndim(spacing) == 0 else spacing
        result[:3, :3] = np.diag(triple("spacing", steps, above=0))
    if origin is not None:
        result[:3, 3] = triple("origin", origin)
    return result


def is_path(value: Any) -> bool:
    """Whether this names a file."""
    return isinstance(value, (str, bytes)) or hasattr(value, "__fspath__")


def path_text(name: str, value: Any) -> str:
    """A path."""
    import os

    try:
        text = os.fspath(value)
    except TypeError:
        raise TypeError(f"{name} must be a path, not {type(value).__name__}") from None
    return os.fsdecode(text)


def flag(name: str, value: Any) -> bool:
    """True or False."""
    if not isinstance(value, (bool, np.bool_)):
        raise TypeError(f"{name} must be True or False, not {value!r}")
    return bool(value)


def word(name: str, value: Any, choices: abc.Sequence[str]) -> str:
    """One of several words."""
    if value not in choices or not isinstance(value, str):
        raise ValueError(f"{name} must be one of {', '.join(map(repr, choices))}, not {value!r}")
    return value


Sigma = Union[None, str, float]


def sigma_normal(value: Any) -> Sigma:
    """Noise of the normals: a number, 'auto', or None for what the program takes."""
    if value is None or value == "auto":
        return None if value is None else "auto"
    if isinstance(value, str):
        raise ValueError(f"sigma_normal must be a number >= 0 or 'auto', not {value!r}")
    return number("sigma_normal", value, at_least=0, infinite=True)
