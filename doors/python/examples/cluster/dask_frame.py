"""Finds the first contact in each row of a Parquet table, with Dask.

    python dask_frame.py box.ccd knot.ccd motions.parquet contacts

The table has the columns that `rigid_ccd.first_contacts` takes, and ids that are unique. The results are Parquet files in
a new folder.
"""

import argparse
import os
from pathlib import Path

import dask.dataframe
from distributed import Client, LocalCluster, get_client

from rigid_ccd import TableQuery


def answer(a: Path, b: Path, motions: Path, results: Path) -> None:
    """Answers a file or folder of Parquet, and writes a new folder. All machines must share the paths."""
    results.mkdir(parents=True)  # Dask would mix the files with those of a former run
    frame = dask.dataframe.read_parquet(motions.resolve(), dtype_backend="pyarrow", split_row_groups=True)
    # A row group may have a million rows, and a thread answers one partition at a time.
    parts = 8 * sum(get_client().nthreads().values())
    if frame.npartitions < parts:
        frame = frame.repartition(npartitions=parts)
    query = TableQuery(a.resolve(), b.resolve())
    found = frame.map_partitions(query, meta=query.schema(frame._meta))
    found.to_parquet(results.resolve(), write_index=False)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("a", type=Path, help="a mesh, or a body that Body.save prepared")
    parser.add_argument("b", type=Path)
    parser.add_argument("motions", type=Path, help="a folder or a file of Parquet")
    parser.add_argument("results", type=Path, help="a folder to make")
    parser.add_argument("--workers", type=int, default=os.cpu_count() or 1)
    given = parser.parse_args()
    # A cluster on this machine; Client("tcp://…") connects to a running one.
    cluster = LocalCluster(n_workers=given.workers, threads_per_worker=1, dashboard_address=None)
    with cluster, Client(cluster):
        answer(given.a, given.b, given.motions, given.results)
        print(f"{len(dask.dataframe.read_parquet(given.results))} rows in {given.results}")


if __name__ == "__main__":
    main()
