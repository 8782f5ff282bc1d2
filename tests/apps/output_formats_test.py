#!/usr/bin/env python3
"""Meshes written as .glb, .3mf, .vtp and compressed, read back by VTK, Assimp and gzip: the places, faces and properties of the .ply.

Exit code 77 if one of them is not there, unless PDC_NEED_PYTHON is set. Usage: output_formats_test.py PDC SCENES_DIR
"""
import gzip
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

try:
    import numpy
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError as error:
    vtk, missing = None, error
if vtk is None or shutil.which("assimp") is None:
    print("python3-vtk9 or assimp-utils are not there (Debian: apt-get install); FORMATS WERE NOT READ BACK")
    sys.exit(1 if os.environ.get("PDC_NEED_PYTHON") else 77)

PDC, SCENES = sys.argv[1], pathlib.Path(sys.argv[2])


def pdc(*arguments):
    subprocess.run([PDC, *map(str, arguments), "--quiet"], check=True)


def read_ply(path):
    """Places, triangles and properties of a binary .ply of quads and triangles, as pdc writes it."""
    data = path.read_bytes()
    header, body = data[: data.index(b"end_header\n")].decode().split("\n"), data[data.index(b"end_header\n") + 11 :]
    counts = {line.split()[1]: int(line.split()[2]) for line in header if line.startswith("element")}
    columns = [line.split()[1:] for line in header if line.startswith("property") and "list" not in line]
    kinds = {"float": "<f4", "double": "<f8", "uchar": "u1"}
    layout = numpy.dtype([(name, kinds[kind]) for kind, name in columns])
    vertices = numpy.frombuffer(body, layout, counts["vertex"])
    at, triangles = layout.itemsize * counts["vertex"], []
    for _ in range(counts["face"]):
        corners = numpy.frombuffer(body, "<i4", body[at], at + 1)
        triangles += [[corners[0], corners[i], corners[i + 1]] for i in range(1, len(corners) - 1)]
        at += 1 + 4 * len(corners)
    return vertices, numpy.array(triangles)


def places(vertices):
    return numpy.stack([vertices["x"], vertices["y"], vertices["z"]], 1).astype(float)


def check_vtp(path, vertices, triangles, origin, settings):
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    data = reader.GetOutput()
    numpy.testing.assert_array_equal(vtk_to_numpy(data.GetPoints().GetData()), places(vertices) + origin)
    for name in ("confidence", "sigma"):
        numpy.testing.assert_array_equal(vtk_to_numpy(data.GetPointData().GetArray(name)), vertices[name])
    normals = vtk_to_numpy(data.GetPointData().GetNormals())
    numpy.testing.assert_array_equal(normals, numpy.stack([vertices[n] for n in ("nx", "ny", "nz")], 1))
    split = vtk.vtkTriangleFilter()
    split.SetInputData(data)
    split.Update()
    assert split.GetOutput().GetNumberOfCells() == len(triangles)
    corners = vtk_to_numpy(data.GetPolys().GetConnectivityArray())
    assert corners.min() == 0 and corners.max() == len(vertices) - 1
    assert sorted(data.GetFieldData().GetAbstractArray("settings").GetValue(0).split()) == sorted(settings)
    assert data.GetFieldData().GetAbstractArray("unit").GetValue(0) == "mm"


def check_glb(path, vertices, triangles, origin):
    reader = vtk.vtkGLTFReader()
    reader.SetFileName(str(path))
    reader.Update()
    blocks = reader.GetOutput().NewIterator()
    blocks.InitTraversal()
    data = blocks.GetCurrentDataObject()
    world = (places(vertices) + origin) * 1e-3
    turned = numpy.stack([world[:, 0], world[:, 2], -world[:, 1]], 1)
    numpy.testing.assert_allclose(vtk_to_numpy(data.GetPoints().GetData()), turned, atol=1e-6)
    numpy.testing.assert_array_equal(vtk_to_numpy(data.GetPointData().GetArray("_confidence")), vertices["confidence"])
    corners = vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    numpy.testing.assert_array_equal(corners, triangles)


def check_with_assimp(path, vertices, triangles, origin):
    """By way of text that Assimp writes of the file."""
    out = path.with_suffix(".obj")
    subprocess.run(["assimp", "export", str(path), str(out)], check=True, stdout=subprocess.DEVNULL)
    lines = [line.split() for line in out.read_text().splitlines()]
    read = numpy.array([line[1:4] for line in lines if line[:1] == ["v"]], float)
    faces = numpy.array([[c.split("/")[0] for c in line[1:]] for line in lines if line[:1] == ["f"]], int) - 1
    expected = places(vertices) + origin
    # Assimp may put vertices into another order, but keeps that of faces.
    numpy.testing.assert_allclose(read[faces], expected[triangles], rtol=1e-5, atol=1e-5)


def check_all(folder, scene, origin, options):
    settings = ["--confidence", "--normals", "--unit", "mm", *options]
    outputs = {suffix: folder / f"out{suffix}" for suffix in (".ply", ".vtp", ".glb")}
    for path in outputs.values():
        pdc("mesh", scene, path, *settings)
    vertices, triangles = read_ply(outputs[".ply"])
    check_vtp(outputs[".vtp"], vertices, triangles, origin, settings)
    check_glb(outputs[".glb"], vertices, triangles, origin)
    pdc("mesh", scene, folder / "out.3mf", "--unit", "mm", *options)
    check_with_assimp(folder / "out.3mf", vertices, triangles, origin)
    for suffix in (".ply", ".obj", ".stl", ".off"):
        pdc("mesh", scene, folder / f"plain{suffix}", *options)
        pdc("mesh", scene, folder / f"packed{suffix}.gz", *options)
        assert gzip.open(folder / f"packed{suffix}.gz").read() == (folder / f"plain{suffix}").read_bytes()


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        scene = SCENES / "rotated_box.yaml"
        check_all(folder, scene, numpy.zeros(3), ["--resolution", "24"])
        check_all(folder, scene, numpy.array([100.0, 200, -300]), ["--resolution", "24", "--origin", "100,200,-300"])
    print("formats are read back alike")


if __name__ == "__main__":
    main()
