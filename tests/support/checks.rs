//! What every answer owes, checked against the referee and against the bodies themselves.

use crate::models::{Kind, Mesh};
use crate::query::{Actor, Bodies, Query};
use crate::referee::{Placement, Referee, Verdict, point_segment, point_triangle};
use ccd_core::glam::DVec3;
use ccd_core::{
    Answer, Body, Config, Contact, Feature, Origin, Outcome, Overlap, Piece, Polytope, Separation,
};

/// Holds answers to one query against what the referee saw of it.
pub struct Judge<'a> {
    query: &'a Query,
    config: Config,
    referee: Referee<'a>,
    verdict: Verdict,
    nested: bool,
    /// The least distance at a few sampled times.
    samples: Vec<(f64, f64)>,
}

/// Holds, or says why not.
pub type Law = Result<(), String>;

/// Returns the reason unless the condition holds; comparisons with NaN do not.
macro_rules! law {
    ($holds:expr, $($why:tt)*) => {{
        let holds: bool = $holds;
        if !holds {
            return Err(format!($($why)*));
        }
    }};
}

impl<'a> Judge<'a> {
    /// Lets the referee look at a query.
    pub fn new(query: &'a Query, config: &Config) -> Self {
        let referee = Referee::with_margin(query, config.margin);
        let time = |k: u32| query.duration * f64::from(k) / 16.0;
        Judge {
            query,
            config: *config,
            verdict: referee.verdict(),
            nested: referee.nested(0.0),
            samples: (0..=16).map(|k| (time(k), referee.gap(time(k)))).collect(),
            referee,
        }
    }

    /// The same judge of another tolerance; the referee need not look again.
    pub fn with_tolerance(self, tolerance: f64) -> Self {
        let config = Config {
            tolerance,
            ..self.config
        };
        Judge { config, ..self }
    }

    /// What the referee saw.
    pub fn verdict(&self) -> Verdict {
        self.verdict
    }

    /// Whether one solid holds the other at the start.
    pub fn nested(&self) -> bool {
        self.nested
    }

    /// Checks an answer under the start policy `Report`: never late, never false, tight, resolved,
    /// its contact as claimed.
    ///
    /// # Errors
    /// Which law the answer breaks.
    pub fn check(&self, answer: &Answer, bodies: &Bodies) -> Law {
        self.check_time(answer, 0.0)?;
        let reach = self.config.margin + answer.tolerance + self.query.rounding();
        match &answer.outcome {
            Outcome::Contact { time, contact } => {
                check_contact(self.query, *time, contact, bodies, reach)
            }
            Outcome::Touching { contact } => check_contact(self.query, 0.0, contact, bodies, reach),
            Outcome::Overlapping { overlap } => self.check_overlap(overlap, bodies),
            Outcome::Free { .. } => Ok(()),
            Outcome::Unresolved { .. } => Err("unresolved".into()),
        }
    }

    /// Checks what an answer says of the time alone, so that it may be the answer to this query in
    /// another guise, one that rounds by `more` than this one.
    ///
    /// # Errors
    /// Which law the answer breaks.
    pub fn check_time(&self, answer: &Answer, more: f64) -> Law {
        let rounding = self.query.rounding() + more;
        law!(
            answer.tolerance >= self.config.tolerance,
            "the tolerance was lowered"
        );
        let reach = self.config.margin + answer.tolerance + rounding;
        match &answer.outcome {
            Outcome::Contact { time, .. } => {
                self.never_late(*time)?;
                let gap = self.referee.gap(*time);
                law!(gap <= reach, "false: the distance at {time} is {gap}");
            }
            Outcome::Free { clearance } => {
                law!(
                    self.verdict.latest().is_none(),
                    "missed: {:?}",
                    self.verdict
                );
                law!(!self.nested, "missed: one body is inside of the other");
                let less = self.samples.iter().find(|s| s.1 < clearance - rounding);
                law!(
                    less.is_none(),
                    "the clearance {clearance} is less at {less:?}"
                );
            }
            Outcome::Touching { .. } => {
                let gap = self.referee.gap(0.0);
                law!(gap <= reach, "false: the distance at the start is {gap}");
            }
            Outcome::Overlapping { .. } => {}
            Outcome::Unresolved { safe_until, .. } => self.never_late(*safe_until)?,
        }
        Ok(())
    }

    /// Checks that a time is not past a contact that the referee is sure of.
    ///
    /// # Errors
    /// When it is.
    pub fn never_late(&self, time: f64) -> Law {
        let in_range = (0.0..=self.query.duration).contains(&time);
        law!(in_range, "the time {time} is not within the duration");
        match self.verdict {
            Verdict::Hit { hi, .. } => law!(time <= hi, "late: {time} > {hi}"),
            Verdict::Start => law!(time == 0.0, "late: {time} > 0"),
            _ => {}
        }
        Ok(())
    }

