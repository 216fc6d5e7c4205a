//! Nothing touches before a hit, as parry's distances in double precision see it.

use crate::double::library::math::{Pose, Real};
use crate::double::library::query::{NonlinearRigidMotion, distance};
use crate::double::library::shape::TypedShape;
use crate::double::make::SharedShape;
use crate::scenes::{KINDS, motions, random, shape};
use crate::{double, single};
use ccd_core::order::lesser;
use rigid_ccd_parry::{Settings, f32 as ours32, f64 as ours64};

/// A scene in both precisions.
struct Scene {
    /// Without voxels, for which parry has no distances.
    parts: [Vec<Part>; 2],
    motions: [NonlinearRigidMotion; 2],
}

type Part = (Pose, SharedShape);

/// Returns the parts of a shape, and voxels as boxes.
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
            voxels
                .voxels()
                .map(|voxel| (place(voxel.center), cube.clone()))
                .collect()
        }
        _ => vec![(at, shape.clone())],
    }
}

impl Scene {
    /// The distance at a time; parry's is 0 for shapes that intersect.
    fn distance(&self, time: Real) -> Real {
        let [p, q] = self.motions.map(|motion| motion.position_at_time(time));
        let [a, b] = &self.parts;
        let pairs = a.iter().flat_map(|a| b.iter().map(move |b| (a, b)));
        let of_pair = |((at, a), (beside, b)): (&Part, &Part)| {
            let found = distance(&(p * *at), &**a, &(q * *beside), &**b);
            found.expect("supported").distance
        };
        pairs.map(of_pair).fold(Real::INFINITY, lesser)
    }

    /// Returns whether the shapes stay apart at sampled times.
    fn is_apart_until(&self, end: Real) -> bool {
        (0..60).all(|k| self.distance(end * Real::from(k) / 60.0) > 0.0)
    }
}

#[test]
fn nothing_touches_before_a_hit() {
    let (mut hits, mut misses, mut starts) = (0, 0, 0);
    for seed in 0..800 {
        let mut rng = random(seed);
        // Hulls and heights of single precision are others.
        let kinds = [seed as u32 % KINDS, seed as u32 / KINDS % KINDS].map(|kind| match kind {
            7 | 8 | 10 => 9,
            kind => kind,
        });
        let recipes = kinds.map(|kind| shape(&mut rng, kind));
        let moves = motions(&mut rng);
        let shapes = [0, 1].map(|k| double::make::shape(&recipes[k]));
        let scene = Scene {
            parts: [0, 1].map(|k| parts(Pose::IDENTITY, &shapes[k])),
            motions: moves.map(|moves| double::make::motion(&moves)),
        };
        let [a, b] = [0, 1].map(|k| single::make::shape(&recipes[k]));
        let [m, n] = moves.map(|moves| single::make::motion(&moves));
        let hit32 =
            ours32::cast_shapes_nonlinear(&m, &*a, &n, &*b, 0.0, 2.0, true).expect("served");
        let ([a, b], [m, n]) = (&shapes, &scene.motions);
        let hit64 =
            ours64::cast_shapes_nonlinear(m, &**a, n, &**b, 0.0, 2.0, true).expect("served");
        let excess = [a, b].map(|shape| {
            let body = ours64::body(&**shape, &Settings::default()).expect("served");
            body.excess()
        });
        let times = [
            hit32.map(|hit| f64::from(hit.time_of_impact)),
            hit64.map(|hit| hit.time_of_impact),
        ];
        for (time, tolerance) in times.into_iter().zip([1e-6, 1e-9]) {
            let end = time.unwrap_or(2.0);
            let apart = end == 0.0 || scene.is_apart_until(end);
            assert!(apart, "seed {seed}: {kinds:?} before {end}");
            match time {
                Some(0.0) => {
                    starts += 1;
                    assert!(scene.distance(0.0) <= tolerance, "seed {seed}: {kinds:?}");
                }
                Some(time) => {
                    hits += 1;
                    let gap = scene.distance(time);
                    // Of single precision the time is rounded down, at speeds of up to 30.
                    let rounded = if tolerance > 1e-7 { 1e-5 } else { 1e-12 };
                    // parry's distances are off by 1.5e-8 of the distance of cores, and more.
                    let most = tolerance + excess[0] + excess[1] + rounded + 1e-7;
                    assert!(gap <= most, "seed {seed}: {kinds:?} at {time}: {gap:e}");
                }
                None => misses += 1,
            }
        }
        // What is proven with less room lasts longer.
        if let Some(time) = times[1] {
            assert!(
                times[0].is_some_and(|earlier| earlier <= time),
                "seed {seed}: {times:?}"
            );
        }
    }
    assert!(
        hits > 600 && misses > 200 && starts < 60,
        "{hits} {misses} {starts}"
    );
}
