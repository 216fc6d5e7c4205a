//! Draws groups of nodes, and other nodes near them, in f64 and rounded to f32.

use super::{EightPairSample, Solid};
use crate::body::tree::{
    BoxGroup, LANES, Node, NodeChildren, StoredTriangleGroup, TriangleGroup, is_thin_triangle,
    round_up_to_f32, unit_normal,
};
use crate::engine::nodes::eight_pairs::BodyRotation;
use crate::engine::nodes::eight_pairs::RelativeMotionF32;
use crate::engine::nodes::shape::{OtherBox, OtherNode, OtherTriangle};
use crate::math::order::greater;
use crate::rounding::{
    ARM_INCREASE_PER_DISTANCE, GAP_ERROR_PER_DISTANCE_F32, GAP_ERROR_PER_RADIUS_F32, LEAST_GAP_F32,
    RATE_ERROR_F32,
};
use crate::settings::VectorInstructions;
use crate::tests::scene::{
    RngExt, random_direction, random_point_in_ball, random_power_of_ten, random_rotation,
};
use crate::vectorize;
use glam::{DMat3, DVec3, Vec3};

fn spin(rng: &mut impl RngExt) -> DVec3 {
    if rng.random_bool(0.7) {
        random_direction(rng) * random_power_of_ten(rng, -3.0, 1.6)
    } else {
        DVec3::ZERO
    }
}

/// Draws the center of rotation of a body with a node of this size and position.
fn center(rng: &mut impl RngExt, at: DVec3, size: f64) -> DVec3 {
    let reach = size * random_power_of_ten(rng, -1.0, 4.0);
    if rng.random_bool(0.3) {
        at
    } else {
        at + random_point_in_ball(rng, reach)
    }
}

/// The points of a node in its body's frame.
pub(super) struct Shape {
    points: Vec<DVec3>,
    node: Node,
}

impl Shape {
    /// Draws a box of random size and proportions, often as thin as a plate or a needle.
    pub(super) fn new(rng: &mut impl RngExt) -> Self {
        let size = random_power_of_ten(rng, -4.0, 4.0);
        Shape::random_box(rng, size, DVec3::ZERO)
    }

    fn random_box(rng: &mut impl RngExt, size: f64, center: DVec3) -> Self {
        let frame = DMat3::from_quat(random_rotation(rng));
        let mut ratio = || match rng.random_range(0..3) {
            0 => 1e-7,
            _ => rng.random_range(0.1..1.0),
        };
        let half = size * DVec3::new(1.0, ratio(), ratio());
        let corner = |k: usize| {
            let sign = |bit: usize| if k >> bit & 1 == 1 { 1.0 } else { -1.0 };
            center + frame * (half * DVec3::new(sign(0), sign(1), sign(2)))
        };
        let points: Vec<DVec3> = (0..8).map(corner).collect();
        let axes = [frame.x_axis, frame.y_axis, frame.z_axis].map(DVec3::as_vec3);
        let farthest = |measure: &dyn Fn(DVec3) -> f64| {
            round_up_to_f32(
                points
                    .iter()
                    .map(|&p| measure(p - center))
                    .fold(0.0, greater),
            )
            .next_up()
        };
        let node = Node {
            center,
            axes,
            half_extents: axes.map(|u| farthest(&|offset| offset.dot(u.as_dvec3()).abs())),
            rounding_radius: 0.0,
            radius: farthest(&DVec3::length),
            children: NodeChildren::Boxes(0),
        };
        Shape { points, node }
    }

    /// Returns a triangle of three corners of the shape, relative to their mean.
    pub(super) fn triangle(mut self) -> Self {
        self.points.truncate(3);
        let mean = (self.points[0] + self.points[1] + self.points[2]) / 3.0;
        for point in &mut self.points {
            *point -= mean;
        }
        self
    }
}

/// The pose of the other node, and the motions of both bodies.
pub(super) struct PairConfiguration {
    /// The rotation from the other body's frame to the split body's.
    rotation: DMat3,
    other_position: DVec3,
    /// The scale of the children's sizes, and of their distances from the group's origin.
    children_scale: f64,
    origin: DVec3,
    velocity: DVec3,
    acceleration: Option<DVec3>,
    angular_velocities: [DVec3; 2],
    rotation_centers: [DVec3; 2],
}

