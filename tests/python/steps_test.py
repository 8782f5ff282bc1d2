"""Steps on grids: what they do, and that they do what the program does."""

import json
import subprocess

import numpy as np
import pytest

import pdc


def ball(radius=1.0, center=(0, 0, 0), voxel=0.1):
    """The level set of a ball."""
    return pdc.Grid.from_mesh(pdc.contour(pdc.sphere(radius, center), box=4, resolution=40), voxel)


def fog():
    """Two cubes of fog, the larger one with a cavity."""
    values = np.zeros((24, 24, 24), np.float32)
    values[2:16, 2:16, 2:16] = 1
    values[8:10, 8:10, 8:10] = 0
    values[19:22, 19:22, 19:22] = 1
    return pdc.Grid.from_array(values, spacing=0.1, grid_class="fog")


def same(grid, other):
    box = ((-40, -40, -40), (40, 40, 40))
    return (grid.active_voxels, grid.grid_class) == (other.active_voxels, other.grid_class) and np.array_equal(
        grid.to_array(box), other.to_array(box))


CHAINS = {
    "fog": (["--fog-to-level-set", "0.4", "--smooth", "gaussian:0.1", "--keep", "largest", "--fill-cavities"],
            lambda g: g.fog_to_level_set(0.4).smooth(0.1, filter="gaussian").keep().fill_cavities()),
    "box": (["--clip", "-1,-1,-1,1,1,0.33", "--resample", "0.15", "--offset", "0.1"],
            lambda g: g.clip([(-1, -1, -1), (1, 1, 0.33)]).resample(0.15).offset(0.1)),
    "ball": (["--open-close", "0.2", "--union", "other.vdb", "--subtract", "third.vdb"],
             lambda g: g.open_close(0.2).union(pdc.read_grid("other.vdb")).subtract(pdc.read_grid("third.vdb"))),
    "open": (["--clip", "-1,-1,-1,1,1,0.33", "--open", "--keep", "above:10"],
             lambda g: g.clip([(-1, -1, -1), (1, 1, 0.33)], closed=False).keep(above=10)),
    "level": (["--iso", "0.25", "--keep", "1", "--fill-cavities"],
              lambda g: g.keep(1, level=0.25).fill_cavities()),
}


@pytest.mark.filterwarnings("ignore::pdc.Warning")
@pytest.mark.parametrize("name", CHAINS)
def test_chains_are_the_programs(program, name):
    options, steps = CHAINS[name]
    (fog() if name in ("fog", "level") else ball()).save("in.vdb")
    ball(0.5, (1, 0, 0)).save("other.vdb")
    ball(0.4, (0, 1, 0), 0.07).save("third.vdb")
    subprocess.run([program, "grid", "in.vdb", "program.vdb", *options, "--quiet", "--json", "grid.json"], check=True)
    made = steps(pdc.read_grid("in.vdb"))
    assert same(made, pdc.read_grid("program.vdb"))
    expected = json.load(open("grid.json"))["steps"]
    assert len(made.steps) == len(expected)
    for step, other in zip(made.steps, expected):
        assert {**step, "parameter": 0} == {**other, "parameter": 0}
    subprocess.run([program, "mesh", "in.vdb", "program.ply", *options, "--quiet"], check=True)
    pdc.contour(made, open="--open" in options).save("python.ply")
    assert open("python.ply", "rb").read() == open("program.ply", "rb").read()


def test_grids_that_steps_begin_with_do_not_change():
    grid = ball()
    before = grid.to_array()
    grid.offset(0.2), grid.clip(1), grid.smooth(0.1), grid.union(ball(0.5))
    assert np.array_equal(grid.to_array(), before) and [step["name"] for step in grid.steps] == ["mesh-to-level-set"]


def test_what_steps_make_of_a_ball():
    grid = ball()
    top = pdc.contour(grid.clip([(-2, -2, 0.25), (2, 2, 2)]))
    assert pdc.check(top).clean and top.vertices[:, 2].min() == pytest.approx(0.25, abs=0.002)
    assert pdc.contour(grid.offset(-0.4)).vertices[:, 2].max() == pytest.approx(0.6, abs=0.01)
    assert pdc.contour(grid.intersect(ball(1, (1, 0, 0)))).vertices[:, 0].min() == pytest.approx(0, abs=0.01)
    assert np.allclose(np.diag(grid.resample(0.25).affine), [0.25, 0.25, 0.25, 1])
    mask = pdc.Grid.from_array(np.ones((5, 5, 5), bool), spacing=0.1, origin=(0.8, -0.2, -0.2))
    assert 0 < grid.clip(mask=mask).active_voxels < grid.active_voxels / 10


