"""Questions that go to other processes."""

import multiprocessing
import os
import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from test_tables import BALL, WALL, knot, same, shots

from rigid_ccd import Body, InputError, Table, TableQuery, first_contacts

COLUMNS = shots(60)


def expected(a: Body = BALL, b: Body = WALL) -> Table:
    return first_contacts(a, b, COLUMNS, micros=False)


@pytest.mark.parametrize("body", [BALL, Body.box(1, 2, 3), Body.capsule(0.1, 2), knot(60)])
def test_bodies_are_pickled_with_the_same_answers(body: Body) -> None:
    again = pickle.loads(pickle.dumps(body))
    assert (again.report, again.is_solid, again.pieces) == (body.report, body.is_solid, body.pieces)
    same(expected(again), expected(body))


def test_bodies_are_saved_with_the_same_answers(tmp_path: Path) -> None:
    for body in (knot(60), Body.box(1, 2, 3)):
        body.save(tmp_path / "body.ccd")
        same(expected(Body.from_file(tmp_path / "body.ccd")), expected(body))
    with pytest.raises(OSError):
        BALL.save(tmp_path / "nowhere" / "body.ccd")
    with pytest.raises(InputError):
        Body._from_bytes(b"no body")


def test_other_processes_have_the_same_answers() -> None:
    query = TableQuery(knot(60), WALL)
    # Forked processes would share this one's threads.
    with multiprocessing.get_context("spawn").Pool(2) as pool:
        for found in pool.map(query, [COLUMNS] * 4):
            same(found, expected(knot(60)))


def test_results_are_of_the_kind_of_the_motions() -> None:
    query = TableQuery(BALL, WALL)
    found = query(COLUMNS)
    assert isinstance(found, dict)
    same(found, expected())
    pyarrow, polars, pandas = (pytest.importorskip(name) for name in ("pyarrow", "polars", "pandas"))
    table = pyarrow.table(COLUMNS)
    for motions, kind in (
        (table, pyarrow.Table),
        (table.to_batches()[0], pyarrow.RecordBatch),
        (polars.DataFrame(COLUMNS), polars.DataFrame),
        (pandas.DataFrame(COLUMNS), pandas.DataFrame),
        (Table(COLUMNS), Table),
    ):
        found = query(motions)
        assert type(found) is kind
        assert pyarrow.table(found).select(["id", "status", "time"]).equals(
            pyarrow.table(expected()).select(["id", "status", "time"]).cast(pyarrow.table(found).select(["id", "status", "time"]).schema)
        )


def test_an_iterator_of_tables_gives_an_iterator_of_tables() -> None:
    pyarrow = pytest.importorskip("pyarrow")
    parts = pyarrow.table(COLUMNS).to_batches(max_chunksize=13)
    found = TableQuery(BALL, WALL)(iter(parts))
    same(Table(pyarrow.Table.from_batches(found)), expected())


def test_the_schema_is_known_without_an_answer() -> None:
    pyarrow = pytest.importorskip("pyarrow")
    for ask in ("first-contact", "is-free", "contact-interval", "closest-approach", "distance"):
        query: Any = TableQuery(BALL, WALL, ask=ask)  # type: ignore[arg-type]
        table = pyarrow.table(COLUMNS)
        assert pyarrow.schema(query.schema(table)) == query(table).schema


def test_files_are_loaded_once_in_a_process(tmp_path: Path) -> None:
    path = tmp_path / "ball.ccd"
    BALL.save(path)
    query = TableQuery(path, WALL)
    same(query(COLUMNS), expected())
    time = os.stat(path).st_mtime_ns
    path.write_bytes(b"no body")
    os.utime(path, ns=(time, time))
    same(query(COLUMNS), expected())
    os.utime(path, ns=(time, time + 1))
    with pytest.raises(InputError):
        query(COLUMNS)


def test_questions_that_cannot_be_asked_are_refused_at_once() -> None:
    with pytest.raises(InputError, match="ask"):
        TableQuery(BALL, WALL, ask="when")  # type: ignore[arg-type]
    with pytest.raises(InputError, match="tolerance"):
        TableQuery(BALL, WALL, tolerance=0)
    with pytest.raises(TypeError, match="speed"):
        TableQuery(BALL, WALL, speed=1)


def test_reprs() -> None:
    assert "first-contact" in repr(TableQuery(BALL, WALL)) and "micros=False" in repr(TableQuery(BALL, WALL))
    assert np.all(expected()["iterations"] >= 0)