impl PairConfiguration {
    pub(super) fn new(rng: &mut impl RngExt, other: &Shape) -> Self {
        let radius = f64::from(other.node.radius);
        let size = radius * random_power_of_ten(rng, -3.0, 3.0);
        // The distance is mostly near; otherwise so near, or so far, that one kind of rounding dominates.
        let far = match rng.random_range(0..5) {
            0 => random_power_of_ten(rng, -3.0, 0.0),
            1 => random_power_of_ten(rng, 0.0, 4.0),
            _ => rng.random_range(0.5..4.0),
        } * (radius + size);
        let place = random_direction(rng) * far;
        let fast = far * random_power_of_ten(rng, -3.0, 2.0);
        let offset = size * random_power_of_ten(rng, 0.0, 6.0);
        PairConfiguration {
            rotation: DMat3::from_quat(random_rotation(rng)),
            other_position: place,
            children_scale: size,
            origin: random_point_in_ball(rng, offset),
            velocity: if rng.random_bool(0.8) {
                random_direction(rng) * fast
            } else {
                DVec3::ZERO
            },
            acceleration: rng
                .random_bool(0.4)
                .then(|| random_direction(rng) * far * random_power_of_ten(rng, -3.0, 2.0)),
            angular_velocities: [spin(rng), spin(rng)],
            rotation_centers: [center(rng, DVec3::ZERO, size), center(rng, place, radius)],
        }
    }

    /// Returns the scale of the children's sizes, and of their distances from the group's origin.
    pub(super) fn size(&self) -> f64 {
        self.children_scale
    }

    /// Moves the other node to the distance `far`, in units of the sum of both sizes.
    pub(super) fn with_relative_distance(self, far: f64, other: &Shape) -> Self {
        let far = far * (f64::from(other.node.radius) + self.children_scale);
        PairConfiguration {
            other_position: self.other_position / self.other_position.length() * far,
            ..self
        }
    }

    /// Makes only the other node turn, about a point at `arm` from its middle.
    pub(super) fn with_only_other_turning(self, spin: DVec3, arm: DVec3) -> Self {
        PairConfiguration {
            velocity: DVec3::ZERO,
            angular_velocities: [DVec3::ZERO, spin],
            rotation_centers: [DVec3::ZERO, self.other_position + arm],
            ..self
        }
    }

    fn child(&self, points: &[DVec3]) -> Solid {
        Solid {
            points: points.iter().map(|&p| p - self.origin).collect(),
            center: self.rotation_centers[0],
            spin: self.angular_velocities[0],
        }
    }

    fn other_solid(&self, other: &Shape) -> Solid {
        Solid {
            points: other
                .points
                .iter()
                .map(|&p| self.rotation * p + self.other_position)
                .collect(),
            center: self.rotation_centers[1],
            spin: self.angular_velocities[1],
        }
    }

    fn random_child_shape(&self, rng: &mut impl RngExt) -> Shape {
        let size = self.children_scale * random_power_of_ten(rng, -2.0, 0.0);
        let center = self.origin + random_point_in_ball(rng, self.children_scale);
        Shape::random_box(rng, size, center)
    }

    pub(super) fn box_sample(
        &self,
        rng: &mut impl RngExt,
        other: &Shape,
    ) -> EightPairSample<BoxGroup, OtherBox> {
        let shapes: Vec<Shape> = (0..LANES).map(|_| self.random_child_shape(rng)).collect();
        let nodes: Vec<Node> = shapes.iter().map(|s| s.node.clone()).collect();
        let group = BoxGroup::new(&nodes, 0, self.origin);
        let children = shapes.iter().map(|s| self.child(&s.points)).collect();
        let [x, y, z] = [
            self.rotation.x_axis,
            self.rotation.y_axis,
            self.rotation.z_axis,
        ]
        .map(DVec3::as_vec3);
        let node = &other.node;
        let boxed = OtherBox {
            center: (self.rotation * node.center + self.other_position).as_vec3(),
            axes: node.axes.map(|u| x * u.x + y * u.y + z * u.z),
            half_extents: node.half_extents,
            rounding_radius: node.rounding_radius,
            radius: node.radius,
            is_piece: false,
        };
        let reach = group.header.max_distance_from_origin;
        self.build_sample(group, boxed, reach, children, self.other_solid(other))
    }