def test_parts_and_cavities():
    grid = fog()
    assert pdc.check(pdc.contour(grid))["components"] == 3
    assert pdc.check(pdc.contour(grid.keep()))["components"] == 2
    assert pdc.check(pdc.contour(grid.keep(2)))["components"] == 3
    assert pdc.check(pdc.contour(grid.keep(above=100)))["components"] == 2
    assert pdc.check(pdc.contour(grid.keep().fill_cavities()))["components"] == 1


def test_where_the_surface_is_goes_on_with_the_grid():
    values = np.zeros((12, 12, 12), np.float32)
    values[3:9, 3:9, 3:9] = 0.2
    grid = pdc.Grid.from_array(values, grid_class="fog")
    kept = grid.keep(level=0.1)
    assert kept.active_voxels > 0 and len(pdc.contour(kept).quads) == len(pdc.contour(grid, 0.1).quads) > 0
    with pytest.warns(pdc.Warning, match="no surface at level 0.5"):
        pdc.contour(kept, 0.5)


def test_level_sets_of_meshes_are_the_programs(program):
    mesh = pdc.contour(pdc.box(1.2), box=2, resolution=24)
    mesh.save("cube.ply")
    subprocess.run([program, "grid", "cube.ply", "program.vdb", "--mesh-to-level-set", "0.1:0.5", "--quiet"], check=True)
    assert same(pdc.Grid.from_mesh(mesh, 0.1, half_width=0.5), pdc.read_grid("program.vdb"))


def test_warnings_name_the_caller_and_arguments():
    values = np.full((6, 6, 6), 3.0, np.float32)
    values[2:4, 2:4, 2:4] = 5
    with pytest.warns(pdc.Warning, match="level=V") as caught:
        pdc.Grid.from_array(values, background=3).keep()
    assert caught[0].filename == __file__ and "--" not in str(caught[0].message)
    in_voxels = pdc.Grid.from_array(10 * ball().to_array(), spacing=0.1, background=3, grid_class="level-set")
    with pytest.warns(pdc.Warning, match="union: the values are no distances in world units") as caught:
        in_voxels.union(ball())
    assert caught[0].filename == __file__


def test_progress_and_threads():
    def stop(stage, share):
        raise LookupError(stage)

    grid = ball()
    assert same(grid.smooth(0.2, threads=1), grid.smooth(0.2, threads=2))
    with pytest.raises(LookupError):
        ball(voxel=0.01).offset(0.3, progress=stop)


@pytest.mark.parametrize(
    "call, error, line",
    [
        (lambda: fog().offset(0.1), pdc.Error, "offset: an offset needs a level set, and the grid is a fog volume; Grid.fog_to_level_set() makes one"),
        (lambda: pdc.Grid.from_array(np.ones((3, 3, 3), int)).keep(), pdc.Error, "int64"),
        (lambda: ball().clip(), ValueError, "clip needs a box or a mask, and not both"),
        (lambda: ball().clip([(0, 0, 0), (1, 1, 0)]), ValueError, "box must not be empty: it goes from 0 to 0 along z"),
        (lambda: ball().clip(mask=np.ones((2, 2, 2))), TypeError, "mask must be pdc.Grid, not ndarray"),
        (lambda: ball().resample(0), ValueError, "voxel_size must be a finite number > 0, not 0"),
        (lambda: ball().resample(0.2, method="cubic"), ValueError, "method must be one of 'best', 'contour', 'linear', 'quadratic', not 'cubic'"),
        (lambda: ball().smooth(0.1, filter="box"), ValueError, "filter must be one of 'mean', 'gaussian', 'median', 'curvature', not 'box'"),
        (lambda: ball().smooth(0.001), pdc.Error, "half a voxel"),
        (lambda: ball().open_close(-1), ValueError, "distance must be a finite number > 0, not -1"),
        (lambda: ball().keep(0), ValueError, "most must be from 1"),
        (lambda: ball().union(), ValueError, "union needs another grid"),
        (lambda: ball().union(3), TypeError, "others must be pdc.Grid, not int"),
        (lambda: ball().keep(inside="up"), ValueError, "inside must be one of 'low', 'high', not 'up'"),
        (lambda: ball().keep(leval=1), TypeError, "a step on grids got an unexpected argument 'leval'"),
        (lambda: pdc.Grid.from_mesh(ball(), 0.1), TypeError, "mesh must be a pdc.Mesh, not Grid"),
        (lambda: pdc.Grid.from_mesh(pdc.Mesh(np.eye(3), [[0, 1, 2]]), 0.1, half_width=0.05), ValueError, "half_width must be a finite number >= 0.1"),
    ],
)
def test_mistakes_are_named(call, error, line):
    with pytest.raises(error) as raised:
        call()
    assert line in str(raised.value) and "\n" not in str(raised.value) and "--" not in str(raised.value)
