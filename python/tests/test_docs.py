"""The examples in the documentation."""

import doctest
import importlib
import inspect
import re
import struct
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

import rigid_ccd
from rigid_ccd import _rigid_ccd

# A triangle, as an STL file.
PART = bytes(80) + struct.pack("<I12fH", 1, 0, 0, 1, -1, -1, 0, 1, -1, 0, 0, 1, 0, 0)
MODULES = ["rigid_ccd", "rigid_ccd._tables", "rigid_ccd._query"]


@pytest.mark.parametrize("name", MODULES)
def test_examples_run(name: str) -> None:
    module = importlib.import_module(name)
    found = doctest.testmod(module, optionflags=doctest.NORMALIZE_WHITESPACE)
    assert found.attempted > 0 and found.failed == 0


def test_examples_of_the_extension_run() -> None:
    runner, parser = doctest.DocTestRunner(), doctest.DocTestParser()
    with_examples = 0
    for name, thing in documented(_rigid_ccd):
        test = parser.get_doctest(inspect.getdoc(thing) or "", {}, name, None, None)
        with_examples += bool(test.examples)
        runner.run(test)
    assert with_examples >= 6
    assert runner.summarize().failed == 0


def test_everything_is_documented() -> None:
    for name, thing in documented(rigid_ccd):
        assert inspect.getdoc(thing), name


def documented(module: ModuleType) -> list[tuple[str, Any]]:
    """Lists what a module has, and the public methods of its classes."""
    found = []
    for name in getattr(module, "__all__", dir(module)):
        thing = getattr(module, name)
        if name.startswith("_"):
            continue
        found.append((name, thing))
        if inspect.isclass(thing) and not issubclass(thing, BaseException):
            members = vars(thing).items()
            found += [(f"{name}.{member}", value) for member, value in members if not member.startswith("_")]
    return found


@pytest.mark.parametrize("name", ["README.md", "python/README.md"])
def test_the_examples_of_a_readme_run(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "part.stl").write_bytes(PART)
    text = (Path(__file__).parents[2] / name).read_text()
    blocks = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    assert blocks
    names: dict[str, Any] = {}
    for block in blocks:
        exec(compile(block, name, "exec"), names)  # noqa: S102
