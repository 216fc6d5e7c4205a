//! A family of scenes with known answers, whose parameter makes them harder step by step.

use crate::truth::Truth;
use anyhow::Result;
use ccd_core::glam::{DQuat, DVec3};
use ccd_core::{InputError, Motion, Pose};
use ccd_decomp::TriangleMesh;
use ccd_tables::motions::Motions;

/// A set of scenes of one kind, made from a parameter whose later values make the scene harder.
#[derive(Clone, Debug)]
pub struct Family {
    /// The name of the family in tables.
    pub name: &'static str,
    /// What the parameter measures, in words for tables, such as "distance in sizes".
    pub parameter_description: &'static str,
    /// The values of the parameter, the easiest first.
    pub parameter_values: Vec<f64>,
    /// The function that makes the scene for one value of the parameter.
    pub make_scene: fn(f64) -> Result<FamilyScene>,
}

/// The scene of a family for one value of its parameter: two meshes, and queries with known answers.
#[derive(Clone, Debug)]
pub struct FamilyScene {
    /// The meshes of body A and body B.
    pub meshes: [TriangleMesh; 2],
    /// The tolerance of the queries, in the scene's unit of length.
    pub tolerance: f64,
    /// The distance to keep between the bodies, in the scene's unit of length.
    pub margin: f64,
    /// The duration of each query, in the motions' unit of time.
    pub duration: f64,
    /// The queries about the two meshes, each with its exact answer.
    pub cases: Vec<ExactCase>,
}

/// A query with its exact answer.
#[derive(Clone, Debug)]
pub struct ExactCase {
    /// The motions of both bodies.
    pub query: Motions,
    /// The exact answer of the query, where a contact is a distance of at most the margin, or one body inside the
    /// other.
    pub expected_truth: Truth,
}

impl Family {
    /// Returns the same family with the given description and values of its parameter.
    pub(super) fn with_parameter(self, parameter: &'static str, values: Vec<f64>) -> Self {
        Family {
            parameter_description: parameter,
            parameter_values: values,
            ..self
        }
    }
}

/// The motion of one body; the velocities are the displacement and the rotation vector over the whole duration.
#[derive(Clone, Copy, Debug)]
pub(super) struct BodyMotion {
    pub(super) start_position: DVec3,
    pub(super) orientation: DQuat,
    pub(super) velocity: DVec3,
    pub(super) angular_velocity: DVec3,
    /// The center of rotation, in the body's frame.
    pub(super) rotation_center: DVec3,
}

/// The rotations by which a whole scene is turned to repeat its queries, as pairs of an axis and an angle in radians.
const WORLD_ROTATIONS: [(DVec3, f64); 2] = [
    (DVec3::new(0.6, 0.0, 0.8), 1.1),
    (DVec3::new(-0.48, 0.6, 0.64), 2.3),
];

/// The default tolerance of a scene, in the scene's unit of length.
const TOLERANCE: f64 = 1e-6;

/// Returns the exact answer for a contact at a known time, widened by `slack` for the rounding of the query's numbers.
pub(super) fn truth_for_contact_time(time: f64, slack: f64) -> Truth {
    Truth::Hit {
        lo: time - slack,
        hi: time + slack,
    }
}

impl BodyMotion {
    pub(super) const STILL: BodyMotion = BodyMotion {
        start_position: DVec3::ZERO,
        orientation: DQuat::IDENTITY,
        velocity: DVec3::ZERO,
        angular_velocity: DVec3::ZERO,
        rotation_center: DVec3::ZERO,
    };

    /// The motion of a body that falls from z = 3 to z = −1.
    pub(super) const FALLING: BodyMotion = BodyMotion {
        start_position: DVec3::new(0.0, 0.0, 3.0),
        velocity: DVec3::new(0.0, 0.0, -4.0),
        ..BodyMotion::STILL
    };

