//! Computes positions of a moving body's points from the definition of the motion.

use crate::query::{MovingShape, Query};
use ccd_core::glam::DVec3;

/// The map from a body's points to positions at time t, relative to the center of body A: `x(t) = R(t) R₀ (x − c) + d +
/// v t`.
///
/// Offsets are subtracted before anything is rounded at their size, and A's velocity is subtracted
/// from both bodies, so that far and fast scenes keep their digits.
#[derive(Clone, Debug)]
pub struct RelativeMotion {
    start: [DVec3; 3],
    center: DVec3,
    offset: DVec3,
    velocity: DVec3,
    spin: DVec3,
    radius: f64,
    origin: DVec3,
}

impl RelativeMotion {
    /// Returns the placements of both bodies of a query, A first.
    pub fn pair(query: &Query) -> [RelativeMotion; 2] {
        let (mut a, mut b) = (RelativeMotion::new(&query.a), RelativeMotion::new(&query.b));
        let (pa, pb) = (
            query.a.motion.start().translation(),
            query.b.motion.start().translation(),
        );
        b.offset = (pb - pa) + (b.offset - a.offset);
        b.velocity -= a.velocity;
        (a.origin, b.origin) = (pa + a.offset, pa + a.offset);
        (a.offset, a.velocity) = (DVec3::ZERO, DVec3::ZERO);
        [a, b]
    }

    fn new(actor: &MovingShape) -> Self {
        let motion = &actor.motion;
        let start = rotation(motion.start().rotation().to_array());
        let center = motion.center();
        RelativeMotion {
            start,
            center,
            offset: apply(start, center),
            velocity: motion.velocity(),
            spin: motion.angular_velocity(),
            radius: actor.shape.mesh.radius_about(center),
            origin: DVec3::ZERO,
        }
    }

    /// Returns the position of a point of the body at a time, relative to the center of body A.
    pub fn point_position_at(&self, time: f64, point: DVec3) -> DVec3 {
        let arm = apply(self.start, point - self.center);
        rotated(arm, time * self.spin) + self.offset + time * self.velocity
    }

    /// Returns the point in the world to which positions are relative: the center of body A at the start.
    pub fn origin(&self) -> DVec3 {
        self.origin
    }

    /// Returns the body's velocity relative to body A's center.
    pub fn velocity(&self) -> DVec3 {
        self.velocity
    }

    /// Returns the largest speed due to rotation of a point of the body.
    pub fn max_rotational_speed(&self) -> f64 {
        self.spin.length() * self.radius
    }

    /// Returns the largest distance of a point of the body from its center of rotation.
    pub fn radius(&self) -> f64 {
        self.radius
    }
}

/// Rotates a point by a rotation vector, with Rodrigues' formula.
fn rotated(p: DVec3, turn: DVec3) -> DVec3 {
    let angle = turn.length();
    if angle == 0.0 {
        return p;
    }
    let n = turn / angle;
    let half = (0.5 * angle).sin();
    // 1 − cos is written as 2 sin² of the half angle: small turns keep their digits.
    p + angle.sin() * n.cross(p) + 2.0 * half * half * n.cross(n.cross(p))
}

/// Returns the columns of the rotation matrix of a unit quaternion `x y z w`.
fn rotation([x, y, z, w]: [f64; 4]) -> [DVec3; 3] {
    let q = DVec3::new(x, y, z);
    let column = |e: DVec3| e + 2.0 * q.cross(q.cross(e) + w * e);
    [column(DVec3::X), column(DVec3::Y), column(DVec3::Z)]
}

fn apply(columns: [DVec3; 3], p: DVec3) -> DVec3 {
    p.x * columns[0] + p.y * columns[1] + p.z * columns[2]
}
