"""The examples in the documentation."""

import doctest
from typing import Any

import rigid_ccd
from rigid_ccd import _rigid_ccd


def test_examples_run() -> None:
    for module in (rigid_ccd, _rigid_ccd):
        found = doctest.DocTestFinder(exclude_empty=True).find(module, globs={})
        examples = [test for test in found if test.examples]
        assert examples
    runner = doctest.DocTestRunner()
    documented: list[Any] = [rigid_ccd.Body, rigid_ccd.Motion, rigid_ccd.first_contact, rigid_ccd.distance]
    parser = doctest.DocTestParser()
    for thing in documented:
        text = thing.__doc__ or ""
        test = parser.get_doctest(text, {}, thing.__name__, None, None)
        assert test.examples, thing
        runner.run(test)
    assert runner.summarize().failed == 0
