"""Tables of motions, of all kinds, compared with single queries."""

import math
import os
import signal
import threading
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from rigid_ccd import (
    Body,
    Cell,
    InputError,
    InterruptError,
    Joint,
    Motion,
    Robot,
    Table,
    TableQuery,
    are_free,
    closest_approaches,
    contact_intervals,
    distance,
    distances,
    first_contact,
    first_contacts,
)
from rigid_ccd._settings import ContactsOfTables, DistancesOfTables, OfContacts, OfDistances

BALL = Body.sphere(0.5)
WALL = Body.box(0.1, 5, 5)
COLUMNS = (
    "id status time distance_lower distance_upper normal_x normal_y normal_z witness_a_x witness_a_y witness_a_z "
    "witness_b_x witness_b_y witness_b_z feature_a feature_b iterations oracle_calls micros reason"
).split()


def shots(rows: int) -> dict[str, NDArray[Any]]:
    """Returns motions of balls from all sides. About half of them hit."""
    random = np.random.default_rng(1)
    return {
        "id": np.array([f"shot {k}" for k in range(rows)]),
        "a_px": np.full(rows, -3.0),
        "a_vx": random.uniform(1, 4, rows),
        "a_wy": random.uniform(-9, 9, rows),
        "b_vy": random.uniform(-1, 1, rows),
    }


def as_pyarrow(columns: Any) -> Any:
    return pytest.importorskip("pyarrow").table(columns)


def as_chunks(columns: Any) -> Any:
    pyarrow = pytest.importorskip("pyarrow")
    return pyarrow.concat_tables([pyarrow.table(columns).slice(k, 7) for k in range(0, len(columns["id"]), 7)])


def as_reader(columns: Any) -> Any:
    return as_chunks(columns).to_reader()


def as_batch(columns: Any) -> Any:
    return pytest.importorskip("pyarrow").record_batch(columns)


def as_polars(columns: Any) -> Any:
    return pytest.importorskip("polars").DataFrame(columns)


def as_pandas(columns: Any) -> Any:
    return pytest.importorskip("pandas").DataFrame(columns)


def as_duckdb(columns: Any) -> Any:
    arrows = as_pyarrow(columns)  # noqa: F841
    return pytest.importorskip("duckdb").sql("select * from arrows")


KINDS = [dict, Table, as_pyarrow, as_chunks, as_reader, as_batch, as_polars, as_pandas, as_duckdb]


@pytest.mark.parametrize("kind", KINDS)
def test_rows_have_the_answers_of_single_queries(kind: Callable[[Any], Any]) -> None:
    columns = shots(100)
    found = first_contacts(BALL, WALL, kind(columns))
    assert found.column_names == COLUMNS and len(found) == 100
    assert found["id"].tolist() == columns["id"].tolist()
    hits = 0
    for k in range(100):
        flies = Motion([-3, 0, 0], velocity=[columns["a_vx"][k], 0, 0], angular_velocity=[0, columns["a_wy"][k], 0])
        hit = first_contact(BALL, WALL, flies, Motion(velocity=[0, columns["b_vy"][k], 0]))
        hits += hit is not None
        assert found["status"][k] == (hit.kind if hit else "free")
        assert found["time"][k] == (hit.time if hit else 1)
        if hit:
            assert hit.distance == (found["distance_lower"][k], found["distance_upper"][k])
            assert hit.witness_b == tuple(found[f"witness_b_{axis}"][k] for axis in "xyz")
    assert 30 < hits < 70
    assert repr(found) == f"Table(100 rows, 20 columns, {counts(found)})"


def counts(found: Table) -> str:
    names, firsts, number = np.unique(found["status"].astype(str), return_index=True, return_counts=True)
    return ", ".join(f"{number[k]} {names[k]}" for k in np.argsort(firsts))


def test_results_are_the_same_on_any_number_of_threads() -> None:
    columns = shots(500)
    one = first_contacts(BALL, WALL, columns, threads=1, micros=False)
    for threads in (2, 3, 16, None):
        same(first_contacts(BALL, WALL, columns, threads=threads, micros=False), one)
    with ThreadPoolExecutor(4) as pool:
        for found in pool.map(lambda _: first_contacts(BALL, WALL, columns, micros=False), range(8)):
            same(found, one)


