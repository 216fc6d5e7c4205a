//! Tests that convex patches are exactly within the solid and on its surface, or that decomposition gives a typed
//! error.

use ccd_core::glam::{DQuat, DVec3};
use ccd_decomp::{DecomposeError, Decomposition, PatchOrder, decompose};
use ccd_tests::exact::{SampleCounts, Solid};
use ccd_tests::models::{
    Mesh, Model, Shape, boulder, convex_solids, cuboid, dented_cube, flat_faced_solids, hollow,
    pile, solids, terrain, torus, torus_knot,
};
use ccd_tests::patches::{Claim, check_hull_in_solid, check_partition, check_polytope};
use ccd_tests::strategies::{rotation, runner};
use proptest::prelude::*;
use std::cell::Cell;

const ORDERS: [PatchOrder; 3] = [
    PatchOrder::Cresting,
    PatchOrder::BreadthFirst,
    PatchOrder::DepthFirst,
];

fn decompose_shape(shape: &Shape, order: PatchOrder) -> Result<Decomposition, DecomposeError> {
    decompose(&shape.mesh.to_triangle_mesh(), order)
}

fn claimed_patches(decomposition: &Decomposition) -> Vec<Claim<'_>> {
    decomposition
        .patches
        .iter()
        .map(|patch| Claim {
            faces: &patch.faces,
            polytope: &patch.polytope,
        })
        .collect()
}

/// Checks that the patches cover the mesh, and that their polytopes are valid and inside the solid. Returns the number
/// of sampled points.
fn check(
    mesh: &Mesh,
    decomposition: &Decomposition,
    effort: SampleCounts,
) -> Result<usize, String> {
    let solid = Solid::new(mesh);
    let claims = claimed_patches(decomposition);
    check_partition(mesh, &claims)?;
    let mut points = 0;
    for (seed, claim) in (0..).zip(&claims) {
        check_polytope(mesh, claim)?;
        points += check_hull_in_solid(&solid, claim, effort, seed)?;
    }
    Ok(points)
}

/// Checks the decomposition of a model in every order of patches: the default order with the given effort, the others
/// quickly.
fn check_model(model: &Model, effort: SampleCounts) {
    check_model_in_order(PatchOrder::Cresting, model, effort);
    for order in [PatchOrder::BreadthFirst, PatchOrder::DepthFirst] {
        check_model_in_order(order, model, SampleCounts::QUICK);
    }
}

fn check_model_in_order(order: PatchOrder, model: &Model, effort: SampleCounts) {
    let name = &model.name;
    decompose_shape(&model.shape, order)
        .map_err(|error| error.to_string())
        .and_then(|decomposition| check(&model.shape.mesh, &decomposition, effort))
        .unwrap_or_else(|why| panic!("{name}, {order:?}: {why}"));
}

#[test]
fn patches_of_solids() {
    for model in solids() {
        check_model(&model, SampleCounts::THOROUGH);
    }
}

#[test]
fn patches_of_solids_in_general_position() {
    for model in solids() {
        check_model_in_order(
            PatchOrder::Cresting,
            &model.turned(),
            SampleCounts::THOROUGH,
        );
    }
}

#[test]
fn patches_of_thousands_of_faces() {
    let mut knots = vec![(120, 12)];
    if std::env::var_os("CCD_TEST_SLOW").is_some() {
        knots.extend([(240, 24), (480, 36)]);
    }
    for (rings, sides) in knots {
        let name = format!("knot of {rings} rings");
        let shape = torus_knot(rings, sides);
        check_model(&Model { name, shape }, SampleCounts::QUICK);
    }
}

