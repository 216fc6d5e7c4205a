//! Forward kinematics: the frames of all moving links at a configuration.

pub(crate) mod joint_arms;
pub(crate) mod magnitude;
pub(crate) mod moving_frame;

use crate::robot::{PositionSource, Robot};
use magnitude::Magnitude;
use rigid_ccd::Pose;
use rigid_ccd::glam::{DMat3, DVec3};
use rigid_ccd::oracle::Frame;
use rigid_ccd::trajectory::JointKind;

/// The moving joints of a robot, parents first. Joint `k` moves frame `k + 1`; frame 0 is the base.
#[derive(Clone, Debug)]
pub(crate) struct Kinematics {
    joints: Vec<MovingJoint>,
    /// For each link, the frame to which it is fixed, and its pose there.
    links: Vec<(usize, Pose)>,
    /// For each joint of the robot, its index among the moving joints; `None` for a fixed joint.
    moving_joint_indices: Vec<Option<usize>>,
    /// The sum of the distances of all joint origins from their parent frames' origins.
    pub(crate) arm_length_sum: f64,
    /// The number of all joints, including fixed ones.
    pub(crate) total_joint_count: usize,
}

/// A moving joint, with precomputed constants.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MovingJoint {
    /// The index of the parent frame.
    pub(crate) parent: usize,
    /// Computes the joint's position from a configuration.
    pub(crate) source: PositionSource,
    /// The joint's origin in the parent frame.
    pub(crate) origin: DVec3,
    /// The unit vector along the axis, in the parent frame.
    pub(crate) axis: DVec3,
    pub(crate) is_prismatic: bool,
    /// Terms of the rotation from the joint's frame to the parent's, at position `q`: `constant_term + sin(q)
    /// sine_coefficient + cos(q) cosine_coefficient`.
    constant_term: DMat3,
    sine_coefficient: DMat3,
    cosine_coefficient: DMat3,
}

impl Kinematics {
    /// Precomputes the moving joints of a robot. A fixed joint is merged into the joints below it in the tree.
    pub(crate) fn of_robot(robot: &Robot) -> Self {
        let mut joints: Vec<MovingJoint> = Vec::new();
        let mut links = vec![(0, Pose::IDENTITY); robot.links().len()];
        let mut moving_joint_indices = vec![None; robot.joints().len()];
        let mut arm_length_sum = 0.0;
        for (link, parent, joint) in robot.joints_parents_first() {
            arm_length_sum += robot.joints()[joint]
                .geometry
                .origin()
                .translation()
                .length();
            let (frame, parent_pose) = links[parent];
            let origin = parent_pose.compose(robot.joints()[joint].geometry.origin());
            let kind = robot.joints()[joint].geometry.kind();
            let (axis, is_prismatic, source) = match (kind, robot.source(joint)) {
                (JointKind::Revolute(axis), Some(source)) => (axis, false, source),
                (JointKind::Prismatic(axis), Some(source)) => (axis, true, source),
                _ => {
                    links[link] = (frame, origin);
                    continue;
                }
            };
            moving_joint_indices[joint] = Some(joints.len());
            joints.push(MovingJoint::new(frame, source, &origin, axis, is_prismatic));
            links[link] = (joints.len(), Pose::IDENTITY);
        }
        Kinematics {
            joints,
            links,
            moving_joint_indices,
            arm_length_sum,
            total_joint_count: robot.joints().len(),
        }
    }

    pub(crate) fn joints(&self) -> &[MovingJoint] {
        &self.joints
    }

    /// Returns an upper bound of each moving joint's positions, over all configurations whose positions have at most
    /// the absolute values of the positions in `configuration`.
    pub(crate) fn magnitudes(&self, configuration: &[f64]) -> impl Iterator<Item = Magnitude> {
        self.joints.iter().map(|joint| {
            let rounding = joint.source.magnitude(configuration);
            Magnitude {
                position: rounding,
                rounding,
            }
        })
    }

    /// Returns the index of the frame to which a link is fixed, and the link's pose there.
    pub(crate) fn link_frame_and_pose(&self, link: usize) -> (usize, Pose) {
        self.links[link]
    }

    /// Returns the index of a joint among the moving joints; `None` for a fixed joint.
    pub(crate) fn moving_joint_index(&self, joint: usize) -> Option<usize> {
        self.moving_joint_indices[joint]
    }

