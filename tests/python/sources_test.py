"""Meshes as volumes, values of further grids, and remedies in the package's own words."""

import re
import subprocess

import numpy as np
import pytest

import pdc
from conftest import sphere_values


def bytes_of(mesh):
    mesh.save("python.ply")
    return open("python.ply", "rb").read()


def cube():
    return pdc.contour(pdc.box(1.2).rotate(20, (1, 2, 3)), box=2, resolution=24, triangles=True)


@pytest.mark.parametrize(
    "options, arguments",
    [
        (["--resolution", "32"], dict(resolution=32)),
        (["--voxel-size", "0.05", "--offset", "0.1"], dict(voxel_size=0.05, offset=0.1)),
        (["--resolution", "40", "--shell", "0.15", "--sigma-n", "0.1"], dict(resolution=40, shell=0.15, sigma_normal=0.1)),
    ],
)
def test_meshes_give_the_programs_bytes(program, options, arguments):
    cube().save("cube.ply")
    subprocess.run([program, "mesh", "cube.ply", "program.ply", *options, "--quiet"], check=True)
    expected = open("program.ply", "rb").read()
    of_file = pdc.contour("cube.ply", **arguments)
    assert bytes_of(of_file) == expected
    assert bytes_of(pdc.contour(pdc.read_mesh("cube.ply"), **arguments)) == expected
    assert of_file.report["mesh"]["triangles"] == len(cube().triangles)


def test_offsets_go_with_level_sets_in_files(program):
    distances, step = sphere_values(24)
    pdc.Grid.from_array(distances.astype(np.float32), spacing=step, background=1, grid_class="level-set").save("ball.vdb")
    subprocess.run([program, "mesh", "ball.vdb", "program.ply", "--offset", "0.1", "--quiet"], check=True)
    assert bytes_of(pdc.contour("ball.vdb", offset=0.1)) == open("program.ply", "rb").read()


def test_the_field_of_a_mesh_is_its_distance():
    mesh = pdc.contour(pdc.box(2), box=2.5, resolution=20)
    points = np.random.default_rng(2).uniform(-2, 2, (500, 3))
    exact = np.linalg.norm(np.maximum(abs(points) - 1, 0), axis=1) + np.minimum((abs(points) - 1).max(1), 0)
    assert np.allclose(pdc.mesh_field(mesh)(points), exact, atol=1e-4)
    both = pdc.contour(pdc.mesh_field(mesh) - pdc.sphere(1.2), box=2.5, resolution=32)
    assert pdc.check(both).clean
    with pytest.raises(pdc.Error, match="no triangle"):
        pdc.mesh_field(pdc.Mesh(np.eye(3)))
    with pytest.raises(TypeError, match="mesh must be a pdc.Mesh, not ndarray"):
        pdc.mesh_field(np.eye(3))


def grids():
    """A ball, and the x coordinate and its voxel's number along x on another lattice."""
    distances, step = sphere_values(32)
    shape = pdc.Grid.from_array(distances.astype(np.float32), spacing=step, origin=(-1, -1, -1), background=1,
                                grid_class="level-set")
    x = np.broadcast_to(np.linspace(-2, 2, 21)[:, None, None], (21, 21, 21))
    height = pdc.Grid.from_array(x.astype(np.float32), spacing=0.2, origin=(-2, -2, -2), background=-99)
    number = pdc.Grid.from_array(np.round(5 * x).astype(np.int32), spacing=0.2, origin=(-2, -2, -2), background=-99)
    return shape, height, number


def test_attributes_are_sampled_at_vertices():
    shape, height, number = grids()
    mesh = pdc.contour(shape, attributes={"height": height, "n": number}, confidence=True)
    assert set(mesh.properties) == {"confidence", "sigma", "height", "n"}
    assert np.allclose(mesh["height"], mesh.vertices[:, 0], atol=1e-5)
    assert mesh["n"].dtype == np.int32 and abs(mesh["n"] - 5 * mesh.vertices[:, 0]).max() <= 0.51


def test_attributes_go_with_every_volume():
    _, height, _ = grids()
    distances, step = sphere_values(24)
    with_x = dict(attributes={"height": height})
    meshes = [pdc.contour(distances, spacing=step, origin=(-1, -1, -1), **with_x),
              pdc.contour(pdc.sphere(0.7), box=2, resolution=20, **with_x),
              pdc.contour(cube(), resolution=20, **with_x)]
    for mesh in meshes:
        assert np.allclose(mesh["height"], mesh.vertices[:, 0], atol=1e-5) and len(mesh.vertices) > 300


def test_attributes_of_files_are_the_programs(program):
    openvdb = pytest.importorskip("pyopenvdb")
    near = pdc.Grid.from_array(np.ones((9, 9, 9), bool), spacing=0.1)
    scale = pdc.Grid.from_array(np.linspace(0.01, 2, 8000, dtype=np.float32).reshape(20, 20, 20), spacing=0.2, origin=(-2, -2, -2))
    parts = [grid.to_openvdb() for grid in (*grids()[:2], near, scale)]
    for grid, name in zip(parts, ("surface", "height", "near", "scale")):
        grid.name = name
    openvdb.write("several.vdb", grids=parts)
    for options, attributes in ((["--attribute", "height"], ["height"]), (["--attribute", "all"], "all")):
        subprocess.run([program, "mesh", "several.vdb", "program.ply", "--grid", "surface", *options, "--quiet"], check=True)
        mesh = pdc.contour("several.vdb", grid="surface", attributes=attributes)
        assert bytes_of(mesh) == open("program.ply", "rb").read()
    in_memory = pdc.contour(parts[0], attributes={"height": parts[1], "near": parts[2], "scale": parts[3]})
    assert bytes_of(in_memory) == open("program.ply", "rb").read()
    subprocess.run([program, "mesh", "several.vdb", "program.ply", "--grid", "surface", "--adaptive", "0.05", "--adaptive-grid",
                    "scale", "--quiet"], check=True)
    for given in ("scale", scale):
        mesh = pdc.contour("several.vdb", grid="surface", adaptive=0.05, adaptive_scale=given)
        assert bytes_of(mesh) == open("program.ply", "rb").read()


