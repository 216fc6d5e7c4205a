"""Ctrl-C ends each call that may take long, with the results so far. Progress is reported during the call."""

import functools
import math
import os
import pickle
import signal
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rigid_ccd import (
    Body,
    Cell,
    EdgesQuery,
    InputError,
    InterruptError,
    Joint,
    Motion,
    PathRange,
    Proof,
    Robot,
    Table,
    TableQuery,
    check_proof,
    closest_approach,
    first_contact,
    first_contacts,
    is_free,
    prove,
)


def knot(size: int) -> tuple[Any, Any]:
    """The mesh of a torus knot, with enough triangles to keep a query busy."""
    around, along = np.meshgrid(np.arange(16) * np.pi / 8, np.arange(size) * 2 * np.pi / size)
    radius = 1 + 0.4 * np.cos(3 * along) + 0.15 * np.cos(around)
    place = np.stack(
        [radius * np.cos(2 * along), radius * np.sin(2 * along), 0.4 * np.sin(3 * along) + 0.15 * np.sin(around)], axis=-1
    )
    corner = np.arange(16 * size).reshape(size, 16)
    a, b = corner, np.roll(corner, -1, 0)
    c, d = np.roll(b, -1, 1), np.roll(a, -1, 1)
    faces = np.concatenate([np.stack(f, -1).reshape(-1, 3) for f in ((a, b, c), (a, c, d))])
    return place.reshape(-1, 3), faces


KNOT = Body(*knot(600))
# The knot makes a hundred thousand turns, and barely misses each time, which is minutes of work.
MISSES = Motion([3.3, 0, 0], angular_velocity=[6e5, 6e5, 0])
HARD: Any = {"tolerance": 1e-9, "budget": 2**60}


def hard_cell() -> Cell:
    """A knot on a hinge without limits, beside another knot."""
    cell = Cell(Robot([Joint.revolute("hinge", "base", "knot", axis=[1, 1, 0])], {"knot": KNOT}))
    cell.add_obstacle("other", KNOT, ([3.3, 0, 0], [0, 0, 0, 1]))
    return cell


CELL = hard_cell()
# The first edges are short, and the others are many turns.
ENDS = np.array([[1e-9]] * 40 + [[1e6]] * 40)
STARTS = np.zeros_like(ENDS)
LONG = [[0.0], [1e6]]


def interrupted(call: Callable[[], Any], seconds: float = 0.5, most_work: float = math.inf) -> BaseException:
    """Sends Ctrl-C during a call, and returns the exception. `most_work` limits the CPU seconds after it."""
    sent = []

    def send() -> None:
        sent.append(time.process_time())
        os.kill(os.getpid(), signal.SIGINT)

    # A background job of a shell ignores Ctrl-C, and so do the programs that it starts.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    timer = threading.Timer(seconds, send)
    timer.start()
    with pytest.raises(KeyboardInterrupt) as caught:
        call()
        # A call that ends before Ctrl-C does not take long enough for this test.
        pytest.fail("the call has ended")
    assert time.process_time() - sent[0] < most_work
    timer.join()
    return caught.value


@pytest.mark.parametrize(
    "ask",
    [
        lambda: first_contact(KNOT, KNOT, MISSES, **HARD),
        lambda: is_free(KNOT, KNOT, MISSES, **HARD),
        lambda: prove(KNOT, KNOT, MISSES, **HARD),
        lambda: CELL.first_contact(LONG, **HARD),
        lambda: CELL.is_free(LONG, **HARD),
    ],
)
def test_a_question_about_contacts(ask: Callable[[], Any]) -> None:
    error = interrupted(ask)
    assert isinstance(error, InterruptError)
    assert error.safe_until is None or 0 <= error.safe_until < 1


@pytest.mark.parametrize(
    "ask",
    [
        lambda: closest_approach(KNOT, KNOT, MISSES, **HARD),
        lambda: CELL.closest_approach(LONG, **HARD),
    ],
)
def test_a_question_about_a_distance(ask: Callable[[], Any]) -> None:
    error = interrupted(ask)
    assert isinstance(error, InterruptError) and error.lower is not None and error.upper is not None
    assert 0 <= error.lower <= error.upper