def same(found: Table | dict[str, Any], other: Table) -> None:
    for name in other:
        assert np.array_equal(found[name], other[name], equal_nan=found[name].dtype == float), name


@pytest.mark.parametrize("dtype", ["int8", "int64", "float32", ">f8", "float16"])
def test_numbers_of_any_kind_are_taken(dtype: str) -> None:
    columns = {"a_px": np.array([-3, -2], dtype), "a_vx": np.array([4, 1], dtype)}
    expected = first_contacts(BALL, WALL, {"a_px": [-3.0, -2.0], "a_vx": [4.0, 1.0]}, micros=False)
    same(first_contacts(BALL, WALL, columns, micros=False), expected)
    if dtype not in (">f8", "float16"):
        same(first_contacts(BALL, WALL, as_pyarrow(columns), micros=False), expected)
    wide = np.zeros((4, 3), dtype)
    wide[::2, 1] = [-3, -2]
    columns["a_px"] = wide[::2, 1]
    same(first_contacts(BALL, WALL, columns, micros=False), expected)


def test_a_pandas_frame_may_be_filtered() -> None:
    pandas = pytest.importorskip("pandas")
    columns = shots(50)
    whole = first_contacts(BALL, WALL, columns, micros=False)
    frame = pandas.DataFrame(columns)
    kept = np.flatnonzero(frame["a_vx"] > 2)
    assert 10 < len(kept) < 50
    for some in (frame[frame["a_vx"] > 2], frame.iloc[kept].set_index("id")):
        same(first_contacts(BALL, WALL, some, micros=False), whole.take(kept))
    with pytest.raises(InputError, match="unknown column `shot`"):
        first_contacts(BALL, WALL, frame.rename_axis("shot"))


def a_frame(columns: Any) -> Any:
    """A subclass of the pandas frame."""

    class Frame(as_pandas({}).__class__):  # type: ignore[misc]
        pass

    return Frame(columns)


@pytest.mark.parametrize("dtype", ["float64", "float32", "float16", "Float64", "double[pyarrow]", "object"])
@pytest.mark.parametrize("kind", [as_pandas, a_frame])
def test_no_missing_cell_of_pandas_passes_for_a_default(dtype: str, kind: Callable[[Any], Any]) -> None:
    frame = kind({"id": [1.5, None], "a_px": [-3.0, -3.0], "a_vx": [4.0, math.nan]})
    frame = frame.astype({"a_vx": dtype})
    found = first_contacts(BALL, WALL, frame)
    assert found["status"].tolist() == ["contact", "error"]
    assert found["reason"][1] == "column a_vx: no value, and an empty cell has no default"
    assert as_pyarrow(found)["id"].to_pylist() == [1.5, None]
    query = TableQuery(BALL, WALL)(frame)
    assert query["status"].tolist() == ["contact", "error"]


@pytest.mark.parametrize("cells", [[4, math.nan], [4, None], [math.nan, math.nan]])
def test_missing_cells_of_objects_of_pandas_are_errors(cells: list[Any]) -> None:
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame({"a_px": [-3.0, -3.0], "a_vx": pandas.Series(cells, dtype=object)})
    found = first_contacts(BALL, WALL, frame)
    assert found["status"].tolist() == ["contact" if cell == 4 else "error" for cell in cells]
    assert found["reason"][1].startswith("column a_vx: ")


def test_rows_of_a_frame_give_velocities_or_an_end_pose() -> None:
    nan = math.nan
    frame = as_pandas(
        {"a_px": [-3.0] * 4, "a_vx": [4, nan, nan, 4], "a_end_px": [nan, 1, nan, 1]}
        | {f"a_end_p{axis}": [nan, 0, nan, 0] for axis in "yz"}
    )
    found = first_contacts(BALL, WALL, frame)
    assert found["status"].tolist() == ["contact", "contact", "error", "error"]
    assert "no value" in found["reason"][2] and "either" in found["reason"][3]


def test_rows_of_a_path_need_names_that_can_be_told_apart() -> None:
    pyarrow = pytest.importorskip("pyarrow")
    poses = {"t": [0.0, 1.0], "a_px": [-3.0, 3.0]}
    found = first_contacts(BALL, WALL, pyarrow.table({"id": pyarrow.nulls(2), **poses}))
    assert set(found["status"]) == {"error"}
    for ids in (
        pyarrow.array([["a, b"], ["a", "b"]]),
        pyarrow.array([{"a": None}, {"a": ""}]),
        pyarrow.array([(1, 2, 3), (1, 2, 3)], pyarrow.month_day_nano_interval()),
    ):
        with pytest.raises(InputError, match="column id: text, numbers or times are needed"):
            first_contacts(BALL, WALL, pyarrow.table({"id": ids, **poses}))


