use crate::error::DecomposeError;
use crate::manifold::Manifold;
use crate::mesh::TriangleMesh;
use crate::self_intersection::Crossing;
use crate::test_meshes::{cubes, joined, mesh, placed, tetrahedron};
use crate::topology::Topology;
use crate::work::Work;
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

/// A polygon along z, each cap the fan about its first corner.
fn prism(outline: &[DVec3]) -> TriangleMesh {
    let n = outline.len() as u32;
    let mut vertices = outline.to_vec();
    vertices.extend(outline.iter().map(|&p| p + DVec3::Z));
    let mut faces = Vec::new();
    for k in 0..n {
        let l = (k + 1) % n;
        faces.extend([[k, l, n + l], [k, n + l, n + k]]);
    }
    for k in 1..n - 1 {
        faces.extend([[0, k + 1, k], [n, n + k, n + k + 1]]);
    }
    mesh(vertices, &faces)
}

/// Work that grows as the number of triangles, not as the square of those about one vertex.
#[test]
fn fans_of_convex_caps_are_not_compared_pair_by_pair() {
    for corners in [50, 500, 5_000] {
        let corner = |k: u32| {
            let angle = std::f64::consts::TAU * f64::from(k) / f64::from(corners);
            dvec3(angle.cos(), angle.sin(), 0.0)
        };
        let mesh = prism(&(0..corners).map(corner).collect::<Vec<_>>());
        let manifold = Manifold::unchecked(&mesh, &Topology::of(&mesh)).unwrap();
        // All pairs about a corner of 5,000 would be 2,500 for each triangle.
        let work = Work::of(100 * mesh.faces().len() as u64);
        assert_eq!(manifold.check(&work), Ok(()), "{corners}");
    }
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
    let Err(DecomposeError::SelfIntersecting { pairs }) = Manifold::new(&mesh).map(|_| ()) else {
        panic!("overlapping fans");
    };
    assert_eq!(pairs.count(), crate::tolerance::CROSSINGS);
}
