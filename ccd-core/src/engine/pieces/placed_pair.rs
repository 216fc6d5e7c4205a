//! Two pieces at the poses of one clock: their distance by the oracle, and their gap along an axis.

use crate::answer::{Contact, Separation};
use crate::body::piece::{ConvexCombination, Piece};
use crate::distance::oracle::{DistanceOracle, PiecePair};
use crate::distance::separation::{self, CheckedClaim};
use crate::engine::meter::Meter;
use crate::engine::shortcuts::turning_pieces::MovingPiece;
#[cfg(feature = "hull-tree")]
use crate::math::order::lesser;
use crate::math::vector::unit;
use crate::motion::pose::Frame;
use crate::problem::{BodyWithPath, Problem};
use crate::tuning::ASSUMED_ORACLE_STEPS;
use glam::DVec3;
use std::cell::Cell;

/// Two pieces at the poses of one clock.
pub(crate) struct PlacedPair<'p> {
    pub(crate) problem: &'p Problem<'p>,
    /// The poses of A and B, in the problem's coordinates.
    pub(crate) frames: [Frame; 2],
    pub(crate) pieces: PiecePair<'p>,
    pub(crate) clock: f64,
    /// The number of heights of points that were evaluated for this pair.
    pub(crate) height_evaluation_count: Cell<u64>,
}

impl<'p> PlacedPair<'p> {
    /// Places piece `a` of A and piece `b` of B at a clock.
    pub(crate) fn new(problem: &'p Problem<'_>, pieces: [u32; 2], clock: f64) -> Self {
        PlacedPair::from_pieces(problem, problem.pieces(pieces), clock)
    }

    /// Places any two convex pieces, of A and of B, at a clock.
    pub(crate) fn from_pieces(
        problem: &'p Problem<'_>,
        [a, b]: [Piece<'p>; 2],
        clock: f64,
    ) -> Self {
        let frames = [problem.a.path.frame(clock), problem.b.path.frame(clock)];
        let b_to_a = frames[0].transform_from(&frames[1]);
        PlacedPair {
            problem,
            frames,
            pieces: PiecePair { a, b, b_to_a },
            clock,
            height_evaluation_count: Cell::new(0),
        }
    }

    /// Places two other pieces at the same clock.
    pub(crate) fn with_pieces(&self, [a, b]: [Piece<'p>; 2]) -> Self {
        PlacedPair {
            pieces: PiecePair {
                a,
                b,
                ..self.pieces
            },
            height_evaluation_count: Cell::new(0),
            ..*self
        }
    }

    /// Calls the oracle, and checks its claim; `None` if the oracle gave up.
    pub(crate) fn query_oracle<O: DistanceOracle>(
        &self,
        oracle: &mut O,
        cache: &mut O::Cache,
        meter: &mut Meter,
    ) -> Option<CheckedClaim> {
        let stats = &mut meter.stats;
        stats.oracle_calls += 1;
        let before = oracle.effort().steps;
        let claim = oracle.separation(&self.pieces, cache);
        stats.point_evaluations += match oracle.effort().steps.saturating_sub(before) {
            0 => ASSUMED_ORACLE_STEPS * self.pieces.points_per_support_search(),
            steps => ASSUMED_ORACLE_STEPS * steps,
        };
        match claim {
            Ok(claim) => Some(separation::check_claim(
                &self.pieces,
                &claim,
                self.problem.rounding,
            )),
            Err(_) => {
                stats.give_ups += 1;
                None
            }
        }
    }

    /// Converts a checked claim about pieces `a` and `b` to a contact in world coordinates, with its features.
    pub(crate) fn contact(&self, [a, b]: [u32; 2], checked: &CheckedClaim) -> Contact {
        let (problem, a_to_world) = (self.problem, &self.frames[0]);
        let world = |x: DVec3| problem.to_world_point(a_to_world.transform_point(x));
        let feature = |side: &BodyWithPath<'_>, piece: u32, point: &ConvexCombination| {
            side.body.feature(piece, point)
        };
        Contact {
            separation: Separation {
                lower: checked.lower,
                upper: checked.upper,
                normal: unit(a_to_world.rotation * checked.axis).unwrap_or(checked.axis),
                witness_a: world(checked.witness_a),
                witness_b: world(checked.witness_b),
            },
            feature_a: feature(&problem.a, a, &checked.claim.a),
            feature_b: feature(&problem.b, b, &checked.claim.b),
            piece_a: problem.a.index_in_given_body(a),
            piece_b: problem.b.index_in_given_body(b),
        }
    }

    /// Returns the overlap of two pieces of many points along the axis between their middles, as a share of the smaller
    /// bounding radius. It is negative if the pieces are apart along the axis; `None` if a piece has few points.
    #[cfg(feature = "hull-tree")]
    pub(crate) fn relative_overlap_along_center_line(&self) -> Option<f64> {
        let pair = &self.pieces;
        let ((a, radius_a), (b, radius_b)) = (pair.a.bounding_ball()?, pair.b.bounding_ball()?);
        let axis = unit(pair.b_to_a.transform_point(b) - a)?;
        let gap = separation::support_gap(pair, axis, a) - pair.a.radius - pair.b.radius;
        Some(-gap / lesser(radius_a, radius_b))
    }

    /// Returns the gap of the pieces along a unit vector, minus rounding. The vector, and the point from which heights
    /// are measured, are in A's frame.
    pub(crate) fn gap_along(&self, axis: DVec3, from: DVec3) -> f64 {
        let radii = self.pieces.a.radius + self.pieces.b.radius;
        separation::support_gap(&self.pieces, axis, from) - radii - self.problem.rounding
    }

    /// Returns the pieces of A and of B with their motions.
    pub(crate) fn moving_pieces(&self) -> [MovingPiece<'_>; 2] {
        let Problem { a, b, .. } = self.problem;
        let [frame_a, frame_b] = &self.frames;
        [
            MovingPiece::new(a, frame_a, self.pieces.a, self.clock),
            MovingPiece::new(b, frame_b, self.pieces.b, self.clock),
        ]
    }

    pub(super) fn record_evaluations(&self, points: u64) {
        self.height_evaluation_count
            .set(self.height_evaluation_count.get() + points);
    }

    pub(super) fn time_left(&self) -> f64 {
        1.0 - self.clock
    }
}
