"""Arrays of any type, order and strides, and where their surfaces lie."""

import numpy as np
import pytest

import pdc
from conftest import sphere_values

FLOATS = [np.float16, np.float32, np.float64]
INTEGERS = [np.int8, np.uint8, np.int16, np.uint16, np.int32, np.uint32, np.int64, np.uint64]


def same(mesh, other):
    return np.array_equal(mesh.vertices, other.vertices) and np.array_equal(mesh.quads, other.quads)


def layouts(a):
    """The same values in other places of memory, by name."""
    padded = np.full([2 * n + 3 for n in a.shape], 77, a.dtype)
    stepped = padded[1 : 2 * a.shape[0] + 1 : 2, 1 : 2 * a.shape[1] + 1 : 2, 1 : 2 * a.shape[2] + 1 : 2]
    stepped[...] = a
    read_only = a.copy()
    read_only.setflags(write=False)
    unaligned = np.frombuffer(b"x" + a.tobytes(), a.dtype, offset=1).reshape(a.shape)
    return {
        "C": np.ascontiguousarray(a),
        "Fortran": np.asfortranarray(a),
        "transposed": np.ascontiguousarray(a.transpose(2, 0, 1)).transpose(1, 2, 0),
        "reversed": a[::-1, ::-1, ::-1].copy()[::-1, ::-1, ::-1],
        "stepped": stepped,
        "read-only": read_only,
        "big-endian": a.astype(a.dtype.newbyteorder(">")),
        "unaligned": unaligned,
    }


@pytest.mark.parametrize("dtype", FLOATS + INTEGERS)
def test_types_and_layouts_give_the_mesh_of_the_contiguous_floats(dtype):
    distances, step = sphere_values(24)
    low = 60 if np.dtype(dtype).kind == "u" else 0
    values = (40 * distances + low).astype(np.float32).astype(dtype)
    options = dict(level=low + 0.25, inside="low", grid_class="level-set", spacing=step)
    expected = pdc.contour(values.astype(np.float32), **options)
    assert len(expected.quads) > 500
    for name, array in layouts(values).items():
        assert np.array_equal(array, values)
        assert same(pdc.contour(array, **options), expected), name


def test_booleans_in_every_layout():
    distances, _ = sphere_values(24)
    expected = pdc.contour((distances < 0).astype(np.float32), level=0.5, inside="high")
    for name, array in layouts(distances < 0).items():
        mesh = pdc.contour(array, level=0.5, inside="high")
        assert same(mesh, expected), name


def test_a_broadcast_array_with_strides_of_zero():
    row = np.linspace(-1, 1, 12, dtype=np.float32)
    array = np.broadcast_to(row, (8, 9, 12))
    mesh = pdc.contour(array, open=True)
    assert same(mesh, pdc.contour(array.copy(), open=True)) and len(mesh.quads) > 0


def plane_values(affine, shape, normal, offset):
    """Signed distances to a plane of the world, at the points of an array."""
    index = np.stack(np.meshgrid(*map(np.arange, shape), indexing="ij"), -1)
    world = index @ affine[:3, :3].T + affine[:3, 3]
    return world @ normal - offset


AFFINES = {
    "mirrored": np.array([[-0.5, 0, 0, 3], [0, 0.7, 0, -2], [0, 0, 1.25, 10], [0, 0, 0, 1.0]]),
    "sheared": np.array([[0.5, 0.2, -0.1, 3], [0, 0.7, 0.3, -2], [0.1, 0, 1.25, 1], [0, 0, 0, 1.0]]),
    "turned": np.array([[0, -1, 0, 4], [1, 0, 0, 5], [0, 0, 2, -6], [0, 0, 0, 1.0]]),
    "LPS to RAS": np.diag([-0.9, -0.9, 3, 1]),
}


def check_plane(mesh, normal, offset, voxel):
    inner = mesh.vertices.astype(float) @ normal - offset
    assert len(inner) > 30 and abs(inner).max() < 1e-5 * voxel
    triangle = mesh.vertices[mesh.faces].astype(float)
    directions = np.cross(triangle[:, 1] - triangle[:, 0], triangle[:, 2] - triangle[:, 0])
    assert (directions @ normal > 0).all()


