//! Balls that cover the convex parts of a robot, and balls inside them.
//!
//! A part is cut by planes into convex pieces, the piece with the largest ball first. A piece is the convex hull of its
//! points, which lie in a ball. So the balls of all pieces cover the part.
//!
//! # Why nothing is lost at a cut
//! Each face of a piece is cut where its edges cross the plane, and both halves get the crossing points. So the hulls of
//! both halves cover the surface of the piece, even if the crossing points are rounded along their edges. Two convex
//! sets that cover the surface of a convex body also cover its interior: if a point is in neither set, there is a plane
//! through it for each set that has the set strictly on one side. A ray along the intersection line of both planes
//! meets neither set, so it never meets the surface, but it leaves the body. Crossing points are also rounded across
//! their edges; [`CROSSING_ERROR`] enlarges the balls for that.

use super::part::HullPart;
use crate::tuning::{BALL_STEPS, BALLS_PER_PART, LEAST_CUT_GAIN, TRIAL_BALL_STEPS, TRIAL_POLYGONS};
use ccd_core::order::{greater, lesser};
use rigid_ccd::glam::DVec3;

/// An upper bound of the distance of a computed crossing point from its edge, and of the rounding error of a distance
/// between points, as a fraction of the largest coordinate. Each cut adds a few units in the last place of f64.
const CROSSING_ERROR: f64 = 1e-13;

/// A ball of a cover, in the frame of its part.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CoverBall {
    /// A point of the part's hull.
    pub(crate) center: DVec3,
    pub(crate) radius: f64,
    /// The radius of a ball about the same center that is inside the body; negative infinity if there is none.
    pub(crate) inner_radius: f64,
}

/// The balls that cover each part of a robot.
#[derive(Clone, Debug, Default)]
pub(crate) struct Covers {
    /// The balls of all parts, sorted by part.
    pub(crate) balls: Vec<CoverBall>,
    /// For each part the index of its first ball, then the number of all balls.
    pub(crate) first_ball_by_part: Vec<usize>,
    /// One ball around each part.
    pub(crate) enclosing_balls: Vec<CoverBall>,
}

/// The surface of a part's hull.
struct Surface {
    polygons: Vec<Vec<DVec3>>,
    can_be_cut: bool,
}

/// A convex piece of a part: the polygons of its surface without the cuts.
struct Piece<'p> {
    part: &'p HullPart,
    part_index: usize,
    polygons: Vec<Vec<DVec3>>,
    center: DVec3,
    radius: f64,
    can_be_cut: bool,
}

impl Covers {
    /// Covers parts by about [`BALLS_PER_PART`] balls each, more for large parts than for small ones.
    pub(crate) fn of_parts(parts: &[HullPart]) -> Self {
        let surfaces: Vec<Surface> = parts.iter().map(Surface::of_part).collect();
        let whole = |(index, surface): (usize, &Surface)| {
            let mut piece = Piece::new(&parts[index], index, surface.polygons.clone());
            piece.can_be_cut &= surface.can_be_cut;
            piece
        };
        let mut pieces: Vec<Piece<'_>> = surfaces.iter().enumerate().map(whole).collect();
        let ball_of = |piece: &Piece<'_>| piece.ball(&surfaces[piece.part_index].polygons);
        let enclosing_balls = pieces.iter().map(ball_of).collect();
        let max_count = (BALLS_PER_PART * parts.len() as f64) as usize;
        while pieces.len() < max_count {
            let candidates = pieces.iter_mut().filter(|piece| piece.can_be_cut);
            let Some(largest) = candidates.max_by(|a, b| a.radius.total_cmp(&b.radius)) else {
                break;
            };
            match largest.cut() {
                Some([one, other]) => {
                    *largest = one;
                    pieces.push(other);
                }
                None => largest.can_be_cut = false,
            }
        }
        pieces.sort_unstable_by_key(|piece| piece.part_index);
        let first = |part| pieces.partition_point(|piece| piece.part_index < part);
        Covers {
            balls: pieces.iter().map(ball_of).collect(),
            first_ball_by_part: (0..=parts.len()).map(first).collect(),
            enclosing_balls,
        }
    }
}

impl<'p> Piece<'p> {
    fn new(part: &'p HullPart, part_index: usize, polygons: Vec<Vec<DVec3>>) -> Self {
        let points = distinct_points(&polygons);
        let center = ball_center(&points, BALL_STEPS);
        Piece {
            part,
            part_index,
            polygons,
            center,
            radius: farthest(&points, center).0,
            can_be_cut: points.len() > 1,
        }
    }

    /// Cuts the piece by the plane that gives the smallest balls; `None` if that gains too little.
    fn cut(&self) -> Option<[Self; 2]> {
        let points = distinct_points(&self.polygons);
        let mut best = (LEAST_CUT_GAIN * self.radius, None);
        for (normal, [low, high]) in longest_directions(&points) {
            for share in [0.4, 0.5, 0.6] {
                let halves = cut_polygons(&self.polygons, normal, low + share * (high - low));
                let radii = halves.each_ref().map(|polygons| {
                    // Any choice of points tells halves apart; the ball that is used contains all.
                    let step = polygons.len() / TRIAL_POLYGONS + 1;
                    let points = polygons.iter().step_by(step).flatten().copied();
                    let points: Vec<DVec3> = points.collect();
                    farthest(&points, ball_center(&points, TRIAL_BALL_STEPS)).0
                });
                let larger = greater(radii[0], radii[1]);
                if larger < best.0 {
                    best = (larger, Some(halves));
                }
            }
        }
        let new = |polygons| Piece::new(self.part, self.part_index, polygons);
        let halves = best.1.map(|halves| halves.map(new))?;
        let larger = greater(halves[0].radius, halves[1].radius);
        (larger < LEAST_CUT_GAIN * self.radius).then_some(halves)
    }

