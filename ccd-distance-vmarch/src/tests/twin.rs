//! Computes distances by brute force, as a reference: all corners, edges and faces of one polytope against all of the
//! other.

use super::shape::Shape;
use crate::double_double::DoubleDoubleVector;
use ccd_core::Frame;
use ccd_core::glam::{DMat3, DQuat, DVec3};
use ccd_core::order::{greater, lesser};

/// A polytope in A's frame, as plain lists of features.
pub(crate) struct ReferencePolytope {
    pub(crate) points: Vec<DVec3>,
    edges: Vec<Segment>,
    faces: Vec<Polygon>,
}

struct Segment {
    ends: [DVec3; 2],
    middle: DVec3,
    half_length: f64,
}

struct Polygon {
    corners: Vec<DVec3>,
    normal: DVec3,
}

impl ReferencePolytope {
    pub(crate) fn new(shape: &Shape, frame: &Frame) -> Self {
        let points: Vec<DVec3> = shape
            .points
            .iter()
            .map(|&p| frame.transform_point(p))
            .collect();
        let at = |v: &u32| points[*v as usize];
        let segment = |e: [u32; 2]| {
            let ends = [at(&e[0]), at(&e[1])];
            Segment {
                ends,
                middle: 0.5 * (ends[0] + ends[1]),
                half_length: 0.5 * ends[0].distance(ends[1]),
            }
        };
        let mut loops = shape.loops.clone();
        if shape.points.len() == 3 && loops.is_empty() {
            loops.push(vec![0, 1, 2]);
        }
        // The normal of the corners as they were given, by exact differences.
        let normal = |corners: &Vec<u32>| {
            let from = |k: usize| {
                let [p, q] = [corners[k], corners[0]].map(|v| shape.points[v as usize]);
                DoubleDoubleVector::difference(p, q)
            };
            let parts = (1..corners.len() - 1).map(|k| from(k).cross(from(k + 1)));
            let area = parts.reduce(|sum, part| sum + part).expect("three corners");
            frame.rotation * area.value().normalize_or_zero()
        };
        let polygon = |corners: &Vec<u32>| Polygon {
            corners: corners.iter().map(at).collect(),
            normal: normal(corners),
        };
        ReferencePolytope {
            edges: shape.edges().into_iter().map(segment).collect(),
            faces: loops.iter().map(polygon).collect(),
            points,
        }
    }

    fn max_height(&self, n: DVec3) -> f64 {
        self.points
            .iter()
            .map(|p| n.dot(*p))
            .fold(f64::NEG_INFINITY, greater)
    }
}

/// Returns the support gap from A to B along a unit vector.
pub(crate) fn gap(a: &ReferencePolytope, b: &ReferencePolytope, n: DVec3) -> f64 {
    -b.max_height(-n) - a.max_height(n)
}

/// Returns the distance of the surfaces of two polytopes. It is that of the polytopes, if neither is inside the other
/// one and they do not intersect.
///
/// Every number that is compared is the distance of two points that the polytopes do have, so that it
/// is never too small by more than the rounding of a point.
pub(crate) fn distance(a: &ReferencePolytope, b: &ReferencePolytope) -> f64 {
    let mut best = f64::INFINITY;
    for &p in &a.points {
        for &q in &b.points {
            best = lesser(best, p.distance(q));
        }
    }
    for (one, other) in [(a, b), (b, a)] {
        for &p in &one.points {
            for edge in &other.edges {
                best = lesser(best, p.distance(foot(p, edge)));
            }
            for face in &other.faces {
                best = lesser(best, height(p, face));
            }
        }
    }
    for e in &a.edges {
        for f in &b.edges {
            // Segments in balls that are farther apart than the best so far can be passed over.
            let reach = best + e.half_length + f.half_length;
            if e.middle.distance_squared(f.middle) <= reach * reach {
                best = lesser(best, distance_near_line_crossing(e, f));
            }
        }
    }
    best
}

fn foot(p: DVec3, edge: &Segment) -> DVec3 {
    let [a, b] = edge.ends;
    let along = b - a;
    let t = (p - a).dot(along) / along.length_squared();
    if t > 0.0 {
        a + along * lesser(1.0, t)
    } else {
        a
    }
}

