//! Checks every answer against the referee's findings and against the bodies.

mod questions;

use crate::distances::{
    distance_to_mesh, distance_to_mesh_feature, distance_to_part_feature, distance_to_piece,
};
use crate::models::PieceKind;
use crate::query::{Bodies, MovingShape, Query};
use crate::referee::{Finding, Referee, RelativeMotion};
use ccd_core::glam::DVec3;
use ccd_core::order::greater;
use ccd_core::{Answer, Body, Contact, Feature, Outcome, Overlap, Piece, Separation, Settings};

/// A judge of the answers to one query, which compares them with the referee's findings.
pub struct Judge<'a> {
    query: &'a Query,
    config: Settings,
    referee: Referee<'a>,
    finding: Finding,
    are_nested: bool,
    /// Pairs of a time and the distance of the bodies at that time, at 17 even times.
    samples: Vec<(f64, f64)>,
}

/// The result of a check: `Ok`, or the reason why the answer is wrong.
pub type CheckResult = Result<(), String>;

/// Returns an error with the given reason unless the condition holds; a comparison with NaN does not hold.
#[macro_export]
macro_rules! law {
    ($holds:expr, $($why:tt)*) => {{
        let holds: bool = $holds;
        if !holds {
            return Err(format!($($why)*));
        }
    }};
}

impl<'a> Judge<'a> {
    /// Creates the judge of a query, and runs the referee.
    pub fn new(query: &'a Query, config: &Settings) -> Self {
        let referee = Referee::with_margin(query, config.margin);
        let time = |k: u32| query.duration * f64::from(k) / 16.0;
        Judge {
            query,
            config: config.clone(),
            finding: referee.finding(),
            are_nested: referee.are_nested(0.0),
            samples: (0..=16).map(|k| (time(k), referee.gap(time(k)))).collect(),
            referee,
        }
    }

    /// Returns the judge with another tolerance, without running the referee again.
    pub fn with_tolerance(self, tolerance: f64) -> Self {
        let config = Settings {
            tolerance,
            ..self.config.clone()
        };
        Judge { config, ..self }
    }

    /// Returns the settings of the answers that are judged.
    pub fn config(&self) -> Settings {
        self.config.clone()
    }

    /// Returns the referee's finding about the first contact.
    pub fn finding(&self) -> Finding {
        self.finding
    }

    /// Returns true if one solid contains the other at the start.
    pub fn are_nested(&self) -> bool {
        self.are_nested
    }

    /// Checks an answer under `StartPolicy::Report`: it is resolved, not late and not false, and its contact is as
    /// claimed.
    ///
    /// # Errors
    /// Describes how the answer is wrong.
    pub fn check(&self, answer: &Answer, bodies: &Bodies) -> CheckResult {
        self.check_time(answer, 0.0)?;
        let reach = self.config.margin + answer.tolerance + self.query.rounding();
        match &answer.outcome {
            Outcome::Contact { time, contact } => {
                check_contact(self.query, *time, contact, bodies, reach)
            }
            Outcome::Touching { contact } => check_contact(self.query, 0.0, contact, bodies, reach),
            Outcome::Overlapping { overlap, .. } => self.check_overlap(overlap, bodies),
            Outcome::Free { .. } => Ok(()),
            Outcome::Unresolved(_) => Err("unresolved".into()),
            other => Err(format!("no outcome of a first contact: {other:?}")),
        }
    }

