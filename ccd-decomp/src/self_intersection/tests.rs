use crate::error::DecomposeError;
use crate::manifold::Manifold;
use crate::self_intersection::Crossing;
use crate::test_meshes::{cubes, joined, mesh, placed, tetrahedron};
use ccd_core::glam::{DVec3, dvec3};
use rstest::rstest;

/// Whether two tetrahedra are said to meet.
fn meet(offset: DVec3) -> bool {
    let solid = tetrahedron();
    let both = joined(&[&solid, &placed(&solid, 1.0, offset)]);
    match Manifold::new(&both).map(|_| ()) {
        Ok(()) => false,
        Err(DecomposeError::SelfIntersecting { pairs }) => {
            let across = |pair: &Crossing| pair.face < 4 && pair.other >= 4;
            assert!(pairs.first().iter().all(across), "{pairs}");
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
fn two_tetrahedra(#[case] offset: DVec3, #[case] expected: bool) {
    assert_eq!(meet(offset), expected);
}

/// Two at one corner are one surface, pinched there: they share the corner alone.
#[test]
fn a_shared_corner_is_no_intersection() {
    assert!(!meet(DVec3::X));
    let solid = tetrahedron();
    let inside = placed(&solid, 0.5, DVec3::ZERO);
    let nested = joined(&[&solid, &inside]);
    assert!(matches!(
        Manifold::new(&nested).err(),
        Some(DecomposeError::SelfIntersecting { .. } | DecomposeError::NotManifold { .. })
    ));
}

/// A thin fin folded flat onto itself.
#[test]
fn a_fold_is_found() {
    let vertices = vec![
        DVec3::ZERO,
        2.0 * DVec3::X,
        2.0 * DVec3::Y,
        dvec3(0.5, 0.5, 0.0),
    ];
    let folded = mesh(vertices, &[[0, 1, 2], [0, 2, 3], [2, 1, 3], [1, 0, 3]]);
    let error = Manifold::new(&folded).err();
    assert!(
        matches!(error, Some(DecomposeError::SelfIntersecting { .. })),
        "{error:?}"
    );
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
    assert!(Manifold::new(&stairs).is_ok());
}
