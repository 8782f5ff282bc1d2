"""What others in the process notice: threads, signals, progress, memory, forks."""

import multiprocessing
import os
import resource
import signal
import subprocess
import sys
import textwrap
import threading
import time

import numpy as np
import pytest

import pdc
from conftest import sphere_values

# Takes several seconds to contour on any machine.
LONG = dict(box=2.4, resolution=600, threads=2)


def long_field():
    return pdc.difference(pdc.sphere(1), pdc.gyroid(0.2, 0.3))


class Ticker:
    """A thread that takes a turn each millisecond."""

    def __enter__(self):
        self.turns, self.done = 0, False
        self.thread = threading.Thread(target=self.run)
        self.thread.start()
        return self

    def run(self):
        while not self.done:
            time.sleep(0.001)
            self.turns += 1

    def __exit__(self, *_):
        self.done = True
        self.thread.join()

    def rate(self, work):
        """Turns a second while work() is done."""
        begin, turns = time.perf_counter(), self.turns
        work()
        return (self.turns - turns) / (time.perf_counter() - begin)


@pytest.mark.skipif(bool(os.environ.get("PDC_SANITIZED")), reason="sanitizers slow one side down")
def test_other_threads_run_while_work_is_done(program):
    """The ticker takes 80 % of the turns that it takes beside the same work in another process, which holds no lock."""
    formula = "x^2 + y^2 + z^2 - 1 + 0.05 * sin(20 * x)"
    with open("scene.yaml", "w") as file:
        print("box: [[-1.2, -1.2, -1.2], [1.2, 1.2, 1.2]]\nresolution: 96", file=file)
        print("shape: {formula: {expression: '" + formula + "'}}", file=file)
    command = [program, "mesh", "scene.yaml", "program.ply", "--threads", "1", "--quiet"]
    apart, within = [], []
    with Ticker() as ticker:
        for _ in range(5):
            apart.append(ticker.rate(lambda: subprocess.run(command, check=True)))
            within.append(ticker.rate(lambda: pdc.contour("scene.yaml", threads=1)))
    assert sum(within) > 0.8 * sum(apart), (within, apart)


def interrupted_after(seconds):
    """How long Ctrl-C takes to end a contour that would take far longer."""
    field = long_field()
    sent = []

    def send():
        sent.append(time.perf_counter())
        os.kill(os.getpid(), signal.SIGINT)

    timer = threading.Timer(seconds, send)
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        pdc.contour(field, **LONG)
    return time.perf_counter() - sent[0]


def test_an_interrupt_comes_back_at_once_every_time():
    waits = [interrupted_after(0.05 + 0.04 * i) for i in range(20)]
    assert max(waits) < 0.2, sorted(waits)[-3:]
    assert pdc.check(pdc.contour(pdc.sphere(1), box=2.5, resolution=16)).clean


def test_an_interrupt_ends_work_on_functions_of_python():
    def slow(points):
        time.sleep(0.001)
        return np.linalg.norm(points, axis=1) - 1

    threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    begin = time.perf_counter()
    with pytest.raises(KeyboardInterrupt):
        pdc.contour(slow, box=2.5, resolution=400)
    assert time.perf_counter() - begin < 2


def test_progress_is_heard_on_the_calling_thread():
    heard = []
    here = threading.get_ident()

    def progress(stage, share):
        assert threading.get_ident() == here
        heard.append((stage, share))

    mesh = pdc.contour(long_field(), box=2.4, resolution=48, progress=progress)
    assert len(heard) > 3 and all(isinstance(stage, str) and 0 <= share <= 1 for stage, share in heard)
    heard.clear()
    pdc.decimate(mesh, ratio=0.5, progress=progress)
    assert {stage for stage, _ in heard} == {"decimate"}


def test_what_progress_raises_stops_the_work():
    def stop(stage, share):
        raise LookupError("enough")

    begin = time.perf_counter()
    with pytest.raises(LookupError, match="enough"):
        pdc.contour(long_field(), **LONG, progress=stop)
    assert time.perf_counter() - begin < 1


def test_work_within_progress_and_in_several_threads():
    distances, step = sphere_values(48)
    expected = pdc.contour(distances, spacing=step).vertices
    inner = []

    def progress(stage, share):
        if not inner:
            inner.append(pdc.contour(distances, spacing=step).vertices)

    pdc.contour(long_field(), box=2.4, resolution=40, progress=progress)
    assert np.array_equal(inner[0], expected)
    results = [None] * 6

    def work(i):
        results[i] = pdc.contour(distances, spacing=step).vertices

    threads = [threading.Thread(target=work, args=(i,)) for i in range(6)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(np.array_equal(result, expected) for result in results)


def resident():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * resource.getpagesize()


@pytest.mark.skipif(bool(os.environ.get("PDC_SANITIZED")), reason="sanitizers keep what is freed")
def test_a_thousand_contours_leak_nothing():
    distances, step = sphere_values(24)
    field = pdc.function(lambda p: np.linalg.norm(p, axis=1) - 1, lipschitz=1)
    grid = pdc.Grid.from_array(distances, spacing=step, background=1)

    def once():
        mesh = pdc.contour(distances, spacing=step, confidence=True, normals=True)
        mesh.vertices, mesh.faces, mesh.properties
        pdc.contour(grid)
        pdc.contour(field, box=2.5, resolution=10)
        with pytest.raises(pdc.Error):
            pdc.contour(np.full((3, 3, 3), np.nan))

    for _ in range(150):
        once()
    before = resident()
    for _ in range(250):  # Four calls each.
        once()
    assert resident() < 1.01 * before


def child(queue):
    try:
        queue.put(len(pdc.contour(pdc.sphere(1), box=2.5, resolution=16).vertices))
    except pdc.Error as error:
        queue.put(str(error))


@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_a_child_works_or_says_why_not(method, monkeypatch):
    expected = len(pdc.contour(pdc.sphere(1), box=2.5, resolution=16).vertices)
    context = multiprocessing.get_context(method)
    queue = context.Queue()
    process = context.Process(target=child, args=(queue,))
    process.start()
    result = queue.get(timeout=60)
    process.join(60)
    assert process.exitcode == 0
    if method == "spawn":
        assert result == expected
    else:
        assert "forked after pdc had worked" in result and "spawn" in result and "\n" not in result


def test_a_child_forked_before_the_first_work_works():
    code = """
        import os, pdc
        pid = os.fork()
        n = len(pdc.contour(pdc.sphere(1), box=2.5, resolution=16).vertices)
        if pid == 0:
            os._exit(0 if n > 100 else 1)
        assert os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]) == 0
    """
    subprocess.run([sys.executable, "-c", textwrap.dedent(code)], check=True, timeout=60)