@pytest.mark.parametrize("ask", ["is-free", "first-contact", "closest-approach"])
def test_edges_keep_what_is_answered(ask: Any) -> None:
    whole = CELL.answer_edges(STARTS[:40], ENDS[:40], ask)
    told: list[tuple[int, int | None]] = []
    calls: list[Callable[..., Any]] = [
        lambda **how: CELL.answer_edges(STARTS, ENDS, ask, threads=1, progress=lambda *now: told.append(now), **how),
        lambda **how: CELL.answer_paths(np.stack([STARTS, ENDS], 1), ask, threads=2, **how),
        lambda **how: EdgesQuery(CELL, question=ask, **how)({"id": range(80), "from_hinge": STARTS[:, 0], "to_hinge": ENDS[:, 0]}),
    ]
    for call in calls:
        error = interrupted(functools.partial(call, **HARD))
        assert isinstance(error, InterruptError) and isinstance(error.results, Table)
        rows = len(error.results)
        assert rows <= 40 and "unresolved" not in error.results["status"]
        assert error.results["status"].tolist() == whole["status"].tolist()[:rows]
        assert rows == 40 or ask == "closest-approach"
    assert told and told[-1][1] == 80 and [done for done, _ in told] == sorted(done for done, _ in told)


def test_ranges_are_those_found_by_then() -> None:
    # A box slides on a table, so it is undecided everywhere on the path whether the box keeps a distance of 0.
    slider = Joint.prismatic("slider", "table", "box", axis=[1, 0, 0])
    cell = Cell(Robot([slider], {"box": Body.box(0.1, 0.1, 0.1)}))
    cell.add_obstacle("floor", Body.box(5, 5, 0.1), ([5.5, 0, -0.2], [0, 0, 0, 1]))
    error = interrupted(lambda: cell.clearance_ranges([[0.0], [1.0]], resolution=1e-9))
    assert isinstance(error, InterruptError) and isinstance(error.results, list)
    ranges = [item for item in error.results if isinstance(item, PathRange)]
    assert ranges[0].start == 0 and ranges[-1].end == 1
    assert ranges[0].clearance == "kept" and ranges[-1].clearance == "unverified"


def test_proofs_are_those_made_by_then() -> None:
    told: list[tuple[int, int | None]] = []
    # Each segment has a proof of its own, and there are very many segments.
    path = np.linspace(0, 0.1, 500_000)[:, None]
    error = interrupted(lambda: CELL.prove(path, progress=lambda *now: told.append(now)), 1)
    assert isinstance(error, InterruptError) and isinstance(error.results, list)
    proofs = [proof for proof in error.results if isinstance(proof, Proof)]
    assert len(proofs) < len(path) - 1 and all(proof.check() == "holds" for proof in proofs[:3])
    assert told and told[-1][1] == len(path) - 1 and told[-1][0] <= len(proofs) + 1


def test_meshes_are_prepared_for_proofs_until_ctrl_c() -> None:
    large = Body(*knot(6000))
    cell = Cell(Robot([Joint.prismatic("slider", "base", "knot", axis=[1, 0, 0])], {"knot": large}))
    cell.add_obstacle("other", large, ([9, 0, 0], [0, 0, 0, 1]))
    calls: list[Callable[[], Any]] = [lambda: prove(large, large, Motion([9, 0, 0])), lambda: cell.prove([[0.0], [0.1]])]
    for call in calls:
        for seconds in (0.2, 0.5):
            error = interrupted(call, seconds, most_work=0.2)
            assert isinstance(error, InterruptError) and error.results in (None, [])


def test_tables_keep_what_is_answered() -> None:
    rows = 100_000
    columns = {"id": np.arange(rows), "a_px": np.full(rows, 3.3), "a_wx": np.full(rows, 6e5), "a_wy": np.full(rows, 6e5)}
    calls: list[Callable[[], Any]] = [
        lambda: first_contacts(KNOT, KNOT, columns, **HARD),
        lambda: TableQuery(KNOT, KNOT, **HARD)(columns),
    ]
    for call in calls:
        error = interrupted(call)
        assert isinstance(error, InterruptError) and isinstance(error.results, Table) and len(error.results) < rows


def write_obj(path: Path, vertices: Any, faces: Any) -> None:
    lines = [*(f"v {x} {y} {z}" for x, y, z in vertices), *(f"f {a} {b} {c}" for a, b, c in faces + 1)]
    path.write_text("\n".join(lines))


