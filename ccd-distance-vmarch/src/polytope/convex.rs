//! Tests whether faces enclose a convex polytope exactly once.

use super::{NO_FACE, Polytope, Side, unit};
use crate::tolerance::{CONVEX_HEIGHT, COPLANAR_DISTANCE, MAX_RAYS};
use ccd_core::exact::side;
use ccd_core::glam::DVec3;
use ccd_core::order::greater;

/// Returns whether a closed surface is that of a convex polytope, up to the rounding of its
/// corners.
///
/// It is if it is connected, locally convex, and winds once `[TIE28]`: polygons turn left at every corner, once around;
/// neighbours are behind each face; and a ray from inside leaves through one face.
pub(crate) fn is_convex(points: &[DVec3], polytope: &Polytope, rounding: f64) -> bool {
    let edges = &polytope.edges;
    if polytope.faces.len() < 2 || edges.iter().any(|edge| edge.faces.contains(&NO_FACE)) {
        return false;
    }
    let rounding = rounding * (CONVEX_HEIGHT / COPLANAR_DISTANCE);
    let check = Check::new(points, polytope, rounding);
    let mut faces = 0..polytope.faces.len() as u32;
    faces.clone().all(|f| check.is_polygon(f))
        && faces.all(|f| check.is_convex_towards_neighbours(f))
        && check.is_connected()
        && (polytope.faces.len() == 2 || check.winds_once())
}

struct Check<'a> {
    points: &'a [DVec3],
    polytope: &'a Polytope,
    /// For each face, the distance from its plane that rounding of the corners allows.
    slacks: Vec<f64>,
    /// For each edge, its position among the sides of its two faces.
    positions: Vec<[usize; 2]>,
}

impl<'a> Check<'a> {
    fn new(points: &'a [DVec3], polytope: &'a Polytope, rounding: f64) -> Self {
        let mut positions = vec![[0; 2]; polytope.edges.len()];
        let mut slacks = Vec::with_capacity(polytope.faces.len());
        for face in 0..polytope.faces.len() as u32 {
            let sides = polytope.sides_of(face);
            for (at, side) in sides.iter().enumerate() {
                let slot = usize::from(polytope.edge(side.edge).faces[0] != face);
                positions[side.edge as usize][slot] = at;
            }
            let width = greater(f64::MIN_POSITIVE, width(polytope, face));
            slacks.push(rounding * (1.0 + polytope.reach / width));
        }
        Check {
            points,
            polytope,
            slacks,
            positions,
        }
    }

    /// Returns whether a face is a planar convex polygon that winds once.
    fn is_polygon(&self, face: u32) -> bool {
        let normal = self.polytope.face(face).normal;
        let sides = self.polytope.sides_of(face);
        if sides.len() < 3 || normal == DVec3::ZERO {
            return false;
        }
        let slack = self.slacks[face as usize];
        let at = |k: usize| self.corner(sides[k % sides.len()].vertex);
        let first = at(0);
        (0..sides.len()).all(|k| {
            let (here, next, over) = (at(k), at(k + 1), at(k + 2));
            let inward = normal.cross(unit(next - here));
            // No triangle of the fan about the first corner is reversed.
            let fan = (here - first).cross(next - first).dot(normal);
            let longest = greater((here - first).length(), (next - first).length());
            normal.dot(here - first).abs() <= slack
                && inward.dot(over - next) >= -slack
                && fan >= -slack * longest
        })
    }

    /// Returns whether a face is convex towards its neighbours: their vertices next to the common edges are behind it.
    fn is_convex_towards_neighbours(&self, face: u32) -> bool {
        let normal = self.polytope.face(face).normal;
        self.polytope.sides_of(face).iter().all(|side| {
            let edge = self.polytope.edge(side.edge);
            let slot = usize::from(edge.faces[0] == face);
            let other = edge.faces[slot];
            let ring = self.polytope.sides_of(other);
            let at = self.positions[side.edge as usize][slot];
            let start = self.corner(side.vertex);
            let slack = greater(self.slacks[face as usize], self.slacks[other as usize]);
            [ring.len() - 1, 2].into_iter().all(|step| {
                let corner = self.corner(ring[(at + step) % ring.len()].vertex);
                normal.dot(corner - start) <= slack
            })
        })
    }

    /// Returns whether all faces are connected over edges.
    fn is_connected(&self) -> bool {
        let mut reached = vec![false; self.polytope.faces.len()];
        reached[0] = true;
        let mut open = vec![0];
        while let Some(face) = open.pop() {
            for side in self.polytope.sides_of(face) {
                for other in self.polytope.edge(side.edge).faces {
                    if !std::mem::replace(&mut reached[other as usize], true) {
                        open.push(other);
                    }
                }
            }
        }
        reached.into_iter().all(|reached| reached)
    }

    /// Returns whether the surface winds once: a ray from the mean of all vertices leaves through at most one face, by
    /// exact signs. Rays that meet an edge are skipped.
    fn winds_once(&self) -> bool {
        let vertices = 0..self.polytope.vertices.len() as u32;
        let middle =
            vertices.clone().map(|v| self.corner(v)).sum::<DVec3>() / vertices.len() as f64;
        let targets = (0..self.polytope.faces.len() as u32).map(|f| {
            let sides = self.polytope.sides_of(f);
            // Avoids the symmetry lines of regular shapes.
            let parts = [0.47, 0.33, 0.2].into_iter().zip(sides);
            parts
                .map(|(part, side)| part * self.corner(side.vertex))
                .sum::<DVec3>()
        });
        let layers = targets
            .take(MAX_RAYS)
            .find_map(|target| self.count_exits(middle, target));
        layers.is_none_or(|layers| layers <= 1)
    }

    /// Counts the faces through which the ray from one point through another leaves; `None` if the ray meets an edge.
    fn count_exits(&self, from: DVec3, to: DVec3) -> Option<usize> {
        let mut layers = 0;
        for face in 0..self.polytope.faces.len() as u32 {
            let sides = self.polytope.sides_of(face);
            let at = |k: usize| self.corner(sides[k].vertex);
            for k in 1..sides.len() - 1 {
                let corners = [at(0), at(k), at(k + 1)];
                let [a, b, c] = corners;
                let turns = [[a, b], [b, c], [c, a]].map(|[p, q]| side([from, p, q], to));
                if turns.iter().all(|&turn| turn.is_gt()) {
                    layers += 1;
                } else if turns.iter().all(|&turn| turn.is_ge()) && side(corners, from).is_ne() {
                    return None;
                }
            }
        }
        Some(layers)
    }

    fn corner(&self, v: u32) -> DVec3 {
        self.points[self.polytope.vertex(v).number as usize]
    }
}

/// Returns a lower estimate of a face's width, at least a quarter of it: the area over the extent from the first
/// vertex.
fn width(polytope: &Polytope, face: u32) -> f64 {
    let sides = polytope.sides_of(face);
    let first = polytope.vertex(sides[0].vertex).point;
    let arm = |side: &Side| polytope.vertex(side.vertex).point - first;
    let fan = sides
        .windows(2)
        .map(|two| 0.5 * arm(&two[0]).cross(arm(&two[1])).length());
    let farthest = sides
        .iter()
        .map(|side| arm(side).length())
        .fold(0.0, greater);
    fan.sum::<f64>() / farthest
}
