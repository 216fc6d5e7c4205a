//! Tests by parry's distances in double precision that there is no contact before a hit.
//!
//! `CCD_TEST_CASES` in the environment multiplies the number of cases.

use crate::double::library::math::{Pose, Real};
use crate::double::library::query::{NonlinearRigidMotion, ShapeCastOptions, distance};
use crate::double::library::shape::TypedShape;
use crate::double::make::SharedShape;
use crate::scenes::{
    MotionSpec, SHAPE_KIND_COUNT, ShapeSpec, number, random_motions, random_shape, seeded_rng,
};
use crate::{double, single};
use ccd_core::order::{greater, lesser};
use rand::RngExt;
use rigid_ccd_parry::{Options, f32 as ours32, f64 as ours64};

/// A random scene with single-precision numbers.
struct Scene {
    shape_specs: [ShapeSpec; 2],
    motion_specs: [MotionSpec; 2],
    /// The factor on all lengths, a power of two.
    scale: f32,
    shapes: [SharedShape; 2],
    motions: [NonlinearRigidMotion; 2],
    /// The convex parts of both shapes; voxels, for which parry has no distances, are boxes.
    parts: [Vec<Part>; 2],
}

type Part = (Pose, SharedShape);

impl Scene {
    fn new(seed: u64) -> Self {
        let mut rng = seeded_rng(seed);
        // Hulls and height fields differ in single precision.
        let kinds = [
            seed as u32 % SHAPE_KIND_COUNT,
            seed as u32 / SHAPE_KIND_COUNT % SHAPE_KIND_COUNT,
        ];
        let kinds = kinds.map(|kind| if [7, 8, 10].contains(&kind) { 9 } else { kind });
        let scale = [1.0, 1.0, 0.0078125, 4096.0][rng.random_range(0..4)];
        let recipes = kinds.map(|kind| random_shape(&mut rng, kind).scaled(scale));
        let moves = random_motions(&mut rng).map(|moves| moves.scaled(scale));
        let shapes = [0, 1].map(|k| double::make::shape(&recipes[k]));
        Scene {
            parts: [0, 1].map(|k| parts(Pose::IDENTITY, &shapes[k])),
            motions: moves.map(|moves| double::make::motion(&moves)),
            shapes,
            shape_specs: recipes,
            motion_specs: moves,
            scale,
        }
    }

    /// Returns the shapes and motions in single precision.
    fn shapes_and_motions_f32(
        &self,
    ) -> (
        [single::make::SharedShape; 2],
        [parry3d::query::NonlinearRigidMotion; 2],
    ) {
        let shapes = [0, 1].map(|k| single::make::shape(&self.shape_specs[k]));
        (
            shapes,
            self.motion_specs.map(|moves| single::make::motion(&moves)),
        )
    }

    /// Returns parry's distance of the shapes at a time; it is 0 if they intersect.
    fn distance(&self, time: Real) -> Real {
        let [a, b] = &self.parts;
        self.least_distances_by_order(time, [a, b]).0
    }

    /// Returns the least distance over all pairs of convex parts at a time, computed by parry in both orders, the
    /// smaller first. parry's distance of many parts may be far off, as may that of two parts in one order. The true
    /// distance is between the two.
    fn least_distance_interval(&self, time: Real) -> (Real, Real) {
        let [a, b] = self.parts.each_ref().map(|parts| {
            let of_part = |(at, shape): &Part| simple_parts(*at, shape);
            parts.iter().flat_map(of_part).collect::<Vec<Part>>()
        });
        let (there, least) = self.least_distances_by_order(time, [&a, &b]);
        (lesser(there, least), greater(there, least))
    }

