//! Remarks on input that is valid, but probably a mistake.

#[cfg(feature = "meshes")]
mod mesh;

use crate::text::{Number, RoundedToFourDigits};
use ccd_core::Body;
use ccd_core::glam::DVec3;
use ccd_core::order::{greater, lesser};
use ccd_core::vector::{bounding_box, length};
use std::f64::consts::TAU;
use std::fmt;

/// A remark about input that is valid, but probably a mistake. It changes no answer.
///
/// The command prints it, and the Python package warns of it, each kind once. Who asks through the library decides
/// for himself what to do with it.
///
/// ```
/// use rigid_ccd::{Body, Remark};
/// // A part in metres, and a tolerance as for millimetres.
/// let (part, wall) = (Body::sphere(0.0005)?, Body::cuboid([1.0; 3])?);
/// let sizes = [&part, &wall].map(Remark::body_size);
/// let remark = Remark::remark_on_tolerance(0.001, sizes).expect("it is as large as the part");
/// assert!(remark.to_string().starts_with("the tolerance is large against the smaller body"));
/// assert_eq!(Remark::remark_on_tolerance(0.00001, sizes), None);
/// # Ok::<(), rigid_ccd::InputError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Remark {
    /// The tolerance is more than a tenth of the smaller body's size.
    CoarseTolerance {
        /// The tolerance of the query, in the scene's unit of length.
        tolerance: f64,
        /// The largest side of the smaller body's bounding box, in the same unit.
        size: f64,
    },
    /// An angular velocity seems to be in degrees.
    AngularVelocityInDegrees {
        /// The angular velocity, in radians per unit of time.
        spin: DVec3,
        /// The angle of the rotation over the duration, in radians.
        turn: f64,
    },
    /// A revolute joint's position seems to be in degrees.
    JointInDegrees {
        /// The position of the joint, in radians.
        joint_position: f64,
    },
    /// Roll, pitch or yaw is more than a turn, and seems to be in degrees.
    RollPitchYawInDegrees {
        /// Roll, pitch and yaw, in radians.
        angles: [f64; 3],
    },
    /// A quaternion is far from unit length.
    NonUnitQuaternion {
        /// The components x, y, z, w as given.
        quaternion_components: [f64; 4],
        /// The length of the quaternion, which should be 1.
        quaternion_norm: f64,
    },
    /// A mesh bounds no solid, and was not asked to be a surface.
    SurfaceOnly {
        /// The number of its edges with a single face.
        open_edges: usize,
    },
    /// A mesh bounds no solid, but would if vertices that nearly meet were one.
    OpenSeam {
        /// The largest distance between two of these vertices.
        joining_distance: f64,
    },
    /// Closed shells of a mesh were turned, so that one inside another bounds a cavity.
    TurnedShells {
        /// The number of shells that were turned.
        turned_shells: usize,
    },
    /// All vertices of a mesh are at one point.
    PointMesh,
    /// A mesh file states a unit that is not the metre, and no unit was asked for.
    UnitOfFile {
        /// The symbol of the unit.
        unit: &'static str,
    },
}

/// The tolerance above which a remark is made, as a share of the smaller body's size. With the default tolerance, a
/// part of a centimetre in metres is not remarked upon, and one of a millimetre is.
const COARSE_TOLERANCE_SHARE: f64 = 0.1;

/// The rotation in radians above which an angle may be meant in degrees. Four turns in radians are 25; as degrees, that
/// is a small angle. Robots' joints and parts that are thrown or assembled turn less.
const MIN_SUSPICIOUS_ROTATION: f64 = 4.0 * TAU;

/// The largest angle in radians of something at rest: a turn, rounded up.
const MAX_FIXED_ANGLE: f64 = 1.001 * TAU;

/// The largest angle, in degrees, that a mistaken input is assumed to mean: two turns. More is a shaft that spins.
const MAX_MISTAKEN_DEGREES: f64 = 720.0;

/// The step in degrees whose multiples count as round angles. None of 50, 100, 200, 500 and the multiples of π, which
/// are typical of radians, is a multiple of it.
const ROUND_ANGLE_STEP_DEGREES: f64 = 15.0;

