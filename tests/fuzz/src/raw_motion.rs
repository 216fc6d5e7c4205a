//! A body's motion as the numbers given to the engine, and the positions of its points in [`DoubleDouble`].

use crate::double::DoubleDouble;
use crate::vector::{Number, Vector};
use ccd_core::glam::{DQuat, DVec3};
use ccd_core::{InputError, Motion, Pose};

/// A motion as the numbers that the engine receives.
#[derive(Clone, Copy, Debug)]
pub struct RawMotion {
    pub start: RawPose,
    pub spec: MotionSpec,
    /// The point that moves in a straight line, in the body's frame.
    pub center: [f64; 3],
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RawPose {
    pub position: [f64; 3],
    /// The components w, x, y, z of a quaternion, whose length need not be 1.
    pub quaternion: [f64; 4],
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MotionSpec {
    Velocities { linear: [f64; 3], spin: [f64; 3] },
    EndPose(RawPose),
}

impl RawPose {
    pub fn at(position: [f64; 3]) -> Self {
        RawPose {
            position,
            quaternion: [1.0, 0.0, 0.0, 0.0],
        }
    }

    fn pose(&self) -> Result<Pose, InputError> {
        let [w, x, y, z] = self.quaternion;
        Pose::new(self.position, DQuat::from_xyzw(x, y, z, w))
    }

    /// Returns the rotation as a unit quaternion.
    fn unit_quaternion(&self) -> [DoubleDouble; 4] {
        let q = self.quaternion.map(DoubleDouble::new);
        let square = q
            .iter()
            .fold(DoubleDouble::default(), |sum, &x| sum + x * x);
        q.map(|x| x / square.sqrt())
    }

    fn point(&self, x: Vector<DoubleDouble>) -> Vector<DoubleDouble> {
        let [w, a, b, c] = self.unit_quaternion();
        let (u, two) = (Vector([a, b, c]), DoubleDouble::new(2.0));
        let across = u.cross(x) * two;
        x + across * w + u.cross(across) + Vector::from_array(self.position)
    }
}

impl RawMotion {
    pub fn from_velocities(start: RawPose, linear: [f64; 3], spin: [f64; 3]) -> Self {
        RawMotion {
            start,
            spec: MotionSpec::Velocities { linear, spin },
            center: [0.0; 3],
        }
    }

    /// Converts the motion to the engine's type.
    pub fn motion(&self, duration: f64) -> Result<Motion, InputError> {
        let (start, center) = (self.start.pose()?, DVec3::from(self.center));
        match self.spec {
            MotionSpec::Velocities { linear, spin } => Motion::about(start, linear, spin, center),
            MotionSpec::EndPose(end) => Motion::between(start, end.pose()?, center, duration),
        }
    }

    /// Returns the angle of rotation over the duration, in radians; between end poses its upper bound π.
    pub fn max_rotation_angle(&self, duration: f64) -> f64 {
        match self.spec {
            MotionSpec::Velocities { spin, .. } => Vector(spin).length() * duration,
            MotionSpec::EndPose(_) => std::f64::consts::PI,
        }
    }

    /// Returns the motion over a duration, exact except for the rounding of [`DoubleDouble`]. Between end poses, the center
    /// moves straight, and the body rotates by the shortest rotation between the unit quaternions.
    pub fn exact_motion(&self, duration: f64) -> ExactMotion {
        let center = Vector::from_array(self.center);
        let start = self.start.point(center);
        let per_time = DoubleDouble::new(1.0) / DoubleDouble::new(duration);
        let (velocity, axis, rate) = match self.spec {
            MotionSpec::Velocities { linear, spin } => {
                let spin = Vector::from_array(spin);
                let axis = spin.unit().unwrap_or(Vector::from_array([0.0; 3]));
                (Vector::from_array(linear), axis, spin.length())
            }
            MotionSpec::EndPose(end) => {
                let velocity = (end.point(center) - start) * per_time;
                let (axis, angle) =
                    shortest_rotation(self.start.unit_quaternion(), end.unit_quaternion());
                (velocity, axis, angle * per_time)
            }
        };
        let columns = [0, 1, 2].map(|k| {
            let mut unit = [0.0; 3];
            unit[k] = 1.0;
            let rotation = RawPose {
                position: [0.0; 3],
                ..self.start
            };
            rotation.point(Vector::from_array(unit))
        });
        ExactMotion {
            start,
            velocity,
            axis,
            rate,
            columns,
            center,
        }
    }
}

/// Returns the unit axis and the angle, in radians, of the shortest rotation `end · start⁻¹`.
fn shortest_rotation(
    [w, x, y, z]: [DoubleDouble; 4],
    end: [DoubleDouble; 4],
) -> (Vector<DoubleDouble>, DoubleDouble) {
    let (u, v) = (Vector([x, y, z]), Vector([end[1], end[2], end[3]]));
    let cos = end[0] * w + v.dot(u);
    let sin = v * w - u * end[0] - v.cross(u);
    let (cos, sin) = if cos < DoubleDouble::default() {
        (-cos, -sin)
    } else {
        (cos, sin)
    };
    let axis = sin.unit().unwrap_or(Vector::from_array([0.0; 3]));
    (
        axis,
        DoubleDouble::angle(sin.length(), cos) * DoubleDouble::new(2.0),
    )
}

/// A motion that is exact except for the rounding of [`DoubleDouble`].
#[derive(Clone, Debug)]
pub struct ExactMotion {
    pub start: Vector<DoubleDouble>,
    pub velocity: Vector<DoubleDouble>,
    pub axis: Vector<DoubleDouble>,
    pub rate: DoubleDouble,
    /// The directions of the body's axes at the start, in the world.
    columns: [Vector<DoubleDouble>; 3],
    pub center: Vector<DoubleDouble>,
}

/// The position and orientation of a body at a time.
#[derive(Clone, Copy, Debug)]
pub struct Snapshot {
    columns: [Vector<DoubleDouble>; 3],
    pub center: Vector<DoubleDouble>,
}

impl ExactMotion {
    pub fn snapshot_at(&self, t: f64) -> Snapshot {
        let center = self.start + self.velocity * DoubleDouble::new(t);
        let columns = if self.rate.to_f64() > 0.0 {
            let (sin, cos) = (self.rate * DoubleDouble::new(t)).sin_cos();
            let n = self.axis;
            let [a, b, c] = self.columns;
            let turned = |c: Vector<DoubleDouble>| {
                let along = n * n.dot(c);
                (c - along) * cos + n.cross(c) * sin + along
            };
            [turned(a), turned(b), turned(c)]
        } else {
            self.columns
        };
        Snapshot { columns, center }
    }

    /// Returns the velocity in the world, rounded to f64, of the point at `arm` from the center.
    pub fn point_velocity(&self, arm: Vector<f64>) -> Vector<f64> {
        self.velocity.to_f64() + self.axis.to_f64().cross(arm) * self.rate.to_f64()
    }
}

impl Snapshot {
    /// Returns the vector in the world from the center to a point, given that vector in the body's frame as `x`.
    pub fn world_arm(&self, x: Vector<DoubleDouble>) -> Vector<DoubleDouble> {
        let [a, b, c] = x.0;
        self.columns[0] * a + self.columns[1] * b + self.columns[2] * c
    }
}
