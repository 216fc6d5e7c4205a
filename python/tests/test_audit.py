"""Motions that another checker has called free."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from rigid_ccd import Body, audit, first_contacts

BALL = Body.sphere(0.5)
WALL = Body.box(0.001, 5, 5)
# A check at ten steps detects neither shot; "half" is an invalid motion, and "beside" is free.
SHOTS: dict[str, Any] = {
    "id": ["beside", "fast", "half", "slow/../x", "fast"],
    "a_px": [-3.0, -3, np.nan, -3, -3],
    "a_py": [6.0, 0, 0, 0, 0],
    "a_vx": [60.0, 60, 60, 3, 70],
}


def test_what_was_missed_is_listed(tmp_path: Path) -> None:
    found = audit(BALL, WALL, SHOTS, pages=tmp_path / "pages")
    assert not found.is_clean and found.rows == 5
    assert found.missed["id"].tolist() == ["fast", "slow/../x", "fast"] and found.missed_rows == (1, 3, 4)
    assert found.missed["time"][0] == pytest.approx(2.499 / 60, abs=1e-7)
    assert found.missed["witness_b_x"][0] == pytest.approx(-0.001)
    assert found.unproven["status"].tolist() == ["error"]
    assert repr(found) == "Audit(5 rows, 1 free, 3 missed, 1 unproven)"
    names = [page.name for page in found.pages]
    assert names == ["fast.html", "slow_.._x.html", "fast-1.html"]
    assert sorted(path.name for path in (tmp_path / "pages").iterdir()) == sorted(names)
    for page in found.pages:
        assert "First contact at" in page.read_text()


def test_pages_are_for_tables_of_any_kind(tmp_path: Path) -> None:
    pyarrow = pytest.importorskip("pyarrow")
    reader = pyarrow.table(SHOTS).to_reader()
    assert len(audit(BALL, WALL, reader, pages=tmp_path, most_pages=2).pages) == 2
    paths = {"id": ["p", "p"], "t": [0.0, 1], "a_px": [-3.0, 3]}
    found = audit(BALL, WALL, paths, pages=tmp_path)
    assert [page.name for page in found.pages] == ["p.html"]


def test_a_clean_audit_says_so(tmp_path: Path) -> None:
    found = audit(BALL, WALL, {"a_px": [-3.0], "a_vx": [2.0]}, pages=tmp_path / "none")
    assert found.is_clean and found.pages == () and not (tmp_path / "none").exists()


def test_a_budget_leaves_rows_unproven() -> None:
    rods = Body.capsule(0.01, 2)
    columns = {"a_px": [-3.0], "a_vx": [4.0], "a_wx": [300.0], "a_wy": [200.0], "a_wz": [100.0]}
    found = audit(rods, rods, columns, budget=1)
    assert len(found.unproven) == 1 and not found.is_clean


def test_a_folder_that_cannot_be_made_is_an_error(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(OSError):
        audit(BALL, WALL, SHOTS, pages=tmp_path / "file")


def test_the_margin_is_kept() -> None:
    columns = {"a_px": [-3.0], "a_vx": [2.0]}
    assert audit(BALL, WALL, columns, margin=0.4).is_clean
    found = audit(BALL, WALL, columns, margin=0.6)
    assert found.missed["time"][0] == first_contacts(BALL, WALL, columns, margin=0.6, tolerance=1e-6)["time"][0]