def test_a_batch_that_does_not_fit_its_stream_ends_it() -> None:
    pyarrow = pytest.importorskip("pyarrow")
    good = pyarrow.record_batch({"a_px": [-3.0] * 4, "a_vx": [4.0] * 4})
    bad = pyarrow.record_batch({"a_px": [1.0]})
    reader = pyarrow.RecordBatchReader.from_batches(good.schema, iter([good, bad]))
    with pytest.raises(InputError, match="does not fit the schema") as error:
        first_contacts(BALL, WALL, reader)
    assert error.value.results is not None
    assert error.value.results["status"].tolist() == ["contact"] * 4


def test_a_released_array_is_refused() -> None:
    pyarrow = pytest.importorskip("pyarrow")
    batch = pyarrow.record_batch({"a_px": np.full(20_000, -3.0), "a_vx": np.full(20_000, 4.0)})

    class Used:
        def __arrow_c_array__(self, _schema: object = None) -> Any:
            capsules = batch.__arrow_c_array__()
            pyarrow.RecordBatch._import_from_c_capsule(*capsules)
            return capsules

    class Kept:
        capsules = batch.__arrow_c_array__()

        def __arrow_c_array__(self, _schema: object = None) -> Any:
            return self.capsules

    with pytest.raises(InputError, match="already released"):
        first_contacts(BALL, WALL, Used())
    kept = Kept()
    assert len(first_contacts(BALL, WALL, kept)) == 20_000
    with pytest.raises(InputError, match="already released"):
        first_contacts(BALL, WALL, kept)


def test_chunks_may_have_dictionaries_of_their_own() -> None:
    pyarrow = pytest.importorskip("pyarrow")
    of = pyarrow.dictionary(pyarrow.int8(), pyarrow.string())
    chunks = [pyarrow.array([f"{k} {row}" for row in range(100)]).cast(of) for k in range(2)]
    ids = pyarrow.chunked_array(chunks)
    table = pyarrow.table({"id": ids, "a_px": [-3.0] * 200, "a_vx": [1.0] * 200})
    assert set(first_contacts(BALL, WALL, table)["status"]) == {"free"}
    assert len(TableQuery(BALL, WALL)(table)) == 200
    of_paths = pyarrow.table({"id": ids, "t": [0.0] * 200, "a_px": [-3.0] * 200})
    assert as_pyarrow(first_contacts(BALL, WALL, of_paths))["id"].to_pylist() == ids.to_pylist()


def test_decimals_are_the_nearest_numbers() -> None:
    pyarrow = pytest.importorskip("pyarrow")
    decimal = pytest.importorskip("decimal")
    random = np.random.default_rng(5)
    texts = [f"{speed:.17f}" for speed in random.uniform(3, 4, 300)]
    speeds = pyarrow.array([decimal.Decimal(text) for text in texts], pyarrow.decimal128(38, 17))
    expected = {"a_px": [-3.0] * 300, "a_vx": [float(text) for text in texts]}
    found = first_contacts(BALL, WALL, pyarrow.table({**expected, "a_vx": speeds}), micros=False)
    same(found, first_contacts(BALL, WALL, expected, micros=False))


def test_a_table_is_no_array() -> None:
    found = first_contacts(BALL, WALL, shots(3))
    for make in (np.asarray, pytest.importorskip("pandas").DataFrame):
        with pytest.raises(TypeError, match="from_arrow"):
            make(found)


def test_an_index_of_pandas_is_named_as_such() -> None:
    frame = as_pandas(shots(3)).iloc[[2, 0, 1]]
    with pytest.raises(InputError, match="index=False"):
        first_contacts(BALL, WALL, pytest.importorskip("pyarrow").Table.from_pandas(frame))


