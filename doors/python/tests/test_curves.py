"""Curves of scipy: splines keep their values at all times, and objects without coefficients are refused."""

from typing import Any

import numpy as np
import pytest

from rigid_ccd import Body, Cell, InputError, Joint, Robot

interpolate: Any = pytest.importorskip("scipy.interpolate")
TIMES = np.array([0, 0.5, 1.25, 2, 3, 4.5])
PLACES = np.array([[0, 0], [1, 0.5], [0.5, 1], [2, 2], [3, 1], [4, -1.0]])


@pytest.fixture
def cell() -> Cell:
    """A ball that two slides move in a plane, and a post."""
    slides = [Joint.prismatic("x", "w", "a", axis=[1, 0, 0]), Joint.prismatic("y", "a", "b", axis=[0, 1, 0])]
    made = Cell(Robot(slides, {"b": Body.sphere(0.25)}))
    made.add_obstacle("post", Body.sphere(0.25), ([2.5, 1.75, 0], [0, 0, 0, 1]))
    return made


def first_time(spline: Any, start: float, end: float) -> float:
    """Returns the time at which the ball first touches the post, by sampling."""
    times = np.linspace(start, end, 400_001)
    apart = np.linalg.norm(spline(times) - [2.5, 1.75], axis=1) - 0.5
    return float(times[np.argmax(apart <= 0)])


@pytest.mark.parametrize("degree", [1, 2, 3, 4, 5, 7])
def test_a_spline_is_a_curve(cell: Cell, degree: int) -> None:
    many = np.linspace(0, 4.5, 16)
    places = interpolate.CubicSpline(TIMES, PLACES)(many)
    spline = interpolate.make_interp_spline(many, places, k=degree)
    contact = cell.first_contact(spline, tolerance=1e-7)
    assert contact is not None
    touch = first_time(spline, 0, 4.5)
    assert touch - 1e-4 < contact.time <= touch + 1e-9
    nearest = cell.closest_approach(spline, tolerance=1e-7)
    assert nearest.upper == 0
    # The curve equals that of scipy's own polynomials, which are for one joint each.
    each = [interpolate.PPoly.from_spline(interpolate.make_interp_spline(many, places[:, k], k=degree)) for k in (0, 1)]
    inside = np.flatnonzero(np.diff(each[0].x) > 0)
    breaks = each[0].x[[*inside, inside[-1] + 1]]
    whole = interpolate.PPoly(np.stack([one.c[:, inside] for one in each], 2), breaks)
    again = cell.first_contact(whole, tolerance=1e-7)
    assert again is not None and again.time == pytest.approx(contact.time, abs=1e-7)
    rows = cell.answer_paths([spline, whole], "first-contact", tolerance=1e-7)
    assert rows["time"].tolist() == [contact.time, again.time]


def test_a_spline_ends_with_its_base_interval(cell: Cell) -> None:
    # Knots that are not repeated at the ends: the base interval is from 3 to 5 of 0 to 8.
    spline = interpolate.BSpline(np.arange(9.0), np.array([[0, 0], [1, 0], [0, 1], [1, 1], [0, 0.5]]), 3)
    ranges = cell.clearance_ranges(spline)
    assert (ranges[0].start, ranges[-1].end) == (3, 5)
    # A repeated knot makes no segment. A knot that is repeated so often that the spline jumps is refused.
    knots = np.array([0, 0, 0, 1, 1, 2, 2, 2.0])
    bends = interpolate.BSpline(knots, np.array([[0, 0], [1, 0], [3, 0], [3, 1], [2, 4.0]]), 2)
    contact = cell.first_contact(bends, tolerance=1e-7)
    assert contact is not None and abs(contact.time - first_time(bends, 0, 2)) < 1e-4
    jumps = interpolate.BSpline(np.array([0, 0, 0, 1, 1, 1, 2, 2, 2.0]), np.ones((6, 2)) * np.arange(6)[:, None], 2)
    with pytest.raises(InputError, match="jump"):
        cell.is_free(jumps)


def test_what_is_no_curve_is_refused_by_its_name(cell: Cell) -> None:
    bernstein = interpolate.BPoly(np.random.default_rng(1).normal(size=(4, 2, 2)), [0, 1, 2])
    with pytest.raises(InputError):
        cell.is_free(bernstein)
    high = interpolate.make_interp_spline(np.arange(30.0), np.ones((30, 2)), k=11)
    with pytest.raises(InputError, match="degree"):
        cell.is_free(high)
    turned = interpolate.make_interp_spline(TIMES, PLACES.T, axis=1)
    with pytest.raises(InputError):
        cell.is_free(turned)
    others: list[Any] = [
        interpolate.splrep(TIMES, PLACES[:, 0]),
        interpolate.interp1d(TIMES, PLACES, axis=0),
        interpolate.RBFInterpolator(TIMES[:, None], PLACES),
        lambda t: [t, t],
        interpolate.make_interp_spline(TIMES, PLACES[:, 0]),
        interpolate.CubicSpline(TIMES, PLACES[:, 0]),
    ]
    for other in others:
        with pytest.raises((InputError, TypeError)):
            cell.is_free(other)


def test_curves_have_no_proofs(cell: Cell) -> None:
    for curve in (interpolate.CubicSpline(TIMES, PLACES), interpolate.make_interp_spline(TIMES, PLACES)):
        with pytest.raises(InputError, match="only a path of configurations can be proven"):
            cell.prove(curve)
