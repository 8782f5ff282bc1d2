"""pdc.Mesh, files and pictures."""

import gc
import subprocess

import numpy as np
import pytest

import pdc


def ball(**options):
    return pdc.contour(pdc.sphere(1), box=2.5, resolution=20, **options)


def test_arrays_are_read_only_views():
    mesh = ball(normals=True, confidence=True, rank=True)
    arrays = [mesh.vertices, mesh.quads, mesh.triangles, mesh.faces, mesh.normals, *mesh.properties.values()]
    for array in arrays:
        assert not array.flags.writeable and not array.flags.owndata
        with pytest.raises(ValueError):
            array.setflags(write=True)
    assert mesh.vertices.dtype == np.float32 and mesh.quads.dtype == np.uint32
    assert mesh.vertices.__array_interface__["data"] == mesh.vertices.__array_interface__["data"]
    assert mesh.confidence.shape == mesh.sigma.shape == mesh.rank.shape == (len(mesh.vertices),)
    assert np.allclose(np.linalg.norm(mesh.vertices, axis=1), 1, atol=0.01)
    assert np.einsum("ij,ij->i", mesh.normals, mesh.vertices).min() > 0.95


def test_views_outlive_their_mesh():
    mesh = ball(confidence=True)
    expected = mesh.vertices.copy(), mesh.confidence.copy()
    vertices, confidence, part = mesh.vertices, mesh.confidence, mesh.vertices[3:7]
    del mesh
    gc.collect()
    others = [ball() for _ in range(5)]
    assert np.array_equal(vertices, expected[0]) and np.array_equal(confidence, expected[1])
    del vertices, others
    gc.collect()
    assert np.array_equal(part, expected[0][3:7])


def test_faces_are_the_quads_triangles_then_the_triangles():
    mesh = pdc.Mesh(np.eye(5, 3), [[1, 2, 4]], [[0, 1, 2, 3]])
    assert mesh.faces.tolist() == [[0, 1, 2], [0, 2, 3], [1, 2, 4]]
    assert ball(triangles=True).quads.shape == (0, 4)


@pytest.mark.parametrize("suffix", ["ply", "obj", "off", "stl"])
def test_files_come_back(suffix):
    mesh = ball(triangles=True)
    mesh.save(f"ball.{suffix}")
    again = pdc.read_mesh(f"ball.{suffix}")
    assert len(again.vertices) == len(mesh.vertices) and len(again.triangles) == len(mesh.triangles)
    if suffix == "ply":
        assert np.array_equal(again.vertices, mesh.vertices) and np.array_equal(again.triangles, mesh.triangles)


def test_properties_keep_types_and_shapes_through_files():
    points = np.zeros((3, 3))
    given = {
        "a": np.arange(3, dtype=np.int16),
        "b": np.arange(6, dtype=np.float64).reshape(3, 2),
        "c": np.array([1, 2, 255], np.uint8),
    }
    pdc.Mesh(points, [[0, 1, 2]], properties=given).save("mesh.ply")
    read = pdc.read_mesh("mesh.ply").properties
    assert list(read) == ["a", "b", "c"]
    for name, values in given.items():
        assert read[name].dtype == values.dtype and np.array_equal(read[name], values)


@pytest.mark.parametrize(
    "arguments, error, line",
    [
        (([[0, 0]],), ValueError, "vertices must have shape (n, 3), not (1, 2)"),
        ((np.eye(3), [[0, 1, 3]]), ValueError, "triangles must name vertices from 0 to 2, not 3"),
        ((np.eye(3), [[0, -1, 2]]), ValueError, "triangles must name vertices from 0 to 2, not -1"),
        ((np.eye(3), [[0.0, 1, 2]]), TypeError, "triangles must hold integers, not float64"),
        ((np.eye(3), [[0, 1]]), ValueError, "triangles must have shape (n, 3), not (1, 2)"),
        ((np.eye(3, dtype=complex),), TypeError, "vertices must hold bool, integers or floats"),
    ],
)
def test_wrong_arrays_are_named(arguments, error, line):
    with pytest.raises(error) as raised:
        pdc.Mesh(*arguments)
    assert line in str(raised.value)


def test_files_that_cannot_be_written_or_read_are_errors_of_one_line():
    with pytest.raises(pdc.Error, match="nowhere"):
        ball().save("nowhere/ball.ply")
    with pytest.raises(pdc.Error, match="missing.ply"):
        pdc.read_mesh("missing.ply")
    with pytest.raises(pdc.Error) as raised:
        ball().save("ball.xyz")
    assert "\n" not in str(raised.value)
    assert issubclass(pdc.Error, RuntimeError) and pdc.Error.__module__ == "pdc"


def test_pictures_are_those_of_the_program(program):
    mesh = ball()
    mesh.save("ball.ply")
    subprocess.run([program, "render", "ball.ply", "ball.png", "--size", "64x48", "--quiet"], check=True)
    picture = pdc.render(mesh, size=(64, 48))
    assert picture.shape == (48, 64, 3) and picture.dtype == np.uint8
    pdc.write_png("python.png", picture)
    assert open("python.png", "rb").read() == open("ball.png", "rb").read()
    assert mesh._repr_png_()[1:4] == b"PNG"


def test_pictures_of_values():
    mesh = ball(confidence=True)
    by_name = pdc.render(mesh, size=(64, 48), shading="confidence")
    assert np.array_equal(by_name, pdc.render(mesh, size=(64, 48), shading=mesh.confidence, range=(0, 1)))
    assert not np.array_equal(by_name, pdc.render(mesh, size=(64, 48), shading=mesh.vertices[:, 2]))
    with pytest.raises(ValueError, match="shading must be one of clay, normal, confidence, sigma, not 'heat'"):
        pdc.render(mesh, shading="heat")


def test_an_empty_mesh_has_no_picture():
    assert pdc.Mesh(np.empty((0, 3)))._repr_png_() is None


def test_meshes_go_to_trimesh_and_pyvista_by_their_interfaces(monkeypatch):
    """Neither is at hand, so stand-ins note what they are given."""
    import sys
    import types

    class Trimesh:
        def __init__(self, vertices, faces, **more):
            self.vertices, self.faces, self.more = vertices, faces, more

    class PolyData:
        def __init__(self, points, faces):
            self.points, self.faces, self.point_data = points, faces, {}

    monkeypatch.setitem(sys.modules, "trimesh", types.SimpleNamespace(Trimesh=Trimesh))
    monkeypatch.setitem(sys.modules, "pyvista", types.SimpleNamespace(PolyData=PolyData))
    mesh = pdc.Mesh(np.eye(4, 3), [[1, 2, 3]], [[0, 1, 2, 3]], properties={"heat": np.arange(4.0)})
    tri = mesh.to_trimesh()
    assert tri.faces.tolist() == [[0, 1, 2], [0, 2, 3], [1, 2, 3]] and tri.more["process"] is False
    assert np.array_equal(tri.more["vertex_attributes"]["heat"], np.arange(4))
    poly = mesh.to_pyvista()
    assert poly.faces.tolist() == [4, 0, 1, 2, 3, 3, 1, 2, 3]
    assert np.array_equal(poly.point_data["heat"], np.arange(4))
