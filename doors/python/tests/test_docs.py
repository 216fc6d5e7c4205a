"""The examples in the documentation."""

import ast
import contextlib
import doctest
import importlib
import inspect
import io
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
    """Lists the public objects of a module, and the public methods of its classes."""
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


def python_blocks(name: str) -> list[str]:
    """Returns the Python blocks of a page, with leading empty lines, so that errors show the lines of the page."""
    text = (ROOT / name).read_text()
    starts = re.finditer(r"```python\n(.*?)```", text, re.DOTALL)
    return ["\n" * text[: block.start(1)].count("\n") + block[1] for block in starts]


ROOT = Path(__file__).parents[3]
BLOCKS = [(name, number) for name in ("README.md", "doors/python/README.md") for number in range(len(python_blocks(name)))]


@pytest.mark.parametrize(("name", "number"), BLOCKS)
def test_a_block_of_a_readme_runs_alone_and_prints_what_it_says(
    name: str, number: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "part.stl").write_bytes(PART)
    said = run(python_blocks(name)[number], name)
    for line, (printed, comment) in said.items():
        assert same(comment, printed), f"{name}, line {line}: prints {printed}, and says {comment}"


def test_all_figures_of_the_readme_are_compared() -> None:
    blocks = python_blocks("doors/python/README.md")
    assert len(blocks) >= 6
    # Each print statement has its output in a comment beside it, which is compared.
    printing = [line for block in blocks for line in block.splitlines() if line.startswith("print(")]
    assert len(printing) >= 11
    assert [line for line in printing if "  # " not in line] == []


def run(code: str, name: str) -> dict[int, tuple[str, str]]:
    """Runs the statements of a block, and returns what each prints, with the comment beside it."""
    lines, names = code.splitlines(), {"__name__": "__main__"}
    said = {}
    for statement in ast.parse(code, name).body:
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            exec(compile(ast.Module([statement], []), name, "exec"), names)  # noqa: S102
        assert statement.end_lineno is not None
        _, mark, comment = lines[statement.end_lineno - 1].partition("  # ")
        if mark and printed.getvalue():
            said[statement.lineno] = (printed.getvalue(), comment)
    return said


def same(expected: str, printed: str) -> bool:
    """Returns whether a text equals the expected one. "..." stands for any text, and lines may be broken anywhere."""
    words = [" ".join(text.split()) for text in (expected, printed)]
    return re.fullmatch(re.escape(words[0]).replace(re.escape("..."), ".*"), words[1]) is not None


def test_a_wrong_figure_is_seen() -> None:
    said = run('import math\nprint(round(math.pi, 2))  # 3.15\nprint("a  b", [1,\n 2])  # a b [1, ...]\n', "page")
    assert [same(comment, printed) for printed, comment in said.values()] == [False, True]
