//! The frames of all links in eight configurations, with their velocities.

use super::sine::sin_cos;
use crate::kinematics::{Kinematics, MovingJoint};
use ccd_core::fearless_simd::{Simd, SimdBase, f32x8};
use ccd_core::simd::{Vec3x8, load, splat};
use rigid_ccd::glam::{DMat3, DQuat, DVec3, Vec3};

/// The x, y and z of eight vectors.
pub(super) type Rows = [[f32; 8]; 3];

/// Entries of rotations that are nearer to 0 than this count as 0, and coordinates of origins that are nearer to 0 than
/// this times their length.
const LEAST_ENTRY: f64 = 1e-12;

/// A joint, with constants in f32. The frame after the joint is turned so that its z axis is the joint's axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct LaneJoint {
    parent: usize,
    is_prismatic: bool,
    /// The joint's origin in the parent's frame.
    origin: [f32; 3],
    /// The axes of the frame after the joint in the parent's frame, at position 0.
    axes: [[f32; 3]; 3],
}

/// A frame in eight configurations.
#[derive(Clone, Copy, Debug)]
pub(super) struct LaneFrame {
    axes: [Rows; 3],
    origin: Rows,
    angular_velocity: Rows,
    velocity: Rows,
}

/// A frame in eight configurations, in registers.
#[derive(Clone, Copy)]
pub(super) struct LoadedFrame<L: Simd> {
    pub(super) axes: [Vec3x8<L>; 3],
    pub(super) origin: Vec3x8<L>,
    pub(super) angular_velocity: Vec3x8<L>,
    pub(super) velocity: Vec3x8<L>,
}

impl LaneJoint {
    /// Returns all joints of a robot, and for each frame the rotation from a frame of the kinematics to the frame here.
    pub(super) fn of_robot(kinematics: &Kinematics) -> (Vec<Self>, Vec<DMat3>) {
        let mut to_lane_frames = vec![DMat3::IDENTITY];
        let mut joints = Vec::new();
        for joint in kinematics.joints() {
            let to_own = rotation_to_z(joint.axis_in_own_frame());
            joints.push(LaneJoint::new(
                joint,
                [&to_lane_frames[joint.parent], &to_own],
            ));
            to_lane_frames.push(to_own);
        }
        (joints, to_lane_frames)
    }

    fn new(joint: &MovingJoint, [to_parent, to_own]: [&DMat3; 2]) -> Self {
        let axes = *to_parent * joint.rotation_at_zero() * to_own.transpose();
        let origin = *to_parent * joint.origin;
        let rounded = |x: f64, least: f64| if x.abs() < least { 0.0 } else { x as f32 };
        let coordinate = |x: f64| rounded(x, LEAST_ENTRY * origin.length());
        let entry = |x: f64| rounded(x, LEAST_ENTRY);
        LaneJoint {
            parent: joint.parent,
            is_prismatic: joint.is_prismatic,
            origin: origin.to_array().map(coordinate),
            axes: axes.to_cols_array_2d().map(|column| column.map(entry)),
        }
    }
}

/// Returns a rotation that maps a unit vector to the z axis.
fn rotation_to_z(axis: DVec3) -> DMat3 {
    if axis.x.abs() + axis.y.abs() < LEAST_ENTRY && axis.z > 0.0 {
        return DMat3::IDENTITY;
    }
    DMat3::from_quat(DQuat::from_rotation_arc(axis, DVec3::Z))
}

impl LaneFrame {
    pub(super) const BASE: LaneFrame = LaneFrame {
        axes: [
            [[1.0; 8], [0.0; 8], [0.0; 8]],
            [[0.0; 8], [1.0; 8], [0.0; 8]],
            [[0.0; 8], [0.0; 8], [1.0; 8]],
        ],
        origin: [[0.0; 8]; 3],
        angular_velocity: [[0.0; 8]; 3],
        velocity: [[0.0; 8]; 3],
    };

    #[inline(always)]
    pub(super) fn load<L: Simd>(&self, level: L) -> LoadedFrame<L> {
        let [x, y, z] = &self.axes;
        LoadedFrame {
            axes: [
                Vec3x8::load(level, x),
                Vec3x8::load(level, y),
                Vec3x8::load(level, z),
            ],
            origin: Vec3x8::load(level, &self.origin),
            angular_velocity: Vec3x8::load(level, &self.angular_velocity),
            velocity: Vec3x8::load(level, &self.velocity),
        }
    }
}

/// Computes all frames for eight positions and rates of each joint.
#[inline(always)]
pub(super) fn place_frames<L: Simd>(
    level: L,
    joints: &[LaneJoint],
    (positions, rates): (&[[f32; 8]], &[[f32; 8]]),
    frames: &mut [LaneFrame],
) {
    for (k, joint) in joints.iter().enumerate() {
        let parent = frames[joint.parent].load(level);
        let rate = load(level, &rates[k]);
        let position = load(level, &positions[k]);
        let offset = parent.combined(level, &joint.origin);
        let mut velocity = parent.velocity + parent.angular_velocity.cross(offset);
        let mut origin = parent.origin + offset;
        let mut angular_velocity = parent.angular_velocity;
        let [mut x, mut y, z] = [
            parent.combined(level, &joint.axes[0]),
            parent.combined(level, &joint.axes[1]),
            parent.combined(level, &joint.axes[2]),
        ];
        if joint.is_prismatic {
            let travel = z * position;
            origin = origin + travel;
            velocity = velocity + angular_velocity.cross(travel) + z * rate;
        } else {
            let [sine, cosine] = sin_cos(level, position);
            (x, y) = (x * cosine + y * sine, y * cosine - x * sine);
            angular_velocity = angular_velocity + z * rate;
        }
        let frame = &mut frames[k + 1];
        store_vectors(x, &mut frame.axes[0]);
        store_vectors(y, &mut frame.axes[1]);
        store_vectors(z, &mut frame.axes[2]);
        store_vectors(origin, &mut frame.origin);
        store_vectors(angular_velocity, &mut frame.angular_velocity);
        store_vectors(velocity, &mut frame.velocity);
    }
}

impl<L: Simd> LoadedFrame<L> {
    /// Returns the vector with these coordinates along the axes. Leaves out coordinates that are 0.
    #[inline(always)]
    fn combined(&self, level: L, coordinates: &[f32; 3]) -> Vec3x8<L> {
        let mut sum = Vec3x8::splat(level, Vec3::ZERO);
        for (axis, &coordinate) in self.axes.iter().zip(coordinates) {
            if coordinate != 0.0 {
                sum = sum + *axis * splat(level, coordinate);
            }
        }
        sum
    }

    /// Returns the position and the velocity of a point of the frame.
    #[inline(always)]
    pub(super) fn point(&self, level: L, point: Vec3) -> [Vec3x8<L>; 2] {
        let arm = self.axes[0] * splat(level, point.x)
            + self.axes[1] * splat(level, point.y)
            + self.axes[2] * splat(level, point.z);
        [
            self.origin + arm,
            self.velocity + self.angular_velocity.cross(arm),
        ]
    }
}

#[inline(always)]
pub(super) fn store_vectors<L: Simd>(vectors: Vec3x8<L>, rows: &mut Rows) {
    store(vectors.x, &mut rows[0]);
    store(vectors.y, &mut rows[1]);
    store(vectors.z, &mut rows[2]);
}

#[inline(always)]
pub(super) fn store<L: Simd>(numbers: f32x8<L>, row: &mut [f32; 8]) {
    numbers.store_slice(row);
}
