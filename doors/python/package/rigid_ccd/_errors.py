"""The exceptions of the package."""

from typing import Any


class InputError(ValueError):
    """A number is out of range, or a mesh, a motion or a table is invalid. The message names the element."""

    __module__ = "rigid_ccd"
    results: Any = None


class UnresolvedError(RuntimeError):
    """A limit was reached before the answer was known. Attributes that do not apply are None.

    Attributes:
        results: the proofs until the limit, if proofs were asked for.
        safe_until: for questions about contacts, the time before which nothing touches.
        lower, upper: for questions about distances, proven bounds.
    """

    __module__ = "rigid_ccd"
    results: Any = None
    safe_until: float | None = None
    lower: float | None = None
    upper: float | None = None


class InterruptError(KeyboardInterrupt):
    """Ctrl-C ended a call. Attributes that do not apply are None.

    Attributes:
        results: the answers so far, such as the first rows of a table.
        safe_until, lower, upper: what a single question has proven so far, as in `UnresolvedError`.
    """

    __module__ = "rigid_ccd"
    results: Any = None
    safe_until: float | None = None
    lower: float | None = None
    upper: float | None = None
