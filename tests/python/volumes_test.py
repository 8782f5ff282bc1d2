"""Volumes from files: as arrays, and contoured as the program does."""

import gc
import subprocess

import numpy as np
import pytest

import pdc
from conftest import sphere_values


def bytes_of(mesh):
    mesh.save("python.ply")
    return open("python.ply", "rb").read()


def program_bytes(program, file, *options):
    subprocess.run([program, "mesh", file, "program.ply", *options, "--quiet"], check=True, stderr=subprocess.DEVNULL)
    return open("program.ply", "rb").read()


def write_nrrd(path, values, **fields):
    """Values indexed [x, y, z], in the byte order they have, raw behind a header."""
    kinds = {"f4": "float", "i2": "short", "u1": "uchar"}
    lines = ["NRRD0004", f"type: {kinds[values.dtype.str[1:]]}", "dimension: 3", "sizes: {} {} {}".format(*values.shape),
             "encoding: raw", "endian: " + ("big" if values.dtype.str[0] == ">" else "little")]
    lines += [f"{name.replace('_', ' ')}: {value}" for name, value in fields.items()]
    with open(path, "wb") as file:
        file.write(("\n".join(lines) + "\n\n").encode() + values.tobytes("F"))


def scan(n=24):
    distances, _ = sphere_values(n)
    return (1000 - 1000 * distances).astype(np.int16)


def test_values_lie_in_the_file_as_they_are_stored():
    values = np.random.default_rng(3).integers(-3000, 3000, (5, 6, 7)).astype(">i2")
    write_nrrd("v.nrrd", values, space="right-anterior-superior", space_directions="(0,2,0) (-3,0,0) (0,0,0.5)",
               space_origin="(1,2,3)", space_units='"mm" "mm" "mm"')
    volume = pdc.read_volume("v.nrrd")
    assert np.array_equal(volume.values, values) and volume.stored.dtype == np.dtype(">i2")
    assert volume.values is volume.stored or np.shares_memory(volume.values, volume.stored)
    assert np.shares_memory(np.asarray(volume), volume.stored) and not volume.stored.flags.writeable
    assert volume.shape == (5, 6, 7) and volume.spacing == (2, 3, 0.5)
    assert np.array_equal(volume.affine, [[0, -3, 0, 1], [2, 0, 0, 2], [0, 0, 0.5, 3], [0, 0, 0, 1]])
    assert (volume.format, volume.encoding, volume.space, volume.unit) == ("NRRD", "raw", "RAS", "mm")
    assert volume.spacing_known


@pytest.mark.filterwarnings("ignore::pdc.Warning")
def test_the_file_is_mapped_and_not_read():
    import resource

    with open("large.raw", "wb") as file:
        file.truncate(1 << 31)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    volume = pdc.read_volume("large.raw", raw="1024x1024x512:f32")
    assert volume.stored[1, 2, 3] == 0 and volume.stored.nbytes == 1 << 31
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 1 << 16


def test_views_outlive_their_volume():
    values = scan()
    write_nrrd("v.nrrd", values)
    with pytest.warns(pdc.Warning, match="spacing"):
        view = pdc.read_volume("v.nrrd").stored[2:, ::-1]
    gc.collect()
    assert np.array_equal(view, values[2:, ::-1])


def test_slopes_are_applied_to_values():
    nibabel = pytest.importorskip("nibabel")
    image = nibabel.Nifti1Image(scan(), np.diag([-0.8, -0.8, 1.2, 1]))
    image.header.set_slope_inter(0.5, -100)
    nibabel.save(image, "v.nii.gz")
    volume = pdc.read_volume("v.nii.gz")
    assert (volume.slope, volume.intercept, volume.encoding) == (0.5, -100, "deflate")
    assert np.array_equal(volume.values, nibabel.load("v.nii.gz").get_fdata()) and volume.values.dtype == np.float64
    assert np.allclose(volume.affine, np.diag([-0.8, -0.8, 1.2, 1]), atol=1e-6)


@pytest.mark.filterwarnings("ignore::pdc.Warning")
@pytest.mark.parametrize(
    "options, arguments",
    [
        ([], {}),
        (["--iso", "otsu"], dict(level="otsu")),
        (["--iso", "300", "--open", "--triangles"], dict(level=300, open=True, triangles=True)),
        (["--spacing", "0.5,0.5,2", "--iso", "250"], dict(spacing=(0.5, 0.5, 2), level=250)),
        (["--space", "lps", "--iso", "250", "--inside", "low"], dict(space="lps", level=250, inside="low")),
    ],
)
def test_volume_files_give_the_programs_bytes(program, options, arguments):
    write_nrrd("v.nrrd", scan(), space="right-anterior-superior", space_directions="(1,0,0) (0,1,0) (0,0,2)",
               space_origin="(0,0,0)")
    expected = program_bytes(program, "v.nrrd", *options)
    assert bytes_of(pdc.contour("v.nrrd", **arguments)) == expected
    reading = {name: arguments.pop(name) for name in ("spacing", "space") if name in arguments}
    assert bytes_of(pdc.contour(pdc.read_volume("v.nrrd", **reading), **arguments)) == expected


