"""Questions that are pickled and answered in other processes."""

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
    assert (again.report, again.is_solid, again.piece_count) == (body.report, body.is_solid, body.piece_count)
    same(expected(again), expected(body))


def test_tables_are_pickled() -> None:
    pyarrow = pytest.importorskip("pyarrow")
    names = pyarrow.array(["a", None, "b"] * 20).dictionary_encode()
    some = pyarrow.table({**COLUMNS, "id": names})
    for table in (expected(), expected().take([]), first_contacts(BALL, WALL, some), Table(some)):
        assert pyarrow.table(pickle.loads(pickle.dumps(table))).equals(pyarrow.table(table))
    with pytest.raises(InputError):
        Table._from_bytes(b"no table", 0)


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
    # Forked processes would inherit the state of this one's threads.
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
    pyarrow, polars, pandas = (pytest.importorskip(name) for name in ("pyarrow", "polars", "pandas"))
    for ask in ("first-contact", "is-free", "contact-interval", "closest-approach", "distance"):
        query: Any = TableQuery("nowhere.ccd", "nowhere.ccd", question=ask)
        other: Any = TableQuery(BALL, WALL, question=ask)
        table = pyarrow.table(COLUMNS)
        assert query.schema(table.schema) == query.schema(table).schema == other(table).schema
        frame = polars.DataFrame(COLUMNS)
        assert query.schema(frame).schema == other(frame).schema
        frames = pandas.DataFrame(COLUMNS)
        assert query.schema(frames).dtypes.equals(other(frames).dtypes)
        assert pyarrow.schema(query.schema(Table(COLUMNS))) == query.schema(table.schema)


def test_parts_of_a_pandas_frame_fit_together() -> None:
    pandas = pytest.importorskip("pandas")
    query = TableQuery(BALL, WALL)
    frame = pandas.DataFrame({"id": [2**60 + k for k in range(6)], "a_px": [-3, -3, np.inf, -3, np.inf, -3]})
    frame["a_vx"] = [1.0, 4, 1, 4, 1, 1]
    found = query(frame)
    assert found["id"].tolist() == frame["id"].tolist()
    assert found["status"].tolist() == ["free", "contact", "error", "contact", "error", "free"]
    # Groups of rows that are not consecutive: without contacts, with contacts only, with errors only.
    for rows in ([0, 5], [1, 3], [2, 4], []):
        part = query(frame.loc[rows])
        pandas.testing.assert_frame_equal(part, found.loc[rows])
        named = query(frame.loc[rows].set_index("id"))
        pandas.testing.assert_frame_equal(named, found.loc[rows].set_index("id"))


def test_paths_of_a_pandas_frame_have_their_ids() -> None:
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame({"id": ["x", "x", "y"], "t": [0.0, 1, 0], "a_px": [-3.0, 3, 9]}, index=[4, 5, 7])
    query = TableQuery(BALL, WALL, paths="whole")
    assert query(frame)["id"].tolist() == ["x", "y"] == query(frame.set_index("id")).index.tolist()


def test_what_engines_would_tear_apart_is_refused() -> None:
    query = TableQuery(BALL, WALL)
    starts = {"a_px": [-3.0, 3.0]}
    for refused, message in ((starts, "no column `id`"), ({"id": ["x", "x"], "t": [0, 1], **starts}, "paths='whole'")):
        for ask in (query, query.schema):
            with pytest.raises(InputError, match=message):
                ask(refused)
        with pytest.raises(InputError, match=message):
            next(query(iter([refused])))
    assert TableQuery(BALL, WALL, paths="whole")(refused)["status"].tolist() == ["contact"]
    with pytest.raises(InputError, match="paths"):
        TableQuery(BALL, WALL, paths="cut")  # type: ignore[arg-type]


def test_a_process_unpickles_a_body_once() -> None:
    query = TableQuery(knot(60), WALL)
    once, again = (pickle.loads(pickle.dumps(query)) for _ in range(2))
    assert once._a is again._a is not query._a
    same(again(COLUMNS), expected(knot(60)))


def test_files_are_loaded_once_in_a_process(tmp_path: Path) -> None:
    path = tmp_path / "ball.ccd"
    BALL.save(path)
    query = TableQuery(path, WALL)
    same(query(COLUMNS), expected())
    time = os.stat(path).st_mtime_ns
    path.write_bytes(b"x" * os.stat(path).st_size)
    os.utime(path, ns=(time, time))
    same(query(COLUMNS), expected())
    os.utime(path, ns=(time, time + 1))
    with pytest.raises(InputError):
        query(COLUMNS)


def test_questions_that_cannot_be_asked_are_refused_at_once() -> None:
    with pytest.raises(InputError, match="question"):
        TableQuery(BALL, WALL, question="when")  # type: ignore[arg-type]
    with pytest.raises(InputError, match="tolerance"):
        TableQuery("nowhere.ccd", WALL, tolerance=0)
    with pytest.raises(TypeError, match="speed"):
        TableQuery(BALL, WALL, speed=1)


def test_reprs() -> None:
    assert "first-contact" in repr(TableQuery(BALL, WALL)) and "micros=False" in repr(TableQuery(BALL, WALL))
    assert np.all(expected()["iterations"] >= 0)