def test_ids_come_back_as_they_are() -> None:
    pyarrow = pytest.importorskip("pyarrow")
    start = {"a_px": [-3.0, -3.0]}
    for ids in (np.array([7, 9], "uint16"), [2**53 + 1, 2**53 + 2], np.array([2**63 + 1, 2**63 + 3], "uint64")):
        assert first_contacts(BALL, WALL, {"id": ids, **start})["id"].tolist() == list(ids)
    for texts in (["x", "1"], ["x", None], ["x", "a\0"], np.array(["x", "y"]), np.array(["x", None], object)):
        assert first_contacts(BALL, WALL, {"id": texts, **start})["id"].tolist() == list(texts)
    assert first_contacts(BALL, WALL, start)["id"].tolist() == [0, 1]
    for ids in (
        pyarrow.array(["x", None]),
        pyarrow.array([3, 4], pyarrow.int16()),
        pyarrow.array([2**53 + 1, None]),
        pyarrow.array([b"\xff", b"y"]),
        pyarrow.array([[1, 2], [3]]),
        pyarrow.array([{"x": 1}, {"x": 2}]),
        pyarrow.array(["x", "y"], pyarrow.string_view()),
    ):
        found = first_contacts(BALL, WALL, pyarrow.table({"id": ids, **start}))
        table = pyarrow.table(found)
        assert table.schema.field("id").type == ids.type
        assert table["id"].to_pylist() == ids.to_pylist() == [plain(id) for id in found["id"]]
    # The dictionaries of parts together may be too large for one dictionary.
    names = [f"n{k}" for k in range(300)]
    parts = [pyarrow.array(names[k : k + 50]).cast(pyarrow.dictionary(pyarrow.int8(), pyarrow.string())) for k in range(0, 300, 50)]
    chunks = pyarrow.concat_tables([pyarrow.table({"id": part, "a_px": np.full(50, -3.0)}) for part in parts])
    assert first_contacts(BALL, WALL, chunks)["id"].tolist() == names


def plain(value: Any) -> Any:
    return value.item() if isinstance(value, np.generic) else value


@pytest.mark.parametrize("ids", [["1", 1], [1.0, 2.0], [True, False], [(1,), (2,)], [2**64, 1], [2**63, -1]])
def test_ids_that_might_become_equal_are_refused(ids: list[Any]) -> None:
    with pytest.raises((InputError, TypeError), match="column id"):
        first_contacts(BALL, WALL, {"id": ids, "a_px": [-3.0, -3.0]})


def test_numbers_that_float64_cannot_hold_are_bad_rows() -> None:
    pyarrow = pytest.importorskip("pyarrow")
    times = [2**60 + 129, 2**60 + 10**9]
    for motions in (
        {"t": np.array(times), "a_px": np.zeros(2)},
        {"t": np.array(times, "uint64"), "a_px": np.zeros(2)},
        pyarrow.table({"t": times, "a_px": [0.0, 0.0]}),
    ):
        found = first_contacts(BALL, WALL, motions)
        assert found["status"].tolist() == ["error"] and "1152921504606847105" in found["reason"][0]
    # Powers of two are exact, and times since the first one are small.
    assert first_contacts(BALL, WALL, {"t": [2**60, 2**61], "a_px": [0.0, 0]})["status"].tolist() == ["overlapping"]


def test_masked_values_are_refused() -> None:
    masked = np.ma.masked_array([-3.0, 0, -3], mask=[False, True, False])
    with pytest.raises(InputError, match="column a_px: some values are masked"):
        first_contacts(BALL, WALL, {"a_px": masked})
    with pytest.raises(InputError, match="position: some values are masked"):
        Motion(masked)
    assert len(first_contacts(BALL, WALL, {"a_px": np.ma.masked_array([-3.0])})) == 1


def test_a_stream_that_fails_leaves_what_is_done() -> None:
    pyarrow = pytest.importorskip("pyarrow")
    table = pyarrow.table(shots(50))

    def batches() -> Any:
        yield from table.to_batches(max_chunksize=10)
        raise RuntimeError("the disk is gone")

    reader = pyarrow.RecordBatchReader.from_batches(table.schema, batches())
    with pytest.raises(InputError, match="the disk is gone") as error:
        first_contacts(BALL, WALL, reader, micros=False)
    assert error.value.results is not None
    same(error.value.results, first_contacts(BALL, WALL, table, micros=False))