@pytest.mark.filterwarnings("ignore::pdc.Warning")
def test_raw_files_arrays_of_npz_and_moments_are_chosen(program):
    values = scan()
    values.tofile("v.raw")  # In C order: z runs fastest.
    expected = program_bytes(program, "v.raw", "--raw", "24x24x24:i16", "--iso", "300")
    assert bytes_of(pdc.contour("v.raw", 300, raw="24x24x24:i16")) == expected
    assert np.array_equal(pdc.read_volume("v.raw", raw="24x24x24:i16").stored.T, values)
    np.savez("v.npz", a=values, b=-values)
    assert np.array_equal(pdc.read_volume("v.npz", array="b").stored, -values)
    nibabel = pytest.importorskip("nibabel")
    nibabel.save(nibabel.Nifti1Image(np.stack([values, values[::-1]], -1), np.eye(4)), "v.nii")
    assert np.array_equal(pdc.read_volume("v.nii", volume_index=1).stored, values[::-1])
    assert bytes_of(pdc.contour("v.nii", 300, volume_index=1)) == program_bytes(
        program, "v.nii", "--iso", "300", "--volume-index", "1")


@pytest.mark.filterwarnings("ignore::pdc.Warning")
def test_reports_name_the_volume():
    write_nrrd("v.nrrd", scan())
    for source in ("v.nrrd", pdc.read_volume("v.nrrd")):
        assert pdc.contour(source, 300).report["volume"]["format"] == "NRRD"
    assert pdc.contour(scan(), 300).report["volume"] is None


def test_masks_and_sigmas_go_with_volumes():
    np.save("v.npy", scan())
    with pytest.warns(pdc.Warning, match="spacing"):
        volume = pdc.read_volume("v.npy")
    mask = np.ones(volume.shape, bool)
    mask[:12] = False
    half = pdc.contour(volume, 300, mask=mask, open=True)
    assert half.vertices[:, 0].min() >= 12 and half.report["boundary_edges"] > 10
    with pytest.raises(ValueError, match=r"mask must have the volume's shape \(24, 24, 24\), not \(2, 2, 2\)"):
        pdc.contour(volume, 300, mask=mask[:2, :2, :2])


@pytest.mark.parametrize(
    "call, error, line",
    [
        (lambda: pdc.read_volume("missing.nrrd"), pdc.Error, "missing.nrrd"),
        (lambda: pdc.read_volume("v.raw"), pdc.Error, "raw says what they are"),
        (lambda: pdc.read_volume("v.raw", raw="3x3"), ValueError, "raw: "),
        (lambda: pdc.read_volume("v.raw", raw=3), TypeError, "raw must be a str, not int"),
        (lambda: pdc.read_volume("v.npz"), pdc.Error, "array takes one of them"),
        (lambda: pdc.read_volume("v.npy", volume_index=-1), ValueError, "volume_index must be from 0"),
        (lambda: pdc.read_volume("v.npy", spacing=(1, 0, 1)), ValueError, "spacing[1] must be a finite number > 0, not 0"),
        (lambda: pdc.read_volume("v.npy", space="mni"), ValueError, "space must be one of 'file', 'ras', 'lps', not 'mni'"),
        (lambda: pdc.contour("v.npy", origin=(1, 2, 3)), ValueError, "origin goes with volumes in memory only"),
        (lambda: pdc.contour(np.zeros((2, 2, 2)), raw="2x2x2:u8"), ValueError, "raw goes with files only"),
        (lambda: pdc.contour("v.npy", resolution=12), pdc.Error, "a resolution goes with scenes and meshes only"),
        (lambda: pdc.Volume(), TypeError, "volumes are made by pdc.read_volume()"),
    ],
)
def test_mistakes_are_named(call, error, line):
    np.arange(27, dtype=np.uint8).tofile("v.raw")
    np.save("v.npy", np.zeros((3, 3, 3)))
    np.savez("v.npz", a=np.zeros((3, 3, 3)), b=np.zeros((3, 3, 3)))
    with pytest.raises(error) as raised:
        call()
    assert line in str(raised.value) and "\n" not in str(raised.value) and "--" not in str(raised.value)