    /// Checks that the time of an answer is neither late nor false. The answer may be to an equivalent query that
    /// rounds by `more` than this one.
    ///
    /// # Errors
    /// Describes how the answer is wrong.
    pub fn check_time(&self, answer: &Answer, more: f64) -> CheckResult {
        let rounding = self.query.rounding() + more;
        law!(
            answer.tolerance >= self.config.tolerance,
            "the tolerance was lowered"
        );
        let reach = self.config.margin + answer.tolerance + rounding;
        match &answer.outcome {
            Outcome::Contact { time, .. } => {
                self.check_not_late(*time)?;
                let gap = self.referee.gap(*time);
                law!(gap <= reach, "false: the distance at {time} is {gap}");
            }
            Outcome::Free { proven_gap } => {
                law!(
                    self.finding.proven_contact_time().is_none(),
                    "missed: {:?}",
                    self.finding
                );
                law!(!self.are_nested, "missed: one body is inside the other");
                let less = self.samples.iter().find(|s| s.1 < proven_gap - rounding);
                law!(
                    less.is_none(),
                    "the proven gap {proven_gap} is less at {less:?}"
                );
            }
            Outcome::Touching { .. } => {
                let gap = self.referee.gap(0.0);
                law!(gap <= reach, "false: the distance at the start is {gap}");
            }
            Outcome::Overlapping { .. } => {}
            Outcome::Unresolved(known) => self.check_not_late(known.safe_until)?,
            other => return Err(format!("no outcome of a first contact: {other:?}")),
        }
        Ok(())
    }

    /// Checks that a time is within the duration, and not after a contact that the referee has proven.
    ///
    /// # Errors
    /// If the time is after a proven contact.
    pub fn check_not_late(&self, time: f64) -> CheckResult {
        let in_range = (0.0..=self.query.duration).contains(&time);
        law!(in_range, "the time {time} is not within the duration");
        match self.finding {
            Finding::Hit { hi, .. } => law!(time <= hi, "late: {time} > {hi}"),
            Finding::ContactAtStart => law!(time == 0.0, "late: {time} > 0"),
            _ => {}
        }
        Ok(())
    }

    /// Returns true if a point of a piece at the start is inside its body's solid or on its mesh. The body is A (0) or
    /// B (1). Parts are not checked, because they need not be closed together.
    fn may_lie_in_body(&self, body: usize, point: DVec3, kind: PieceKind) -> bool {
        let placements = RelativeMotion::pair(self.query);
        let to_world = |p| placements[body].point_position_at(0.0, p) + placements[0].origin();
        let mesh = &[&self.query.a, &self.query.b][body].shape.mesh;
        kind == PieceKind::ConvexParts
            || kind != PieceKind::Triangles && self.referee.contains_at_start(body, point)
            || distance_to_mesh(point, mesh, to_world) <= self.query.rounding()
    }

    fn check_overlap(&self, overlap: &Overlap, bodies: &Bodies) -> CheckResult {
        match overlap {
            Overlap::Pieces(contact) => {
                let gap = self.referee.gap(0.0);
                let both = [contact.separation.witness_a, contact.separation.witness_b];
                let inside =
                    || (0..2).all(|k| self.may_lie_in_body(k, both[k], bodies.piece_kinds[k]));
                law!(
                    gap <= self.query.rounding() || inside(),
                    "false: overlap at distance {gap}"
                );
                law!(
                    both[0].distance(both[1]) <= self.query.rounding(),
                    "not in both: {both:?}"
                );
                check_contact(self.query, 0.0, contact, bodies, f64::INFINITY)
            }
            Overlap::AInsideB(p) => {
                law!(self.referee.contains_at_start(1, *p), "{p} is not inside B");
                Ok(())
            }
            Overlap::BInsideA(p) => {
                law!(self.referee.contains_at_start(0, *p), "{p} is not inside A");
                Ok(())
            }
        }
    }
}

