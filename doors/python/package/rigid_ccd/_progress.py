"""Reports the progress of a call to a function or a bar of tqdm."""

from collections.abc import Callable
from typing import Any

from ._settings import Progress

Report = Callable[[int, int | None], object]


def reporter(progress: Progress) -> tuple[Report | None, Callable[[], object]]:
    """Returns two functions: the first reports the amount of work done and the total, and the second ends the report."""
    if progress is None or progress is False:
        return None, lambda: None
    if progress is True:
        return _own_bar()
    update: Any = getattr(progress, "update", None)
    if update is not None:
        return _increments(update), lambda: None
    if not callable(progress):
        raise TypeError(f"progress: a function, a bar of tqdm or True is needed, not {type(progress).__name__}")
    return progress, lambda: None


def _own_bar() -> tuple[Report, Callable[[], object]]:
    try:
        from tqdm.auto import tqdm
    except ModuleNotFoundError as error:
        message = "progress=True needs tqdm: pip install tqdm, or pass a function"
        raise ModuleNotFoundError(message, name="tqdm") from error

    bar = tqdm(total=None)
    tqdm_bar: Any = bar

    def report(done: int, total: int | None) -> None:
        tqdm_bar.total = total
        tqdm_bar.update(done - tqdm_bar.n)

    return report, bar.close


def _increments(update: Callable[[int], object]) -> Report:
    reported = 0

    def report(done: int, _total: int | None) -> None:
        nonlocal reported
        update(done - reported)
        reported = done

    return report
