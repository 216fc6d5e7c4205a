//! Computes the greatest distance along trajectories by branch and bound over time.
//!
//! The distance of two points, one of each body, is never less than the distance of the bodies. The points that are
//! nearest at a time therefore bound the bodies' distance from above near that time. They move straight at their
//! velocities, up to half their acceleration times the square of the time. Two points that move straight are farthest
//! apart at an end.

use super::motions::{Motions, Span};
use super::stretches::Stretches;
use crate::answer::{Answer, Contact, Limit, Outcome, Overlap, Unresolved};
use crate::distance::oracle::DistanceOracle;
use crate::engine::answer::run_metered;
use crate::engine::depth_first::DepthFirst;
use crate::engine::meter::Meter;
use crate::engine::nearest::SearchEnd;
use crate::engine::start::at_start;
use crate::error::InputError;
use crate::math::order::{greater, lesser};
use crate::math::vector::length;
use crate::problem::Problem;
use crate::query::Query;
use crate::questions::closest::guess::nearest_at;
use crate::rounding::FARTHEST_F64;
use crate::tuning::SETTLED_GROWTH;
use glam::DVec3;
use std::cmp::Ordering;
use std::collections::BinaryHeap;
use std::ops::ControlFlow;

impl<O: DistanceOracle> DepthFirst<O> {
    /// Bounds the greatest distance of the bodies along their trajectories, to within the tolerance.
    ///
    /// The margin plays no role.
    ///
    /// # Guarantee
    /// The guarantee of [`Outcome`]; ends on every input.
    ///
    /// # Errors
    /// An [`InputError`] if a trajectory has no motion at some time, or one out of range.
    pub fn greatest_distance(
        &mut self,
        query: &Query<'_>,
        oracle: &mut O,
    ) -> Result<Answer, InputError> {
        let query = &query.for_distances();
        let mut search = GreatestDistanceSearch {
            stretches: Stretches::new(query),
            schedule: self,
            oracle,
            best: None,
            settled: 0.0,
        };
        let reason = search.run()?;
        let (upper, reason) = match reason {
            Ok(upper) => (upper, None),
            Err((upper, reason)) => (upper, Some(reason)),
        };
        let excess = query.excess();
        let upper = excess.upper_bound_of_shapes(upper);
        let seen = |(time, contact): (f64, Contact)| (time, contact.to_shapes(excess));
        let at = search.best.map(seen);
        let lower = at.map_or(0.0, |(_, contact)| greater(0.0, contact.separation.lower));
        let outcome = match reason {
            None => Outcome::Measured { lower, upper, at },
            Some(limit) => Outcome::Unresolved(Unresolved {
                limit,
                safe_until: 0.0,
                safe_from: f64::INFINITY,
                lower,
                upper,
                at,
            }),
        };
        Ok(Answer {
            tolerance: greater(query.terms.tolerance, outcome.width()),
            outcome,
            stats: search.stretches.stats,
        })
    }
}

struct GreatestDistanceSearch<'s, 'j, 'a, O: DistanceOracle> {
    stretches: Stretches<'j, 'a>,
    schedule: &'s mut DepthFirst<O>,
    oracle: &'s mut O,
    /// The time of the greatest distance measured so far, and the nearest pieces at that time.
    best: Option<(f64, Contact)>,
    /// An upper bound of the distance in stretches that need no further cut.
    settled: f64,
}

/// A waiting stretch of time with an upper bound of the distance in it; the order is that of the bounds.
struct BoundedStretch {
    span: Span,
    upper: f64,
}

impl Ord for BoundedStretch {
    fn cmp(&self, other: &Self) -> Ordering {
        self.upper.total_cmp(&other.upper)
    }
}

