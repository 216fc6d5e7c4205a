//! Tests that bodies have the extent of parry's shapes in every direction.

use crate::double;
use crate::scenes::{SHAPE_KIND_COUNT, ShapeSpec, random_shape, seeded_rng, turn};
use ccd_core::order::greater;
use parry3d_f64::math::{Pose, Vector};
use parry3d_f64::shape::{Shape, SharedShape, TypedShape};
use rigid_ccd::glam::DVec3;
use rigid_ccd_parry::{BodyOfShape, Options};

/// Returns the extent of a body in a direction.
fn reach(body: &BodyOfShape, direction: DVec3) -> f64 {
    let pieces = body.body().pieces();
    let of_piece = |piece: rigid_ccd::body::Piece<'_>| {
        let points = piece.points.iter().map(|p| p.dot(direction));
        points.fold(f64::NEG_INFINITY, greater) + piece.radius
    };
    pieces.iter().map(of_piece).fold(f64::NEG_INFINITY, greater)
}

/// Returns the extent of a parry shape in a direction, computed by parry.
fn support_height(shape: &dyn Shape, at: &Pose, direction: Vector) -> f64 {
    if let Some(map) = shape.as_support_map() {
        return map.support_point(at, direction).dot(direction);
    }
    let most = |points: &mut dyn Iterator<Item = Vector>| {
        points
            .map(|p| (at * p).dot(direction))
            .fold(f64::NEG_INFINITY, greater)
    };
    match shape.as_typed_shape() {
        TypedShape::TriMesh(mesh) => most(&mut mesh.triangles().flat_map(|t| [t.a, t.b, t.c])),
        TypedShape::HeightField(field) => {
            most(&mut field.triangles().flat_map(|t| [t.a, t.b, t.c]))
        }
        TypedShape::Polyline(line) => most(&mut line.vertices().iter().copied()),
        TypedShape::Voxels(voxels) => most(&mut voxels.voxels().flat_map(|voxel| {
            let half = 0.5 * voxels.voxel_size();
            (0..8).map(move |k| {
                let sign = |bit: u32| if k >> bit & 1 == 1 { 1.0 } else { -1.0 };
                voxel.center + half * Vector::new(sign(0), sign(1), sign(2))
            })
        })),
        TypedShape::Compound(compound) => {
            let part = |(inner, shape): &(Pose, SharedShape)| {
                support_height(&**shape, &(at * *inner), direction)
            };
            compound
                .shapes()
                .iter()
                .map(part)
                .fold(f64::NEG_INFINITY, greater)
        }
        _ => unreachable!("all others have a support map"),
    }
}

fn directions(seed: u64) -> Vec<DVec3> {
    let mut rng = seeded_rng(seed);
    let mut all = vec![
        DVec3::X,
        DVec3::Y,
        DVec3::Z,
        -DVec3::X,
        -DVec3::Y,
        -DVec3::Z,
    ];
    all.extend((0..200).map(|_| {
        let [x, y, z, _] = turn(&mut rng).map(f64::from);
        DVec3::new(x, y, z).normalize_or(DVec3::X)
    }));
    all
}

#[test]
fn bodies_hold_their_shapes_and_exceed_them_by_what_they_say() {
    for kind in 0..SHAPE_KIND_COUNT {
        let (mut exact, mut most) = (true, 0.0);
        for seed in 0..20 {
            let recipe = random_shape(&mut seeded_rng(seed), kind);
            let theirs = double::make::shape(&recipe);
            let ours = rigid_ccd_parry::f64::body(&*theirs, &Options::default()).expect("served");
            exact &= ours.excess() == 0.0;
            for direction in directions(seed) {
                let v = Vector::new(direction.x, direction.y, direction.z);
                let more = reach(&ours, direction) - support_height(&*theirs, &Pose::IDENTITY, v);
                assert!(more > -1e-14 - ours.slack(), "{recipe:?} lacks {more:e}");
                assert!(
                    more < ours.excess() + ours.slack() + 1e-14,
                    "{recipe:?} has {more:e} more"
                );
                most = greater(most, more);
            }
        }
        let round = matches!(
            random_shape(&mut seeded_rng(0), kind),
            ShapeSpec::Cylinder(..) | ShapeSpec::Cone(..)
        );
        assert_eq!(
            exact && most < 1e-13,
            !(round || kind == 15),
            "kind {kind}: {most:e}"
        );
    }
}

#[test]
fn single_precision_makes_the_same_bodies() {
    // Convex hulls and height fields are computed by parry, in its precision.
    for kind in (0..SHAPE_KIND_COUNT).filter(|kind| ![7, 8, 10, 15].contains(kind)) {
        for seed in 0..20 {
            let recipe = random_shape(&mut seeded_rng(seed), kind);
            let options = Options::default();
            let single = crate::single::make::shape(&recipe);
            let single = rigid_ccd_parry::f32::body(&*single, &options).expect("served");
            let double = double::make::shape(&recipe);
            let double = rigid_ccd_parry::f64::body(&*double, &options).expect("served");
            // parry keeps voxels in no order.
            let sorted = |body: &BodyOfShape| {
                let points = body.body().pieces().points().iter().map(|p| p.to_array());
                let mut points: Vec<[f64; 3]> = points.collect();
                points.sort_by(|a, b| a.partial_cmp(b).expect("finite"));
                points
            };
            assert_eq!(sorted(&single), sorted(&double), "{recipe:?}");
        }
    }
}