/// The largest relative deviation from a round angle that is attributed to rounding.
const ROUNDING: f64 = 1e-9;

/// The deviation of a quaternion's length from 1 above which a remark is made. A quaternion that is printed with two
/// digits deviates less.
const MAX_UNIT_LENGTH_DEVIATION: f64 = 0.1;

impl Remark {
    /// Returns the largest side of a body's axis-aligned bounding box in the body's frame.
    ///
    /// # Complexity
    /// Linear in the body's points.
    pub fn body_size(body: &Body) -> f64 {
        Remark::sides(body).into_iter().fold(0.0, greater)
    }

    /// Returns the sides of a body's axis-aligned bounding box in the body's frame.
    ///
    /// # Complexity
    /// Linear in the body's points.
    pub fn sides(body: &Body) -> [f64; 3] {
        let (low, high) = bounding_box(corners_of_boxes_around_points(body));
        (high - low).to_array()
    }

    /// Returns a remark if the tolerance is large relative to the smaller of two bodies, given their
    /// [sizes](Remark::body_size). A point has none.
    pub fn remark_on_tolerance(tolerance: f64, sizes: [f64; 2]) -> Option<Self> {
        let size = lesser(sizes[0], sizes[1]);
        let is_coarse = size > 0.0 && tolerance > COARSE_TOLERANCE_SHARE * size;
        is_coarse.then_some(Remark::CoarseTolerance { tolerance, size })
    }

    /// Returns a remark if an angular velocity rotates a body by many turns in the duration, and is a round number of
    /// degrees.
    pub fn remark_on_spin(spin: impl Into<[f64; 3]>, duration: f64) -> Option<Self> {
        let spin = DVec3::from_array(spin.into());
        let turn = length(spin) * duration;
        let is_round = [spin, spin * duration]
            .into_iter()
            .any(|rate| rate.to_array().into_iter().all(is_round_degrees));
        (may_be_degrees(turn) && is_round)
            .then_some(Remark::AngularVelocityInDegrees { spin, turn })
    }

    /// Returns a remark if a joint's position is many turns and a round number of degrees.
    pub fn remark_on_joint(position: f64) -> Option<Self> {
        let is_odd = may_be_degrees(position.abs()) && is_round_degrees(position);
        is_odd.then_some(Remark::JointInDegrees {
            joint_position: position,
        })
    }

    /// Returns a remark if one of three angles, such as roll, pitch and yaw, is more than a turn.
    pub fn remark_on_roll_pitch_yaw(angles: [f64; 3]) -> Option<Self> {
        let is_odd = angles.iter().any(|angle| angle.abs() > MAX_FIXED_ANGLE);
        is_odd.then_some(Remark::RollPitchYawInDegrees { angles })
    }

    /// Returns a remark if a quaternion x, y, z, w is far from unit length.
    pub fn remark_on_quaternion(parts: [f64; 4]) -> Option<Self> {
        let [x, y, z, w] = parts;
        let length = length(DVec3::new(w, length(DVec3::new(x, y, z)), 0.0));
        let is_unit = (length - 1.0).abs() <= MAX_UNIT_LENGTH_DEVIATION;
        (!is_unit).then_some(Remark::NonUnitQuaternion {
            quaternion_components: parts,
            quaternion_norm: length,
        })
    }

