//! Tests which pairs the bounds choose to visit again, and which nodes to split, against choices computed in f64.

use super::setting::{PairConfiguration, Shape};
use super::{EightPairSample, slowest_closing_axis, values_along_three_axes};
use crate::body::tree::LANES;
use crate::engine::nodes::bounds::{EightPairFreeTimes, bound_eight_pairs};
use crate::engine::nodes::eight_pairs::LargerBody;
use crate::engine::nodes::shape::{Children, OtherNode};
use crate::math::order::greater;
use crate::settings::VectorInstructions;
use crate::tests::scene::{Pcg64, RngExt, rng};
use crate::tuning::{
    ADDED_THICKNESS_PER_RADIUS, MIN_REVISIT_DISTANCE_RATIO, MIN_REVISIT_SWEEP,
    MIN_TURNING_PLANE_RADIUS_RATIO,
};
use crate::vectorize;
use fearless_simd::{Simd, prelude::*};
use glam::Vec3;

/// The values of eight pairs from which the bounds choose.
struct SplitChoiceInputs {
    radius: [f32; LANES],
    /// The distances of the small nodes from the other body's center of rotation.
    arm_lengths: [f32; LANES],
    child_extent: [f32; LANES],
    other_extent: [f32; LANES],
    gap: [f32; LANES],
    /// The free times of two fixed planes, and of planes that turn with the split body and the other body.
    free_times: [[f32; LANES]; 4],
    piece_mask: u8,
    computed_bounds: EightPairFreeTimes,
}

#[inline(never)]
fn bounds<L: Simd, C: Children, P: OtherNode>(
    level: L,
    sample: &EightPairSample<C, P>,
) -> EightPairFreeTimes {
    bound_eight_pairs(
        level,
        &sample.group,
        &sample.other_node,
        &sample.motion,
        u8::MAX,
    )
}

impl<C: Children, P: OtherNode> EightPairSample<C, P> {
    fn split_choice_inputs(&self) -> SplitChoiceInputs {
        let level = VectorInstructions::Best.simd_level();
        let [along, passing, _] =
            vectorize!(level, level => values_along_three_axes(level, self, Vec3::X));
        vectorize!(level, level => {
            let across = slowest_closing_axis(&self.pairs(level)).across;
            SplitChoiceInputs {
                radius: *self.group.radius(level),
                arm_lengths: *self.motion.other_rotation.distances_from_center(self.group.center(level)),
                child_extent: *across.child_extent,
                other_extent: *across.other_extent,
                gap: *across.gap,
                free_times: [along.free_times[0], passing.free_times[0], along.free_times[1], along.free_times[2]],
                piece_mask: self.group.leaf_children_mask(level).to_bitmask() as u8,
                computed_bounds: bounds(level, self),
            }
        })
    }

    /// Sets `motion.larger` to the body whose nodes are much larger, or to `None` if neither body's nodes are.
    fn with_larger_body(mut self) -> Self {
        let level = VectorInstructions::Best.simd_level();
        let radii = vectorize!(level, level => *self.group.radius(level));
        let reach = radii.into_iter().fold(0.0, greater);
        let other = self.other_node.radius();
        self.motion.larger_body = match (
            reach > MIN_TURNING_PLANE_RADIUS_RATIO * other,
            other > MIN_TURNING_PLANE_RADIUS_RATIO * reach,
        ) {
            (true, _) => Some(LargerBody::BodyToSplit),
            (_, true) => Some(LargerBody::OtherBody),
            _ => None,
        };
        self
    }
}

/// Returns whether one number is greater than another; `None` if they are equal up to rounding.
fn exceeds_beyond_rounding(one: f64, other: f64) -> Option<bool> {
    let near = 1e-4 * (one.abs() + other.abs());
    ((one - other).abs() > near).then_some(one > other)
}

/// How often each decision of the bounds was no, and how often yes.
#[derive(Debug, Default)]
struct ChoiceCounts {
    similar_size_revisit_counts: [usize; 2],
    larger_body_revisit_counts: [usize; 2],
    split_child_counts: [usize; 2],
}

