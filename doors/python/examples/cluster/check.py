"""Do the answers of an engine have the bits of one process, even if a machine dies? What does the engine cost?

    python check.py ray 1000000 --kill
    python check.py dask 100000 --kill
    python check.py spark 100000 --kill

Answers a table of random motions alternately in one process and by the example of the engine, on as many cores. Times
include reading and writing, but not the start of the cluster. With --kill, `kill -9` ends a node of Ray, a worker of
Dask, or an executor of Spark when a third of the rows is answered.
"""

import argparse
import importlib
import math
import os
import shutil
import signal
import statistics
import tempfile
import threading
import time
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow
import pyarrow.parquet

from rigid_ccd import Body, Table, TableQuery, first_contacts

# Local clusters listen on loopback only, and send no usage statistics.
os.environ |= {"RAY_ENABLE_WINDOWS_OR_OSX_CLUSTER": "0", "RAY_USAGE_STATS_ENABLED": "0", "SPARK_LOCAL_IP": "127.0.0.1"}


class Logged(TableQuery):
    """A query that records the number of rows answered in each process."""

    where: Callable[[], str]

    def __call__(self, motions: Any) -> Any:
        found = super().__call__(motions)
        if isinstance(found, Iterator):  # it calls this method for each table
            return found
        with open(Path(self._a).with_name("log") / self.where(), "a") as file:  # type: ignore[arg-type]
            file.write(f"{len(found)}\n")
        return found


class OfRay(Logged):
    @staticmethod
    def where() -> str:
        import ray

        return str(ray.get_runtime_context().get_node_id())


class OfDask(Logged):
    @staticmethod
    def where() -> str:
        return str(os.getpid())


class OfSpark(Logged):
    @staticmethod
    def where() -> str:
        """Returns the executor, the grandparent of this process."""
        return Path(f"/proc/{os.getppid()}/stat").read_text().rpartition(")")[2].split()[1]


def answered(log: Path) -> Counter[str]:
    """Returns the number of rows that each process has answered."""
    return Counter({place.name: sum(map(int, place.read_text().split())) for place in log.iterdir()})


@contextmanager
def killer(given: argparse.Namespace, log: Path, victims: list[str], kill: Callable[[str], None]) -> Iterator[None]:
    """Kills the busiest of the given processes, or of all, after a third of the rows."""
    over = threading.Event()

    def watch() -> None:
        while not over.wait(0.05):
            done = answered(log)
            if sum(done.values()) >= given.rows / 3:
                victim = max(victims or done, key=done.__getitem__)
                kill(victim)
                print(f"\nkilled after {sum(done.values())} rows, of which the dead had answered {done[victim]}")
                return
        print("NOT killed: the answers came too soon")

    watching = threading.Thread(target=watch)
    if given.kill:
        watching.start()
    try:
        yield
    finally:
        over.set()
        if given.kill:
            watching.join()


@contextmanager
def ray(given: argparse.Namespace, log: Path) -> Iterator[Callable[..., None]]:
    """Starts three nodes: the head, and two others, one of which is killed."""
    from ray.cluster_utils import Cluster

    example = importlib.import_module("ray_data")
    example.TableQuery = OfRay
    node = {"node_ip_address": "127.0.0.1", "object_store_memory": 500 * 2**20, "include_dashboard": False}
    cluster = Cluster(initialize_head=True, head_node_args={**node, "num_cpus": given.head})
    nodes = {made.node_id: made for made in (cluster.add_node(**node, num_cpus=1) for _ in range(2))}
    cluster.connect()

    def kill(victim: str) -> None:
        cluster.remove_node(nodes[victim], allow_graceful=False)

    def answer(*paths: Path) -> None:
        with killer(given, log, list(nodes), kill):
            example.answer(*paths, actors=given.actors)

    yield answer
    example.ray.shutdown()
    cluster.shutdown()


@contextmanager
def dask(given: argparse.Namespace, log: Path) -> Iterator[Callable[..., None]]:
    from distributed import Client, LocalCluster

    example = importlib.import_module("dask_frame")
    example.TableQuery = OfDask
    with (
        LocalCluster(n_workers=given.cores, threads_per_worker=1, dashboard_address=None) as cluster,
        Client(cluster),
    ):

        def answer(*paths: Path) -> None:
            workers = [str(nanny.pid) for nanny in cluster.workers.values()]
            with killer(given, log, workers, kill_process):
                example.answer(*paths)

        yield answer


@contextmanager
def spark(given: argparse.Namespace, log: Path) -> Iterator[Callable[..., None]]:
    """Starts Spark, with executors in separate processes if one is to be killed."""
    import pyspark

    example = importlib.import_module("spark_arrow")
    example.TableQuery = OfSpark
    os.environ["SPARK_HOME"] = str(Path(pyspark.__file__).parent)
    session = example.session(f"local-cluster[{given.cores},1,1024]" if given.kill else f"local[{given.cores}]")

    def answer(*paths: Path) -> None:
        with killer(given, log, [], kill_process):
            example.answer(session, *paths)

    yield answer
    session.stop()


