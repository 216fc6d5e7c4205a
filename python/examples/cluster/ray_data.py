"""The first contact in each row of a Parquet table, by Ray Data.

    python ray_data.py knot.ccd box.ccd motions.parquet contacts

The table has the columns that `rigid_ccd.first_contacts` takes, and ids that are unique. The results are Parquet files in
a new folder, in any order.
"""

import argparse
import os
from pathlib import Path
from typing import Any

import ray
from ray.data import ActorPoolStrategy, SaveMode

from rigid_ccd import TableQuery


def answer(a: Path, b: Path, motions: Path, results: Path, *, actors: int, query: Any = TableQuery) -> None:
    """Answers a folder or file of Parquet into a new folder. All machines see the same paths."""
    table = ray.data.read_parquet(str(motions))
    # Ray makes blocks of a hundred megabytes: a million rows. An actor takes a block at a time.
    table = table.repartition(target_num_rows_per_block=10_000)
    table = table.map_batches(
        query,  # the class: each actor makes its query, and so its bodies, once
        fn_constructor_args=(a.resolve(), b.resolve()),
        # A pool that grows leaves a processor to the tasks that read and write. A fixed one may wait for them for ever.
        compute=ActorPoolStrategy(min_size=1, max_size=actors),
        batch_format="pyarrow",  # batches of NumPy have no null
    )
    # SaveMode.APPEND, the default, would add the same rows again.
    table.write_parquet(str(results.resolve()), mode=SaveMode.ERROR)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("a", type=Path, help="a mesh, or a body that Body.save prepared")
    parser.add_argument("b", type=Path)
    parser.add_argument("motions", type=Path, help="a folder or a file of Parquet")
    parser.add_argument("results", type=Path, help="a folder to make")
    parser.add_argument("--actors", type=int, default=os.cpu_count() or 1)
    given = parser.parse_args()
    # This machine alone; "auto" is the address of a cluster that runs. One processor more is for reading and writing.
    ray.init(num_cpus=given.actors + 1, include_dashboard=False)
    answer(given.a, given.b, given.motions, given.results, actors=given.actors)
    print(f"{ray.data.read_parquet(str(given.results)).count()} rows in {given.results}")


if __name__ == "__main__":
    main()
