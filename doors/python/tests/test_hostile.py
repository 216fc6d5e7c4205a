"""Every Python argument gives an answer or an exception that `except Exception` catches."""

import datetime
import decimal
import pickle
import zlib
from typing import Any

import numpy as np
import pytest

from rigid_ccd import Body, InputError, InterruptError, Motion, Table, UnresolvedError, closest_approach, first_contact, first_contacts

BALL, WALL = Body.sphere(0.5), Body.box(0.1, 5, 5)


def columns(table: Table) -> dict[str, list[Any]]:
    return {name: table[name].tolist() for name in table}


def test_a_damaged_pickle_is_no_table() -> None:
    table = Table({"id": ["a", "b"], "time": [1.5, 2.5]})
    make, (stored, checksum) = table.__reduce__()
    assert columns(make(stored, checksum)) == columns(table)
    for bit in range(8 * len(stored)):
        damaged = bytearray(stored)
        damaged[bit // 8] ^= 1 << bit % 8
        with pytest.raises(InputError, match="damaged"):
            make(bytes(damaged), checksum)
    for bit in range(32):
        with pytest.raises(InputError, match="damaged"):
            make(stored, checksum ^ 1 << bit)
    for cut in range(len(stored)):
        with pytest.raises(InputError, match="damaged"):
            make(stored[:cut], checksum)


def test_a_damaged_pickle_as_a_whole() -> None:
    table = Table({"id": ["a", "b"], "time": [1.5, 2.5]})
    whole, told = pickle.dumps(table), 0
    for bit in range(8 * len(whole)):
        damaged = bytearray(whole)
        damaged[bit // 8] ^= 1 << bit % 8
        try:
            found = pickle.loads(bytes(damaged))
        except Exception:
            told += 1
            continue
        # A change outside of the table's bytes may make pickle return another object, but never another table.
        if isinstance(found, Table):
            assert columns(found) == columns(table), bit
    assert told > 0.9 * 8 * len(whole)


def test_forged_bytes_are_no_more_than_they_say() -> None:
    """Damage with a valid checksum causes no allocation for missing data, and no panic."""
    table = Table({"id": ["a", None], "time": [1.5, 2.5], "whole": np.array([1, 2], "int16")})
    make, (stored, _) = table.__reduce__()
    made = refused = 0
    for bit in range(8 * len(stored)):
        forged = bytearray(stored)
        forged[bit // 8] ^= 1 << bit % 8
        try:
            found = make(bytes(forged), zlib.crc32(forged))
            made += 1
            columns(found)
        except (InputError, MemoryError):
            refused += 1
    assert made > 100 and refused > 100


def arrays() -> dict[str, Any]:
    pa = pytest.importorskip("pyarrow")
    wide = pa.array([2**63 - 1, -(2**63), None])
    date = datetime.date(2020, 1, 1)
    runs = pa.array([2, 3], pa.int32())
    key, value = pa.field("k", pa.string(), nullable=False), pa.field("v", pa.int8())
    return {
        "nulls": pa.nulls(3),
        "bool": pa.array([True, False, None]),
        "dictionary": pa.array(["a", "b", "a"]).dictionary_encode(),
        "runs of text": pa.RunEndEncodedArray.from_arrays(runs, pa.array(["a", "b"])),
        "runs of numbers": pa.RunEndEncodedArray.from_arrays(runs, pa.array([1.0, None])),
        "runs of a dictionary": pa.RunEndEncodedArray.from_arrays(runs, pa.array(["a", "b"]).dictionary_encode()),
        "runs in a list": pa.ListArray.from_arrays([0, 1, 2, 3], pa.RunEndEncodedArray.from_arrays(runs, [1, 2])),
        "sparse union": pa.UnionArray.from_sparse(pa.array([0, 1, 0], pa.int8()), [pa.array([1, 2, 3]), pa.array(["a", "b", "c"])]),
        "dense union": pa.UnionArray.from_dense(
            pa.array([0, 1, 0], pa.int8()), pa.array([0, 0, 1], pa.int32()), [pa.array([1, 2]), pa.array(["a"])]
        ),
        "map": pa.array([[("a", 1)], [], None], pa.map_(pa.string(), pa.int64())),
        "map of other names": pa.array([[("a", 1)], [], None], pa.map_(key, value)),
        "list": pa.array([[1], [], None]),
        "list view": pa.array([[1], [], None], pa.list_view(pa.int8())),
        "large list view": pa.array([[1], [], None], pa.large_list_view(pa.int8())),
        "fixed list": pa.array([[1, 2], [3, 4], None], pa.list_(pa.int8(), 2)),
        "empty fixed list": pa.array([[], [], None], pa.list_(pa.int8(), 0)),
        "struct": pa.array([{"a": 1}, {"a": 2}, None]),
        "empty struct": pa.array([{}, {}, None], pa.struct([])),
        "text view": pa.array(["a", "longer than twelve letters", None], pa.string_view()),
        "bytes view": pa.array([b"a", b"longer than twelve letters", None], pa.binary_view()),
        "bytes": pa.array([b"\xff", b"", None]),
        "fixed bytes": pa.array([b"ab", b"cd", None], pa.binary(2)),
        "decimal": pa.array([decimal.Decimal("1.5"), None, None], pa.decimal128(10, 2)),
        "wide decimal": pa.array([decimal.Decimal("1.5"), None, None], pa.decimal256(70, 2)),
        "coarse decimal": pa.array([decimal.Decimal("1500"), None, None], pa.decimal128(10, -2)),
        "date": pa.array([date, date, None]),
        "far dates": pa.array([2**31 - 1, -(2**31), None], pa.int32()).cast(pa.date32()),
        "farther dates": wide.view(pa.date64()),
        "times": wide.view(pa.timestamp("s")),
        "times of a zone": wide.view(pa.timestamp("us", "Europe/Berlin")),
        "times of no zone": wide.view(pa.timestamp("us", "No/Where")),
        "times of day": wide.view(pa.time64("ns")),
        "durations": wide.view(pa.duration("s")),
        "interval": pa.array([(1, 2, 3), (2**31 - 1, -(2**31), 2**63 - 1), None], pa.month_day_nano_interval()),
        "halves": pa.array(np.array([1, 2, 3], np.float16)),
        "uuid": pa.ExtensionArray.from_storage(pa.uuid(), pa.array([b"0" * 16] * 2 + [None], pa.binary(16))),
        "tensors": pa.FixedShapeTensorArray.from_numpy_ndarray(np.arange(6.0).reshape(3, 2)),
    }


@pytest.mark.parametrize("name", list(arrays()))
def test_any_type_of_arrow(name: str) -> None:
    pa = pytest.importorskip("pyarrow")
    whole, places = arrays()[name], pa.array([-3.0] * 3)
    for array in (whole, whole.slice(1), whole.slice(0, 0)):
        here = places.slice(0, len(array))
        chunked = [pa.chunked_array([column, column]) for column in (array, here)]
        for given in (
            {"id": array, "a_px": here},
            {"a_px": array},
            {"id": array, "t": here, "a_px": here},
            {"t": array, "a_px": here},
            dict(zip(("id", "a_px"), chunked, strict=True)),
        ):
            arrow = pa.table(given)
            for use in (
                lambda arrow=arrow: columns(Table(arrow)),
                lambda arrow=arrow: columns(first_contacts(BALL, WALL, arrow)),
                lambda arrow=arrow: pickle.loads(pickle.dumps(Table(arrow))).take(range(min(1, len(arrow)))),
            ):
                try:
                    use()
                except Exception as error:
                    assert isinstance(error, InputError), error


def test_runs_are_values() -> None:
    pa = pytest.importorskip("pyarrow")
    runs = pa.array([2, 3], pa.int32())
    ids = pa.RunEndEncodedArray.from_arrays(runs, pa.array(["a", "b"]))
    speeds = pa.RunEndEncodedArray.from_arrays(runs, pa.array([4.0, 1.0]))
    found = first_contacts(BALL, WALL, pa.table({"id": ids, "a_px": [-3.0] * 3, "a_vx": speeds}))
    assert found["id"].tolist() == ["a", "a", "b"]
    assert found["status"].tolist() == ["contact", "contact", "free"]
    assert Table(pa.table({"id": ids}))["id"].tolist() == ["a", "a", "b"]
    poses = {"t": [0.0, 1.0, 0.0], "a_px": [-3.0, 3.0, 3.0]}
    found = first_contacts(BALL, WALL, pa.table({"id": ids, **poses}))
    assert (found["id"].tolist(), found["status"].tolist()) == (["a", "b"], ["contact", "free"])


def test_a_column_of_nulls_of_polars() -> None:
    polars = pytest.importorskip("polars")
    frame = polars.DataFrame({"id": [None, None], "a_px": [-3.0, -3.0], "a_vx": [4.0, 1.0]})
    assert frame.schema["id"] == polars.Null
    found = first_contacts(BALL, WALL, frame)
    assert found["status"].tolist() == ["contact", "free"] and found["id"].tolist() == [None, None]
    reasons = first_contacts(BALL, WALL, polars.DataFrame({"a_px": [None, None]}))["reason"].tolist()
    assert reasons == ["column a_px: no value, and an empty cell has no default"] * 2


def test_what_does_not_fit_into_memory() -> None:
    pa = pytest.importorskip("pyarrow")
    many = 2**60
    nulls = pa.Array.from_buffers(pa.null(), many, [None])
    runs = pa.RunEndEncodedArray.from_arrays(pa.array([many], pa.int64()), pa.array([1.0]))
    for column in (nulls, runs):
        for given in ({"a_px": column}, {"t": column}):
            with pytest.raises(InputError, match="memory"):
                first_contacts(BALL, WALL, pa.table(given))
    with pytest.raises(InputError, match="memory"):
        Table(pa.table({"id": runs}))
    with pytest.raises(MemoryError, match="memory"):
        Table(pa.table({"id": nulls}))["id"]


def test_an_interrupt_inside_a_stream_stays_one() -> None:
    pa = pytest.importorskip("pyarrow")
    schema = pa.schema({"a_px": pa.float64()})

    def batches() -> Any:
        yield pa.record_batch({"a_px": [1.0, 2.0]})
        raise KeyboardInterrupt

    def reader() -> Any:
        return pa.RecordBatchReader.from_batches(schema, batches())

    with pytest.raises(InterruptError) as interrupted:
        first_contacts(BALL, WALL, reader())
    assert interrupted.value.results is not None and len(interrupted.value.results) == 2
    with pytest.raises(KeyboardInterrupt):
        Table(reader())


class Raises:
    """Raises an exception at every access."""

    def __init__(self, error: type[BaseException]) -> None:
        self.error = error

    def fail(self, *_: Any, **__: Any) -> Any:
        raise self.error("mine")

    __float__ = __index__ = __array__ = __len__ = __iter__ = __getitem__ = __fspath__ = __bool__ = fail


@pytest.mark.parametrize("error", [ZeroDivisionError, RecursionError, MemoryError, KeyboardInterrupt, SystemExit])
def test_exceptions_of_arguments_come_out(error: type[BaseException]) -> None:
    bad: Any = Raises(error)
    table = Table({"a_px": [1.0, 2.0]})
    for use in (
        lambda: first_contacts(BALL, WALL, {"a_px": bad}),
        lambda: first_contacts(BALL, WALL, {"a_px": [bad]}),
        lambda: first_contacts(BALL, WALL, {"id": [bad], "a_px": [1.0]}),
        lambda: first_contacts(BALL, WALL, bad),
        lambda: first_contact(BALL, WALL, tolerance=bad),
        lambda: Motion(bad),
        lambda: Motion([bad, 0, 0]),
        lambda: Motion.between((bad, bad), np.eye(4)),
        lambda: Body(bad, bad),
        lambda: Body.from_file(bad),
        lambda: table.take(bad),
        lambda: table[bad],
    ):
        with pytest.raises((InputError, TypeError, error)) as raised:
            use()
        assert isinstance(raised.value, Exception) or raised.type is error


def test_exceptions_have_their_attributes() -> None:
    for make in (UnresolvedError, InputError, InterruptError):
        made: Any = make("text")
        assert getattr(made, "results", None) is None
    plain = UnresolvedError("text")
    assert (plain.safe_until, plain.lower, plain.upper) == (None, None, None)
    motion = Motion([-3, 0, 0], velocity=[4, 0, 0])
    with pytest.raises(UnresolvedError, match="the budget is spent: a larger tolerance") as of_contact:
        first_contact(BALL, WALL, motion, budget=0)
    assert of_contact.value.safe_until is not None and of_contact.value.lower is None
    with pytest.raises(UnresolvedError) as of_distance:
        closest_approach(BALL, WALL, motion, budget=0)
    assert of_distance.value.safe_until is None and of_distance.value.lower is not None
    again = pickle.loads(pickle.dumps(of_contact.value))
    assert again.safe_until == of_contact.value.safe_until
