"""Points to Gaussians and surfaces: arrays of any type and strides, and files, as the program has them."""

import json
import subprocess

import numpy as np
import pytest

import pdc


def ball_points(n=1500):
    """Points on the unit sphere that single precision holds."""
    points = np.random.default_rng(7).normal(size=(n, 3))
    return (points / np.linalg.norm(points, axis=1, keepdims=True)).astype(np.float32)


def write_ply(path, points, normals=None):
    columns = points if normals is None else np.hstack([points, normals])
    names = ["x", "y", "z", "nx", "ny", "nz"][: columns.shape[1]]
    header = "\n".join(["ply", "format binary_little_endian 1.0", f"element vertex {len(points)}",
                        *(f"property float {name}" for name in names), "end_header", ""])
    with open(path, "wb") as file:
        file.write(header.encode() + columns.astype("<f4").tobytes())


def bytes_of(mesh):
    mesh.save("python.ply")
    return open("python.ply", "rb").read()


def run(program, verb, *options):
    subprocess.run([program, verb, "points.ply", "program.ply", *options, "--quiet", "--json", "program.json"], check=True)
    return open("program.ply", "rb").read(), json.load(open("program.json"))


def test_mixtures_are_the_programs(program):
    points = ball_points()
    write_ply("points.ply", points, points)
    expected, facts = run(program, "mixture", "--alpha", "2.5", "--levels", "3", "--sigma0", "0.1")
    options = dict(alpha=2.5, levels=3, sigma0=0.1)
    of_array = pdc.mixture(points, normals=3 * points.astype(float), **options)
    of_file = pdc.mixture("points.ply", **options)
    assert bytes_of(of_array) == expected and bytes_of(of_file) == expected
    files = {"input", "output", "bytes", "seconds", "options"}
    assert of_file.report == {name: value for name, value in facts.items() if name not in files}
    assert len(of_array.faces) == 0 and of_array["weight"].sum() == pytest.approx(1)


def test_surfaces_are_the_programs(program):
    points = ball_points()
    write_ply("points.ply", points)
    expected, facts = run(program, "reconstruct", "--subdivide", "2", "--overlap", "0.2", "--mesh-covariances", "control.ply")
    mesh, control = pdc.reconstruct(points, subdivide=2, overlap=0.2, covariance_mesh=True)
    assert bytes_of(mesh) == expected
    assert bytes_of(control) == open("control.ply", "rb").read()
    assert bytes_of(pdc.reconstruct("points.ply", subdivide=2, overlap=0.2)) == expected
    for name in ("mixture", "gaussians", "triangulation", "control_triangles", "vertices", "triangles"):
        assert mesh.report[name] == facts[name], name


def test_types_and_strides_give_the_surface_of_the_contiguous_doubles():
    points = (64 * ball_points(900)).round().astype(np.float16)
    expected = bytes_of(pdc.mixture(points.astype(float), sigma0=8))
    wide = np.full((2 * len(points), 5), np.nan, np.float32)
    wide[::2, 1:4] = points
    backwards = points[::-1].copy()[::-1]
    for array in (points, points.astype(np.int8), points.astype(">f8"), np.asfortranarray(points), wide[::2, 1:4], backwards):
        assert np.array_equal(array, points)
        assert bytes_of(pdc.mixture(array, sigma0=8)) == expected


def test_closed_surfaces_bound_the_ball():
    closed = pdc.reconstruct(ball_points(6000), voxel_size=0.1)
    assert pdc.check(closed).clean and pdc.check(closed)["euler_number"] == 2
    assert abs(np.linalg.norm(closed.vertices, axis=1) - 1).max() < 0.02


def test_sigma_and_colours_reach_the_gaussians():
    points = ball_points()
    plain = pdc.mixture(points)
    noisy = pdc.mixture(points, sigma=np.full(len(points), 0.2))
    assert len(noisy.vertices) < len(plain.vertices)
    red = np.zeros((len(points), 3), np.uint8)
    red[:, 0] = 200
    coloured = pdc.mixture(points, colours=red)
    assert set(coloured["red"]) == {200} and set(coloured["green"]) == {0}


def test_threads_and_progress():
    heard = []
    points = ball_points()
    one = pdc.reconstruct(points, threads=1, progress=lambda stage, share: heard.append(stage))
    assert bytes_of(one) == bytes_of(pdc.reconstruct(points, threads=3))
    assert set(heard) <= {"mixture", "overlaps", "triangulate", "subdivide"} and heard

    def stop(stage, share):
        raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        pdc.mixture(np.tile(points, (60, 1)) + np.random.default_rng(1).normal(0, 0.01, (60 * len(points), 3)), progress=stop)


@pytest.mark.parametrize(
    "call, error, line",
    [
        (lambda: pdc.mixture(np.zeros((4, 2))), ValueError, "points must have shape (n, 3), not (4, 2)"),
        (lambda: pdc.mixture(np.zeros((4, 3), complex)), TypeError, "points must hold bool, integers or floats"),
        (lambda: pdc.mixture(np.full((4, 3), np.nan)), pdc.Error, "finite"),
        (lambda: pdc.mixture(np.ones((4, 3))), pdc.Error, "sigma0"),
        (lambda: pdc.mixture(np.eye(3), normals=np.eye(2)), ValueError, "normals must have shape (3, 3), not (2, 2)"),
        (lambda: pdc.mixture(np.eye(3), sigma=[1, 2]), ValueError, "sigma must have a number for each of 3 points, not 2"),
        (lambda: pdc.mixture(np.eye(3), colours=np.eye(3)), TypeError, "colours must hold uint8, not float64"),
        (lambda: pdc.mixture(np.eye(3), alpha=0), ValueError, "alpha must be a finite number > 0, not 0"),
        (lambda: pdc.mixture("points.ply", sigma=[1]), ValueError, "sigma goes with arrays of points only"),
        (lambda: pdc.mixture("missing.xyz"), pdc.Error, "missing.xyz"),
        (lambda: pdc.reconstruct(np.eye(3), overlap=1), ValueError, "overlap must be below 1, not 1"),
        (lambda: pdc.reconstruct(np.eye(3), subdivide=11), ValueError, "subdivide must be from 0 to 10, not 11"),
        (lambda: pdc.reconstruct(100 * np.eye(3), sigma0=0.1), pdc.Error, "overlap"),
    ],
)
def test_mistakes_are_named(call, error, line):
    with pytest.raises(error) as raised:
        call()
    assert line in str(raised.value) and "\n" not in str(raised.value)