def test_bad_rows_are_rows() -> None:
    columns = {
        "a_px": [-3, math.nan, -3, -3, -3],
        "a_vx": [4.0, 4, math.inf, 4, 4],
        "duration": [1.0, 1, 1, -1, 1],
        "a_qw": [1.0, 1, 1, 1, 0],
        "a_qx": [0.0] * 5,
        "a_qy": [0.0] * 5,
        "a_qz": [0.0] * 5,
    }
    found = first_contacts(BALL, WALL, columns)
    assert found["status"].tolist() == ["contact"] + 4 * ["error"]
    assert np.isnan(found["time"][1:]).all()
    reasons = found["reason"]
    for row, words in ((1, "column a_px: `NaN`"), (2, "column a_vx: `inf`"), (3, "duration"), (4, "zero quaternion")):
        assert words in reasons[row]
    assert reasons[0] is None


def test_null_cells_are_errors() -> None:
    table = as_pyarrow({"a_px": [-3.0, -3.0, -3.0], "a_vx": [4.0, 4.0, None], "duration": [2.0, None, 2.0]})
    found = first_contacts(BALL, WALL, table)
    assert found["status"].tolist() == ["contact", "error", "error"]
    assert [reason.split(":")[0] for reason in found["reason"][1:]] == ["column duration", "column a_vx"]


@pytest.mark.parametrize(
    ("columns", "message"),
    [
        ({"a_x": [1.0]}, "unknown column `a_x`; did you mean `a_px`"),
        ({"time": [1.0]}, "unknown column `time`; did you mean `t`?"),
        ({"a_qw": [1.0], "a_qx": [0.0]}, "no column `a_qy`, but column `a_qw` needs it"),
        ({"a_end_px": [1.0]}, "no column `a_end_py`"),
        ({"t": [0.0], "a_vx": [1.0]}, "unknown column `a_vx`; a table with a column t"),
        ({}, "there is no column"),
        ({"a_px": [1.0], "a_py": [1.0, 2.0]}, "column a_py: has 2 rows, but the first column has 1"),
        ({"a_px": ["x"]}, "column a_px: numbers are needed, not"),
        ({"a_px": [True]}, "column a_px: numbers are needed, not bool"),
        ({"a_px": [1 + 2j]}, "column a_px: numbers are needed"),
        ({"a_px": [[1.0]]}, "column a_px: an array of one dimension is needed, not of 2"),
        ({"a_px": 1.0}, "column a_px: an array of one dimension is needed, not of 0"),
        ({"id": np.zeros((2, 2), int)}, "column id: an array of one dimension is needed, not of 2"),
        ({"a_px": [None]}, "column a_px: numbers are needed, not object"),
    ],
)
def test_bad_columns_are_one_clear_error(columns: dict[str, Any], message: str) -> None:
    with pytest.raises(InputError) as error:
        first_contacts(BALL, WALL, columns)
    assert message in str(error.value)


def test_arrow_columns_of_other_types_are_refused() -> None:
    pyarrow = pytest.importorskip("pyarrow")
    for column in (["x"], [True], [[1.0]], [b"x"]):
        with pytest.raises(InputError, match="column a_px: numbers are needed"):
            first_contacts(BALL, WALL, pyarrow.table({"a_px": column}))
    nothing = pyarrow.table({"a_px": pyarrow.nulls(2), "a_vx": [9.0, 1.0]})
    assert first_contacts(BALL, WALL, nothing)["status"].tolist() == ["error"] * 2


def test_what_is_no_table_is_refused() -> None:
    for wrong in (None, 1, "motions.csv", [1, 2], np.zeros(3)):
        with pytest.raises(TypeError, match="motions: an Arrow table"):
            first_contacts(BALL, WALL, wrong)
    with pytest.raises(TypeError):
        first_contacts(BALL, "wall", {"a_px": [1.0]})  # type: ignore[arg-type]