    pub(super) fn triangle_sample(
        &self,
        rng: &mut impl RngExt,
        other: &Shape,
    ) -> EightPairSample<TriangleGroup, OtherTriangle> {
        let shapes: Vec<Shape> = (0..LANES).map(|_| self.random_child_shape(rng)).collect();
        let corners: Vec<[DVec3; 3]> = shapes
            .iter()
            .map(|s| [s.points[0], s.points[1], s.points[6]])
            .collect();
        let level = VectorInstructions::Best.simd_level();
        let row = StoredTriangleGroup::new(&corners, 0, self.origin);
        let group = vectorize!(level, level => TriangleGroup::new(level, &row, &corners));
        let children = corners.iter().map(|t| self.child(t)).collect();
        let far = self.other_solid(other);
        let [a, b, c] = [far.points[0], far.points[1], far.points[2]];
        let center = (a + b + c) / 3.0;
        let arms = [a - center, b - center, c - center];
        let triangle = OtherTriangle {
            center: center.as_vec3(),
            corners: arms.map(DVec3::as_vec3),
            normal: unit_normal([a, b, c]),
            is_thin: is_thin_triangle([a, b, c]),
            radius: round_up_to_f32(arms.map(DVec3::length).into_iter().fold(0.0, greater))
                .next_up(),
        };
        let reach = group.header.max_distance_from_origin;
        self.build_sample(group, triangle, reach, children, far)
    }

    /// Creates a sample with the allowances for rounding that an expansion uses.
    fn build_sample<C, P: OtherNode>(
        &self,
        group: C,
        other: P,
        reach: f32,
        children: Vec<Solid>,
        far: Solid,
    ) -> EightPairSample<C, P> {
        let turning = |k: usize| BodyRotation {
            is_turning: true,
            spin: self.angular_velocities[k].as_vec3(),
            angular_speed: round_up_to_f32(self.angular_velocities[k].length()),
            rotation_center: self.rotation_centers[k].as_vec3(),
        };
        let (split, turning_far) = (turning(0), turning(1));
        let velocity = self.velocity.as_vec3();
        let [x, y, z] = other.center().abs().to_array();
        let allowed = GAP_ERROR_PER_DISTANCE_F32 * (x + y + z)
            + GAP_ERROR_PER_RADIUS_F32 * (other.radius() + reach);
        let places = other.center().length() + turning_far.distance_from_center(Vec3::ZERO);
        let far_arm = turning_far.distance_from_center(other.center())
            + ARM_INCREASE_PER_DISTANCE as f32 * places;
        let change = self.acceleration.unwrap_or(DVec3::ZERO).as_vec3();
        let speed = velocity.length()
            + change.length()
            + split.angular_speed * (reach + split.distance_from_center(Vec3::ZERO))
            + turning_far.angular_speed * (other.radius() + far_arm);
        let kept = 1e-3 * other.radius();
        EightPairSample {
            motion: RelativeMotionF32 {
                velocity,
                acceleration: self.acceleration.map(|change| change.as_vec3()),
                split_body_rotation: split,
                other_rotation: turning_far,
                remaining_time: 1.0,
                required_gap: (kept + allowed).next_up(),
                closed_gap_threshold: LEAST_GAP_F32,
                rate_allowance: RATE_ERROR_F32 * speed,
                larger_body: None,
            },
            group,
            other_node: other,
            kept_gap: f64::from(kept),
            allowed_gap_error: allowed,
            children,
            other_node_solid: far,
            velocity: self.velocity,
            acceleration: self.acceleration.unwrap_or(DVec3::ZERO),
        }
    }
}
