//! Judges the engine's answers by the referee's distances.

mod start;

use crate::case::{Case, Expectation};
use crate::double::DoubleDouble;
use crate::engine::{Bodies, Method};
use crate::nearest::{Triangle, distance, penetration_depth};
use crate::referee::{ContactCriterion, MarginViolation, Scene};
use crate::solid::{PointLocation, Solid, distance_to_surface};
use crate::vector::{Number, Vector, larger, smaller};
use ccd_core::Unresolved;
use ccd_core::{Answer, Contact, Outcome, Overlap, Piece, Solidity, StartPolicy};
use start::StartState;

/// The allowed decrease of the distance from that at the start under `StartPolicy::Leave`, in units of the rounding
/// bound.
const MAX_DISTANCE_DECREASE_FACTOR: f64 = 1.0;

/// A kind of fault of an answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Fault {
    /// The bodies were nearer than allowed before the reported time.
    Late,
    /// The bodies were nearer than allowed, and no contact was reported.
    Missed,
    /// A contact is reported although the bodies are farther apart than margin and tolerance.
    FalseContact,
    /// Touching or overlap at the start is reported although the bodies are apart.
    FalseStartContact,
    /// The bodies overlap at the start, which is not reported.
    MissedOverlap,
    /// A reported lower bound is above the distance.
    WrongLowerBound,
    /// A reported upper bound is below the distance.
    WrongUpperBound,
    /// A witness point is not on its body.
    WrongWitness,
    /// A proven gap is larger than the distance.
    WrongProvenGap,
    /// The bodies of an unresolved query were in contact before the certified time.
    FalseSafeTime,
    /// The answers of two methods contradict each other.
    Disagreement,
    Panic,
    Hang,
}

/// An answer, with the method that gave it.
pub struct MethodAnswer<'a> {
    pub bodies: &'a Bodies,
    pub method: Method,
    pub answer: Answer,
}

/// A judge of the answers to one case, which compares them with the referee's distances.
pub struct Judge<'a> {
    case: &'a Case,
    scene: Scene,
    /// The least tolerance that the engine accepts, which bounds the rounding errors of its distances.
    rounding: f64,
    start: StartState,
    /// The closed surfaces of both bodies at the start.
    solids_at_start: [Solid; 2],
    volume_kinds: [Solidity; 2],
}

pub type Faults = Vec<(Fault, String)>;

impl<'a> Judge<'a> {
    pub fn new(case: &'a Case, volumes: [Solidity; 2], rounding: f64) -> Self {
        let scene = Scene::new(case);
        let placed = [0, 1].map(|side| Solid::new(scene.triangles_at(side, 0.0)));
        let start = StartState::new(&scene, &placed, volumes, rounding);
        Judge {
            case,
            scene,
            rounding,
            start,
            solids_at_start: placed,
            volume_kinds: volumes,
        }
    }

