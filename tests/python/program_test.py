"""The package gives what the program gives: bytes, reports, lines."""

import json
import subprocess

import pytest

import pdc

CASES = [
    ("scenes/csg.yaml", [], {}),
    ("scenes/csg.yaml", ["--resolution", "40", "--triangles", "--normals"], dict(resolution=40, triangles=True, normals=True)),
    ("scenes/smooth_union.yaml", ["--sigma-n", "0.1", "--placement", "free"], dict(sigma_normal=0.1, placement="free")),
    ("scenes/noise_minus_sphere.yaml", ["--voxel-size", "0.08", "--open"], dict(voxel_size=0.08, open=True)),
    ("scenes/csg.yaml", ["--adaptive", "0.1v", "--resolution", "24"], dict(adaptive="0.1v", resolution=24)),
    ("tests/data/mpm_bullet.vdb", [], {}),
    ("tests/data/mpm_bullet.vdb", ["--confidence", "--rank"], dict(confidence=True, rank=True)),
    ("tests/data/mpm_bullet.vdb", ["--iso", "-0.005", "--sigma-n", "inf"], dict(level=-0.005, sigma_normal=float("inf"))),
    ("tests/data/mpm_bullet.vdb", ["--hermite", "gradient", "--placement", "cell"], dict(hermite="gradient", placement="cell")),
    ("tests/data/mpm_bullet.vdb", ["--inside", "high", "--class", "fog", "--iso", "0"], dict(inside="high", grid_class="fog", level=0)),
]


def run(program, root, file, options):
    subprocess.run([program, "mesh", root / file, "program.ply", *options, "--quiet", "--json", "program.json"], check=True,
                   stderr=subprocess.DEVNULL)
    return open("program.ply", "rb").read(), json.load(open("program.json"))


@pytest.mark.filterwarnings("ignore::pdc.Warning")
@pytest.mark.parametrize("file, options, arguments", CASES)
def test_bytes_and_reports_are_the_programs(program, root, file, options, arguments):
    expected, facts = run(program, root, file, options)
    mesh = pdc.contour(root / file, **arguments)
    mesh.save("python.ply")
    assert open("python.ply", "rb").read() == expected
    measured = {"seconds", "peak_memory_bytes"}
    files = {"output", "bytes_written", "double_precision", "options"}
    assert set(mesh.report) == set(facts) - files
    for name in set(mesh.report) - measured - {"warnings"}:
        assert mesh.report[name] == facts[name], name


@pytest.mark.filterwarnings("ignore::pdc.Warning")
@pytest.mark.parametrize("file, options, arguments", CASES[5:])
def test_grids_in_memory_give_the_bytes_of_their_file(program, root, file, options, arguments):
    expected, _ = run(program, root, file, options)
    pdc.contour(pdc.read_grid(root / file), **arguments).save("python.ply")
    assert open("python.ply", "rb").read() == expected


@pytest.mark.parametrize("file, options, arguments", CASES[:5])
def test_scenes_in_memory_give_the_bytes_of_their_file(program, root, file, options, arguments):
    expected, _ = run(program, root, file, options)
    pdc.contour(pdc.scene(root / file), **arguments).save("python.ply")
    assert open("python.ply", "rb").read() == expected


@pytest.mark.parametrize(
    "verb, options, arguments",
    [
        ("decimate", ["--ratio", "0.2"], dict(ratio=0.2)),
        ("decimate", ["--faces", "300", "--sound", "--quadric", "plane"], dict(faces=300, sound=True, quadric="plane")),
        ("cluster", ["--cell", "0.2", "--clean"], dict(cell=0.2, clean=True)),
        ("smooth", ["--sigma", "0.1", "--iterations", "4"], dict(sigma=0.1, iterations=4)),
        ("subdivide", ["--levels", "1", "--normals"], dict(levels=1, normals=True)),
        ("subdivide", ["--scheme", "catmull-clark", "--covariance", "none", "--levels", "1"],
         dict(scheme="catmull-clark", covariance=None, levels=1)),
    ],
)
def test_verbs_give_the_programs_bytes(program, root, verb, options, arguments):
    pdc.contour(root / "scenes/csg.yaml", resolution=24).save("in.ply")
    subprocess.run([program, verb, "in.ply", "program.ply", *options, "--quiet"], check=True)
    getattr(pdc, verb)(pdc.read_mesh("in.ply"), **arguments).save("python.ply")
    assert open("python.ply", "rb").read() == open("program.ply", "rb").read()


def test_checks_are_the_programs(program, root):
    mesh = pdc.contour(root / "scenes/csg.yaml", resolution=24)
    mesh.save("mesh.ply")
    subprocess.run([program, "check", "mesh.ply", "--quiet", "--json", "check.json"], check=True)
    facts = json.load(open("check.json"))
    found = pdc.check(mesh)
    assert found.clean and dict(found) == {k: v for k, v in facts.items() if k not in ("file", "warnings")}
    cut = pdc.Mesh(mesh.vertices, quads=mesh.quads[1:])
    assert pdc.check(cut).faults == ["boundary_edges"] and pdc.check(cut, allow_boundary=True).clean


def test_facts_on_files_are_the_programs(program, root):
    for file in ("scenes/csg.yaml", "tests/data/mpm_bullet.vdb"):
        subprocess.run([program, "info", root / file, "--json", "info.json"], check=True)
        assert pdc.info(root / file) == json.load(open("info.json"))


def test_sweeps_are_the_programs(program, root):
    options = ["--sigma-n", "0,0.1,inf", "--voxel-size", "0.2"]
    subprocess.run([program, "sweep", root / "scenes/csg.yaml", "sweep", *options, "--quiet"], check=True)
    expected = json.load(open("sweep/sweep.json"))
    report, meshes = pdc.sweep(root / "scenes/csg.yaml", "sigma_normal", [0, 0.1, float("inf")], voxel_size=0.2, meshes=True)
    assert len(meshes) == 3
    for step, other in zip(report["steps"], expected["steps"]):
        assert {k: v for k, v in step.items() if k != "seconds"} == {k: v for k, v in other.items() if k != "seconds"}
    levels = pdc.sweep(pdc.sphere(1), "level", [0, 0.2], box=3, resolution=12)
    assert levels["steps"][1]["vertices"] > levels["steps"][0]["vertices"]
    sizes = pdc.sweep(pdc.sphere(1), "voxel_size", [0.2, 0.1], box=3)
    assert sizes["steps"][1]["vertices"] > 3 * sizes["steps"][0]["vertices"]
