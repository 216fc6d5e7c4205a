//! What every answer owes, checked against the referee and against the bodies themselves.

use crate::models::Kind;
use crate::query::Query;
use crate::referee::{Placement, Referee, Verdict, point_segment, point_triangle};
use ccd_core::glam::DVec3;
use ccd_core::{Answer, Body, Config, Contact, Feature, Outcome, Overlap, Piece, Separation};

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

type Law = Result<(), String>;

macro_rules! law {
    ($holds:expr, $($why:tt)*) => {
        if !$holds {
            return Err(format!($($why)*));
        }
    };
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

    /// What the referee saw.
    pub fn verdict(&self) -> Verdict {
        self.verdict
    }

    /// Whether one solid holds the other at the start.
    pub fn nested(&self) -> bool {
        self.nested
    }

    /// Checks an answer under the start policy `Report`: never late, never false, tight, resolved.
    ///
    /// # Errors
    /// Which law the answer breaks.
    pub fn check(&self, answer: &Answer, bodies: [(&Body, Kind); 2]) -> Law {
        let rounding = self.query.rounding();
        law!(answer.tolerance >= self.config.tolerance, "the tolerance was lowered");
        let reach = self.config.margin + answer.tolerance + rounding;
        match &answer.outcome {
            Outcome::Contact { time, contact } => {
                self.never_late(*time)?;
                let gap = self.referee.gap(*time);
                law!(gap <= reach, "false: the distance at {time} is {gap}");
                self.check_contact(*time, contact, bodies, reach)
            }
            Outcome::Free { clearance } => {
                law!(self.verdict.latest().is_none(), "missed: {:?}", self.verdict);
                law!(!self.nested, "missed: one body is inside of the other");
                let less = self.samples.iter().find(|s| s.1 < clearance - rounding);
                law!(less.is_none(), "the clearance {clearance} is less at {less:?}");
                Ok(())
            }
            Outcome::Touching { contact } => {
                let gap = self.referee.gap(0.0);
                law!(gap <= reach, "false: the distance at the start is {gap}");
                law!(contact.separation.upper <= reach, "touching from afar: {contact:?}");
                self.check_contact(0.0, contact, bodies, reach)
            }
            Outcome::Overlapping { overlap } => self.check_overlap(overlap, bodies),
            Outcome::Unresolved { .. } => Err("unresolved".into()),
        }
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

    fn check_overlap(&self, overlap: &Overlap, bodies: [(&Body, Kind); 2]) -> Law {
        match overlap {
            Overlap::Pieces(contact) => {
                let gap = self.referee.gap(0.0);
                let rounding = self.query.rounding();
                let filled = bodies.iter().any(|(_, kind)| *kind == Kind::Parts);
                law!(gap <= rounding || filled, "false: no overlap at distance {gap}");
                self.check_contact(0.0, contact, bodies, f64::INFINITY)
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

    /// Checks witnesses, normal, bounds and features of a contact.
    ///
    /// # Errors
    /// Which of them is wrong.
    pub fn check_contact(
        &self,
        time: f64,
        contact: &Contact,
        bodies: [(&Body, Kind); 2],
        reach: f64,
    ) -> Law {
        let rounding = self.query.rounding();
        let places = Placement::pair(self.query);
        let separation = &contact.separation;
        let Separation { lower, upper, normal, witness_a, witness_b } = separation;
        law!((normal.length() - 1.0).abs() <= 1e-12, "no unit normal: {normal}");
        law!(lower <= upper, "lower {lower} > upper {upper}");
        law!(*upper <= reach, "upper {upper} > {reach}");
        let distance = witness_a.distance(*witness_b);
        law!(distance <= upper + rounding, "the witnesses are {distance} apart, not {upper}");
        law!(distance >= lower - rounding, "the witnesses are {distance} apart, not {lower}");
        let mut ends = [f64::NEG_INFINITY, f64::INFINITY];
        for (k, (body, kind)) in bodies.into_iter().enumerate() {
            let piece = [contact.piece_a, contact.piece_b][k] as usize;
            law!(piece < body.pieces().len(), "there is no piece {piece}");
            let piece = body.pieces().get(piece);
            // As A's centre moves in the world, so does everything that is relative to it.
            let drift = places[0].origin() + time * self.query.a.motion.velocity();
            let place = |p: DVec3| places[k].at(time, p) + drift;
            let along = piece.points.iter().map(|&p| place(p).dot(*normal));
            ends[k] = match k {
                0 => along.fold(f64::NEG_INFINITY, f64::max) + piece.radius,
                _ => along.fold(f64::INFINITY, f64::min) - piece.radius,
            };
            let witness = [*witness_a, *witness_b][k];
            let off = distance_to_piece(witness, &piece, place);
            law!(off <= rounding, "witness {k} is {off} off its piece");
            let feature = [contact.feature_a, contact.feature_b][k];
            let shape = [&self.query.a.shape, &self.query.b.shape][k];
            let off = match kind {
                Kind::Triangles => distance_to_mesh_feature(witness, feature, &shape.mesh, place)?,
                Kind::Parts => distance_to_part_feature(witness, feature, &shape.parts, place)?,
            };
            law!(off <= rounding, "witness {k} is {off} off its feature {feature}");
        }
        let gap = ends[1] - ends[0];
        law!(gap >= lower - rounding, "lower {lower}, but the gap along the normal is {gap}");
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
            let height = |l: &Vec<DVec3>| (l[1] - l[0]).cross(l[2] - l[0]).dot(p - l[0]);
            if loops.iter().all(|l| height(l) <= 0.0) {
                0.0
            } else {
                loops.iter().map(|l| distance_to_polygon(p, l)).fold(f64::INFINITY, f64::min)
            }
        }
    };
    (core - piece.radius).max(0.0)
}

fn distance_to_mesh_feature(
    p: DVec3,
    feature: Feature,
    mesh: &crate::models::Mesh,
    place: impl Fn(DVec3) -> DVec3,
) -> Result<f64, String> {
    let vertex = |v: u32| mesh.vertices.get(v as usize).map(|&q| place(q));
    let bad = || format!("the mesh has no {feature}");
    match feature {
        Feature::Vertex(v) => Ok(vertex(v).ok_or_else(bad)?.distance(p)),
        Feature::Edge(v, w) => {
            let side = |f: &[u32; 3]| f.contains(&v) && f.contains(&w);
            law_edge(mesh.faces.iter().any(side), feature)?;
            let ends = [vertex(v).ok_or_else(bad)?, vertex(w).ok_or_else(bad)?];
            Ok(point_segment(p, ends).distance(p))
        }
        Feature::Face(f) => {
            law_edge((f as usize) < mesh.faces.len(), feature)?;
            let corners = mesh.triangle(f as usize).map(place);
            Ok(point_triangle(p, corners).distance(p))
        }
        Feature::Piece(_) => Err("a triangle's feature has a better name".into()),
    }
}

fn law_edge(holds: bool, feature: Feature) -> Law {
    law!(holds, "the mesh has no {feature}");
    Ok(())
}

fn distance_to_part_feature(
    p: DVec3,
    feature: Feature,
    parts: &[ccd_core::Polytope],
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
            Feature::Face(f) => part.facets.iter().find(|facet| facet.id == f).map(|facet| {
                let corners = facet.corners.iter().map(|&c| place(part.points[c as usize]));
                distance_to_polygon(p, &corners.collect::<Vec<_>>())
            }),
            // The inside: that the witness lies in the piece is checked elsewhere.
            Feature::Piece(_) => Some(0.0),
        };
        if let Some(distance) = distance {
            nearest = nearest.min(distance - part.radius);
        }
    }
    if nearest == f64::INFINITY { Err(format!("no part has {feature}")) } else { Ok(nearest) }
}

fn distance_to_polygon(p: DVec3, corners: &[DVec3]) -> f64 {
    let fan = (1..corners.len().saturating_sub(1)).map(|k| [corners[0], corners[k], corners[k + 1]]);
    fan.map(|t| point_triangle(p, t).distance(p)).fold(f64::INFINITY, f64::min)
}
