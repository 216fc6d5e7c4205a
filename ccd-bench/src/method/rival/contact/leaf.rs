//! Finds the first contact of two triangles in an interval of time.

use super::clock::{HalvedInterval, MAX_HALVING_DEPTH, MotionEncloser};
use super::elementary::{ElementaryTest, ElementaryTestSet, TrianglePair};
use super::relative::TimeSpan;
use ccd_core::order::{greater, lesser};

/// When two triangles first touch in an interval of time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum FirstTouch {
    /// The triangles first touch at this time.
    AtTime(f64),
    /// The triangles do not touch in the interval.
    NotInInterval,
    /// The work limit was reached before a first touch was found or excluded.
    LimitReached,
}

/// Returns when two triangles first touch: the first root of all elementary tests. Time is halved, the first half
/// first, until every test is excluded, or its contact function is monotone so that signs find its root, or the
/// interval is as short as the resolution \[CONTACT02\].
pub(super) fn first_touch(
    triangles: &TrianglePair,
    interval: HalvedInterval,
    clock: &mut MotionEncloser,
) -> FirstTouch {
    let mut first = FirstTouch::NotInInterval;
    // The stack holds at most one second half of every level, and both halves of the last.
    let mut stack = [(interval, ElementaryTestSet::ALL); MAX_HALVING_DEPTH + 2];
    let mut height = 1;
    while let Some(below) = usize::checked_sub(height, 1) {
        height = below;
        let (mut interval, open) = stack[height];
        if let FirstTouch::AtTime(time) = first {
            interval.span.end = lesser(interval.span.end, time);
        }
        if !(interval.span.width() > 0.0 || first == FirstTouch::NotInInterval) {
            continue;
        }
        let open = triangles.tests_with_possible_roots(open, clock.placement_enclosure(interval));
        if open.is_empty() {
            continue;
        }
        if clock.is_too_short_to_halve(interval) {
            first = FirstTouch::AtTime(interval.span.start);
            continue;
        }
        let open = open.filter_tests(|test| match find_root(triangles, test, interval, clock) {
            Root::MaybeSeveral => true,
            Root::None => false,
            Root::AtTime(time) => {
                first = earlier_touch(first, time);
                false
            }
        });
        if !open.is_empty() {
            if clock.is_at_halving_limit() {
                return FirstTouch::LimitReached;
            }
            clock.halving_count += 1;
            let [early, late] = interval.halves();
            stack[height] = (late, open);
            stack[height + 1] = (early, open);
            height += 2;
        }
    }
    first
}

fn earlier_touch(first: FirstTouch, time: f64) -> FirstTouch {
    match first {
        FirstTouch::AtTime(known) => FirstTouch::AtTime(lesser(known, time)),
        FirstTouch::NotInInterval | FirstTouch::LimitReached => FirstTouch::AtTime(time),
    }
}

/// The roots of a contact function in an interval of time; a root counts only if the features meet there.
enum Root {
    None,
    AtTime(f64),
    /// The function may have several roots in the interval.
    MaybeSeveral,
}

/// Returns the root of a contact function over the interval if the function is proven monotone there, else
/// [`Root::MaybeSeveral`].
fn find_root(
    triangles: &TrianglePair,
    test: ElementaryTest,
    interval: HalvedInterval,
    clock: &mut MotionEncloser,
) -> Root {
    let rates = *clock.placement_rate_enclosure(interval);
    let rate = triangles.contact_function_rate_enclosure(
        test,
        clock.placement_enclosure(interval),
        &rates,
    );
    if !rate.excludes_zero() {
        return Root::MaybeSeveral;
    }
    let Some(found) = bracket_root_by_false_position(triangles, test, interval.span, clock) else {
        return Root::None;
    };
    // As wide as the resolution: features that meet at their borders do so except for rounding.
    let slack = 0.5 * greater(0.0, clock.resolution - found.width());
    let around = TimeSpan {
        start: found.start - slack,
        end: found.end + slack,
    };
    let only = ElementaryTestSet::ALL.filter_tests(|other| other == test);
    if triangles
        .tests_with_possible_roots(only, &clock.relative_motion.enclosure_over(around))
        .is_empty()
    {
        Root::None
    } else {
        Root::AtTime(found.start)
    }
}

/// The maximum number of steps that narrow a bracket of a root. Every other one halves it, so 2·53 lead to neighbouring
/// numbers.
const MAX_BRACKET_STEPS: usize = 110;

/// Returns an interval around the root of a monotone contact function, as wide as the resolution at most; `None`
/// without a root. Uses false position, and bisection after a step that leaves more than half.
fn bracket_root_by_false_position(
    triangles: &TrianglePair,
    test: ElementaryTest,
    span: TimeSpan,
    clock: &MotionEncloser,
) -> Option<TimeSpan> {
    let value =
        |time: f64| triangles.contact_function(test, &clock.relative_motion.placement_at(time));
    let (mut span, mut ends) = (span, [value(span.start), value(span.end)]);
    if ends[0] * ends[1] > 0.0 {
        return None;
    }
    // A guess is put this far beyond the root, so that the far end of the bracket moves as well.
    let beyond = 0.25 * clock.resolution;
    let rising = ends[1] > ends[0];
    let mut halve = false;
    for _ in 0..MAX_BRACKET_STEPS {
        let width = span.width();
        if !(width > clock.resolution) {
            break;
        }
        let guess = span.start + width * (ends[0] / (ends[0] - ends[1]));
        let guess = if guess < span.middle() {
            guess + beyond
        } else {
            guess - beyond
        };
        let inside = !halve && guess > span.start && guess < span.end;
        let time = if inside { guess } else { span.middle() };
        let there = value(time);
        let before = if rising { there < 0.0 } else { there > 0.0 };
        if before {
            (span.start, ends[0]) = (time, there);
        } else {
            (span.end, ends[1]) = (time, there);
        }
        halve = !(span.width() <= 0.5 * width);
    }
    Some(span)
}