def kill_process(number: str) -> None:
    os.kill(int(number), signal.SIGKILL)


def knot() -> Body:
    """A torus knot of 3200 triangles."""
    around, along = np.meshgrid(np.arange(16) * math.tau / 16, np.arange(100) * math.tau / 100)
    radius = 1 + 0.4 * np.cos(3 * along) + 0.15 * np.cos(around)
    height = 0.4 * np.sin(3 * along) + 0.15 * np.sin(around)
    points = np.stack([radius * np.cos(2 * along), radius * np.sin(2 * along), height], axis=-1)
    a = np.arange(1600).reshape(100, 16)
    b, d = np.roll(a, -1, 0), np.roll(a, -1, 1)
    c = np.roll(b, -1, 1)
    faces = [np.stack(corners, -1).reshape(-1, 3) for corners in ((a, b, c), (a, c, d))]
    return Body(points.reshape(-1, 3), np.concatenate(faces))


def motions(rows: int) -> pyarrow.Table:
    """Returns motions of rotating boxes at the knot. About half hit, and a few rows are invalid."""
    random = np.random.default_rng(1)
    columns = {name: random.uniform(-3, 3, rows) for name in ("a_wx", "a_wy", "b_wx", "b_wz")}
    columns |= {name: random.uniform(-2, 2, rows) for name in ("a_py", "a_pz")}
    columns |= {
        "id": random.permutation(rows),
        "a_px": random.uniform(-4, -3, rows),
        "a_vx": random.uniform(2, 8, rows),
    }
    columns["a_px"][::1000] = np.nan
    return pyarrow.table(columns)


def bits(column: pyarrow.ChunkedArray) -> pyarrow.Array:
    """Returns the values to compare: the bits of floats, with null as NaN; the values of other columns."""
    if not pyarrow.types.is_floating(column.type):
        return column.cast(pyarrow.string()).combine_chunks()
    numbers = column.to_numpy()
    return pyarrow.array(np.where(np.isnan(numbers), np.nan, numbers).view(np.uint64))


def compare(found: pyarrow.Table, expected: pyarrow.Table) -> str:
    ids = found["id"].to_numpy()
    assert len(np.unique(ids)) == len(ids) == len(expected), "rows are lost, or there twice"
    assert found.column_names == expected.column_names
    found, expected = (table.sort_by("id") for table in (found, expected))
    other = [name for name in found.column_names if not bits(found[name]).equals(bits(expected[name]))]
    return f"OTHER bits in {other}" if other else "equal bits"


def timed(answer: Callable[..., None], *paths: Path) -> float:
    begin = time.perf_counter()
    answer(*paths)
    return time.perf_counter() - begin


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("engine", choices=["ray", "dask", "spark"])
    parser.add_argument("rows", type=int)
    parser.add_argument("--kill", action="store_true", help="kill a node, a worker or an executor meanwhile")
    parser.add_argument("--cores", type=int, default=2, help="of one process, of Dask and of Spark")
    parser.add_argument("--head", type=int, default=1, help="processors of Ray's head; its other nodes have one")
    parser.add_argument("--actors", type=int, help="of Ray, instead of tasks")
    parser.add_argument("--repeat", type=int, default=1)
    given = parser.parse_args()
    folder = Path(tempfile.mkdtemp())
    a, b, table, log, one, results = (
        folder / name for name in ("box.ccd", "knot.ccd", "motions.parquet", "log", "one.parquet", "results")
    )
    Body.box(0.5, 0.3, 0.2).save(a)
    knot().save(b)
    pyarrow.parquet.write_table(motions(given.rows), table, row_group_size=10_000)
    log.mkdir()

    def alone(*paths: Path) -> None:
        a, b, motions, results = paths
        starts = pyarrow.parquet.read_table(motions)
        found = first_contacts(Body.from_file(a), Body.from_file(b), starts, threads=given.cores, micros=False)
        pyarrow.parquet.write_table(pyarrow.table(found), results)

    begin = time.perf_counter()
    with globals()[given.engine](given, log) as answer:
        print(f"the cluster started in {time.perf_counter() - begin:.1f} s")
        ratios = []
        for _ in range(given.repeat):
            shutil.rmtree(results, ignore_errors=True)
            both = [timed(alone, a, b, table, one), timed(answer, a, b, table, results)]
            ratios.append(both[1] / both[0])
            found, expected = pyarrow.parquet.read_table(results), pyarrow.parquet.read_table(one)
            print(f"one process {both[0]:.1f} s, {given.engine} {both[1]:.1f} s, {compare(found, expected)}")
    print(f"{Table(expected)}\nratio {statistics.median(ratios):.2f}, the median of {len(ratios)}")
    if done := answered(log):
        print(f"rows answered by each: {', '.join(map(str, done.values()))}; all {sum(done.values())}")
    shutil.rmtree(folder)


if __name__ == "__main__":
    main()