    /// The motion of a slab that rests at z = −1, so that its top is at 0.
    pub(super) const RESTING_SLAB_MOTION: BodyMotion = BodyMotion {
        start_position: DVec3::NEG_Z,
        ..BodyMotion::STILL
    };

    /// Returns the motion of a body that rests at a position.
    pub(super) fn motion_at_rest(at: DVec3) -> Self {
        BodyMotion::straight(at, DVec3::ZERO)
    }

    /// Returns the motion of a body in a straight line, without rotation.
    pub(super) fn straight(at: DVec3, velocity: DVec3) -> Self {
        BodyMotion {
            start_position: at,
            velocity,
            ..BodyMotion::STILL
        }
    }

    /// Returns the same motion with another orientation at the start.
    pub(super) fn with_orientation(self, turned: DQuat) -> Self {
        BodyMotion {
            orientation: turned,
            ..self
        }
    }

    /// Returns the same motion with another angular velocity about the center.
    pub(super) fn with_spin(self, spin: DVec3) -> Self {
        BodyMotion {
            angular_velocity: spin,
            ..self
        }
    }

    fn motion(self, world: DQuat, duration: f64) -> Result<Motion, InputError> {
        let start = Pose::new(world * self.start_position, world * self.orientation)?;
        let velocity = world * self.velocity / duration;
        let spin = world * self.angular_velocity / duration;
        Motion::about(start, velocity, spin, self.rotation_center)
    }
}

impl FamilyScene {
    /// Creates a scene for two meshes, with the default tolerance, no margin, duration 1 and no queries.
    pub(super) fn new(a: TriangleMesh, b: TriangleMesh) -> Self {
        FamilyScene {
            meshes: [a, b],
            tolerance: TOLERANCE,
            margin: 0.0,
            duration: 1.0,
            cases: Vec::new(),
        }
    }

    /// Returns the same scene with another tolerance.
    pub(super) fn with_tolerance(self, tolerance: f64) -> Self {
        FamilyScene { tolerance, ..self }
    }

    /// Adds a query with exactly these motions; the expected times are fractions of the duration.
    pub(super) fn with_query(self, a: BodyMotion, b: BodyMotion, expected: Truth) -> Result<Self> {
        self.with_query_in_rotated_world(DQuat::IDENTITY, [a, b], expected)
    }

    /// Adds a query, and the same query with the whole scene turned by each of the `WORLD_ROTATIONS`. The expected
    /// answer must still be right after the rounding of the turned motions.
    pub(super) fn with_query_and_rotations(
        mut self,
        a: BodyMotion,
        b: BodyMotion,
        expected: Truth,
    ) -> Result<Self> {
        self = self.with_query(a, b, expected)?;
        for (axis, angle) in WORLD_ROTATIONS {
            self = self.with_query_in_rotated_world(
                DQuat::from_axis_angle(axis, angle),
                [a, b],
                expected,
            )?;
        }
        Ok(self)
    }

    /// Adds a query, and its copies in turned scenes only if the expected answer is still right after their rounding.
    pub(super) fn with_query_and_rotations_if(
        self,
        bears_rounding: bool,
        a: BodyMotion,
        b: BodyMotion,
        expected: Truth,
    ) -> Result<Self> {
        if bears_rounding {
            self.with_query_and_rotations(a, b, expected)
        } else {
            self.with_query(a, b, expected)
        }
    }

    fn with_query_in_rotated_world(
        mut self,
        world: DQuat,
        [a, b]: [BodyMotion; 2],
        expected: Truth,
    ) -> Result<Self> {
        let query = Motions {
            id: self.cases.len().to_string(),
            a: a.motion(world, self.duration)?,
            b: b.motion(world, self.duration)?,
            duration: self.duration,
        };
        let expected = match expected {
            Truth::Hit { lo, hi } => Truth::Hit {
                lo: lo * self.duration,
                hi: hi * self.duration,
            },
            other => other,
        };
        self.cases.push(ExactCase {
            query,
            expected_truth: expected,
        });
        Ok(self)
    }
}
