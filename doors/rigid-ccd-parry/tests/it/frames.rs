//! Tests that witnesses, normals and sub-shapes equal those of parry's casts, in the same frames.

use crate::double::library::math::{Pose, Vector};
use crate::double::library::query::{self, ShapeCastHit, ShapeCastOptions, ShapeCastStatus};
use crate::double::library::shape::{Shape, TypedShape};
use crate::double::make;
use crate::scenes::{MotionSpec, random_motions, random_shape, seeded_rng};
use rigid_ccd_parry::f64::{cast_shapes, cast_shapes_nonlinear};

/// The number of hits at about the same time as parry's, and how many of them agree in points, normals and sub-shapes.
#[derive(Debug, Default)]
struct AgreementCounts {
    hit_count: u32,
    agreeing_point_count: u32,
    agreeing_normal_count: u32,
    agreeing_sub_shape_count: u32,
}

impl AgreementCounts {
    fn add(
        &mut self,
        shapes: [&make::SharedShape; 2],
        ours: Option<ShapeCastHit>,
        theirs: Option<ShapeCastHit>,
    ) {
        let (Some(ours), Some(theirs)) = (ours, theirs) else {
            return;
        };
        let good = theirs.status == ShapeCastStatus::Converged;
        if !good || (ours.time_of_impact - theirs.time_of_impact).abs() > 1e-6 {
            return;
        }
        let near = |a: Vector, b: Vector| u32::from(a.distance(b) < 1e-3);
        self.hit_count += 1;
        self.agreeing_point_count +=
            near(ours.witness1, theirs.witness1) * near(ours.witness2, theirs.witness2);
        self.agreeing_normal_count +=
            near(ours.normal1, theirs.normal1) * near(ours.normal2, theirs.normal2);
        let [a, b] = shapes;
        self.agreeing_sub_shape_count += u32::from(
            distance_to_sub_shape(a, ours.subshape1, ours.witness1) < 1e-6
                && distance_to_sub_shape(b, ours.subshape2, ours.witness2) < 1e-6,
        );
    }

    /// Asserts that at least nine in ten hits agree with parry's. A few hits may differ: the nearest points of parallel
    /// edges are not unique.
    fn check(&self) {
        let most = self.hit_count * 9 / 10;
        assert!(self.hit_count > 100, "{self:?}");
        assert!(
            self.agreeing_point_count >= most
                && self.agreeing_normal_count >= most
                && self.agreeing_sub_shape_count >= most,
            "{self:?}"
        );
    }
}

/// Returns the distance of a point from a sub-shape, or from the whole shape if it has no sub-shapes.
fn distance_to_sub_shape(shape: &make::SharedShape, number: u32, point: Vector) -> f64 {
    let mut found = f64::INFINITY;
    let mut measure = |at: Option<&Pose>, part: &dyn Shape| {
        found = part.distance_to_point(at.unwrap_or(&Pose::IDENTITY), point, true);
    };
    if let TypedShape::HeightField(field) = shape.as_typed_shape() {
        measure(None, &field.triangle_at_id(number).expect("a triangle"));
        return found;
    }
    match shape.as_composite_shape() {
        Some(composite) => composite.map_part_at(number, &mut |at, part, _| measure(at, part)),
        None => {
            assert_eq!(number, 0);
            measure(None, &**shape);
        }
    }
    found
}

fn pair(seed: u64, kinds: [u32; 2]) -> ([make::SharedShape; 2], [MotionSpec; 2]) {
    let mut rng = seeded_rng(seed);
    let shapes = kinds.map(|kind| make::shape(&random_shape(&mut rng, kind)));
    (shapes, random_motions(&mut rng))
}

#[test]
fn nonlinear_hits_are_in_the_frames_of_parry() {
    let mut count = AgreementCounts::default();
    for seed in 0..600 {
        // Balls, boxes, capsules and rounded hulls: parry converges on most of them.
        let kinds = [
            [0, 1, 2, 3, 8][seed as usize % 5],
            [0, 1, 2, 3, 8][seed as usize / 5 % 5],
        ];
        let ([a, b], moves) = pair(seed, kinds);
        // The rotations are slow: beyond half a turn parry's cast may be late.
        let slow = moves.map(|moves| MotionSpec {
            spin: moves.spin.map(|w| 0.02 * w),
            ..moves
        });
        let [m, n] = slow.map(|moves| make::motion(&moves));
        let theirs = query::cast_shapes_nonlinear(&m, &*a, &n, &*b, 0.0, 2.0, true);
        let ours = cast_shapes_nonlinear(&m, &*a, &n, &*b, 0.0, 2.0, true);
        count.add([&a, &b], ours.expect("served"), theirs.expect("served"));
    }
    count.check();
}

#[test]
fn linear_hits_are_in_the_frames_of_parry() {
    let mut count = AgreementCounts::default();
    for seed in 0..900 {
        // Meshes and compounds are included, whose sub-shapes have numbers.
        let kinds = [
            [0, 1, 9, 10, 3, 15][seed as usize % 6],
            [0, 1, 3][seed as usize / 6 % 3],
        ];
        let ([a, b], moves) = pair(seed, kinds);
        let [p, q] = moves.map(|moves| make::pose(moves.place, moves.turned));
        let [v, w] = moves.map(|moves| make::vector(moves.velocity));
        let options = ShapeCastOptions::with_max_time_of_impact(2.0);
        let theirs = query::cast_shapes(&p, v, &*a, &q, w, &*b, options);
        let ours = cast_shapes(&p, v, &*a, &q, w, &*b, options);
        count.add([&a, &b], ours.expect("served"), theirs.expect("served"));
    }
    count.check();
}
