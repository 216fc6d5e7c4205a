"""Finds the first contact in each row of a Parquet table, with Spark.

    python spark_arrow.py box.ccd knot.ccd motions.parquet contacts

The table has the columns that `rigid_ccd.first_contacts` takes, and ids that are unique. The results are Parquet files in
a new folder, in any order.
"""

import argparse
import os
import sys
from pathlib import Path

from pyspark.sql import SparkSession
from pyspark.sql.pandas.types import from_arrow_schema, to_arrow_schema

from rigid_ccd import TableQuery


def session(master: str) -> SparkSession:
    """Starts Spark."""
    os.environ.setdefault("PYSPARK_PYTHON", sys.executable)  # the workers' Python
    os.environ.setdefault("SPARK_LOCAL_IP", "127.0.0.1")
    return SparkSession.builder.master(master).config("spark.ui.enabled", False).getOrCreate()


def answer(spark: SparkSession, a: Path, b: Path, motions: Path, results: Path) -> None:
    """Answers a file or folder of Parquet, and writes a new folder. All machines must share the paths."""
    table = spark.read.parquet(str(motions.resolve()))
    # By default a partition of Spark has a hundred megabytes, which is a million rows. A core answers one partition at
    # a time.
    table = table.repartition(8 * spark.sparkContext.defaultParallelism, "id")
    query = TableQuery(a.resolve(), b.resolve())
    schema = from_arrow_schema(query.schema(to_arrow_schema(table.schema)))
    table.mapInArrow(query, schema).write.parquet(str(results.resolve()))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("a", type=Path, help="a mesh, or a body that Body.save prepared")
    parser.add_argument("b", type=Path)
    parser.add_argument("motions", type=Path, help="a folder or a file of Parquet")
    parser.add_argument("results", type=Path, help="a folder to make")
    parser.add_argument("--cores", type=int, default=os.cpu_count() or 1)
    given = parser.parse_args()
    spark = session(f"local[{given.cores}]")  # this machine alone
    answer(spark, given.a, given.b, given.motions, given.results)
    print(f"{spark.read.parquet(str(given.results.resolve())).count()} rows in {given.results}")
    spark.stop()


if __name__ == "__main__":
    main()