@pytest.mark.parametrize("name", AFFINES)
def test_a_plane_lies_where_the_affine_says(name):
    affine, normal, shape = AFFINES[name], np.array([0.48, 0.6, 0.64]), (12, 13, 14)
    middle = affine[:3, :3] @ np.array([5.6, 6.1, 6.4]) + affine[:3, 3]
    values = plane_values(affine, shape, normal, middle @ normal)
    mesh = pdc.contour(values, affine=affine, open=True, inside="low")
    check_plane(mesh, normal, middle @ normal, np.cbrt(abs(np.linalg.det(affine[:3, :3]))))
    assert same(mesh, pdc.contour(values, affine=affine[:3], open=True, inside="low"))


@pytest.mark.parametrize("spacing, origin", [(1, None), (0.25, (1, 2, 3)), ((0.5, 1, 2), (-1, 0.5, 0)), (None, (3, 3, 3))])
def test_a_plane_lies_where_spacing_and_origin_say(spacing, origin):
    affine = np.eye(4)
    affine[:3, :3] = np.diag(np.broadcast_to(1 if spacing is None else spacing, 3))
    affine[:3, 3] = 0 if origin is None else origin
    normal = np.array([0.0, 0.6, 0.8])
    offset = normal @ (affine[:3, :3] @ [4, 4.3, 5.2] + affine[:3, 3])
    values = plane_values(affine, (9, 10, 11), normal, offset)
    mesh = pdc.contour(values, spacing=spacing, origin=origin, open=True, inside="low")
    check_plane(mesh, normal, offset, np.cbrt(np.linalg.det(affine[:3, :3])))


def test_sigma_weight_and_mask_change_the_mesh():
    distances, step = sphere_values(24)
    plain = pdc.contour(distances, spacing=step)
    noisy = pdc.contour(distances, spacing=step, sigma=np.full(distances.shape, 0.05, np.float16))
    assert len(noisy.vertices) == len(plain.vertices) and not np.array_equal(noisy.vertices, plain.vertices)
    weight = np.ones(distances.shape, np.uint8)
    weight[:10] = 0
    opened = pdc.contour(distances, spacing=step, weight=weight, open=True)
    masked = pdc.contour(distances, spacing=step, mask=weight > 0, open=True)
    assert opened.report["boundary_edges"] > 20
    assert np.array_equal(np.sort(opened.quads, 1), np.sort(masked.quads, 1)) and opened.vertices[:, 0].min() >= 10 * step - 1e-6
    assert pdc.contour(distances, spacing=step, mask=weight > 0).report["boundary_edges"] == 0


@pytest.mark.filterwarnings("ignore::pdc.Warning")
def test_otsu_finds_the_level_between_two_kinds_of_values():
    distances, step = sphere_values(32)
    noise = np.random.default_rng(5).normal(0, 20, distances.shape)
    scan = (np.where(distances < 0, 900, 100) + noise).astype(np.int16)
    mesh = pdc.contour(scan, "otsu", spacing=step)
    assert 300 < mesh.report["iso"] < 700 and mesh.report["grid"]["inside"] == "high"
    radii = np.linalg.norm(mesh.vertices - 1, axis=1)
    assert abs(np.median(radii) - 0.7) < 0.5 * step
    with pytest.raises(ValueError, match="level 'otsu' goes with arrays, volumes and files only"):
        pdc.contour(pdc.sphere(1), "otsu", box=3, resolution=8)


def test_not_a_number_is_an_error_or_outside():
    distances, step = sphere_values(24)
    distances[3, 4, 5] = np.nan
    with pytest.raises(pdc.Error, match="finite"):
        pdc.contour(distances, spacing=step)
    distances[3, 4, 5] = np.inf
    assert pdc.check(pdc.contour(distances, spacing=step, nan="outside")).clean


