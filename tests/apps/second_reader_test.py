#!/usr/bin/env python3
"""What pdc info says of NIfTI files against nibabel, of TIFF stacks against tifffile and of DICOM series against pydicom: map,
range, size and histogram.

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
    import pydicom
    import pydicom.data
    import tifffile
except ImportError as error:
    print(f"{error} (Debian: apt-get install python3-nibabel python3-pydicom python3-tifffile); VOLUMES WERE NOT READ TWICE")
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


def place(dataset, index, unlike_numbers):
    """Puts a slice of a turned stack: steps are unlike the thickness, and numbers unlike the order."""
    across, down = numpy.array([0.8, 0.6, 0]), numpy.array([0, 0, -1.0])
    dataset.ImageOrientationPatient = [*across, *down]
    dataset.ImagePositionPatient = list(numpy.array([5.0, -7, 11]) + index * 2.5 * numpy.cross(across, down))
    dataset.PixelSpacing, dataset.SliceThickness = [0.75, 0.5], 4
    dataset.InstanceNumber = unlike_numbers
    return across * 0.5, down * 0.75, 2.5 * numpy.cross(across, down)


def compare_series(folder):
    """Series of slices of 12 of 16 bits, with and without a sign, as they are and packed by RLE."""
    random = numpy.random.default_rng(3)
    template = pydicom.data.get_testdata_file("CT_small.dcm", read=True)
    order = [3, 0, 5, 1, 4, 2]
    for signed in (0, 1):
        for packed in (False, True):
            series = folder / f"series{signed}{packed}"
            series.mkdir()
            values = random.integers(-2000 if signed else 0, 2000, (6, 30, 40)).astype("i2" if signed else "u2")
            for index, number in enumerate(order):
                template.Rows, template.Columns = 30, 40
                template.BitsStored, template.HighBit, template.PixelRepresentation = 12, 11, signed
                template.RescaleSlope, template.RescaleIntercept = 2, -1024
                steps = place(template, index, number)
                template.SOPInstanceUID = template.file_meta.MediaStorageSOPInstanceUID = f"1.2.3.{number}"
                stored = (values[index] & 0x0FFF).astype("<u2")
                template.PixelData = stored.tobytes()
                template.file_meta.TransferSyntaxUID = pydicom.uid.ExplicitVRLittleEndian
                if packed:
                    template.compress(pydicom.uid.RLELossless, stored.astype(values.dtype))
                template.save_as(series / f"{number}.dcm")
            facts = facts_of(series)
            compare_values(facts, 2.0 * values.T - 1024, series)
            ours = numpy.array([facts["world_x"], facts["world_y"], facts["world_z"]])
            expected = numpy.column_stack([*steps, [5, -7, 11]])
            numpy.testing.assert_allclose(ours, expected, rtol=1e-5, atol=1e-5, err_msg=str(series))
    return 4


def compare_dicom_files():
    """Files that come with pydicom, of scanners and of treatment plans, whose values it can decode."""
    names = ["CT_small", "MR_small", "MR_small_RLE", "MR_small_bigendian", "MR_small_expb", "MR_small_implicit",
             "image_dfl", "rtdose", "rtdose_expb", "rtdose_rle"]
    for name in names:
        path = pydicom.data.get_testdata_file(name + ".dcm")
        dataset = pydicom.dcmread(path)
        values = dataset.pixel_array * float(dataset.get("RescaleSlope", dataset.get("DoseGridScaling", 1)))
        values = values + float(dataset.get("RescaleIntercept", 0))
        facts = facts_of(path)
        compare_values(facts, (values if values.ndim == 3 else values[None]).T, path)
        if "GridFrameOffsetVector" in dataset:
            assert numpy.allclose(facts["spacing"], [10, 10, 5]), facts
    return len(names)


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
        compared += compare_series(pathlib.Path(folder))
        compared += compare_dicom_files()
    for path in sorted((DATA / "volume").glob("*.nii.gz")):
        compare(path)
        compared += 1
    print(f"{compared} files are read alike")
    assert compared >= 103


if __name__ == "__main__":
    main()