/// Returns the distance of a point from a polygon's plane; infinite if the point does not project into the polygon.
fn height(p: DVec3, face: &Polygon) -> f64 {
    let corners = &face.corners;
    let height = (p - corners[0]).dot(face.normal);
    let foot = p - height * face.normal;
    let inside = (0..corners.len()).all(|k| {
        let (a, b) = (corners[k], corners[(k + 1) % corners.len()]);
        (b - a).cross(foot - a).dot(face.normal) >= 0.0
    });
    if inside && face.normal != DVec3::ZERO {
        height.abs()
    } else {
        f64::INFINITY
    }
}

/// Returns the distance of two points of two segments, taken near the nearest points of the segments' lines.
fn distance_near_line_crossing(e: &Segment, f: &Segment) -> f64 {
    let [p, q] = e.ends;
    let [r, s] = f.ends;
    let (d, g, w) = (
        DoubleDoubleVector::difference(q, p),
        DoubleDoubleVector::difference(s, r),
        DoubleDoubleVector::difference(r, p),
    );
    let n = d.cross(g);
    let t = w.cross(g).dot(n).value() / n.dot(n).value();
    // Parallel segments have no such place; their ends' feet are tested anyway.
    let t = if t > 0.0 { lesser(1.0, t) } else { 0.0 };
    let on_e = p + (q - p) * t;
    let on_f = foot(on_e, f);
    on_f.distance(foot(on_f, e))
}

fn placed_reference(shape: &Shape, by: DQuat, to: DVec3) -> ReferencePolytope {
    let frame = Frame {
        rotation: DMat3::from_quat(by),
        translation: to,
    };
    ReferencePolytope::new(shape, &frame)
}

/// Tests that brute force agrees with closed forms, at distances down to a millionth of the size.
#[test]
fn brute_force_is_right() {
    use super::shape::{cuboid, polygon, shape_of_points};
    let cube = ReferencePolytope::new(&cuboid(DVec3::ONE), &Frame::IDENTITY);
    for gap in [1e-6, 1e-3, 1.0, 1e3] {
        let close = |a: &ReferencePolytope, b: &ReferencePolytope, truth: f64| {
            let found = [distance(a, b), distance(b, a)];
            for found in found {
                let error = (found - truth).abs();
                assert!(error <= 1e-13 * truth + 2e-15, "{found:e}, not {truth:e}");
            }
        };
        let straight = |x: f64, y: f64, z: f64| {
            placed_reference(&cuboid(DVec3::ONE), DQuat::IDENTITY, DVec3::new(x, y, z))
        };
        close(&cube, &straight(2.0 + gap, 0.3, -0.9), gap);
        close(
            &cube,
            &straight(2.0 + 3.0 * gap, 2.0 + 4.0 * gap, 0.1),
            5.0 * gap,
        );
        let corner = straight(2.0 + 2.0 * gap, 2.0 + 3.0 * gap, 2.0 + 6.0 * gap);
        close(&cube, &corner, 7.0 * gap);
        // A corner down: half the diagonal below the middle.
        let down = DQuat::from_rotation_arc(DVec3::ONE.normalize(), -DVec3::Z);
        let half = 3f64.sqrt();
        let standing = placed_reference(&cuboid(DVec3::ONE), down, (1.0 + half + gap) * DVec3::Z);
        close(&cube, &standing, gap);
        // Edges crossed at right angles: half the diagonals of two faces.
        let eighth = std::f64::consts::FRAC_PI_4;
        let roof = placed_reference(
            &cuboid(DVec3::ONE),
            DQuat::from_rotation_x(eighth),
            DVec3::ZERO,
        );
        let up = (2.0 * 2f64.sqrt() + gap) * DVec3::Z;
        let keel = placed_reference(&cuboid(DVec3::ONE), DQuat::from_rotation_y(eighth), up);
        close(&roof, &keel, gap);
        // Needles whose directions differ by an angle of any size cross at their middles.
        let flat =
            ReferencePolytope::new(&shape_of_points(&[-DVec3::X, DVec3::X]), &Frame::IDENTITY);
        for angle in [1e-12, 1e-8, 1e-4, 1.0] {
            let other = placed_reference(
                &shape_of_points(&[-DVec3::X, DVec3::X]),
                DQuat::from_rotation_z(angle),
                gap * DVec3::Z,
            );
            close(&flat, &other, gap);
        }
        let square = placed_reference(
            &polygon(4),
            DQuat::IDENTITY,
            DVec3::new(0.1, 0.2, 1.0 + gap),
        );
        close(&cube, &square, gap);
    }
}