    /// Returns parry's least distance over all pairs of parts at a time, once for each order of the shapes.
    fn least_distances_by_order(&self, time: Real, [a, b]: [&[Part]; 2]) -> (Real, Real) {
        let [p, q] = self.motions.map(|motion| motion.position_at_time(time));
        let mut least = (Real::INFINITY, Real::INFINITY);
        for (at, a) in a {
            for (beside, b) in b {
                let (p, q) = (p * *at, q * *beside);
                let there = distance(&p, &**a, &q, &**b).expect("supported").distance;
                let back = distance(&q, &**b, &p, &**a).expect("supported").distance;
                least = (lesser(least.0, there), lesser(least.1, back));
            }
        }
        least
    }

    /// Returns whether the bodies are more than `by` apart at sampled times before the end.
    fn are_apart_at_sampled_times(&self, [start, end]: [Real; 2], by: Real) -> bool {
        let at = |k: i32| start + (end - start) * Real::from(k) / 60.0;
        (0..60)
            .map(at)
            .all(|time| self.distance(time) > by || self.least_distance_interval(time).1 > by)
    }

    /// Returns a bound on the sum of both bodies' excess over their shapes.
    fn excess(&self) -> f64 {
        let options = Options::default();
        let of = |shape: &SharedShape| ours64::body(&**shape, &options).expect("served").excess();
        self.shapes.iter().map(of).sum()
    }

    /// Returns a bound on the error of parry's distances for shapes of this scene's size. For round shapes, parry's
    /// search stops at that error.
    fn max_distance_error(&self) -> f64 {
        let kinds = self.shape_specs.each_ref().map(ShapeSpec::name);
        let round = ["Round", "Capsule", "Cylinder", "Cone", "Compound"];
        let is_round = |kind: &String| round.iter().any(|round| kind.starts_with(round));
        let off = if kinds.iter().any(is_round) {
            1e-4
        } else {
            1e-7
        };
        off * f64::from(greater(self.scale, 1.0))
    }
}

/// Returns the parts of a shape, with voxels as boxes.
fn parts(at: Pose, shape: &SharedShape) -> Vec<Part> {
    match shape.as_typed_shape() {
        TypedShape::Compound(compound) => {
            let inner = |(inner, shape): &Part| parts(at * *inner, shape);
            compound.shapes().iter().flat_map(inner).collect()
        }
        TypedShape::Voxels(voxels) => {
            let half = 0.5 * voxels.voxel_size();
            let cube = SharedShape::cuboid(half.x, half.y, half.z);
            let place = |center| at * Pose::from_translation(center);
            let boxes = voxels
                .voxels()
                .map(|voxel| (place(voxel.center), cube.clone()));
            boxes.collect()
        }
        _ => vec![(at, shape.clone())],
    }
}

/// Returns the triangles of a mesh, the segments of a polyline, and any other shape itself.
fn simple_parts(at: Pose, shape: &SharedShape) -> Vec<Part> {
    match shape.as_typed_shape() {
        TypedShape::TriMesh(mesh) => (mesh.triangles())
            .map(|triangle| (at, SharedShape::new(triangle)))
            .collect(),
        TypedShape::Polyline(line) => (line.segments())
            .map(|segment| (at, SharedShape::new(segment)))
            .collect(),
        _ => vec![(at, shape.clone())],
    }
}

/// The number of hits after the start, of misses, and of hits at the start.
#[derive(Debug, Default)]
struct HitCounts {
    later_hit_count: u64,
    miss_count: u64,
    start_hit_count: u64,
}

impl HitCounts {
    /// Asserts that the shapes are apart before the hit, or in the whole interval without a hit, and are near at the
    /// hit.
    fn check(
        &mut self,
        scene: &Scene,
        [start, end]: [f64; 2],
        target: f64,
        found: Option<f64>,
        tolerance: f64,
        name: &str,
    ) {
        let (until, distance_error) = (found.unwrap_or(end), scene.max_distance_error());
        if found == Some(start) {
            self.start_hit_count += 1;
        } else {
            let by = if target > 0.0 {
                target - distance_error
            } else {
                0.0
            };
            assert!(
                scene.are_apart_at_sampled_times([start, until], by),
                "{name}: before {until}"
            );
        }
        match found {
            Some(time) => {
                self.later_hit_count += u64::from(time > start);
                let most = target + tolerance + scene.excess() + distance_error;
                let near =
                    scene.distance(time) <= most || scene.least_distance_interval(time).0 <= most;
                assert!(
                    near,
                    "{name}: {:e} at {time}",
                    scene.least_distance_interval(time).0
                );
            }
            None => self.miss_count += 1,
        }
    }
}

