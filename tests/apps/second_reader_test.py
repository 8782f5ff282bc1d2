#!/usr/bin/env python3
"""What pdc info says of NIfTI files against nibabel and of TIFF stacks against tifffile: map, range, size and histogram.

Exit code 77 if one of them is not there, unless PDC_NEED_PYTHON is set. Usage: second_reader_test.py PDC DATA_DIR
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

try:
    import nibabel
    import numpy
    import tifffile
except ImportError as error:
    print(f"{error} (Debian: apt-get install python3-nibabel python3-tifffile); VOLUMES WERE NOT READ TWICE")
    sys.exit(1 if os.environ.get("PDC_NEED_PYTHON") else 77)

PDC, DATA = sys.argv[1], pathlib.Path(sys.argv[2])


def facts_of(path):
    run = subprocess.run([PDC, "info", str(path), "--json", "-", "--quiet"], capture_output=True, check=True, text=True)
    return json.loads(run.stdout)


def compare_values(facts, volume, path):
    assert facts["size"] == list(volume.shape), path
    numpy.testing.assert_allclose([facts["value_min"], facts["value_max"]], [volume.min(), volume.max()], rtol=1e-6)
    # Sixteen counts tell values that are shifted, scaled or torn apart.
    edges = numpy.linspace(float(volume.min()), float(volume.max()), 17)
    counts = numpy.histogram(volume, edges)[0]
    assert abs(counts - numpy.array(facts["histogram"])).sum() <= 0.03 * volume.size, path


def compare(path):
    facts, image = facts_of(path), nibabel.load(path)
    values = numpy.asanyarray(image.dataobj)
    compare_values(facts, values if values.ndim == 3 else values[..., 0], path)
    ours = numpy.array([facts["world_x"], facts["world_y"], facts["world_z"]])
    numpy.testing.assert_allclose(ours, image.affine[:3], rtol=1e-5, atol=1e-5, err_msg=str(path))


def compare_stacks(folder):
    """Strips, tiles and deflate in both byte orders; then ImageJ's spacing."""
    random = numpy.random.default_rng(1)
    path, count = folder / "stack.tif", 0
    for code in ("u1", "u2", "i2", "u4", "f4"):
        for order in "<>":
            for layout in ({}, {"compression": "zlib"}, {"tile": (32, 32)}, {"rowsperstrip": 3}):
                values = (random.random((7, 50, 41)) * 100).astype(code)
                tifffile.imwrite(path, values, byteorder=order, photometric="minisblack", **layout)
                compare_values(facts_of(path), values.T, f"{code} {order} {layout}")
                count += 1
    values = (random.random((6, 20, 30)) * 99).astype("u2")
    metadata = {"spacing": 3, "unit": "um", "axes": "ZYX"}
    tifffile.imwrite(path, values, imagej=True, resolution=(2, 4), metadata=metadata)
    facts = facts_of(path)
    compare_values(facts, values.T, path)
    assert facts["spacing"] == [0.5, 0.25, 3.0] and facts["unit"] == "um", facts
    return count + 1


def write_all(folder):
    random = numpy.random.default_rng(7)
    affine = numpy.array([[-1.5, 0.2, 0, 40], [0.1, 0, 2.5, -20], [0, 1.25, 0.3, 7], [0, 0, 0, 1.0]])
    for kind in (nibabel.Nifti1Image, nibabel.Nifti2Image):
        for code in ("u1", "i2", "u2", "i4", "f4", "f8"):
            for order in "<>":
                values = (random.random((9, 7, 5)) * 200).astype(order + code)
                header = kind.header_class(endianness=order)
                header.set_data_dtype(values.dtype)
                image = kind(values, affine, header)
                image.set_qform(affine if code == "i2" else None, code=1 if code == "i2" else 0, strip_shears=True)
                if code == "i2":
                    image.set_sform(None, code=0)
                for suffix in (".nii", ".nii.gz"):
                    path = folder / f"{kind.__name__}_{code}_{'big' if order == '>' else 'little'}{suffix}"
                    nibabel.save(image, path)
                    yield path


def main():
    compared = 0
    with tempfile.TemporaryDirectory() as folder:
        for path in write_all(pathlib.Path(folder)):
            compare(path)
            compared += 1
        compared += compare_stacks(pathlib.Path(folder))
    for path in sorted((DATA / "volume").glob("*.nii.gz")):
        compare(path)
        compared += 1
    print(f"{compared} files are read alike")
    assert compared >= 89


if __name__ == "__main__":
    main()