def test_adaptive_scale_keeps_faces_where_it_is_small():
    shape, _, _ = grids()
    half = np.ones((21, 21, 21), np.float32)
    half[:10] = 0.001
    scale = pdc.Grid.from_array(half, spacing=0.2, origin=(-2, -2, -2), background=1)
    mesh = pdc.contour(shape, adaptive=0.02, adaptive_scale=scale)
    left = (mesh.vertices[mesh.faces].mean(1)[:, 0] < -0.1).sum()
    right = (mesh.vertices[mesh.faces].mean(1)[:, 0] > 0.1).sum()
    assert left > 5 * right > 0
    report = pdc.sweep(shape, "adaptive", [0, 0.2], adaptive_scale=scale)
    plain = pdc.sweep(shape, "adaptive", [0, 0.2])
    assert report["steps"][1]["triangles"] > 1.5 * plain["steps"][1]["triangles"]


@pytest.mark.parametrize(
    "call, error, line",
    [
        (lambda: pdc.contour(grids()[0], attributes=["x"]), TypeError, "attributes must be a mapping of names to grids, not list"),
        (lambda: pdc.contour(grids()[0], attributes={"x": 3}), TypeError, "attributes['x'] must be a pdc.Grid, not int"),
        (lambda: pdc.contour(grids()[0], attributes={"": grids()[1]}), ValueError, "names of attributes must be strings"),
        (lambda: pdc.contour(grids()[0], attributes={"sigma": grids()[1]}, confidence=True), pdc.Error, "second property 'sigma'"),
        (lambda: pdc.contour(grids()[0], adaptive_scale=3), TypeError, "adaptive_scale must be a pdc.Grid, not int"),
        (lambda: pdc.contour(grids()[0], adaptive=1, adaptive_scale=grids()[2]), pdc.Error, "int32"),
        (lambda: pdc.contour(grids()[0], offset=1), ValueError, "offset goes with meshes and files only"),
        (lambda: pdc.contour(pdc.sphere(1), box=3, resolution=9, shell=1), ValueError, "shell goes with meshes and files only"),
        (lambda: pdc.contour(cube(), 0.1), ValueError, "level goes with volumes and fields only"),
        (lambda: pdc.contour(cube(), shell=0), ValueError, "shell must be a finite number > 0, not 0"),
        (lambda: pdc.contour(pdc.Mesh(np.eye(3))), pdc.Error, "the mesh has no faces"),
        (lambda: pdc.sweep(grids()[0], "level", [0], attributes={}), TypeError, "unexpected argument 'attributes'"),
        (lambda: pdc.sweep(grids()[0], "level", [0], adaptive_scale=grids()[1]), ValueError, "adaptive_scale goes with sweeps of"),
    ],
)
def test_mistakes_are_named(call, error, line):
    with pytest.raises(error) as raised:
        call()
    assert line in str(raised.value) and "\n" not in str(raised.value) and "--" not in str(raised.value)


def test_remedies_are_arguments_of_the_package():
    """Warnings and errors on files speak of options of the program in the library."""
    values = np.full((8, 8, 8), 3.0, np.float32)
    values[2:5, 2:5, 2:5] = 5
    pdc.Grid.from_array(values, background=3).save("unclear.vdb")
    with pytest.warns(pdc.Warning, match="level=V sets it") as caught:
        mesh = pdc.contour("unclear.vdb")
    assert not any("--" in str(warning.message) for warning in caught) and "--" not in str(mesh.report["warnings"])
    np.save("volume.npy", values.astype(np.float64))
    with pytest.warns(pdc.Warning) as caught:
        pdc.contour("volume.npy")
    lines = " ".join(str(warning.message) for warning in caught)
    assert "spacing says better" in lines and "--" not in lines and caught[0].filename == __file__
    values[0, 0, 0] = np.nan
    np.save("volume.npy", values)
    with pytest.raises(pdc.Error, match="nan='outside'"):
        pdc.contour("volume.npy", 4)


def test_every_option_that_the_library_speaks_of_has_words_here(root):
    sources = [file for folder in ("io", "grid", "points", "field", "sample", "extract", "mesh") for file in (root / "src" / folder).rglob("*.[ch]*")]
    spoken = set()
    for file in sources:
        for text in re.findall(r'"(?:[^"\\\n]|\\.)*"', file.read_text()):
            spoken.update(re.findall(r"--([a-z][a-z-]*)", text))
    remedies = (root / "python/src/remedies.cpp").read_text()
    known = set(re.findall(r'\{"([a-z-]+)",', remedies))
    assert len(spoken) >= 10 and spoken <= known, spoken - known