    /// Whether a point of a piece of body A (0) or B (1) is there by right although it is off the
    /// mesh: in the solid. Parts are taken at their word, as they need not be closed together.
    fn fills(&self, body: usize, point: DVec3, kind: Kind) -> bool {
        match kind {
            Kind::Triangles => true,
            Kind::Parts => true,
            Kind::Patches | Kind::Hull => self.referee.holds(body, point),
        }
    }

    fn check_overlap(&self, overlap: &Overlap, bodies: &Bodies) -> Law {
        match overlap {
            Overlap::Pieces(contact) => {
                let gap = self.referee.gap(0.0);
                let both = [contact.separation.witness_a, contact.separation.witness_b];
                let inside = (0..2).all(|k| self.fills(k, both[k], bodies.kinds[k]));
                law!(
                    gap <= self.query.rounding() || inside,
                    "false: overlap at distance {gap}"
                );
                law!(
                    both[0].distance(both[1]) <= self.query.rounding(),
                    "not in both: {both:?}"
                );
                check_contact(self.query, 0.0, contact, bodies, f64::INFINITY)
            }
            Overlap::AInsideB(p) => {
                law!(self.referee.holds(1, *p), "{p} is not inside of B");
                Ok(())
            }
            Overlap::BInsideA(p) => {
                law!(self.referee.holds(0, *p), "{p} is not inside of A");
                Ok(())
            }
        }
    }
}

/// Checks witnesses, normal, bounds and features of a contact.
///
/// # Errors
/// Which of them is wrong.
pub fn check_contact(
    query: &Query,
    time: f64,
    contact: &Contact,
    bodies: &Bodies,
    reach: f64,
) -> Law {
    let rounding = query.rounding();
    let Separation {
        lower,
        upper,
        normal,
        witness_a,
        witness_b,
    } = contact.separation;
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
    let places = Placement::pair(query);
    // Placements are relative to A's centre, witnesses are not.
    let drift = places[0].origin() + time * query.a.motion.velocity();
    let side_a = Side {
        actor: &query.a,
        body: bodies.a(),
        kind: bodies.kinds[0],
        piece: contact.piece_a,
        place: &|p| places[0].at(time, p) + drift,
    };
    let side_b = Side {
        actor: &query.b,
        body: bodies.b(),
        kind: bodies.kinds[1],
        piece: contact.piece_b,
        place: &|p| places[1].at(time, p) + drift,
    };
    side_a
        .check_witness(witness_a, contact.feature_a, rounding)
        .map_err(|e| format!("A: {e}"))?;
    side_b
        .check_witness(witness_b, contact.feature_b, rounding)
        .map_err(|e| format!("B: {e}"))?;
    let gap = -side_a.support(normal)? - side_b.support(-normal)?;
    law!(
        gap >= lower - rounding,
        "lower {lower}, but the gap along the normal is {gap}"
    );
    Ok(())
}

/// One body's side of a contact.
struct Side<'a> {
    actor: &'a Actor,
    body: &'a Body,
    kind: Kind,
    piece: u32,
    place: &'a dyn Fn(DVec3) -> DVec3,
}

impl Side<'_> {
    fn piece(&self) -> Result<Piece<'_>, String> {
        law!(
            (self.piece as usize) < self.body.pieces().len(),
            "there is no piece {}",
            self.piece
        );
        Ok(self.body.pieces().get(self.piece as usize))
    }

    /// The farthest that the touched piece reaches along an axis.
    fn support(&self, axis: DVec3) -> Result<f64, String> {
        let piece = self.piece()?;
        let along = piece.points.iter().map(|&p| (self.place)(p).dot(axis));
        Ok(along.fold(f64::NEG_INFINITY, f64::max) + piece.radius)
    }

    fn check_witness(&self, witness: DVec3, feature: Feature, rounding: f64) -> Law {
        let off = distance_to_piece(witness, &self.piece()?, self.place);
        law!(off <= rounding, "the witness is {off} off its piece");
        let shape = &self.actor.shape;
        let off = match self.kind {
            Kind::Triangles | Kind::Patches | Kind::Hull => {
                distance_to_mesh_feature(witness, feature, &shape.mesh, self.place)?
            }
            Kind::Parts => distance_to_part_feature(witness, feature, &shape.parts, self.place)?,
        };
        law!(
            off <= rounding,
            "the witness is {off} off its feature {feature}"
        );
        Ok(())
    }
}

