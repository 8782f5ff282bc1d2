"""Fields, scenes and functions of Python."""

import numpy as np
import pytest

import pdc


def test_operators_are_those_of_sets():
    a, b = pdc.sphere(1), pdc.box((1, 1, 4))
    points = np.random.default_rng(1).uniform(-2, 2, (1000, 3))
    in_a, in_b = a(points) < 0, b(points) < 0
    assert in_a.any() and in_b.any()
    for field, expected in [(a | b, in_a | in_b), (a & b, in_a & in_b), (a - b, in_a & ~in_b), (~a, ~in_a)]:
        assert np.array_equal(field(points) < 0, expected)
    with pytest.raises(TypeError):
        a | 3


def test_every_shape_and_operation_makes_a_closed_mesh():
    cube = pdc.box(1)
    fields = {
        "rounded_box": pdc.rounded_box(1.5, 0.2),
        "plane": pdc.plane((1, 1, 1)) & pdc.sphere(1),
        "cylinder": pdc.cylinder((0, 0, -0.5), (0, 0, 0.5), 0.6),
        "capped_cone": pdc.capped_cone((0, 0, -0.5), (0, 0, 0.5), 0.8, 0),
        "torus": pdc.torus(0.8, 0.25),
        "capsule": pdc.capsule((0, 0, 0), (0.5, 0.5, 0), 0.4),
        "ellipsoid": pdc.ellipsoid((0.5, 0.7, 1)),
        "gyroid": pdc.gyroid(1, 0.4) & pdc.sphere(1),
        "simplex_noise": pdc.simplex_noise(seed=4) & pdc.sphere(1),
        "formula": pdc.formula("x^2 + y^2 + z^4 - 0.6"),
        "function": pdc.function(lambda p: np.abs(p).sum(1) - 1),
        "smooth": pdc.union(cube, pdc.sphere(0.5, (0.5, 0.5, 0.5)), smooth=0.2),
        "smooth difference": pdc.difference(cube, pdc.sphere(0.5, (0.5, 0.5, 0.5)), smooth=0.1),
        "smooth intersection": pdc.intersection(cube, pdc.sphere(0.6), smooth=0.1),
        "offset": cube.offset(0.2),
        "shell": cube.shell(0.3),
        "translate": cube.translate((0.2, 0, 0)),
        "rotate": cube.rotate(30, (1, 2, 3)),
        "scale": cube.scale(1.5).scale((1, 0.5, 1)),
        "mirror": pdc.sphere(0.4, (0.5, 0, 0)).mirror("x"),
        "repeat": pdc.sphere(0.3).repeat((0.8, 0, 0), (1, 0, 0)),
    }
    for name, field in fields.items():
        mesh = pdc.contour(field, box=2.6, resolution=26)
        assert pdc.check(mesh).clean, name


def test_gradients_are_slopes():
    field = pdc.torus(1, 0.3) - pdc.box(0.4)
    points = np.random.default_rng(2).uniform(-1, 1, (300, 3))
    step = 1e-6
    for axis in range(3):
        shift = np.eye(3)[axis] * step
        slopes = (field(points + shift) - field(points - shift)) / (2 * step)
        assert np.quantile(abs(slopes - field.gradient(points)[:, axis]), 0.95) < 1e-4


def test_a_function_gives_the_mesh_of_its_shape():
    for options in ({}, {"lipschitz": 1}, {"gradient": lambda p: p / np.linalg.norm(p, axis=1)[:, None]}):
        ball = pdc.function(lambda p: np.linalg.norm(p, axis=1) - 1, **options)
        mesh = pdc.contour(ball, box=2.5, resolution=32)
        assert pdc.check(mesh).clean
        assert abs(np.linalg.norm(mesh.vertices, axis=1) - 1).max() < 2e-3
    bare = pdc.contour(lambda p: np.linalg.norm(p, axis=1) - 1, box=2.5, resolution=32)
    assert np.array_equal(bare.quads, mesh.quads)
    drilled = pdc.contour(ball - pdc.cylinder((0, 0, -2), (0, 0, 2), 0.4), box=2.5, resolution=32)
    assert pdc.check(drilled)["euler_number"] == 0