    /// Returns the nearest common ancestor of two frames.
    pub(crate) fn common_frame(&self, [mut a, mut b]: [usize; 2]) -> usize {
        // An ancestor has a lower index.
        while a != b {
            if a > b {
                a = self.joints[a - 1].parent;
            } else {
                b = self.joints[b - 1].parent;
            }
        }
        a
    }

    /// Iterates over the joints that move two frames relative to each other, children before parents.
    pub(crate) fn joints_between(
        &self,
        [mut a, mut b]: [usize; 2],
    ) -> impl Iterator<Item = usize> + '_ {
        std::iter::from_fn(move || {
            if a == b {
                return None;
            }
            // An ancestor has a lower index.
            let farther = if a > b { &mut a } else { &mut b };
            let joint = *farther - 1;
            *farther = self.joints[joint].parent;
            Some(joint)
        })
    }

    /// Computes the poses of all frames in the base frame, from one position for each moving joint.
    pub(crate) fn place(&self, positions: impl Iterator<Item = f64>, frames: &mut Vec<Frame>) {
        frames.clear();
        frames.push(Frame::IDENTITY);
        for (joint, position) in self.joints.iter().zip(positions) {
            let parent = frames[joint.parent];
            frames.push(joint.place(&parent, position));
        }
    }

    /// Computes the poses of the frames that some joints move, relative to the frame `seen_from`. Parents must come
    /// before children. Other frames keep their poses.
    pub(crate) fn place_joints(
        &self,
        chain: (usize, &[usize]),
        configuration: &[f64],
        frames: &mut Vec<Frame>,
    ) {
        let position = |joint: usize| self.joints[joint].source.position(configuration);
        self.place_joints_at(chain, position, frames);
    }

    /// The same as [`Kinematics::place_joints`], for the positions that `position` returns.
    pub(crate) fn place_joints_at(
        &self,
        (seen_from, joints): (usize, &[usize]),
        position: impl Fn(usize) -> f64,
        frames: &mut Vec<Frame>,
    ) {
        frames.resize(self.joints.len() + 1, Frame::IDENTITY);
        frames[seen_from] = Frame::IDENTITY;
        for &index in joints {
            let joint = &self.joints[index];
            let parent = frames[joint.parent];
            frames[index + 1] = joint.place(&parent, position(index));
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
        let rotation = DMat3::from_quat(origin.rotation());
        let axis_projection = DMat3::from_cols(axis * axis.x, axis * axis.y, axis * axis.z);
        let cross_matrix = DMat3::from_cols(
            axis.cross(DVec3::X),
            axis.cross(DVec3::Y),
            axis.cross(DVec3::Z),
        );
        let (constant_term, sine_coefficient, cosine_coefficient) = if is_prismatic {
            (rotation, DMat3::ZERO, DMat3::ZERO)
        } else {
            (
                rotation * axis_projection,
                rotation * cross_matrix,
                rotation * (DMat3::IDENTITY - axis_projection),
            )
        };
        MovingJoint {
            parent,
            source,
            origin: origin.translation(),
            axis: rotation * axis,
            is_prismatic,
            constant_term,
            sine_coefficient,
            cosine_coefficient,
        }
    }

    /// Returns the rotation from the joint's frame to the parent's at position 0.
    pub(crate) fn rotation_at_zero(&self) -> DMat3 {
        self.constant_term + self.cosine_coefficient
    }

    /// Returns the unit vector along the axis, in the frame that the joint moves.
    pub(crate) fn axis_in_own_frame(&self) -> DVec3 {
        self.rotation_at_zero().transpose() * self.axis
    }

    /// Returns the frame that the joint moves.
    #[inline(always)]
    fn place(&self, parent: &Frame, position: f64) -> Frame {
        if self.is_prismatic {
            return Frame {
                rotation: parent.rotation * self.constant_term,
                translation: parent.transform_point(self.origin + self.axis * position),
            };
        }
        let (sine, cosine) = position.sin_cos();
        let rotation =
            self.constant_term + self.sine_coefficient * sine + self.cosine_coefficient * cosine;
        Frame {
            rotation: parent.rotation * rotation,
            translation: parent.transform_point(self.origin),
        }
    }
}
