use crate::mesh::TriangleMesh;
use crate::solid::error::Crossing;
use crate::solid::error::DecomposeError;
use crate::solid::manifold::Manifold;
use crate::solid::topology::TopologyDefects;
use crate::solid::{check_solid, solid_surface};
use crate::test_meshes::{
    comb, cubes, merged_meshes, mesh, prism, prism_under_prism, scaled_and_moved, tetrahedron,
    toothed_quadrant_outline,
};
use crate::tolerance::MAX_CROSSINGS;
use crate::work::WorkBudget;
use ccd_core::glam::{DQuat, DVec3, dvec3};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;
use rstest::rstest;

/// Returns whether a tetrahedron and its copy moved by `offset` are reported to intersect.
fn moved_tetrahedra_meet(offset: DVec3) -> bool {
    let solid = tetrahedron();
    let both = merged_meshes(&[&solid, &scaled_and_moved(&solid, 1.0, offset)]);
    match solid_surface(&both).map(|_| ()) {
        Ok(()) => false,
        Err(DecomposeError::SelfIntersecting { pairs }) => {
            let across = |pair: &Crossing| pair.face < 4 && pair.other >= 4;
            assert!(pairs.first_elements().iter().all(across), "{pairs}");
            true
        }
        Err(other) => panic!("{other}"),
    }
}

#[rstest]
#[case::apart(dvec3(2.0, 0.0, 0.0), false)]
#[case::boxes_overlap(dvec3(0.6, 0.6, 0.6), false)]
#[case::edge_through_face(dvec3(0.1, 0.2, 0.25), true)]
#[case::corner_on_face(dvec3(0.25, 0.25, 0.5), true)]
#[case::corner_on_edge(dvec3(0.5, 0.0, 0.5), true)]
#[case::edge_on_edge(dvec3(0.5, 0.0, 0.0), true)]
#[case::within_a_plane(dvec3(0.2, 0.2, 0.0), true)]
#[case::in_one_plane_apart(dvec3(1.5, 1.5, 0.0), false)]
#[case::almost_a_corner_on_a_face(dvec3(0.25, 0.25, 0.5 + 1e-16), false)]
fn meeting_tetrahedra_are_found(#[case] offset: DVec3, #[case] expected: bool) {
    assert_eq!(moved_tetrahedra_meet(offset), expected);
}

/// Tests that two tetrahedra that share only a corner do not intersect.
#[test]
fn a_shared_corner_is_no_intersection() {
    assert!(!moved_tetrahedra_meet(DVec3::X));
    let solid = tetrahedron();
    let inside = scaled_and_moved(&solid, 0.5, DVec3::ZERO);
    let nested = merged_meshes(&[&solid, &inside]);
    assert!(matches!(
        solid_surface(&nested).err(),
        Some(DecomposeError::SelfIntersecting { .. } | DecomposeError::NotManifold { .. })
    ));
}

/// Tests that a closed surface folded flat into one plane is reported as self-intersecting.
#[test]
fn a_fold_is_found() {
    let vertices = vec![
        DVec3::ZERO,
        2.0 * DVec3::X,
        2.0 * DVec3::Y,
        dvec3(0.5, 0.5, 0.0),
    ];
    let folded = mesh(vertices, &[[0, 1, 2], [0, 2, 3], [2, 1, 3], [1, 0, 3]]);
    let error = solid_surface(&folded).err();
    assert!(
        matches!(error, Some(DecomposeError::SelfIntersecting { .. })),
        "{error:?}"
    );
}

#[test]
fn a_two_sided_sheet_is_found() {
    let sheet = mesh(
        vec![DVec3::ZERO, DVec3::X, DVec3::Y],
        &[[0, 1, 2], [0, 2, 1]],
    );
    let Err(DecomposeError::SelfIntersecting { pairs }) = solid_surface(&sheet).map(|_| ()) else {
        panic!("it holds no volume");
    };
    assert_eq!(pairs.first_elements(), [Crossing { face: 0, other: 1 }]);
}

#[test]
fn stairs_do_not_meet_themselves() {
    let stairs = cubes(&[
        [0, 0, 0],
        [1, 0, 0],
        [2, 0, 0],
        [1, 0, 1],
        [2, 0, 1],
        [2, 0, 2],
    ]);
    assert!(solid_surface(&stairs).is_ok());
}

/// Tests that checking a prism with fans as caps takes work linear in the number of triangles, not quadratic in the
/// size of a fan.
#[test]
fn fans_of_convex_caps_are_not_compared_pair_by_pair() {
    for corners in [50, 500, 5_000] {
        let corner = |k: u32| {
            let angle = std::f64::consts::TAU * f64::from(k) / f64::from(corners);
            dvec3(angle.cos(), angle.sin(), 0.0)
        };
        let mesh = prism(&(0..corners).map(corner).collect::<Vec<_>>());
        let manifold =
            Manifold::without_intersection_check(&mesh, &TopologyDefects::of(&mesh)).unwrap();
        // All pairs about a corner of 5,000 would be 2,500 for each triangle.
        let work = WorkBudget::with_steps(100 * mesh.faces().len() as u64);
        assert_eq!(check_solid(&manifold, &work), Ok(()), "{corners}");
    }
}

