"""Docstrings, stubs, and the code of the pages."""

import doctest
import inspect
import os
import pathlib
import re
import subprocess
import sys

import pytest

import pdc
from pdc._grid_steps import GridSteps

PUBLIC = sorted(pdc.__all__)


def examples_of(thing):
    return doctest.DocTestFinder(recurse=False).find(thing, thing.__name__)


@pytest.mark.parametrize("name", PUBLIC)
def test_every_public_name_has_an_example_that_runs(name, doctest_namespace):
    thing = getattr(pdc, name)
    assert inspect.getdoc(thing)
    tests = [test for test in examples_of(thing) if test.examples]
    assert tests, f"{name} has no example"
    for test in tests:
        test.globs = dict(doctest_namespace)
        assert doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE).run(test).failed == 0


def test_examples_of_methods_and_of_the_package_run(doctest_namespace):
    ran = 0
    steps = [getattr(pdc.Grid, name) for name in vars(GridSteps) if not name.startswith("_")]
    made = [pdc.Grid.from_array, pdc.Grid.from_mesh, pdc.Grid.from_openvdb, pdc.Grid.to_array]
    for thing in (pdc.Mesh.save, *made, *steps, pdc):
        for test in examples_of(thing):
            test.globs = dict(doctest_namespace)
            assert doctest.DocTestRunner().run(test).failed == 0
            ran += len(test.examples)
    assert len(steps) == 11 and ran >= 30


def test_contour_documents_every_argument():
    text = inspect.getdoc(pdc.contour)
    for name in inspect.signature(pdc.contour).parameters:
        assert re.search(rf"^(\w+, )*{name}\b.*$", text, re.MULTILINE), name


def test_stubs_agree_with_the_package(root):
    pytest.importorskip("mypy")
    command = [sys.executable, "-m", "mypy.stubtest", "pdc", "--mypy-config-file", str(root / "python/mypy.ini"),
               "--allowlist", str(root / "python/stubtest_allowlist.txt")]
    result = subprocess.run(command, capture_output=True, text=True)
    assert result.returncode == 0, result.stdout[-3000:] + result.stderr


def test_the_package_is_typed(root):
    pytest.importorskip("mypy")
    package = pathlib.Path(pdc.__file__).parent
    command = [sys.executable, "-m", "mypy", "--config-file", str(root / "python/mypy.ini"), str(package)]
    result = subprocess.run(command, capture_output=True, text=True)
    assert result.returncode == 0, result.stdout[-3000:] + result.stderr


@pytest.mark.parametrize("page, least", [("docs/python.md", 8), ("README.md", 1)])
def test_the_code_of_the_pages_runs(root, page, least):
    """All blocks of a page, one after the other, as a reader would type them."""
    blocks = re.findall(r"^```python\n(.*?)^```", (root / page).read_text(), re.DOTALL | re.MULTILINE)
    assert len(blocks) >= least
    os.symlink(root / "scenes", "scenes")
    os.symlink(root / "tests", "tests")
    names = {}
    for block in blocks:
        exec(compile(block, page, "exec"), names)


@pytest.mark.parametrize("script", ["array", "ct_volume", "csg", "noise", "openvdb_there_and_back", "points", "steps"])
def test_examples_run(root, script):
    result = subprocess.run([sys.executable, root / f"python/examples/{script}.py", "--small"], capture_output=True, text=True)
    assert result.returncode == 0, result.stderr
    assert pathlib.Path(f"{script}.png").stat().st_size > 1000