    /// Returns the remark's text without numbers, the same for remarks of one kind.
    pub fn general_text(&self) -> &'static str {
        match self {
            Remark::CoarseTolerance { .. } => {
                "the tolerance is large against the smaller body, and what is called a contact may be as far away; is it \
                 in the bodies' unit of length?"
            }
            Remark::AngularVelocityInDegrees { .. } => {
                "an angular velocity is a round number of degrees and makes many turns; angular velocities are in radians"
            }
            Remark::JointInDegrees { .. } => {
                "a joint's position is a round number of degrees and many turns; positions are in radians"
            }
            Remark::RollPitchYawInDegrees { .. } => {
                "roll, pitch or yaw is more than a turn; these angles are in radians"
            }
            Remark::NonUnitQuaternion { .. } => {
                "a quaternion is far from unit length, and was taken as one of length 1; is it x, y, z, w?"
            }
            Remark::SurfaceOnly { .. } => {
                "a mesh is not closed: it is a surface, and another body inside it is not found; close it, or say that it is \
                 meant as a surface"
            }
            Remark::OpenSeam { .. } => {
                "a mesh is not closed, by no more than rounding: it is a surface, and another body inside it is not found; join \
                 the vertices that nearly meet"
            }
            Remark::TurnedShells { .. } => {
                "closed shells of a mesh did not alternate and were turned: one inside another bounds a cavity, and a body in it is \
                 not found; if both are solid, give each a body of its own"
            }
            Remark::PointMesh => {
                "all vertices of a mesh are at one point; are its numbers there yet?"
            }
            Remark::UnitOfFile { .. } => {
                "a mesh file states a unit that is not the metre, and its numbers are kept; ask for a unit to convert them"
            }
        }
    }

    /// Returns whether a body rotates by more than four turns in the duration, as if its angular velocity were in
    /// degrees.
    pub fn is_fast_rotation(spin: DVec3, duration: f64) -> bool {
        length(spin) * duration > MIN_SUSPICIOUS_ROTATION
    }
}

/// Returns two opposite corners of a box about each point of a body. The box holds the ball of the piece's radius.
fn corners_of_boxes_around_points(body: &Body) -> impl Iterator<Item = DVec3> {
    body.pieces().iter().flat_map(|piece| {
        let radius = DVec3::splat(piece.radius);
        let both = move |&point: &DVec3| [point - radius, point + radius];
        piece.points.iter().flat_map(both)
    })
}

fn may_be_degrees(angle: f64) -> bool {
    angle > MIN_SUSPICIOUS_ROTATION && angle <= MAX_MISTAKEN_DEGREES * (1.0 + ROUNDING)
}

fn is_round_degrees(angle: f64) -> bool {
    (angle - (angle / ROUND_ANGLE_STEP_DEGREES).round() * ROUND_ANGLE_STEP_DEGREES).abs()
        <= ROUNDING * angle.abs()
}

impl fmt::Display for Remark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.general_text())?;
        if *self != Remark::PointMesh {
            f.write_str(": ")?;
        }
        match *self {
            Remark::CoarseTolerance { tolerance, size } => {
                let [tolerance, size] = [tolerance, size].map(Number);
                write!(f, "{tolerance}, and the body is {size} long")
            }
            Remark::AngularVelocityInDegrees { spin, turn } => {
                let [x, y, z] = spin.to_array().map(Number);
                write!(f, "({x}, {y}, {z}) makes {:.1} turns", turn / TAU)
            }
            Remark::JointInDegrees {
                joint_position: position,
            } => {
                let turns = position.abs() / TAU;
                write!(f, "{} is {turns:.1} turns", Number(position))
            }
            Remark::RollPitchYawInDegrees { angles } => {
                let [roll, pitch, yaw] = angles.map(Number);
                write!(f, "({roll}, {pitch}, {yaw})")
            }
            Remark::NonUnitQuaternion {
                quaternion_components,
                quaternion_norm,
            } => {
                let [x, y, z, w] = quaternion_components.map(Number);
                write!(
                    f,
                    "({x}, {y}, {z}, {w}) has the length {}",
                    RoundedToFourDigits(quaternion_norm)
                )
            }
            Remark::SurfaceOnly { open_edges } => write!(f, "{open_edges} edges have one face"),
            Remark::TurnedShells { turned_shells: 1 } => write!(f, "1 shell was turned"),
            Remark::TurnedShells { turned_shells } => {
                write!(f, "{turned_shells} shells were turned")
            }
            Remark::OpenSeam { joining_distance } => {
                write!(f, "they are up to {joining_distance:.1e} apart")
            }
            Remark::PointMesh => Ok(()),
            Remark::UnitOfFile { unit } => write!(f, "{unit}"),
        }
    }
}

#[cfg(test)]
mod tests;