def test_bad_settings_are_refused_at_once() -> None:
    wrong: dict[str, Any]
    settings: list[dict[str, Any]] = [
        {"tolerance": 0},
        {"tolerance": math.nan},
        {"margin": -1},
        {"deadline": -1},
        {"deadline": math.nan},
    ]
    for wrong in settings:
        with pytest.raises(InputError):
            first_contacts(BALL, WALL, shots(3), **wrong)
    wrongs: list[dict[str, Any]] = [{"threads": 0}, {"threads": -1}, {"threads": 10**9}, {"budget": -1}]
    for wrong in wrongs:
        with pytest.raises(InputError, match=next(iter(wrong))):
            first_contacts(BALL, WALL, shots(3), **wrong)
    for wrong in ({"tolerance": None}, {"margin": "x"}, {"budget": 0.5}, {"deadline": []}):
        with pytest.raises(TypeError, match=next(iter(wrong))):
            first_contacts(BALL, WALL, shots(3), **wrong)
    wrongs = [{"clearance": math.nan}, {"clearance": -1.0}]
    for wrong in wrongs:
        with pytest.raises(InputError, match="clearance"):
            distances(BALL, WALL, shots(3), **wrong)
    for progress in (5, "x"):
        with pytest.raises(TypeError, match="progress"):
            first_contacts(BALL, WALL, shots(3), progress=progress)  # type: ignore[arg-type]
    assert len(first_contacts(BALL, WALL, shots(3), deadline=math.inf)) == 3
    with pytest.raises(TypeError, match="speed"):
        first_contacts(BALL, WALL, shots(3), speed=1)  # type: ignore[call-arg]
    with pytest.raises(TypeError, match="clearance"):
        first_contact(BALL, WALL, clearance=1)  # type: ignore[call-arg]


@pytest.mark.parametrize(
    ("ask", "known"),
    [
        (lambda **unknown: first_contact(BALL, WALL, **unknown), OfContacts),
        (lambda **unknown: distance(BALL, WALL, **unknown), OfDistances),
        (lambda **unknown: first_contacts(BALL, WALL, shots(3), **unknown), ContactsOfTables),
        (lambda **unknown: distances(BALL, WALL, shots(3), **unknown), DistancesOfTables),
    ],
)
def test_an_unknown_setting_is_told_the_known_ones(ask: Callable[..., object], known: Any) -> None:
    with pytest.raises(TypeError, match="unexpected keyword argument 'speed'") as error:
        ask(speed=1)
    assert set(str(error.value).partition("settings are ")[2].split(", ")) == known.__optional_keys__


def test_tables_without_rows_have_columns() -> None:
    found = first_contacts(BALL, WALL, {"a_px": np.zeros(0)})
    assert len(found) == 0 and found.column_names == COLUMNS
    assert found["time"].dtype == float and found["iterations"].dtype == int
    assert len(first_contacts(BALL, WALL, as_pyarrow({"id": np.zeros(0, str)}))) == 0


def test_a_budget_leaves_rows_unresolved() -> None:
    rods = Body.capsule(0.01, 2)
    columns = {"a_px": [-3.0], "a_vx": [4.0], "a_wx": [300.0], "a_wy": [200.0], "a_wz": [100.0]}
    found = first_contacts(rods, rods, columns, tolerance=1e-9, budget=1)
    assert found["status"].tolist() == ["unresolved"]
    assert 0 <= found["time"][0] <= 1 and "budget" in found["reason"][0]


def test_other_questions() -> None:
    columns = {"a_px": [-3.0, -3.0], "a_vx": [1.0, 9.0]}
    assert are_free(BALL, WALL, columns)["status"].tolist() == ["free", "contact"]
    interval = contact_intervals(BALL, WALL, columns)
    assert interval.column_names == [*COLUMNS, "last_time"]
    assert interval["time"][1] == pytest.approx(2.4 / 9, abs=1e-3)
    assert interval["last_time"][1] == pytest.approx(3.6 / 9, abs=1e-3)
    nearest = closest_approaches(BALL, WALL, columns, clearance=1.0)
    assert nearest["status"].tolist() == ["kept", "violated"]
    # The search ends as soon as the clearance is proven.
    assert 1.0 <= nearest["distance_lower"][0] <= 1.4
    measured = closest_approaches(BALL, WALL, columns)
    assert measured["distance_lower"][0] == pytest.approx(1.4, abs=1e-3)
    apart = distances(BALL, WALL, columns)
    assert apart["status"].tolist() == ["measured"] * 2
    assert apart["distance_upper"] == pytest.approx([2.4, 2.4])
    with pytest.raises(TypeError, match="clearance"):
        first_contacts(BALL, WALL, columns, clearance=1.0)  # type: ignore[call-arg]
    with pytest.raises(TypeError, match="margin"):
        distances(BALL, WALL, columns, margin=1.0)  # type: ignore[call-arg]


