//! A body's motion as the numbers given to the engine, and the positions of its points in [`Double`].

use crate::double::Double;
use crate::vector::{Number, Vector};
use ccd_core::glam::{DQuat, DVec3};
use ccd_core::{InputError, Motion, Pose};

/// A motion as the numbers that the engine receives.
#[derive(Clone, Copy, Debug)]
pub struct RawMotion {
    pub start: RawPose,
    pub goal: Goal,
    /// The point that moves in a straight line, in the body's frame.
    pub centre: [f64; 3],
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RawPose {
    pub position: [f64; 3],
    /// The components w, x, y, z of a quaternion, whose length need not be 1.
    pub quaternion: [f64; 4],
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Goal {
    Velocities { linear: [f64; 3], spin: [f64; 3] },
    End(RawPose),
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
    fn unit_quaternion(&self) -> [Double; 4] {
        let q = self.quaternion.map(Double::new);
        let square = q.iter().fold(Double::default(), |sum, &x| sum + x * x);
        q.map(|x| x / square.sqrt())
    }

    fn point(&self, x: Vector<Double>) -> Vector<Double> {
        let [w, a, b, c] = self.unit_quaternion();
        let (u, two) = (Vector([a, b, c]), Double::new(2.0));
        let across = u.cross(x) * two;
        x + across * w + u.cross(across) + Vector::from_array(self.position)
    }
}

impl RawMotion {
    pub fn velocities(start: RawPose, linear: [f64; 3], spin: [f64; 3]) -> Self {
        RawMotion {
            start,
            goal: Goal::Velocities { linear, spin },
            centre: [0.0; 3],
        }
    }

    /// Converts the motion to the engine's type.
    pub fn motion(&self, duration: f64) -> Result<Motion, InputError> {
        let (start, centre) = (self.start.pose()?, DVec3::from(self.centre));
        match self.goal {
            Goal::Velocities { linear, spin } => Motion::about(start, linear, spin, centre),
            Goal::End(end) => Motion::between(start, end.pose()?, centre, duration),
        }
    }

    /// Returns the angle of rotation over the duration, in radians; between end poses its upper bound π.
    pub fn rotation_angle(&self, duration: f64) -> f64 {
        match self.goal {
            Goal::Velocities { spin, .. } => Vector(spin).length() * duration,
            Goal::End(_) => std::f64::consts::PI,
        }
    }

    /// Returns the motion over a duration, exact except for the rounding of [`Double`]. Between end poses, the centre
    /// moves straight, and the body rotates by the shortest rotation between the unit quaternions.
    pub fn track(&self, duration: f64) -> Track {
        let centre = Vector::from_array(self.centre);
        let start = self.start.point(centre);
        let per_time = Double::new(1.0) / Double::new(duration);
        let (velocity, axis, rate) = match self.goal {
            Goal::Velocities { linear, spin } => {
                let spin = Vector::from_array(spin);
                let axis = spin.unit().unwrap_or(Vector::from_array([0.0; 3]));
                (Vector::from_array(linear), axis, spin.length())
            }
            Goal::End(end) => {
                let velocity = (end.point(centre) - start) * per_time;
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
        Track {
            start,
            velocity,
            axis,
            rate,
            columns,
            centre,
        }
    }
}

/// Returns the unit axis and the angle, in radians, of the shortest rotation `end · start⁻¹`.
fn shortest_rotation([w, x, y, z]: [Double; 4], end: [Double; 4]) -> (Vector<Double>, Double) {
    let (u, v) = (Vector([x, y, z]), Vector([end[1], end[2], end[3]]));
    let cos = end[0] * w + v.dot(u);
    let sin = v * w - u * end[0] - v.cross(u);
    let (cos, sin) = if cos < Double::default() {
        (-cos, -sin)
    } else {
        (cos, sin)
    };
    let axis = sin.unit().unwrap_or(Vector::from_array([0.0; 3]));
    (axis, Double::angle(sin.length(), cos) * Double::new(2.0))
}

/// A motion that is exact except for the rounding of [`Double`].
#[derive(Clone, Debug)]
pub struct Track {
    pub start: Vector<Double>,
    pub velocity: Vector<Double>,
    pub axis: Vector<Double>,
    pub rate: Double,
    /// The directions of the body's axes at the start, in the world.
    columns: [Vector<Double>; 3],
    pub centre: Vector<Double>,
}

/// The position and orientation of a body at a time.
#[derive(Clone, Copy, Debug)]
pub struct Snapshot {
    columns: [Vector<Double>; 3],
    pub centre: Vector<Double>,
}

impl Track {
    pub fn at(&self, t: f64) -> Snapshot {
        let centre = self.start + self.velocity * Double::new(t);
        let columns = if self.rate.rounded() > 0.0 {
            let (sin, cos) = (self.rate * Double::new(t)).sin_cos();
            let n = self.axis;
            let [a, b, c] = self.columns;
            let turned = |c: Vector<Double>| {
                let along = n * n.dot(c);
                (c - along) * cos + n.cross(c) * sin + along
            };
            [turned(a), turned(b), turned(c)]
        } else {
            self.columns
        };
        Snapshot { columns, centre }
    }

    /// Returns the velocity in the world, rounded to f64, of the point at `arm` from the centre.
    pub fn point_velocity(&self, arm: Vector<f64>) -> Vector<f64> {
        self.velocity.rounded() + self.axis.rounded().cross(arm) * self.rate.rounded()
    }
}

impl Snapshot {
    /// Returns the vector in the world from the centre to a point, given that vector in the body's frame as `x`.
    pub fn arm_of(&self, x: Vector<Double>) -> Vector<Double> {
        let [a, b, c] = x.0;
        self.columns[0] * a + self.columns[1] * b + self.columns[2] * c
    }
}