impl ChoiceCounts {
    fn check_and_count_choices<C: Children, P: OtherNode>(
        &mut self,
        sample: &EightPairSample<C, P>,
    ) {
        let rows = sample.split_choice_inputs();
        for lane in 0..LANES {
            let revisit = rows.computed_bounds.revisit_mask >> lane & 1 == 1;
            let split_child = rows.computed_bounds.split_child_mask >> lane & 1 == 1;
            if let Some(expected) = rows.should_revisit(lane, sample) {
                assert_eq!(
                    revisit, expected,
                    "{:?} of {:?}",
                    rows.computed_bounds, sample.motion
                );
                match sample.motion.larger_body {
                    Some(_) => self.larger_body_revisit_counts[usize::from(revisit)] += 1,
                    None => self.similar_size_revisit_counts[usize::from(revisit)] += 1,
                }
            }
            if let Some(expected) = rows.should_split_child(lane, sample) {
                assert_eq!(split_child, expected, "{:?}", rows.computed_bounds);
                self.split_child_counts[usize::from(split_child)] += 1;
            }
        }
    }
}

impl SplitChoiceInputs {
    fn should_revisit<C, P: OtherNode>(
        &self,
        lane: usize,
        sample: &EightPairSample<C, P>,
    ) -> Option<bool> {
        let motion = &sample.motion;
        let (radius, other) = (
            f64::from(self.radius[lane]),
            f64::from(sample.other_node.radius()),
        );
        let apart = f64::from(self.gap[lane]) - f64::from(motion.required_gap);
        let clear_of = |size: f64| {
            exceeds_beyond_rounding(apart, size * f64::from(MIN_REVISIT_DISTANCE_RATIO))
        };
        let far = clear_of(radius + other);
        let free = |row: usize| f64::from(self.free_times[row][lane]);
        let fixed = greater(free(0), free(1));
        let swept = |free: f64, rate: f32, arm: f32, large: f64| {
            exceeds_beyond_rounding(
                free * f64::from(rate) * f64::from(arm),
                large * f64::from(MIN_REVISIT_SWEEP),
            )
        };
        let (swept, past) = match motion.larger_body {
            None => (Some(false), Some(false)),
            Some(LargerBody::BodyToSplit) => {
                let arm = motion
                    .split_body_rotation
                    .distance_from_center(sample.other_node.center());
                let other_is_piece = self.piece_mask >> lane & 1 == 1;
                (
                    swept(
                        greater(fixed, free(2)),
                        motion.split_body_rotation.angular_speed,
                        arm,
                        radius,
                    ),
                    if other_is_piece {
                        clear_of(other)
                    } else {
                        Some(false)
                    },
                )
            }
            Some(LargerBody::OtherBody) => {
                let (rate, other_is_piece) = (
                    motion.other_rotation.angular_speed,
                    sample.other_node.is_piece(),
                );
                (
                    swept(greater(fixed, free(3)), rate, self.arm_lengths[lane], other),
                    if other_is_piece {
                        clear_of(radius)
                    } else {
                        Some(false)
                    },
                )
            }
        };
        let all = [far, swept, past];
        if all.contains(&Some(true)) {
            Some(true)
        } else {
            all.iter().all(Option::is_some).then_some(false)
        }
    }

    fn should_split_child<C, P: OtherNode>(
        &self,
        lane: usize,
        sample: &EightPairSample<C, P>,
    ) -> Option<bool> {
        let thick = |reach: f32, radius: f32| {
            f64::from(reach) + f64::from(ADDED_THICKNESS_PER_RADIUS * radius)
        };
        let split = thick(self.child_extent[lane], self.radius[lane]);
        let other = thick(self.other_extent[lane], sample.other_node.radius());
        match (
            self.piece_mask >> lane & 1 == 1,
            sample.other_node.is_piece(),
        ) {
            (true, _) => Some(false),
            (false, true) => Some(true),
            (false, false) => exceeds_beyond_rounding(split, other),
        }
    }
}

#[test]
fn pairs_wait_and_are_split_by_their_sizes_and_gaps() {
    let (mut rng, mut decisions) = (rng(3), ChoiceCounts::default());
    let mut check = |rng: &mut Pcg64| {
        let other = Shape::new(rng);
        let mut boxes = PairConfiguration::new(rng, &other).box_sample(rng, &other);
        boxes.other_node.is_piece = rng.random_bool(0.3);
        decisions.check_and_count_choices(&boxes);
        decisions.check_and_count_choices(&boxes.with_larger_body());
        let other = Shape::new(rng).triangle();
        let triangles = PairConfiguration::new(rng, &other).triangle_sample(rng, &other);
        decisions.check_and_count_choices(&triangles);
        decisions.check_and_count_choices(&triangles.with_larger_body());
    };
    for _ in 0..1_000 {
        check(&mut rng);
    }
    let ChoiceCounts {
        similar_size_revisit_counts: revisit,
        larger_body_revisit_counts: swept,
        split_child_counts: split_child,
    } = decisions;
    let each = [revisit, swept, split_child].concat();
    assert!(each.iter().all(|&count| count > 500), "{each:?}");
}