@pytest.mark.parametrize("kind", [dict, as_pyarrow, as_chunks])
def test_rows_with_a_time_are_poses_of_paths(kind: Callable[[Any], Any]) -> None:
    columns = {
        "id": np.array(["far", "far", "near", "near", "near"]),
        "t": np.array([0.0, 1, 0, 1, 2]),
        "a_px": np.array([-3.0, -2, -3, -2, 2]),
    }
    found = first_contacts(BALL, WALL, kind(columns))
    assert found["id"].tolist() == ["far", "near"]
    assert found["status"].tolist() == ["free", "contact"]
    # From -2 to 2 in a unit of time: the ball's front is at the wall after 1.4.
    assert found["time"][1] == pytest.approx(1 + 1.4 / 4, abs=1e-3)
    assert len(distances(BALL, WALL, kind(columns))) == 5
    columns["t"][1] = 0
    found = first_contacts(BALL, WALL, kind(columns))
    assert found["status"].tolist() == ["error", "contact"] and "not later" in found["reason"][0]


def test_results_go_everywhere_without_a_copy() -> None:
    pyarrow = pytest.importorskip("pyarrow")
    found = first_contacts(BALL, WALL, shots(50))
    column = found["time"]
    assert not column.flags.writeable and not column.flags.owndata
    table = pyarrow.table(found)
    assert table["time"].chunk(0).buffers()[1].address == column.ctypes.data
    assert table.column_names == COLUMNS and table["status"].null_count == 0
    assert as_polars(found).columns == COLUMNS
    assert pytest.importorskip("pandas").DataFrame.from_arrow(found).shape == (50, 20)
    assert pytest.importorskip("duckdb").sql("select count(*) from found").fetchall() == [(50,)]
    assert list(dict(found)) == COLUMNS == list(found) == found.keys()
    assert "time" in found and "times" not in found
    with pytest.raises(KeyError, match="no column .*; there are id, status"):
        found["times"]
    some = found.take([4, 2, 2])
    assert some["id"].tolist() == ["shot 4", "shot 2", "shot 2"]
    # A column outlives its table.
    del found, table
    assert np.isfinite(column).all()


def test_rows_are_taken_by_their_numbers() -> None:
    found = first_contacts(BALL, WALL, shots(50))
    assert found.take([4, 2, 2])["id"].tolist() == ["shot 4", "shot 2", "shot 2"]
    assert len(found.take([])) == 0 and len(found.take(np.arange(50)[::7])) == 8
    contacts = found["status"] == "contact"
    assert 0 < contacts.sum() < 50
    assert found.take(contacts)["id"].tolist() == found.take(np.flatnonzero(contacts))["id"].tolist()
    with pytest.raises(InputError, match=r"50 bool is needed, not one of shape \[49\]"):
        found.take(contacts[:49])
    for wrong in (50, -1, 2**62):
        with pytest.raises(InputError, match=f"row {wrong}: the table has 50 rows"):
            found.take([wrong])
    for rows in ([0.5], ["x"], range(10**15)):
        with pytest.raises(InputError):
            found.take(rows)
    nested = Table(pytest.importorskip("pyarrow").table({"id": [[1], [2]]}))
    with pytest.raises(InputError):
        nested.take([2])


def test_float64_columns_are_not_copied() -> None:
    column = np.linspace(-3, -2, 1_000_000)
    table = Table({"a_px": column})
    assert np.shares_memory(table["a_px"], column)


def test_progress_is_told() -> None:
    told: list[tuple[int, int | None]] = []
    columns = shots(2000)
    first_contacts(BALL, WALL, columns, progress=lambda done, rows: told.append((done, rows)))
    assert told[-1:] == [(2000, 2000)] and [done for done, _ in told] == sorted(done for done, _ in told)
    first_contacts(BALL, WALL, as_reader(columns), progress=lambda done, rows: told.append((done, rows)))
    assert told[-1:] == [(2000, None)]
    tqdm = pytest.importorskip("tqdm").tqdm
    with tqdm(total=2000, disable=None) as bar:
        bar.n = 0
        first_contacts(BALL, WALL, columns, progress=bar)
    first_contacts(BALL, WALL, columns, progress=True)


def test_an_exception_of_the_progress_ends_the_table() -> None:
    def fails(done: int, rows: int | None) -> None:
        raise ZeroDivisionError("told")

    with pytest.raises(ZeroDivisionError, match="told") as error:
        first_contacts(BALL, WALL, shots(10), progress=fails)
    assert isinstance(error.value.results, Table)  # type: ignore[attr-defined]