impl PartialOrd for BoundedStretch {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for BoundedStretch {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for BoundedStretch {}

/// The nearest points of both bodies at a time, with bounds of their distance.
struct MeasuredPoints {
    points: [DVec3; 2],
    lower: f64,
    upper: f64,
    /// The uncertainty of the bound in a stretch of length 0: deviations and rounding.
    blur: f64,
}

impl MeasuredPoints {
    /// Creates the value from the contact of the bodies in a pose.
    fn from_contact(pose: &Motions, contact: Contact) -> Self {
        let separation = contact.separation;
        let points = [separation.witness_a, separation.witness_b];
        MeasuredPoints {
            points,
            blur: pose.distance_growth(points, 0.0),
            lower: greater(0.0, separation.lower),
            upper: separation.upper,
        }
    }
}

/// An upper bound for all times; or, if a limit was reached, the best known bound and the limit.
type Bounded = Result<f64, (f64, Limit)>;

impl<O: DistanceOracle> GreatestDistanceSearch<'_, '_, '_, O> {
    /// Cuts the stretch with the greatest upper bound until the tolerance is met.
    fn run(&mut self) -> Result<Bounded, InputError> {
        let Query {
            duration, terms, ..
        } = *self.stretches.query();
        let whole = Span {
            from: 0.0,
            to: duration,
            part: 0,
        };
        for time in [whole.from, whole.to] {
            if let Err(reason) = self.measure(time)? {
                return Ok(Err((f64::INFINITY, reason)));
            }
        }
        let mut waiting = match self.bound_stretch(whole, f64::INFINITY)? {
            Ok(part) => BinaryHeap::from_iter(part),
            Err(reason) => return Ok(Err((f64::INFINITY, reason))),
        };
        while let Some(BoundedStretch { span, upper }) = waiting.pop() {
            let all = greater(upper, self.settled);
            // Written so that NaN is not the end.
            if upper <= self.lower_bound() + terms.tolerance || upper <= self.settled {
                return Ok(Ok(all));
            }
            let Some(halves) = self.stretches.cut_parts(span, 0.5 * span.length()) else {
                self.settled = all;
                continue;
            };
            for half in halves {
                match self.bound_stretch(half, upper)? {
                    Ok(part) => waiting.extend(part),
                    Err(reason) => return Ok(Err((all, reason))),
                }
            }
        }
        Ok(Ok(self.settled))
    }

    fn lower_bound(&self) -> f64 {
        self.best
            .map_or(0.0, |(_, contact)| contact.separation.lower)
    }

    /// Measures the bodies in the middle of a stretch, and bounds their distance in the whole stretch. Returns `None`
    /// if the stretch needs no further cut.
    fn bound_stretch(
        &mut self,
        span: Span,
        above: f64,
    ) -> Result<Result<Option<BoundedStretch>, Limit>, InputError> {
        self.stretches.charge_to(span);
        let seen = match self.measure(span.middle_time())? {
            Ok(seen) => seen,
            Err(reason) => return Ok(Err(reason)),
        };
        let motions = Motions::new(self.stretches.query(), span)?;
        let moved = motions.distance_growth(seen.points, 0.5 * span.length());
        // Written so that NaN is no bound.
        let upper = match seen.upper + moved {
            upper if upper >= 0.0 => lesser(upper, above),
            _ => above,
        };
        // Deviations and rounding would blur shorter stretches as much.
        if moved <= greater(SETTLED_GROWTH * (seen.upper - seen.lower), 2.0 * seen.blur) {
            self.settled = greater(self.settled, upper);
            return Ok(Ok(None));
        }
        Ok(Ok(Some(BoundedStretch { span, upper })))
    }