fn case_count(count: u64) -> u64 {
    let factor = std::env::var("CCD_TEST_CASES")
        .ok()
        .and_then(|given| given.parse().ok());
    (count as f64 * factor.unwrap_or(1.0)) as u64
}

#[test]
fn nothing_touches_before_a_hit() {
    let (mut count, all) = (HitCounts::default(), case_count(400));
    for seed in 0..all {
        let scene = Scene::new(seed);
        let start = [0.0, 0.0, -0.25, 0.125f32][seed as usize % 4];
        let interval = [f64::from(start), 2.0];
        let ([a, b], [m, n]) = scene.shapes_and_motions_f32();
        let hit32 = ours32::cast_shapes_nonlinear(&m, &*a, &n, &*b, start, 2.0, true);
        let ([a, b], [m, n]) = (&scene.shapes, &scene.motions);
        let hit64 = ours64::cast_shapes_nonlinear(m, &**a, n, &**b, interval[0], 2.0, true);
        let hit32 = hit32
            .expect("served")
            .map(|hit| f64::from(hit.time_of_impact));
        let hit64 = hit64.expect("served").map(|hit| hit.time_of_impact);
        let name = format!(
            "seed {seed}: {:?}",
            scene.shape_specs.each_ref().map(ShapeSpec::name)
        );
        // The single-precision time is rounded down, at speeds of up to 30.
        let rounded = 1e-5 * f64::from(scene.scale);
        count.check(&scene, interval, 0.0, hit32, 1e-6 + rounded, &name);
        count.check(&scene, interval, 0.0, hit64, 1e-9, &name);
        // A proof with a smaller bound holds for longer.
        if let Some(time) = hit64 {
            assert!(
                hit32.is_some_and(|earlier| earlier <= time),
                "{name}: {hit32:?} {hit64:?}"
            );
        }
    }
    let HitCounts {
        later_hit_count: hits,
        miss_count: misses,
        start_hit_count: starts,
    } = count;
    assert!(
        hits > all / 2 && misses > all / 4 && starts < all / 6,
        "{hits} {misses} {starts}"
    );
}

#[test]
fn straight_casts_keep_the_target_distance() {
    let (mut count, all) = (HitCounts::default(), case_count(400));
    for seed in 0..all {
        let mut scene = Scene::new(seed);
        let mut rng = seeded_rng(seed);
        // A body that does not rotate has no center.
        for motion in &mut scene.motions {
            motion.angvel = Default::default();
        }
        let target = [0.0, 0.01, 0.3, number(&mut rng, 0.5, 5.0)][seed as usize % 4];
        let target = f64::from(target * scene.scale);
        let [p, q] = scene.motions.map(|motion| motion.start);
        let [v, w] = scene.motions.map(|motion| motion.linvel);
        let [a, b] = &scene.shapes;
        let options = ShapeCastOptions {
            target_distance: target,
            ..ShapeCastOptions::with_max_time_of_impact(2.0)
        };
        let hit = ours64::cast_shapes(&p, v, &**a, &q, w, &**b, options).expect("served");
        let name = format!(
            "seed {seed}: {:?}",
            scene.shape_specs.each_ref().map(ShapeSpec::name)
        );
        let found = hit.map(|hit| hit.time_of_impact);
        count.check(&scene, [0.0, 2.0], target, found, 1e-9, &name);
    }
    let HitCounts {
        later_hit_count: hits,
        miss_count: misses,
        start_hit_count: starts,
    } = count;
    assert!(
        hits > all / 3 && misses > all / 8 && starts < all / 3,
        "{hits} {misses} {starts}"
    );
}
