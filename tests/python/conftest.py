"""What the tests of the Python package share. The package, the program and the tree come from the environment."""

import os
import pathlib

import numpy as np
import pytest

import pdc


@pytest.fixture(autouse=True)
def scratch(tmp_path, monkeypatch):
    """Each test works in a folder of its own."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture(autouse=True)
def names_of_examples(doctest_namespace):
    import math

    doctest_namespace.update(pdc=pdc, np=np, math=math, pytest=pytest)


@pytest.fixture(scope="session")
def program():
    return os.environ["PDC_PROGRAM"]


@pytest.fixture(scope="session")
def root():
    return pathlib.Path(os.environ["PDC_SOURCE_DIR"])


@pytest.fixture(scope="session")
def data():
    """The folder of real data, or a loud skip."""
    folder = pathlib.Path(os.environ["PDC_DATA_DIR"])
    if not folder.is_dir():
        pytest.skip(f"no data in {folder}")
    return folder


def sphere_values(n=32, radius=0.7):
    """Distances to a sphere in the cube from -1 to 1, and the step between them."""
    x, y, z = np.mgrid[-1 : 1 : n * 1j, -1 : 1 : n * 1j, -1 : 1 : n * 1j]
    return np.sqrt(x * x + y * y + z * z) - radius, 2 / (n - 1)