    /// Returns the faults of all answers, each with the index of its answer. The flag is true if the search for
    /// earlier contacts was complete.
    pub fn faults(&self, given: &[MethodAnswer<'_>]) -> (Vec<(usize, Fault, String)>, bool) {
        let times = given
            .iter()
            .map(|g| self.proven_free_until(&g.answer.outcome));
        let until = times.fold(0.0, larger);
        let (evidence, proven) = self
            .scene
            .first_violation(self.contact_criterion(given), until);
        let mut faults = Vec::new();
        for (k, one) in given.iter().enumerate() {
            let found = self.faults_of_answer(one, evidence).into_iter();
            faults.extend(found.map(|(fault, text)| (k, fault, text)));
        }
        faults.extend(self.disagreements(given));
        (faults, proven)
    }

    /// Returns the time until which an answer proves that there is no contact.
    fn proven_free_until(&self, outcome: &Outcome) -> f64 {
        match *outcome {
            Outcome::Contact { time, .. } => time,
            Outcome::Free { .. } => self.case.duration,
            Outcome::Unresolved(known) => known.safe_until,
            _ => 0.0,
        }
    }

    /// Returns the limits of distance and of penetration depth at which the bodies count as nearer than allowed.
    fn contact_criterion(&self, given: &[MethodAnswer<'_>]) -> ContactCriterion {
        let margin = self.case.config.margin;
        let tolerance = given
            .iter()
            .map(|g| g.answer.tolerance)
            .fold(self.rounding, larger);
        let begun = self.start.distance <= margin + tolerance;
        match self.case.config.start_policy {
            StartPolicy::Leave if begun && self.start.distance < margin + self.rounding => {
                ContactCriterion {
                    distance_threshold: self.required_distance(margin),
                    depth: self.rounding,
                }
            }
            _ => {
                let gaps = given.iter().filter_map(|g| match g.answer.outcome {
                    Outcome::Free { proven_gap } => Some(proven_gap),
                    _ => None,
                });
                ContactCriterion {
                    distance_threshold: gaps.fold(margin, larger),
                    depth: 0.0,
                }
            }
        }
    }

    fn faults_of_answer(
        &self,
        given: &MethodAnswer<'_>,
        evidence: Option<MarginViolation>,
    ) -> Faults {
        let answer = &given.answer;
        let mut faults = self.check_expected_outcome(&answer.outcome);
        let mut say = |fault, text| faults.push((fault, text));
        let margin = self.case.config.margin;
        let proven = self.proven_free_until(&answer.outcome);
        let before = evidence.filter(|e| e.time < proven || proven == self.case.duration);
        let below_margin = |e: &MarginViolation| {
            !(e.distance > 0.0) || e.distance < self.required_distance(margin)
        };
        let early = before.filter(below_margin);
        let known = |e: MarginViolation| {
            let MarginViolation {
                time,
                distance,
                depth,
            } = e;
            format!(
                "at {time:e} {distance:e} apart, {depth:e} deep, {:?}",
                answer.outcome
            )
        };
        let overlaps = self.start.certainly_overlaps;
        match answer.outcome {
            Outcome::Contact { .. } | Outcome::Free { .. } | Outcome::Touching { .. }
                if overlaps =>
            {
                say(Fault::MissedOverlap, format!("{:?}", answer.outcome));
            }
            Outcome::Contact { time, contact } => {
                early.into_iter().for_each(|e| say(Fault::Late, known(e)));
                faults.extend(self.check_contact(given, &contact, time));
            }
            Outcome::Free { proven_gap } => match (early, before) {
                (Some(e), _) => say(Fault::Missed, known(e)),
                (None, Some(e)) if e.distance < proven_gap - self.scene.distance_error_bound() => {
                    say(Fault::WrongProvenGap, known(e));
                }
                _ => {}
            },
            Outcome::Touching { contact } => {
                faults.extend(self.check_contact(given, &contact, 0.0));
            }
            Outcome::Overlapping { overlap, .. } => {
                faults.extend(self.check_overlap(given, &overlap));
            }
            Outcome::Unresolved(Unresolved { safe_until, .. }) => {
                if overlaps && safe_until > 0.0 {
                    say(
                        Fault::FalseSafeTime,
                        format!("overlapping, {:?}", answer.outcome),
                    );
                }
                early
                    .into_iter()
                    .for_each(|e| say(Fault::FalseSafeTime, known(e)));
            }
            Outcome::Interval { .. } | Outcome::LeastDistance { .. } => {
                unreachable!("no outcome of a first contact")
            }
        }
        faults
    }

    /// Returns the distance below which the bodies are nearer than allowed: the margin, or less under
    /// `StartPolicy::Leave`. Then it is at most the distance at the start, less rounding.
    fn required_distance(&self, margin: f64) -> f64 {
        match self.case.config.start_policy {
            StartPolicy::Leave => smaller(
                margin,
                self.start.distance - MAX_DISTANCE_DECREASE_FACTOR * self.rounding,
            ),
            StartPolicy::Report => margin,
        }
    }

    fn check_expected_outcome(&self, outcome: &Outcome) -> Faults {
        let wrong = match (self.case.expected, *outcome) {
            (_, Outcome::Unresolved(_)) | (Expectation::Unknown, _) => None,
            (Expectation::Free, Outcome::Free { .. }) => None,
            (Expectation::Free, _) => Some(Fault::FalseContact),
            (Expectation::ContactBy(t), Outcome::Contact { time, .. }) => {
                (time > t).then_some(Fault::Late)
            }
            (Expectation::ContactBy(_), Outcome::Free { .. }) => Some(Fault::Missed),
            (Expectation::ContactBy(_), _) => None,
        };
        let text = || format!("expected {:?}, {outcome:?}", self.case.expected);
        wrong.into_iter().map(|fault| (fault, text())).collect()
    }

    /// Checks the distance, the bounds and the witnesses of a contact at a time.
    fn check_contact(&self, given: &MethodAnswer<'_>, contact: &Contact, time: f64) -> Faults {
        let mut faults = Vec::new();
        let (scene, error) = (&self.scene, self.scene.distance_error_bound());
        let found = contact.separation;
        let reported = self.case.config.margin + given.answer.tolerance;
        let text = |d: f64| format!("distance {d:e}, {:?}", given.answer.outcome);
        let mut d = scene.distance(time);
        if d > reported + error || d > found.upper + error {
            d = scene.all_pairs_distance(time);
        }
        // A piece may extend through the interior of its solid, where the surfaces are farther apart.
        let inside = || self.is_witness_inside(contact, time);
        if d > reported + error && !inside() {
            let fault = if time > 0.0 {
                Fault::FalseContact
            } else {
                Fault::FalseStartContact
            };
            faults.push((fault, text(d)));
        }
        if d > found.upper + error && !inside() {
            faults.push((Fault::WrongUpperBound, text(d)));
        }
        // At the start this is the distance of the bodies, later that of the pair.
        let lower = if time > 0.0 {
            self.piece_distance(given.bodies, contact, time)
        } else {
            Some(d)
        };
        if let Some(d) = lower.filter(|d| found.lower > d + error) {
            faults.push((Fault::WrongLowerBound, format!("pieces {}", text(d))));
        }
        if let Some(off) = self.witness_or_normal_error(contact, time) {
            faults.push((Fault::WrongWitness, format!("off by {off:e}, {}", text(d))));
        }
        faults
    }

    /// Returns true if a witness on one body is inside the other body's solid.
    fn is_witness_inside(&self, contact: &Contact, time: f64) -> bool {
        let origin = self.scene.snapshots(time)[0].center;
        let found = contact.separation;
        [(0, found.witness_b), (1, found.witness_a)]
            .into_iter()
            .any(|(outer, witness)| {
                let solid = Solid::new(self.scene.triangles_at(outer, time));
                let point = Vector::from_array(witness.to_array()) - origin;
                self.volume_kinds[outer] == Solidity::Solid
                    && solid.locate(point) == PointLocation::Inside
            })
    }

    /// Returns the largest error of a contact's witnesses and normal; `None` if it is within rounding. The error of a
    /// witness is its distance from its body, or the excess of the witnesses' distance over the contact's upper bound.
    fn witness_or_normal_error(&self, contact: &Contact, time: f64) -> Option<f64> {
        let origin = self.scene.snapshots(time)[0].center;
        let found = contact.separation;
        let witnesses = [found.witness_a, found.witness_b].map(|w| Vector(w.to_array()));
        let far = witnesses
            .iter()
            .fold(0.0, |m, w| larger(m, w.max_absolute_component()));
        let far = larger(far, origin.max_absolute_component());
        let allowed = 1e-12 * (self.scene.scale + far) + 16.0 * self.rounding;
        let mut off = [0, 1].map(|k| {
            let placed = self.scene.triangles_at(k, time);
            let point = Vector::from_array(witnesses[k].0) - origin;
            let off = distance_to_surface(point, &placed);
            // A piece may extend through the interior of its solid.
            let may = self.volume_kinds[k] == Solidity::Solid && off > allowed;
            if may && Solid::new(placed).locate(point) != PointLocation::Outside {
                0.0
            } else {
                off
            }
        });
        off.sort_by(f64::total_cmp);
        let way = (witnesses[0] - witnesses[1]).length();
        let long = larger(0.0, way - found.upper);
        let unit = (found.normal.length() - 1.0).abs();
        let bent = if unit < 1e-12 { 0.0 } else { f64::INFINITY };
        let most = larger(larger(off[1], long), bent);
        (most > allowed).then_some(most)
    }

    fn piece_distance(&self, bodies: &Bodies, contact: &Contact, time: f64) -> Option<f64> {
        let [a, b] = self.piece_triangles(bodies, contact, time)?;
        let pairs = a
            .iter()
            .flat_map(|s| b.iter().map(move |t| distance(s, t).to_f64()));
        Some(pairs.fold(f64::INFINITY, smaller))
    }

    fn piece_triangles(
        &self,
        bodies: &Bodies,
        contact: &Contact,
        time: f64,
    ) -> Option<[Vec<Triangle<DoubleDouble>>; 2]> {
        let snapshots = self.scene.snapshots(time);
        let side = |k: usize, piece: u32| {
            let piece = bodies.bodies[k].pieces().get(piece as usize);
            let track = &self.scene.sides[k].track;
            let to_world = |p: [f64; 3]| {
                snapshots[k].world_arm(Vector::from_array(p) - track.center)
                    + (snapshots[k].center - snapshots[0].center)
            };
            Some(
                piece_surface(&piece)?
                    .into_iter()
                    .map(|t| t.map(to_world))
                    .collect(),
            )
        };
        Some([side(0, contact.piece_a)?, side(1, contact.piece_b)?])
    }

    fn check_overlap(&self, given: &MethodAnswer<'_>, overlap: &Overlap) -> Faults {
        let text = || {
            format!(
                "distance {:e}, {:?}",
                self.start.distance, given.answer.outcome
            )
        };
        let wrong = match *overlap {
            Overlap::Pieces(contact) => {
                self.start.distance > self.rounding && !self.start.may_contain
                    || self.are_disjoint_triangles(given.bodies, &contact)
            }
            Overlap::AInsideB(p) => !self.is_inside(p.to_array(), 1),
            Overlap::BInsideA(p) => !self.is_inside(p.to_array(), 0),
        };
        wrong
            .then(|| (Fault::FalseStartContact, text()))
            .into_iter()
            .collect()
    }

    /// Returns true if the pieces of a reported overlap are two triangles with disjoint interiors.
    fn are_disjoint_triangles(&self, bodies: &Bodies, contact: &Contact) -> bool {
        match self
            .piece_triangles(bodies, contact, 0.0)
            .as_ref()
            .map(|both| both.each_ref().map(|s| &s[..]))
        {
            Some([[s], [t]]) => !(penetration_depth(s, t).to_f64() > 0.0),
            _ => false,
        }
    }

    fn is_inside(&self, p: [f64; 3], outer: usize) -> bool {
        let point = Vector::from_array(p) - self.scene.snapshots(0.0)[0].center;
        let solid = &self.solids_at_start[outer];
        // Points are given in world coordinates, rounded.
        let near = 1e-12 * larger(self.scene.scale, Vector(p).max_absolute_component());
        solid.locate(point) != PointLocation::Outside
            || distance_to_surface(point, &solid.triangles) < near
    }

    /// Returns the contradictions between answers: one answer has a contact well within the tolerance, and another one
    /// proves that there is none until later.
    fn disagreements(&self, given: &[MethodAnswer<'_>]) -> Vec<(usize, Fault, String)> {
        let mut faults = Vec::new();
        if self.case.config.start_policy == StartPolicy::Leave {
            return faults;
        }
        for one in given {
            let Outcome::Contact { time, .. } = one.answer.outcome else {
                continue;
            };
            let d = self.scene.distance(time);
            for (k, other) in given.iter().enumerate() {
                let tolerance = smaller(one.answer.tolerance, other.answer.tolerance);
                let near = d < self.case.config.margin + 0.5 * tolerance
                    - self.scene.distance_error_bound();
                if near && self.proven_free_until(&other.answer.outcome) > time {
                    let text = format!("{d:e} apart at {time:e}, {:?}", other.answer.outcome);
                    faults.push((k, Fault::Disagreement, text));
                }
            }
        }
        faults
    }
}

/// Returns the triangles that bound a piece; `None` for a piece of more than three points without facets.
fn piece_surface(piece: &Piece<'_>) -> Option<Vec<[[f64; 3]; 3]>> {
    let at = |k: u32| piece.points[k as usize].to_array();
    if let Some(last) = (piece.points.len() as u32)
        .checked_sub(1)
        .filter(|&last| last < 3)
    {
        return Some(vec![[at(0), at(1.min(last)), at(last)]]);
    }
    let loops = piece.facets.iter();
    let fans =
        loops.flat_map(|l| (1..l.len() - 1).map(move |k| [at(l[0]), at(l[k]), at(l[k + 1])]));
    (!piece.facets.is_empty()).then(|| fans.collect())
}
