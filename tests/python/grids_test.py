"""pdc.Grid, and grids of OpenVDB's own Python module."""

import numpy as np
import pytest

import pdc
from conftest import sphere_values


def test_arrays_come_back_from_grids():
    values = np.random.default_rng(3).normal(size=(5, 6, 7))
    for dtype in (np.float32, np.float64, np.int32, np.int64, bool):
        array = (10 * values).astype(dtype)
        grid = pdc.Grid.from_array(array, background=0)
        assert np.array_equal(grid.to_array(((0, 0, 0), (4, 5, 6))), array)
    fortran = pdc.Grid.from_array(np.asfortranarray(values)[::-1])
    assert np.array_equal(fortran.to_array(((0, 0, 0), (4, 5, 6))), values[::-1])


def test_affines_come_back_from_grids_and_files():
    affine = np.array([[0.5, 0.1, 0, 3], [0, 0.7, 0.2, -2], [0, 0, 1.25, 1], [0, 0, 0, 1.0]])
    grid = pdc.Grid.from_array(np.ones((2, 2, 2)), affine=affine)
    assert np.allclose(grid.affine, affine, atol=1e-15)
    grid.save("grid.vdb")
    assert np.allclose(pdc.read_grid("grid.vdb").affine, affine, atol=1e-15)
    with pytest.raises(ValueError, match="affine must not be singular"):
        pdc.Grid.from_array(np.ones((2, 2, 2)), affine=np.diag([1, 1, 0, 1]))


def test_a_grid_gives_the_bytes_of_its_file(program):
    import subprocess

    distances, step = sphere_values(32)
    grid = pdc.Grid.from_array(distances.astype(np.float32), spacing=step, background=1, grid_class="level-set")
    grid.save("grid.vdb")
    subprocess.run([program, "mesh", "grid.vdb", "program.ply", "--quiet"], check=True)
    pdc.contour(grid).save("python.ply")
    assert open("python.ply", "rb").read() == open("program.ply", "rb").read()


def test_sigma_and_weight_grids():
    distances, step = sphere_values(24)
    grid = pdc.Grid.from_array(distances, spacing=step, background=1)
    sigma = pdc.Grid.from_array(np.full(distances.shape, 0.05), spacing=step)
    assert not np.array_equal(pdc.contour(grid, sigma=sigma).vertices, pdc.contour(grid).vertices)
    with pytest.raises(TypeError, match="sigma must be a pdc.Grid as the volume is, not ndarray"):
        pdc.contour(grid, sigma=distances)
    with pytest.raises(pdc.Error, match="transform"):
        pdc.contour(grid, sigma=pdc.Grid.from_array(distances))


def test_grids_of_openvdb_go_there_and_back():
    openvdb = pytest.importorskip("pyopenvdb")
    theirs = openvdb.createLevelSetSphere(1.0, voxelSize=0.1)
    ours = pdc.Grid.from_openvdb(theirs)
    assert ours.active_voxels == theirs.activeVoxelCount() and ours.grid_class == "level set"
    mesh = pdc.contour(theirs)
    assert np.array_equal(mesh.vertices, pdc.contour(ours).vertices) and pdc.check(mesh).clean
    assert abs(np.linalg.norm(mesh.vertices, axis=1) - 1).max() < 0.01
    back = ours.to_openvdb()
    assert type(back) is openvdb.FloatGrid and back.activeVoxelCount() == theirs.activeVoxelCount()
    assert back.transform.voxelSize() == theirs.transform.voxelSize()
    values = np.zeros((25, 25, 25), np.float32)
    back.copyToArray(values, ijk=(-12, -12, -12))
    assert np.array_equal(values, ours.to_array(((-12, -12, -12), (12, 12, 12))))


@pytest.mark.parametrize(
    "call, error, line",
    [
        (lambda: pdc.read_grid("missing.vdb"), pdc.Error, "missing.vdb"),
        (lambda: pdc.Grid.from_array(np.ones((2, 2))), ValueError, "array must have 3 dimensions, not 2"),
        (lambda: pdc.Grid.from_array(np.ones((2, 2, 2), complex)), TypeError, "not complex128"),
        (lambda: pdc.Grid.from_array(np.full((1, 1, 1), 2**63, np.uint64)), ValueError, "array must hold integers below 2^63"),
        (lambda: pdc.Grid.from_array(np.ones((2, 2, 2)), grid_class="sdf"), ValueError, "grid_class must be one of 'level-set', 'fog', not 'sdf'"),
        (lambda: pdc.Grid.from_openvdb(3), TypeError, "grid must be a grid of pyopenvdb or openvdb, not int"),
        (lambda: pdc.Grid.from_array(np.zeros((2, 2, 2))).to_array(), ValueError, "box must be given for a grid without active voxels"),
        (lambda: pdc.Grid(), TypeError, "grids are made by"),
        (lambda: pdc.contour(pdc.Grid.from_array(np.ones((2, 2, 2))), spacing=1), ValueError, "spacing goes with arrays only"),
    ],
)
def test_mistakes_are_named(call, error, line):
    with pytest.raises(error) as raised:
        call()
    assert line in str(raised.value) and "\n" not in str(raised.value)


def test_grids_of_openvdb_are_borrowed_where_they_can_be():
    openvdb = pytest.importorskip("pyopenvdb")
    pytest.importorskip("pdc._openvdb")
    from pdc._grid import borrowed

    theirs = openvdb.createLevelSetSphere(1.0, voxelSize=0.1)
    ours = borrowed(theirs)
    before = ours.active_voxels
    theirs.fill((50, 50, 50), (52, 52, 52), 0.25)
    assert ours.active_voxels == before + 27
    copied = pdc.Grid.from_openvdb(theirs)
    theirs.fill((60, 60, 60), (60, 60, 60), 0.25)
    assert copied.active_voxels == before + 27 and ours.active_voxels == before + 28
    del theirs
    assert pdc.check(pdc.contour(ours)).clean