def test_what_reads_and_makes_meshes(tmp_path: Path) -> None:
    # The work continues after Ctrl-C, so later calls wait some seconds for the cores.
    vertices, faces = knot(1000)
    calls: list[Callable[[], Any]] = [lambda: Body(vertices, faces, pieces="patches")]
    write_obj(tmp_path / "knot.obj", vertices, faces)
    calls.append(lambda: Body.from_file(tmp_path / "knot.obj", pieces="patches"))
    write_obj(tmp_path / "long.obj", *knot(20_000))
    mesh = '<mesh filename="long.obj"/>'
    links = "".join(f'<link name="l{k}"><collision><geometry>{mesh}</geometry></collision></link>' for k in range(9))
    joints = "".join(f'<joint name="j{k}" type="fixed"><parent link="l0"/><child link="l{k}"/></joint>' for k in range(1, 9))
    (tmp_path / "r.urdf").write_text(f'<robot name="r">{links}{joints}</robot>')
    calls.append(lambda: Robot.from_urdf(tmp_path / "r.urdf"))
    for call in calls:
        error = interrupted(call, 0.1)
        assert type(error) is KeyboardInterrupt


def test_progress_is_told_of_all_that_is_done() -> None:
    start, end = np.zeros((500, 1)), np.full((500, 1), 0.01)
    told: list[tuple[int, int | None]] = []
    CELL.answer_edges(start, end, progress=lambda *now: told.append(now))
    assert told[-1] == (500, 500)
    CELL.answer_paths(np.stack([start, end], 1), progress=lambda *now: told.append(now))
    CELL.prove([[0.0], [0.01], [0.02]], progress=lambda *now: told.append(now))
    assert told[-1] == (2, 2)
    CELL.prove([[0]], progress=lambda *now: told.append(now))
    assert told[-1] == (1, 1)

    class Bar:
        shown = 0

        def update(self, more: float | None = 1) -> None:
            self.shown += int(more or 0)

    bar = Bar()
    CELL.answer_edges(start, end, progress=bar)
    assert bar.shown == 500
    CELL.answer_edges(start, end, progress=True)
    for wrong in (3, "yes", [1]):
        uses: list[Callable[[Any], Any]] = [
            lambda wrong: CELL.answer_edges(start, end, progress=wrong),
            lambda wrong: CELL.prove([[0], [1]], progress=wrong),
            lambda wrong: first_contacts(KNOT, KNOT, {"a_px": [9]}, progress=wrong),
        ]
        for use in uses:
            with pytest.raises(TypeError, match="progress: a function, a bar of tqdm or True is needed"):
                use(wrong)


def test_what_progress_raises_comes_out_with_what_is_done() -> None:
    def fails(_done: int, _total: int | None) -> None:
        raise ZeroDivisionError("mine")

    with pytest.raises(ZeroDivisionError, match="mine") as caught:
        CELL.answer_edges(STARTS, ENDS, progress=fails, **HARD)
    results: Any = getattr(caught.value, "results", None)
    assert isinstance(results, Table) and len(results) <= 40


def test_an_exception_of_an_interrupt_is_pickled() -> None:
    error = interrupted(lambda: CELL.closest_approach(LONG, **HARD))
    again = pickle.loads(pickle.dumps(error))
    assert isinstance(again, InterruptError) and again.upper == error.upper  # type: ignore[attr-defined]


def test_questions_go_on_after_an_interrupt() -> None:
    known = repr(CELL.first_contact([[0], [3]]))
    for _ in range(3):
        interrupted(lambda: CELL.answer_edges(STARTS, ENDS, "first-contact", **HARD), 0.1)
        assert repr(CELL.first_contact([[0], [3]])) == known


def test_a_short_check_of_a_proof_is_not_interrupted() -> None:
    proof = prove(Body.sphere(0.5), Body.box(0.1, 5, 5), Motion([-3, 0, 0], velocity=[4, 0, 0]))
    assert check_proof(proof.proof, proof.meshes) == "holds"
    with pytest.raises((InputError, TypeError)):
        check_proof("no bytes", proof.meshes)  # type: ignore[arg-type]