/// Tests the patches of random solids, some of them on a coarse grid, where many features are coplanar, collinear or
/// folded over.
#[test]
fn patches_of_random_solids() {
    // Solids as they are; and some whose cavity may reach through their surface.
    let sound = prop_oneof![
        3 => (0..3u32, 0.0..0.9f64, any::<u64>())
            .prop_map(|(levels, roughness, seed)| boulder(levels, roughness, seed)),
        1 => (1..8usize, any::<u64>()).prop_map(|(cells, seed)| terrain(cells, seed)),
        2 => (1..6usize, any::<u64>()).prop_map(|(size, seed)| pile(size, seed)),
        1 => (3..16usize, 3..10usize, 0.05..0.5f64)
            .prop_map(|(rings, sides, minor)| torus(0.6, minor, rings, sides)),
        1 => (0.0..1.0f64).prop_map(|depth| dented_cube(0.5, depth)),
    ];
    let shapes = prop_oneof![
        8 => sound.prop_map(|shape| (shape, true)),
        1 => (0..2u32, any::<u64>(), 0.0..0.6f64).prop_map(|(levels, seed, size)| {
            let inner = cuboid(DVec3::splat(0.7 * size));
            (hollow(&boulder(levels, 0.3, seed), &inner), false)
        }),
    ];
    let grid = prop_oneof![2 => Just(None), 1 => (2.0..40.0f64).prop_map(Some)];
    let turn = prop_oneof![1 => Just(DQuat::IDENTITY), 1 => rotation()];
    let order = prop::sample::select(&ORDERS[..]);
    let (whole, faulty) = (Cell::new(0), Cell::new(0));
    let law =
        |((shape, sound), turn, grid, order): ((Shape, bool), DQuat, Option<f64>, PatchOrder)| {
            let mut shape = shape.placed(turn, DVec3::ZERO);
            if let Some(cells) = grid {
                let snap = |p: &mut DVec3| *p = (cells * *p).round() / cells;
                shape.mesh.vertices.iter_mut().for_each(snap);
            }
            // Faces that rounding has reduced to a segment or a point are dropped.
            shape.mesh.faces = shape.mesh.to_triangle_mesh().faces().to_vec();
            match decompose_shape(&shape, order) {
                Ok(it) => {
                    whole.set(whole.get() + 1);
                    let law = check(&shape.mesh, &it, SampleCounts::THOROUGH);
                    law.map(drop).map_err(TestCaseError::fail)
                }
                Err(error) if sound && grid.is_none() => {
                    Err(TestCaseError::fail(error.to_string()))
                }
                Err(_) => {
                    faulty.set(faulty.get() + 1);
                    Ok(())
                }
            }
        };
    runner(120)
        .run(&(shapes, turn, grid, order), law)
        .unwrap_or_else(|error| panic!("{error}"));
    assert!(
        whole.get() > 80 && faulty.get() >= 2,
        "{whole:?} {faulty:?}"
    );
}

#[test]
fn coplanar_triangles_go_together() {
    for model in flat_faced_solids() {
        let faces = model.shape.mesh.faces.len();
        // Around a cavity every side is a patch of its own, and a dent has few triangles to begin with.
        if model.name.ends_with(" cube") {
            continue;
        }
        for order in ORDERS {
            let patches = decompose_shape(&model.shape, order)
                .expect(&model.name)
                .patches;
            let (name, count) = (&model.name, patches.len());
            assert!(4 * count < faces, "{name}, {order:?}: {count} of {faces}");
        }
    }
}

#[test]
fn a_convex_solid_is_one_patch() {
    for model in convex_solids() {
        check_model(&model, SampleCounts::QUICK);
        for order in ORDERS {
            let patches = decompose_shape(&model.shape, order)
                .expect(&model.name)
                .patches;
            assert_eq!(patches.len(), 1, "{}", model.name);
        }
    }
}

#[test]
fn the_same_mesh_gives_the_same_patches() {
    for model in solids() {
        for order in ORDERS {
            let once = decompose_shape(&model.shape, order).expect(&model.name);
            let again = decompose_shape(&model.shape, order).expect(&model.name);
            assert_eq!(
                faces_by_patch(&once),
                faces_by_patch(&again),
                "{}",
                model.name
            );
            let same = |(x, y): (&Claim<'_>, &Claim<'_>)| x.polytope == y.polytope;
            let polytopes = (claimed_patches(&once), claimed_patches(&again));
            assert!(
                polytopes.0.iter().zip(&polytopes.1).all(same),
                "{}",
                model.name
            );
        }
    }
}

#[test]
fn an_inside_out_mesh_gives_the_patches_of_its_twin() {
    for model in solids() {
        let flipped = Shape::from_closed_mesh(model.shape.mesh.clone().with_reversed_faces());
        for order in ORDERS {
            let (here, there) = (
                decompose_shape(&model.shape, order).expect(&model.name),
                decompose_shape(&flipped, order).expect(&model.name),
            );
            assert_eq!(
                sorted_faces_by_patch(&here),
                sorted_faces_by_patch(&there),
                "{}, {order:?}",
                model.name
            );
            if order != PatchOrder::Cresting {
                continue;
            }
            check(&flipped.mesh, &there, SampleCounts::QUICK)
                .unwrap_or_else(|why| panic!("{}, {order:?}: {why}", model.name));
        }
    }
}

fn faces_by_patch(decomposition: &Decomposition) -> Vec<&[u32]> {
    claimed_patches(decomposition)
        .iter()
        .map(|claim| claim.faces)
        .collect()
}

fn sorted_faces_by_patch(decomposition: &Decomposition) -> Vec<Vec<u32>> {
    let mut all: Vec<Vec<u32>> = faces_by_patch(decomposition)
        .iter()
        .map(|f| f.to_vec())
        .collect();
    all.iter_mut().for_each(|faces| faces.sort_unstable());
    all.sort_unstable();
    all
}