def test_what_a_function_raises_passes_through():
    class Odd(Exception):
        pass

    def fail(points):
        raise Odd("no value here")

    for threads in (1, 0):
        with pytest.raises(Odd, match="no value here"):
            pdc.contour(fail, box=2, resolution=16, threads=threads)
    with pytest.raises(ValueError, match=r"the function must return an array of shape \(\d+,\)"):
        pdc.contour(lambda p: p, box=2, resolution=16)
    with pytest.raises(ValueError, match=r"gradient must return an array of shape \(\d+, 3\)"):
        pdc.contour(pdc.function(lambda p: p[:, 0], gradient=lambda p: p[:, 0]), box=2, resolution=16)
    with pytest.raises(pdc.Error, match="finite"):
        pdc.contour(lambda p: np.where(p[:, 0] > 0, np.nan, 1), box=2, resolution=16)


def test_a_function_is_asked_at_fewer_points_than_the_lattice_has():
    asked = 0

    def f(points):
        nonlocal asked
        asked += len(points)
        return np.sqrt((points * points).sum(axis=1)) - 1

    pdc.contour(f, box=2.5, resolution=128)
    assert asked < 129**3


def test_a_scene_says_what_is_not_said(root):
    scene = pdc.scene(root / "scenes/csg.yaml")
    plain = pdc.contour(scene)
    coarse = pdc.contour(scene, voxel_size=2 * scene.voxel_size)
    assert 3 < len(plain.vertices) / len(coarse.vertices) < 5
    again = pdc.contour(scene.field, box=scene.box, voxel_size=scene.voxel_size, sigma_normal=scene.sigma_normal)
    assert np.array_equal(plain.vertices, again.vertices)


@pytest.mark.parametrize(
    "call, error, line",
    [
        (lambda: pdc.sphere(0), ValueError, "radius must be a finite number > 0, not 0"),
        (lambda: pdc.sphere("a"), TypeError, "radius must be a number, not str"),
        (lambda: pdc.sphere(1, center=(1, 2)), ValueError, "center must be three numbers, not 2"),
        (lambda: pdc.box((1, -1, 1)), ValueError, "size[1] must be a finite number > 0, not -1"),
        (lambda: pdc.plane((0, 0, 0)), ValueError, "normal"),
        (lambda: pdc.rounded_box(1, 2), ValueError, "radius"),
        (lambda: pdc.simplex_noise(octaves=17), ValueError, "octaves must be from 1 to 16, not 17"),
        (lambda: pdc.formula("x +"), pdc.Error, "x +"),
        (lambda: pdc.function(3), TypeError, "f must be a function, not int"),
        (lambda: pdc.union(), ValueError, ""),
        (lambda: pdc.union(3), TypeError, "fields must be pdc.Field, not int"),
        (lambda: pdc.sphere(1).mirror("w"), ValueError, "axis must be 'x', 'y' or 'z', not 'w'"),
        (lambda: pdc.contour(pdc.sphere(1)), ValueError, "box must be given"),
        (lambda: pdc.contour(pdc.sphere(1), box=2), ValueError, "voxel_size or resolution must be given"),
        (lambda: pdc.contour(pdc.sphere(1), box=[(0, 0, 0), (1, 0, 1)], resolution=5), ValueError, "box must not be empty: it goes from 0 to 0 along y"),
        (lambda: pdc.contour(pdc.sphere(1), box=2, resolution=5, voxel_size=1), ValueError, "voxel_size excludes resolution"),
        (lambda: pdc.contour(pdc.sphere(1), box=2, resolution=5, spacing=1), ValueError, "spacing goes with arrays only"),
        (lambda: pdc.scene("missing.yaml"), pdc.Error, "missing.yaml"),
    ],
)
def test_mistakes_are_named(call, error, line):
    with pytest.raises(error) as raised:
        call()
    assert line in str(raised.value) and "\n" not in str(raised.value)