/// How far a point is from a piece; 0 inside.
fn distance_to_piece(p: DVec3, piece: &Piece<'_>, place: impl Fn(DVec3) -> DVec3) -> f64 {
    let points: Vec<DVec3> = piece.points.iter().map(|&q| place(q)).collect();
    let core = match points[..] {
        [a] => a.distance(p),
        [a, b] => point_segment(p, [a, b]).distance(p),
        [a, b, c] => point_triangle(p, [a, b, c]).distance(p),
        _ => {
            let loops: Vec<Vec<DVec3>> = piece
                .facets
                .iter()
                .map(|corners| corners.iter().map(|&c| points[c as usize]).collect())
                .collect();
            let normal = |l: &[DVec3]| -> DVec3 {
                let fan = l.windows(2).skip(1);
                fan.map(|e| (e[0] - l[0]).cross(e[1] - l[0])).sum()
            };
            let height = |l: &Vec<DVec3>| normal(l).dot(p - l[0]);
            // A polygon has two facets, and no inside.
            if loops.len() != 2 && loops.iter().all(|l| height(l) <= 0.0) {
                0.0
            } else {
                loops
                    .iter()
                    .map(|l| distance_to_polygon(p, l))
                    .fold(f64::INFINITY, f64::min)
            }
        }
    };
    (core - piece.radius).max(0.0)
}

fn distance_to_mesh_feature(
    p: DVec3,
    feature: Feature,
    mesh: &Mesh,
    place: impl Fn(DVec3) -> DVec3,
) -> Result<f64, String> {
    let vertex = |v: u32| mesh.vertices.get(v as usize).map(|&q| place(q));
    let bad = || format!("the mesh has no {feature}");
    match feature {
        Feature::Vertex(v) => Ok(vertex(v).ok_or_else(bad)?.distance(p)),
        Feature::Edge(v, w) => {
            let side = |f: &[u32; 3]| f.contains(&v) && f.contains(&w);
            law!(mesh.faces.iter().any(side), "the mesh has no {feature}");
            let ends = [vertex(v).ok_or_else(bad)?, vertex(w).ok_or_else(bad)?];
            Ok(point_segment(p, ends).distance(p))
        }
        Feature::Face(f) => {
            law!((f as usize) < mesh.faces.len(), "the mesh has no {feature}");
            let corners = mesh.triangle(f as usize).map(place);
            Ok(point_triangle(p, corners).distance(p))
        }
        Feature::Piece(_) => Err("a triangle's feature has a better name".into()),
    }
}

fn distance_to_part_feature(
    p: DVec3,
    feature: Feature,
    parts: &[Polytope],
    place: impl Fn(DVec3) -> DVec3,
) -> Result<f64, String> {
    let mut nearest = f64::INFINITY;
    for part in parts {
        let id = |k: usize| part.vertex_ids.get(k).copied().unwrap_or(k as u32);
        let named = |v: u32| (0..part.points.len()).find(|&k| id(k) == v);
        let vertex = |v: u32| named(v).map(|k| place(part.points[k]));
        let distance = match feature {
            Feature::Vertex(v) => vertex(v).map(|q| q.distance(p)),
            Feature::Edge(v, w) => vertex(v)
                .zip(vertex(w))
                .map(|(v, w)| point_segment(p, [v, w]).distance(p)),
            Feature::Face(f) => face_of(part, f).map(|corners| {
                let corners: Vec<DVec3> = corners.into_iter().map(&place).collect();
                distance_to_polygon(p, &corners)
            }),
            // The inside: that the witness lies in the piece is checked elsewhere.
            Feature::Piece(_) => Some(0.0),
        };
        if let Some(distance) = distance {
            nearest = nearest.min(distance - part.radius);
        }
    }
    if nearest == f64::INFINITY {
        Err(format!("no part has {feature}"))
    } else {
        Ok(nearest)
    }
}

/// The corners of the face that a part has by a number.
fn face_of(part: &Polytope, face: u32) -> Option<Vec<DVec3>> {
    let mut facets = part.facets.iter();
    let whole = facets.find(|facet| facet.origin == Origin::Face(face));
    let corners = whole.map(|it| {
        it.corners
            .iter()
            .map(|&c| part.points[c as usize])
            .collect()
    });
    let triangle = || part.faces.iter().find(|it| it.id == face);
    corners.or_else(|| triangle().map(|it| it.corners.to_vec()))
}

fn distance_to_polygon(p: DVec3, corners: &[DVec3]) -> f64 {
    let fan =
        (1..corners.len().saturating_sub(1)).map(|k| [corners[0], corners[k], corners[k + 1]]);
    fan.map(|t| point_triangle(p, t).distance(p))
        .fold(f64::INFINITY, f64::min)
}
