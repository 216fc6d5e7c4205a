//! Makes random vectors, triangles and motions for the rivals' tests, and computes distances by brute force.

use crate::scene::model;
use ccd_core::glam::{DQuat, DVec3};
use ccd_core::order::lesser;
use ccd_core::{Motion, Pose};
use ccd_decomp::TriangleMesh;
use ccd_tables::motions::Motions;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// A generator of random vectors, rotations and motions.
pub(in crate::method::rival) struct RandomSource(Pcg64);

impl RandomSource {
    pub(in crate::method::rival) fn new(seed: u64) -> Self {
        RandomSource(Pcg64::seed_from_u64(seed))
    }

    pub(in crate::method::rival) fn uniform_number(&mut self, low: f64, high: f64) -> f64 {
        self.0.random_range(low..high)
    }

    /// Returns a random vector whose coordinates are between `-half` and `half`.
    pub(in crate::method::rival) fn vector(&mut self, half: f64) -> DVec3 {
        DVec3::from_array([(); 3].map(|()| self.uniform_number(-half, half)))
    }

    pub(in crate::method::rival) fn rotation(&mut self) -> DQuat {
        DQuat::from_scaled_axis(self.vector(3.0))
    }

    pub(in crate::method::rival) fn triangle(&mut self) -> [DVec3; 3] {
        [(); 3].map(|()| self.vector(1.0))
    }

    /// Returns a random motion about a random center, whose velocity and angular velocity have coordinates up to
    /// `speed` and `spin`.
    pub(in crate::method::rival) fn motion(&mut self, speed: f64, spin: f64) -> Motion {
        let start = Pose::new(self.vector(2.0), self.rotation()).unwrap();
        let (velocity, spin) = (self.vector(speed), self.vector(spin));
        Motion::about(start, velocity, spin, self.vector(1.0)).unwrap()
    }

    pub(in crate::method::rival) fn query(&mut self, speed: f64, spin: f64) -> Motions {
        query(self.motion(speed, spin), self.motion(speed, spin))
    }
}

/// Returns the query of duration 1 in which A and B have the given motions.
pub(in crate::method::rival) fn query(a: Motion, b: Motion) -> Motions {
    Motions {
        id: String::new(),
        a,
        b,
        duration: 1.0,
    }
}

pub(in crate::method::rival) fn constant_velocity_motion(
    position: DVec3,
    rotation: DQuat,
    velocity: DVec3,
    spin: DVec3,
) -> Motion {
    Motion::new(Pose::new(position, rotation).unwrap(), velocity, spin).unwrap()
}

pub(in crate::method::rival) fn resting_motion(position: DVec3) -> Motion {
    constant_velocity_motion(position, DQuat::IDENTITY, DVec3::ZERO, DVec3::ZERO)
}

pub(in crate::method::rival) fn cuboid(x: f64, y: f64, z: f64) -> TriangleMesh {
    model::cuboid(x, y, z).unwrap()
}

/// Returns the distance of two triangles that do not cross: the least over vertex-face and edge-edge pairs.
pub(in crate::method::rival) fn distance(a: &[DVec3; 3], b: &[DVec3; 3]) -> f64 {
    let edge = |t: &[DVec3; 3], k: usize| [t[k], t[(k + 1) % 3]];
    let mut least = f64::INFINITY;
    for i in 0..3 {
        least = lesser(
            lesser(least, plane_distance_if_foot_inside(a[i], b)),
            plane_distance_if_foot_inside(b[i], a),
        );
        for j in 0..3 {
            least = lesser(least, segment_distance(edge(a, i), edge(b, j)));
        }
    }
    least
}

/// Returns the distance of a point from a triangle's plane if the point's foot lies in the triangle, and infinity
/// otherwise.
fn plane_distance_if_foot_inside(p: DVec3, t: &[DVec3; 3]) -> f64 {
    let normal = (t[1] - t[0]).cross(t[2] - t[0]).normalize();
    let inside = |k: usize| normal.cross(t[(k + 1) % 3] - t[k]).dot(p - t[k]) >= 0.0;
    if (0..3).all(inside) {
        (p - t[0]).dot(normal).abs()
    } else {
        f64::INFINITY
    }
}

/// Returns the distance of two segments: the least over their ends, and over their lines if the nearest points lie on
/// the segments.
fn segment_distance([p, p2]: [DVec3; 2], [q, q2]: [DVec3; 2]) -> f64 {
    let to_segment = |x: DVec3, a: DVec3, b: DVec3| {
        let s = ((x - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
        x.distance(a.lerp(b, s))
    };
    let ends = [
        to_segment(p, q, q2),
        to_segment(p2, q, q2),
        to_segment(q, p, p2),
        to_segment(q2, p, p2),
    ];
    let (e, g, w) = (p2 - p, q2 - q, q - p);
    let c = e.cross(g);
    let [s, u] = [w.cross(g), w.cross(e)].map(|x| x.dot(c) / c.length_squared());
    let lines = if (0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&u) {
        w.dot(c).abs() / c.length()
    } else {
        f64::INFINITY
    };
    ends.into_iter().fold(lines, lesser)
}
