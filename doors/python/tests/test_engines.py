"""The examples for the installed distributed engines give the same results as one process."""

import importlib
import os
import shutil
import sys
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from test_tables import BALL, knot

from rigid_ccd import Table, TableQuery, first_contacts

# Local clusters listen on loopback only, and send no usage statistics.
os.environ |= {"RAY_ENABLE_WINDOWS_OR_OSX_CLUSTER": "0", "RAY_USAGE_STATS_ENABLED": "0", "SPARK_LOCAL_IP": "127.0.0.1"}
# A JVM that compiles little starts in half the time.
os.environ |= {"JAVA_TOOL_OPTIONS": "-XX:TieredStopAtLevel=1 -XX:+UseSerialGC"}
EXAMPLES = Path(__file__).parents[1] / "examples" / "cluster"


def by_ray(example: ModuleType, *paths: Path) -> None:
    ray: Any = importlib.import_module("ray")
    ray.init(num_cpus=2, include_dashboard=False, object_store_memory=100 * 2**20, logging_level="ERROR")
    try:
        example.answer(*paths)
    finally:
        ray.shutdown()


def by_dask(example: ModuleType, *paths: Path) -> None:
    distributed: Any = importlib.import_module("distributed")
    with (
        distributed.LocalCluster(n_workers=1, threads_per_worker=2, dashboard_address=None) as cluster,
        distributed.Client(cluster),
    ):
        example.answer(*paths)


def by_spark(example: ModuleType, *paths: Path) -> None:
    if shutil.which("java") is None and "JAVA_HOME" not in os.environ:
        pytest.skip("Spark needs Java")
    session = example.session("local[1]")
    try:
        example.answer(session, *paths)
    finally:
        session.stop()


@pytest.mark.parametrize(
    ("engine", "example", "by"),
    [("ray.data", "ray_data", by_ray), ("distributed", "dask_frame", by_dask), ("pyspark", "spark_arrow", by_spark)],
)
def test_engines_have_the_results_of_one_process(
    engine: str, example: str, by: Callable[..., None], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    parquet: Any = pytest.importorskip("pyarrow.parquet")
    pytest.importorskip(engine)
    monkeypatch.syspath_prepend(str(EXAMPLES))
    motions = table()
    a, b, starts, results = (tmp_path / name for name in ("ball.ccd", "knot.ccd", "motions.parquet", "results"))
    BALL.save(a)
    knot(60).save(b)
    # Some groups have no contact or no answer, because types of columns must not depend on values.
    parquet.write_table(motions, starts, row_group_size=50)
    by(importlib.import_module(example), a, b, starts, results)
    expected: Any = sys.modules["pyarrow"].table(first_contacts(BALL, knot(60), motions, micros=False))
    found = parquet.read_table(results).sort_by("id").select(expected.column_names)
    assert found.cast(expected.schema).equals(expected)
    # Each single file has the types of the whole table.
    assert len({str(parquet.read_schema(file).remove_metadata()) for file in results.glob("*.parquet")}) == 1


def table() -> Any:
    """Returns fifty motions that miss, fifty invalid motions, and a hundred motions of which about half hit."""
    random = np.random.default_rng(1)
    columns = {
        "id": [f"shot {k:03}" for k in range(200)],
        "a_px": [-3.0] * 200,
        "a_py": random.uniform(-4, 4, 200),
        "a_vx": [0.0] * 50 + [np.nan] * 50 + [6.0] * 99 + [None],
        "b_wx": random.uniform(-3, 3, 200),
    }
    return pytest.importorskip("pyarrow").table(columns)


def test_the_table_has_all_kinds_of_rows() -> None:
    status = TableQuery(BALL, knot(60))(Table(table()))["status"].tolist()
    assert set(status[:50]) == {"free"} and set(status[50:100]) == {"error"}
    assert 30 < status[100:].count("contact") < 70