    /// Returns the ball around the piece. `surface` are the polygons of the whole part.
    fn ball(&self, surface: &[Vec<DVec3>]) -> CoverBall {
        let rounding = CROSSING_ERROR * self.part.coordinate_bound;
        // The center is a convex combination of points of the hull.
        let depth = greater(depth_below_surface(surface, self.center), 0.0);
        CoverBall {
            center: self.center,
            radius: self.radius + self.part.radius + rounding,
            inner_radius: if self.part.is_convex {
                depth + self.part.radius - rounding
            } else {
                f64::NEG_INFINITY
            },
        }
    }
}

impl Surface {
    fn of_part(part: &HullPart) -> Self {
        let corners = part.points();
        let hull = ccd_decomp::convex_hull(corners);
        // Without the edges of the hull, halves would not cover it. The balls of a half-space are not used.
        let can_be_cut = hull.is_ok() && part.plane.is_none();
        let polygons = match hull {
            Ok(hull) if hull.facets.iter().count() > 0 => {
                let polygon =
                    |facet: &[u32]| facet.iter().map(|&k| hull.points[k as usize]).collect();
                hull.facets.iter().map(polygon).collect()
            }
            // All points are on a line, or there is no hull.
            _ => vec![corners.to_vec()],
        };
        Surface {
            polygons,
            can_be_cut,
        }
    }
}

/// Returns a lower bound of the depth of a point below the planes of all polygons; 0 if they bound no volume.
fn depth_below_surface(polygons: &[Vec<DVec3>], point: DVec3) -> f64 {
    if polygons.len() < 4 {
        return 0.0;
    }
    let depths = polygons.iter().map(|polygon| {
        let triangles = polygon.windows(2).skip(1);
        let normals = triangles.map(|edge| {
            let [one, other] = [edge[0] - polygon[0], edge[1] - polygon[0]];
            (one.cross(other), one.length() * other.length())
        });
        let largest = normals.max_by(|a, b| a.0.length().total_cmp(&b.0.length()));
        let Some((normal, product)) = largest else {
            return f64::NEG_INFINITY;
        };
        let (offset, length) = (polygon[0] - point, normal.length());
        // The direction of the normal of a thin triangle is rounded by more.
        let direction_error = CROSSING_ERROR * product / length;
        normal.dot(offset) / length - direction_error * offset.length()
    });
    depths.fold(f64::INFINITY, lesser)
}

/// Cuts polygons by the plane `normal · x = offset`. Returns the polygons below and above it.
fn cut_polygons(polygons: &[Vec<DVec3>], normal: DVec3, offset: f64) -> [Vec<Vec<DVec3>>; 2] {
    let mut halves = [Vec::new(), Vec::new()];
    for polygon in polygons {
        let mut parts = [Vec::new(), Vec::new()];
        for (k, &start) in polygon.iter().enumerate() {
            let end = polygon[(k + 1) % polygon.len()];
            let [from, to] = [start, end].map(|point| normal.dot(point) - offset);
            parts[usize::from(from > 0.0)].push(start);
            if (from > 0.0) != (to > 0.0) {
                let crossing = start + (end - start) * (from / (from - to));
                parts[0].push(crossing);
                parts[1].push(crossing);
            }
        }
        for (half, part) in halves.iter_mut().zip(parts) {
            if !part.is_empty() {
                half.push(part);
            }
        }
    }
    halves
}

/// Returns the three directions, of the axes and diagonals of a cube, along which points extend farthest, each with the
/// least and the largest height along it.
fn longest_directions(points: &[DVec3]) -> Vec<(DVec3, [f64; 2])> {
    let steps = || [-1.0, 0.0, 1.0].into_iter();
    let all = steps().flat_map(|x| steps().flat_map(move |y| steps().map(move |z| [x, y, z])));
    // One of each two opposite directions.
    let mut directions: Vec<(DVec3, [f64; 2])> = all
        .take(13)
        .map(|direction| {
            let direction = DVec3::from_array(direction).normalize();
            let heights = || points.iter().map(|point| direction.dot(*point));
            let low = heights().fold(f64::INFINITY, lesser);
            (direction, [low, heights().fold(low, greater)])
        })
        .collect();
    let extent = |(_, [low, high]): &(DVec3, [f64; 2])| high - low;
    directions.sort_unstable_by(|a, b| extent(b).total_cmp(&extent(a)));
    directions.truncate(3);
    directions
}

/// Returns the center of a small ball around points, a convex combination of them `[BADOIU03]`.
fn ball_center(points: &[DVec3], steps: u32) -> DVec3 {
    let mut center = points.iter().sum::<DVec3>() / points.len() as f64;
    for k in 2..steps + 2 {
        center += (farthest(points, center).1 - center) / f64::from(k);
    }
    center
}

/// Returns the point that is farthest from a center, with its distance.
fn farthest(points: &[DVec3], center: DVec3) -> (f64, DVec3) {
    let mut farthest = (0.0, center);
    for &point in points {
        let squared = point.distance_squared(center);
        if squared > farthest.0 {
            farthest = (squared, point);
        }
    }
    (farthest.0.sqrt(), farthest.1)
}

fn distinct_points(polygons: &[Vec<DVec3>]) -> Vec<DVec3> {
    let mut points: Vec<DVec3> = polygons.iter().flatten().copied().collect();
    let key = |point: &DVec3| point.to_array();
    points.sort_unstable_by(|a, b| {
        key(a)
            .partial_cmp(&key(b))
            .unwrap_or(std::cmp::Ordering::Equal)
    });
    points.dedup();
    points
}

#[cfg(test)]
mod tests;