def knot(size: int) -> Body:
    """A torus knot, with enough triangles to keep a query busy."""
    around, along = np.meshgrid(np.arange(16) * math.tau / 16, np.arange(size) * math.tau / size)
    radius = 1 + 0.4 * np.cos(3 * along) + 0.15 * np.cos(around)
    place = np.stack(
        [
            radius * np.cos(2 * along),
            radius * np.sin(2 * along),
            0.4 * np.sin(3 * along) + 0.15 * np.sin(around),
        ],
        axis=-1,
    )
    corner = np.arange(16 * size).reshape(size, 16)
    a, b = corner, np.roll(corner, -1, 0)
    c, d = np.roll(b, -1, 1), np.roll(a, -1, 1)
    faces = np.concatenate([np.stack(f, -1).reshape(-1, 3) for f in ((a, b, c), (a, c, d))])
    return Body(place.reshape(-1, 3), faces)


@pytest.mark.parametrize("rows", [1, 100_000])
def test_ctrl_c_ends_a_table_with_what_is_done(rows: int) -> None:
    body = knot(600)
    random = np.random.default_rng(1)
    # The knot makes a hundred thousand turns, and barely misses each time: minutes of work.
    columns = {"a_px": random.uniform(3.2, 3.4, rows), "a_wx": np.full(rows, 6e5), "a_wy": np.full(rows, 6e5)}
    interrupt(0.5)
    with pytest.raises(InterruptError) as error:
        first_contacts(body, body, columns, tolerance=1e-9, budget=2**60)
    assert isinstance(error.value, KeyboardInterrupt)
    done = error.value.results
    assert done is not None
    assert len(done) < rows and "unresolved" not in done["status"]
    assert done["id"].tolist() == list(range(len(done)))


@pytest.mark.parametrize("column", ["a_px", "t"])
def test_ctrl_c_ends_an_endless_stream(column: str) -> None:
    pyarrow = pytest.importorskip("pyarrow")
    schema = pyarrow.schema({column: pyarrow.float64()})

    def batches() -> Any:
        row = 0
        while True:
            row += 1
            time.sleep(0.01)
            yield pyarrow.record_batch({column: [float(row)]}, schema=schema)

    def reader() -> Any:
        return pyarrow.RecordBatchReader.from_batches(schema, batches())

    reads: list[Callable[[], Any]] = [lambda: first_contacts(BALL, WALL, reader()), lambda: Table(reader())]
    for read in reads:
        interrupt(0.5)
        with pytest.raises(KeyboardInterrupt):
            read()


def test_ctrl_c_ends_a_question_about_a_path() -> None:
    # A box slides on a table, so it is undecided everywhere on the path whether the box keeps a distance of 0.
    slider = Joint.prismatic("slider", "table", "box", axis=[1, 0, 0])
    cell = Cell(Robot([slider], {"box": Body.box(0.1, 0.1, 0.1)}))
    cell.add_obstacle("floor", Body.box(5, 5, 0.1), ([0, 0, -0.2], [0, 0, 0, 1]))
    interrupt(0.3)
    with pytest.raises(KeyboardInterrupt):
        cell.clearance_ranges([[0.0], [1.0]], resolution=1e-9)


def test_what_ends_the_program_is_no_bad_input() -> None:
    class Ends:
        def __array__(self, *_: Any, **__: Any) -> Any:
            raise KeyboardInterrupt

    reads: list[Callable[[], Any]] = [
        lambda: Motion(Ends()),
        lambda: first_contacts(BALL, WALL, {"a_px": Ends()}),
    ]
    for read in reads:
        with pytest.raises(KeyboardInterrupt):
            read()


def test_ctrl_c_ends_a_single_query() -> None:
    body = knot(600)
    interrupt(0.5)
    with pytest.raises(KeyboardInterrupt):
        first_contact(body, body, Motion([3.3, 0, 0], angular_velocity=[6e5, 6e5, 0]), tolerance=1e-9, budget=2**60)


def interrupt(seconds: float) -> None:
    """Sends Ctrl-C to this process, later."""
    # A background job of a shell ignores Ctrl-C, and so do the programs that it starts.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    threading.Timer(seconds, os.kill, (os.getpid(), signal.SIGINT)).start()