def test_no_surface_is_an_empty_mesh_and_a_warning():
    with pytest.warns(pdc.Warning, match="no surface at level 2; the mesh is empty") as caught:
        mesh = pdc.contour(np.ones((5, 6, 7), np.float32), 2)
    assert len(mesh.vertices) == 0 and len(mesh.faces) == 0
    assert caught[0].filename == __file__


@pytest.mark.parametrize(
    "array, options, error, line",
    [
        (np.zeros((3, 3, 3), complex), {}, TypeError, "volume must hold bool, integers or floats of at most 64 bits, not complex128"),
        (np.zeros((3, 3, 3), object), {}, TypeError, "not object"),
        (np.zeros((3, 3, 3), np.longdouble), {}, TypeError, "not float128"),
        (np.zeros((3, 3, 3), "M8[s]"), {}, TypeError, "not datetime64"),
        (np.zeros((3, 3)), {}, ValueError, "volume must have 3 dimensions, not 2: its shape is (3, 3)"),
        (np.zeros((3, 3, 3, 3)), {}, ValueError, "not 4"),
        (np.zeros((3, 0, 3)), {}, ValueError, "volume must not be empty: its shape is (3, 0, 3)"),
        (np.ma.masked_invalid(np.zeros((3, 3, 3))), {}, TypeError, "volume is a masked array"),
        (np.zeros((3, 3, 3)), dict(spacing=0), ValueError, "spacing[0] must be a finite number > 0, not 0"),
        (np.zeros((3, 3, 3)), dict(spacing=(1, 2)), ValueError, "spacing must be three numbers, not 2"),
        (np.zeros((3, 3, 3)), dict(origin=(0, np.inf, 0)), ValueError, "origin[1] must be a finite number, not inf"),
        (np.zeros((3, 3, 3)), dict(affine=np.eye(4), spacing=1), ValueError, "affine excludes spacing"),
        (np.zeros((3, 3, 3)), dict(affine=np.eye(3)), ValueError, "affine must have shape (4, 4) or (3, 4), not (3, 3)"),
        (np.zeros((3, 3, 3)), dict(affine=np.zeros((3, 4))), ValueError, "affine must not be singular"),
        (np.zeros((3, 3, 3)), dict(mask=np.ones((3, 3, 4))), ValueError, "mask must have the volume's shape (3, 3, 3), not (3, 3, 4)"),
        (np.zeros((3, 3, 3)), dict(level=np.nan), ValueError, "level must be a finite number, not nan"),
        (np.zeros((3, 3, 3)), dict(level="high"), TypeError, "level must be a number, not str"),
        (np.zeros((3, 3, 3)), dict(inside="up"), ValueError, "inside must be one of 'low', 'high', not 'up'"),
        (np.zeros((3, 3, 3)), dict(sigma_normal=-1), ValueError, "sigma_normal must be a number >= 0, not -1"),
        (np.zeros((3, 3, 3)), dict(placement="here"), ValueError, "placement must be one of 'certified', 'cell', 'free', not 'here'"),
        (np.zeros((3, 3, 3)), dict(threads=-1), ValueError, "threads must be from 0 to 4096, not -1"),
        (np.zeros((3, 3, 3)), dict(open=1), TypeError, "open must be True or False, not 1"),
        (np.zeros((3, 3, 3)), dict(adaptive="wide"), ValueError, "adaptive must be a length, or voxels as '0.1v', not 'wide'"),
        (np.zeros((3, 3, 3)), dict(voxel_size=1), ValueError, "voxel_size goes with fields, scenes and meshes only"),
        (np.zeros((3, 3, 3)), dict(progress=3), TypeError, "progress must be a function"),
    ],
)
def test_mistakes_are_named(array, options, error, line):
    with pytest.raises(error) as raised:
        pdc.contour(array, **options)
    assert line in str(raised.value) and "\n" not in str(raised.value)


def test_any_number_of_threads_gives_the_same_bytes():
    distances, step = sphere_values(40)
    expected = pdc.contour(distances, spacing=step, threads=1)
    for threads in (2, 3, 7):
        assert same(pdc.contour(distances, spacing=step, threads=threads), expected)
