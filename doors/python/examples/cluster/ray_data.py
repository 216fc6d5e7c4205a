"""Finds the first contact in each row of a Parquet table, with Ray Data.

    python ray_data.py box.ccd knot.ccd motions.parquet contacts

The table has the columns that `rigid_ccd.first_contacts` takes, and ids that are unique. The results are Parquet files in
a new folder, in any order.
"""

import argparse
from pathlib import Path

import ray
from ray.data import ActorPoolStrategy, Dataset, SaveMode

from rigid_ccd import TableQuery


def answer(a: Path, b: Path, motions: Path, results: Path, *, actors: int | None = None) -> None:
    """Answers a file or folder of Parquet, and writes a new folder. All machines must share the paths."""
    table = ray.data.read_parquet(str(motions.resolve()))
    # By default Ray makes blocks of a hundred megabytes: a million rows for one task.
    table = table.repartition(target_num_rows_per_block=10_000)
    table = by_tasks(table, a, b) if actors is None else by_actors(table, a, b, actors)
    # SaveMode.APPEND, the default, would add to the rows of a former run.
    table.write_parquet(str(results.resolve()), mode=SaveMode.ERROR)


def by_tasks(table: Dataset, a: Path, b: Path) -> Dataset:
    """Uses tasks on all processors. A process loads the bodies once, for all of its tasks."""
    return table.map_batches(TableQuery(a.resolve(), b.resolve()), batch_format="pyarrow")


def by_actors(table: Dataset, a: Path, b: Path, actors: int) -> Dataset:
    """Uses one processor for each actor, and one more for other tasks. With fewer it waits forever."""
    return table.map_batches(
        TableQuery,
        fn_constructor_args=(a.resolve(), b.resolve()),
        compute=ActorPoolStrategy(size=actors),
        batch_format="pyarrow",
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("a", type=Path, help="a mesh, or a body that Body.save prepared")
    parser.add_argument("b", type=Path)
    parser.add_argument("motions", type=Path, help="a folder or a file of Parquet")
    parser.add_argument("results", type=Path, help="a folder to make")
    parser.add_argument("--actors", type=int, help="use so many actors instead of tasks")
    given = parser.parse_args()
    ray.init(include_dashboard=False)  # this machine alone; ray.init("auto") joins the cluster that it belongs to
    answer(given.a, given.b, given.motions, given.results, actors=given.actors)
    print(f"{ray.data.read_parquet(str(given.results.resolve())).count()} rows in {given.results}")


if __name__ == "__main__":
    main()
