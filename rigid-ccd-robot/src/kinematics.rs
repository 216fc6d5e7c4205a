//! The frames of all moving links at one configuration.

pub(crate) mod magnitude;

use crate::robot::{PositionSource, Robot};
use magnitude::Magnitude;
use rigid_ccd::Pose;
use rigid_ccd::glam::{DMat3, DVec3};
use rigid_ccd::oracle::Frame;
use rigid_ccd::trajectory::JointKind;

/// The joints of a robot that move, each after those nearer to the base. Joint `k` moves frame `k + 1`; frame 0 is the
/// base.
#[derive(Clone, Debug)]
pub(crate) struct Kinematics {
    joints: Vec<MovingJoint>,
    /// For each link, the frame in which it rests, and its pose there.
    links: Vec<(usize, Pose)>,
    /// For each joint of the robot, its number among those that move; `None` for a fixed one.
    moving_joint_indices: Vec<Option<usize>>,
    /// The sum of the distances of all joints from the frames that hold them.
    pub(crate) arm_length_sum: f64,
    /// The number of all joints, fixed ones included.
    pub(crate) total_joint_count: usize,
}

/// A joint that moves, with what does not change.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MovingJoint {
    /// The number of the frame that holds the joint.
    pub(crate) parent: usize,
    /// How the joint's position comes from a configuration.
    pub(crate) source: PositionSource,
    /// The position of the joint's origin in the parent frame.
    pub(crate) origin: DVec3,
    /// The unit vector along the axis in the parent frame.
    pub(crate) axis: DVec3,
    pub(crate) is_prismatic: bool,
    /// The rotation from the joint's frame to the parent's is `fixed + sin(q) sine + cos(q) cosine`.
    constant_term: DMat3,
    sine_coefficient: DMat3,
    cosine_coefficient: DMat3,
}

impl Kinematics {
    /// Prepares the joints of a robot. Fixed joints become part of the joints after them.
    pub(crate) fn of_robot(robot: &Robot) -> Self {
        let mut joints: Vec<MovingJoint> = Vec::new();
        let mut links = vec![(0, Pose::IDENTITY); robot.links().len()];
        let mut numbers = vec![None; robot.joints().len()];
        let mut arms = 0.0;
        for (link, parent, joint) in robot.joints_parents_first() {
            arms += robot.joints()[joint]
                .axis_and_limits
                .origin()
                .translation()
                .length();
            let (frame, parent_pose) = links[parent];
            let origin = parent_pose.compose(robot.joints()[joint].axis_and_limits.origin());
            let kind = robot.joints()[joint].axis_and_limits.kind();
            let (axis, is_prismatic, source) = match (kind, robot.source(joint)) {
                (JointKind::Revolute(axis), Some(source)) => (axis, false, source),
                (JointKind::Prismatic(axis), Some(source)) => (axis, true, source),
                _ => {
                    links[link] = (frame, origin);
                    continue;
                }
            };
            numbers[joint] = Some(joints.len());
            joints.push(MovingJoint::new(frame, source, &origin, axis, is_prismatic));
            links[link] = (joints.len(), Pose::IDENTITY);
        }
        Kinematics {
            joints,
            links,
            moving_joint_indices: numbers,
            arm_length_sum: arms,
            total_joint_count: robot.joints().len(),
        }
    }

    pub(crate) fn joints(&self) -> &[MovingJoint] {
        &self.joints
    }

    /// Returns bounds of the positions of all joints in a configuration, for all configurations whose positions are no larger.
    pub(crate) fn magnitudes(&self, configuration: &[f64]) -> impl Iterator<Item = Magnitude> {
        self.joints.iter().map(|joint| {
            let rounding = joint.source.magnitude(configuration);
            Magnitude {
                position: rounding,
                rounding,
            }
        })
    }

    /// Returns the frame in which a link rests, and its pose there.
    pub(crate) fn link_frame_and_pose(&self, link: usize) -> (usize, Pose) {
        self.links[link]
    }

    /// Returns the number of a joint of the robot among those that move; `None` for a fixed one.
    pub(crate) fn moving_joint_index(&self, joint: usize) -> Option<usize> {
        self.moving_joint_indices[joint]
    }

    /// Returns the nearest frame from which two frames move.
    pub(crate) fn common_frame(&self, [mut a, mut b]: [usize; 2]) -> usize {
        // A frame has a greater number than those nearer to the base.
        while a != b {
            if a > b {
                a = self.joints[a - 1].parent;
            } else {
                b = self.joints[b - 1].parent;
            }
        }
        a
    }

    /// Iterates over the joints by which two frames move, as they see each other.
    pub(crate) fn joints_between(
        &self,
        [mut a, mut b]: [usize; 2],
    ) -> impl Iterator<Item = usize> + '_ {
        std::iter::from_fn(move || {
            if a == b {
                return None;
            }
            // A frame has a greater number than those nearer to the base.
            let farther = if a > b { &mut a } else { &mut b };
            let joint = *farther - 1;
            *farther = self.joints[joint].parent;
            Some(joint)
        })
    }

    /// Computes the poses of all frames in the base, for one position for each moving joint.
    pub(crate) fn place(&self, positions: impl Iterator<Item = f64>, frames: &mut Vec<Frame>) {
        frames.clear();
        frames.push(Frame::IDENTITY);
        for (joint, position) in self.joints.iter().zip(positions) {
            let parent = frames[joint.parent];
            frames.push(joint.place(&parent, position));
        }
    }

    /// Computes the poses of the frames after some joints as the frame `seen_from` sees them. Each joint comes after those nearer to
    /// the base. Other frames stay as they are.
    pub(crate) fn place_joints(
        &self,
        (seen_from, joints): (usize, &[usize]),
        configuration: &[f64],
        frames: &mut Vec<Frame>,
    ) {
        frames.resize(self.joints.len() + 1, Frame::IDENTITY);
        frames[seen_from] = Frame::IDENTITY;
        for &number in joints {
            let joint = &self.joints[number];
            let parent = frames[joint.parent];
            frames[number + 1] = joint.place(&parent, joint.source.position(configuration));
        }
    }
}

impl MovingJoint {
    fn new(
        parent: usize,
        source: PositionSource,
        origin: &Pose,
        axis: DVec3,
        is_prismatic: bool,
    ) -> Self {
        let frame = DMat3::from_quat(origin.rotation());
        let along = DMat3::from_cols(axis * axis.x, axis * axis.y, axis * axis.z);
        let cross = DMat3::from_cols(
            axis.cross(DVec3::X),
            axis.cross(DVec3::Y),
            axis.cross(DVec3::Z),
        );
        let (fixed, sine, cosine) = if is_prismatic {
            (frame, DMat3::ZERO, DMat3::ZERO)
        } else {
            (
                frame * along,
                frame * cross,
                frame * (DMat3::IDENTITY - along),
            )
        };
        MovingJoint {
            parent,
            source,
            origin: origin.translation(),
            axis: frame * axis,
            is_prismatic,
            constant_term: fixed,
            sine_coefficient: sine,
            cosine_coefficient: cosine,
        }
    }

    /// Returns the pose of the frame after the joint.
    fn place(&self, parent: &Frame, position: f64) -> Frame {
        if self.is_prismatic {
            return Frame {
                rotation: parent.rotation * self.constant_term,
                translation: parent.transform_point(self.origin + self.axis * position),
            };
        }
        let (sine, cosine) = position.sin_cos();
        let turned =
            self.constant_term + self.sine_coefficient * sine + self.cosine_coefficient * cosine;
        Frame {
            rotation: parent.rotation * turned,
            translation: parent.transform_point(self.origin),
        }
    }
}