/// Returns the number of steps per face that checking a mesh takes.
fn steps_per_face(mesh: &TriangleMesh) -> u64 {
    let manifold = Manifold::without_intersection_check(mesh, &TopologyDefects::of(mesh)).unwrap();
    assert_eq!(crate::solid::star_shaped::star_center(&manifold), None);
    let too_few = WorkBudget::with_steps(100);
    assert_eq!(
        check_solid(&manifold, &too_few),
        Err(DecomposeError::WorkBudgetExceeded)
    );
    let work = WorkBudget::unbounded();
    assert_eq!(check_solid(&manifold, &work), Ok(()));
    work.steps_spent() / mesh.faces().len() as u64
}

/// Tests that checking a solid of slivers that is not star-shaped takes fewer than 400 steps per face. Each sliver is
/// near a few others.
#[test]
fn steps_per_face_stay_bounded_however_many_slivers_there_are() {
    for count in [50, 500, 5_000] {
        let leaning = steps_per_face(&prism(&toothed_quadrant_outline(count)));
        let step = steps_per_face(&prism_under_prism(count));
        let upright = steps_per_face(&comb(&vec![5.0; count as usize]));
        let steps = [leaning, step, upright];
        assert!(steps.iter().all(|&steps| steps < 400), "{count}: {steps:?}");
    }
}

/// Returns a prism over an outline on a grid, or over a rough circle. On a grid, corners coincide and edges lie in
/// lines. The prism is large enough for fans.
fn rough_prism(radii: &[(i32, f64)], on_grid: bool, turn: f64) -> TriangleMesh {
    let corner = |(k, &(step, radius)): (usize, &(i32, f64))| {
        let angle = std::f64::consts::TAU * k as f64 / radii.len() as f64;
        let p = dvec3(angle.cos(), angle.sin(), 0.0);
        if on_grid {
            (p * 4.0 * f64::from(step)).round()
        } else {
            p * radius
        }
    };
    let flat = prism(&radii.iter().enumerate().map(corner).collect::<Vec<_>>());
    let turn = DQuat::from_rotation_x(if on_grid { 0.0 } else { turn });
    let turned = flat.vertices().iter().map(|&p| turn * p);
    mesh(turned.collect(), flat.faces())
}

/// Tests that the reported intersections are those that a test of every pair of faces finds, up to `MAX_CROSSINGS`.
#[test]
fn crossings_are_those_of_all_pairs() {
    let radii = |n| prop::collection::vec((1..=3_i32, 0.9..1.1_f64), n);
    let given = (
        prop_oneof![radii(3..12), radii(30..60)],
        any::<bool>(),
        0.0..3.0_f64,
    );
    let mut runner = TestRunner::deterministic();
    let (mut whole, mut crossed) = (0, 0);
    for _ in 0..150 {
        let (radii, on_grid, turn) = given.new_tree(&mut runner).unwrap().current();
        let mesh = rough_prism(&radii, on_grid, turn);
        let Ok(manifold) = Manifold::without_intersection_check(&mesh, &TopologyDefects::of(&mesh))
        else {
            continue;
        };
        let faces = 0..mesh.faces().len() as u32;
        let pairs = faces
            .clone()
            .flat_map(|f| faces.clone().map(move |g| (f, g)));
        let all: Vec<_> = pairs
            .filter(|&(f, g)| f < g && super::faces_cross(&manifold, f, g))
            .collect();
        let found = super::crossings(&manifold, &WorkBudget::unbounded()).unwrap();
        if all.len() < MAX_CROSSINGS {
            assert_eq!(found, all);
        } else {
            assert_eq!(found.len(), MAX_CROSSINGS);
        }
        whole += u32::from(all.is_empty());
        crossed += u32::from(!all.is_empty());
    }
    assert!(whole > 10 && crossed > 10, "{whole}, {crossed}");
}

#[test]
fn crossings_are_counted_up_to_a_thousand() {
    let mut outline = vec![DVec3::ZERO, dvec3(202.0, 0.0, 0.0)];
    for tooth in (1..=100).rev() {
        let x = 2.0 * f64::from(tooth);
        let corners = [(x, 1.0), (x, 5.0), (x - 1.0, 5.0), (x - 1.0, 1.0)];
        outline.extend(corners.map(|(x, y)| dvec3(x, y, 0.0)));
    }
    let mesh = prism(&outline);
    let Err(DecomposeError::SelfIntersecting { pairs }) = solid_surface(&mesh).map(|_| ()) else {
        panic!("overlapping fans");
    };
    assert_eq!(pairs.count(), MAX_CROSSINGS);
}