    /// Measures the distance of the bodies at a time.
    fn measure(&mut self, time: f64) -> Result<Result<MeasuredPoints, Limit>, InputError> {
        let (pose, terms) = match self.stretches.pose_at(time)? {
            Ok(pose) => pose,
            Err(reason) => return Ok(Err(reason)),
        };
        let query = self.stretches.query();
        let problem = pose.problem(query, &terms)?.for_distances();
        let kept = &mut self.schedule.scratch;
        let answer = run_metered(&problem, self.oracle, kept, |oracle, meter| {
            (distance_at_rest(&problem, oracle, meter), 0.0)
        });
        self.stretches.add(&answer.stats);
        Ok(answer.found.map(|place| match place {
            Placement::Apart(contact) => {
                let contact = pose.contact(contact);
                if contact.separation.lower > self.lower_bound() {
                    self.best = Some((time, contact));
                }
                MeasuredPoints::from_contact(&pose, contact)
            }
            Placement::Meeting(contact) => MeasuredPoints {
                lower: 0.0,
                ..MeasuredPoints::from_contact(&pose, pose.contact(contact))
            },
            Placement::Inside(point) => MeasuredPoints {
                points: [point; 2],
                lower: 0.0,
                upper: pose.stray,
                blur: pose.distance_growth([point; 2], 0.0),
            },
        }))
    }
}

/// How the bodies are placed at a time: apart, meeting, or one inside the other.
enum Placement {
    Apart(Contact),
    /// The surfaces meet, or nearly so, and one of the bodies may be inside the other.
    Meeting(Contact),
    /// A point that is in both bodies.
    Inside(DVec3),
}

/// Measures the distance of bodies at rest.
fn distance_at_rest<O: DistanceOracle>(
    problem: &Problem<'_>,
    oracle: &mut O,
    meter: &mut Meter,
) -> Result<Placement, Limit> {
    match at_start(problem, f64::INFINITY, oracle, meter) {
        Some(Outcome::Touching { contact }) => Ok(Placement::Apart(contact)),
        Some(Outcome::Overlapping { overlap, .. }) => Ok(match overlap {
            Overlap::Pieces(contact) => Placement::Meeting(contact),
            Overlap::AInsideB(point) | Overlap::BInsideA(point) => Placement::Inside(point),
        }),
        Some(Outcome::Unresolved(known)) if known.limit != Limit::Undecided => Err(known.limit),
        // Any two points bound the distance from above.
        _ => match nearest_at(problem, 0.0, f64::INFINITY, oracle, meter) {
            ControlFlow::Continue(Some(nearest)) => Ok(Placement::Meeting(nearest.contact)),
            ControlFlow::Break(SearchEnd::Overlap(_, contact)) => Ok(Placement::Meeting(contact)),
            ControlFlow::Break(SearchEnd::Limit(reason)) => Err(reason),
            ControlFlow::Continue(None) => Err(Limit::OracleGaveUp),
        },
    }
}

impl Motions {
    /// Returns an upper bound of the growth of the distance between a point of A and a point of B, within `time` before
    /// or after the middle of the stretch. The points are given at that middle.
    fn distance_growth(&self, [on_a, on_b]: [DVec3; 2], time: f64) -> f64 {
        let middle = 0.5 * self.span.length();
        let [a, b] = &self.stretches;
        let way = on_b - on_a;
        let velocity = b.velocity_at(on_b, middle) - a.velocity_at(on_a, middle);
        let ends = greater(length(way + time * velocity), length(way - time * velocity));
        let (mut second_derivative, mut turn, mut scale) =
            (length(b.acceleration - a.acceleration), 0.0, 0.0);
        for (stretch, point) in [(a, on_a), (b, on_b)] {
            let motion = &stretch.motion;
            let spin = length(motion.spin());
            let centre = stretch.pose(middle).transform_point(motion.centre());
            let arm = length(point - centre);
            second_derivative += spin * spin * arm;
            turn += spin;
            let speed =
                length(motion.velocity()) + spin * arm + middle * length(stretch.acceleration);
            scale += length(point) + length(centre) + self.span.to * speed;
        }
        // The points of the bodies deviate from those of the motions, which turn.
        let strays = self.stray * (2.0 + turn * time);
        let grown = (ends - length(way)) + 0.5 * second_derivative * time * time + strays;
        // Written so that NaN stays.
        greater(grown, 0.0) * (1.0 + FARTHEST_F64) + FARTHEST_F64 * scale
    }
}