/// Checks the witnesses, the normal, the bounds and the features of a contact.
///
/// # Errors
/// Describes what is wrong about the contact.
pub fn check_contact(
    query: &Query,
    time: f64,
    contact: &Contact,
    bodies: &Bodies,
    reach: f64,
) -> CheckResult {
    let rounding = query.rounding();
    check_separation(&contact.separation, [reach, rounding])?;
    let Separation {
        lower,
        normal,
        witness_a,
        witness_b,
        ..
    } = contact.separation;
    let placements = RelativeMotion::pair(query);
    // Placements are relative to A's center, but witnesses are not.
    let drift = placements[0].origin() + time * query.a.motion.velocity();
    let side_a = ContactSide {
        moving_shape: &query.a,
        body: bodies.a(),
        kind: bodies.piece_kinds[0],
        piece: contact.piece_a,
        to_world: &|p| placements[0].point_position_at(time, p) + drift,
    };
    let side_b = ContactSide {
        moving_shape: &query.b,
        body: bodies.b(),
        kind: bodies.piece_kinds[1],
        piece: contact.piece_b,
        to_world: &|p| placements[1].point_position_at(time, p) + drift,
    };
    side_a
        .check_witness(witness_a, contact.feature_a, [reach, rounding])
        .map_err(|e| format!("A: {e}"))?;
    side_b
        .check_witness(witness_b, contact.feature_b, [reach, rounding])
        .map_err(|e| format!("B: {e}"))?;
    let gap = -side_a.support(normal)? - side_b.support(-normal)?;
    law!(
        gap >= lower - rounding,
        "lower {lower}, but the gap along the normal is {gap}"
    );
    Ok(())
}

/// Checks the bounds, the normal and the distance of the witnesses of a separation.
fn check_separation(separation: &Separation, [reach, rounding]: [f64; 2]) -> CheckResult {
    let Separation {
        lower,
        upper,
        normal,
        witness_a,
        witness_b,
    } = *separation;
    law!(
        (normal.length() - 1.0).abs() <= 1e-12,
        "no unit normal: {normal}"
    );
    law!(lower <= upper, "lower {lower} > upper {upper}");
    law!(upper <= reach, "upper {upper} > {reach}");
    let distance = witness_a.distance(witness_b);
    law!(
        distance <= upper + rounding,
        "the witnesses are {distance} apart, not {upper}"
    );
    law!(
        distance >= lower - rounding,
        "the witnesses are {distance} apart, not {lower}"
    );
    let along = (witness_b - witness_a).dot(normal);
    law!(
        along >= lower - rounding,
        "the normal {normal} does not point from A to B"
    );
    Ok(())
}

/// One of the two bodies of a contact, with the piece in contact.
struct ContactSide<'a> {
    moving_shape: &'a MovingShape,
    body: &'a Body,
    kind: PieceKind,
    piece: u32,
    to_world: &'a dyn Fn(DVec3) -> DVec3,
}

impl ContactSide<'_> {
    fn piece(&self) -> Result<Piece<'_>, String> {
        law!(
            (self.piece as usize) < self.body.pieces().len(),
            "there is no piece {}",
            self.piece
        );
        Ok(self.body.pieces().get(self.piece as usize))
    }

    /// Returns the support function of the piece in contact: its largest coordinate along an axis, in the world.
    fn support(&self, axis: DVec3) -> Result<f64, String> {
        let piece = self.piece()?;
        let along = piece.points.iter().map(|&p| (self.to_world)(p).dot(axis));
        Ok(along.fold(f64::NEG_INFINITY, greater) + piece.radius)
    }

    fn check_witness(
        &self,
        witness: DVec3,
        feature: Feature,
        [reach, rounding]: [f64; 2],
    ) -> CheckResult {
        let off = distance_to_piece(witness, &self.piece()?, self.to_world);
        law!(off <= rounding, "the witness is {off} off its piece");
        let shape = &self.moving_shape.shape;
        let off = match self.kind {
            PieceKind::Patches | PieceKind::Hull if matches!(feature, Feature::Piece(_)) => {
                // A virtual facet is inside the surface, which is then nearer to the other body.
                let off = distance_to_mesh(witness, &shape.mesh, self.to_world);
                law!(
                    off <= reach + rounding,
                    "the surface is {off} from {feature}"
                );
                0.0
            }
            PieceKind::Triangles | PieceKind::Patches | PieceKind::Hull => {
                distance_to_mesh_feature(witness, feature, &shape.mesh, self.to_world)?
            }
            PieceKind::ConvexParts => {
                distance_to_part_feature(witness, feature, &shape.parts, self.to_world)?
            }
        };
        law!(
            off <= rounding,
            "the witness is {off} off its feature {feature}"
        );
        Ok(())
    }
}
