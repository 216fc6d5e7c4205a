//! Tests that the feature found by a table of facets is the one found by a scan of all facets.

use super::*;
use crate::body::pieces::Pieces;
use crate::body::polytope::{Facet, Polytope};
use crate::tests::scene::{RngExt, rng};

/// Creates a prism of 60 sides; every third facet is virtual, which means no face of the mesh.
fn prism_with_virtual_facets() -> Pieces {
    let count = 60;
    let rim = |height: f64| {
        (0..count).map(move |k| {
            let (sin, cos) = (f64::from(k) / f64::from(count) * std::f64::consts::TAU).sin_cos();
            DVec3::new(cos, sin, height)
        })
    };
    let side = |k: u32| {
        let next = (k + 1) % count;
        vec![k, next, next + count, k + count]
    };
    let loops = (0..count).map(side);
    let caps = [(0..count).rev().collect(), (count..2 * count).collect()];
    let facet = |(k, corners)| Facet {
        origin: match k % 3 {
            0 => FacetOrigin::Virtual,
            _ => FacetOrigin::Face(k),
        },
        corners,
    };
    let polytope = Polytope {
        points: rim(0.0).chain(rim(1.0)).collect(),
        facets: (0..).zip(loops.chain(caps)).map(facet).collect(),
        ..Polytope::default()
    };
    Pieces::from_polytopes(&[polytope]).unwrap()
}

#[test]
fn names_agree_with_a_scan_of_all_facets() {
    let pieces = prism_with_virtual_facets();
    let piece = pieces.get(0);
    // The piece belongs to no list, so that nothing is stored.
    let bare = Piece {
        cache_table_row: None,
        ..piece
    };
    assert!(
        FacetsByCorner::cached_if_many_facets(&piece).is_some()
            && FacetsByCorner::cached_if_many_facets(&bare).is_none()
    );
    let mut rng = rng(41);
    let (mut faces, mut edges) = (0, 0);
    for _ in 0..3_000 {
        let corner = rng.random_range(0..60u32);
        let near = [
            corner,
            (corner + 1) % 60,
            corner + 60,
            (corner + 1) % 60 + 60,
        ];
        let mut point = ConvexCombination::EMPTY;
        for _ in 0..rng.random_range(1..=3) {
            point.add_weighted_point(near[rng.random_range(0..4)], rng.random_range(0.1..1.0));
        }
        let name = find_mesh_feature(&piece, &point, |corner| corner);
        let scanned = find_mesh_feature(&bare, &point, |corner| corner);
        assert_eq!(name, scanned, "{point:?}");
        faces += usize::from(matches!(name, Some(Feature::Face(_))));
        edges += usize::from(matches!(name, Some(Feature::Edge(..))));
    }
    assert!(faces > 300 && edges > 300, "{faces} {edges}");
}

#[test]
fn a_point_next_to_a_corner_of_a_face_is_not_on_the_face() {
    let pieces = prism_with_virtual_facets();
    let piece = pieces.get(0);
    // A chord through the prism, from a corner of a face: the share of its other end, and whether the face counts.
    let chord_point = |share: f64| {
        let mut point = ConvexCombination::EMPTY;
        point.add_weighted_point(1, 1.0 - share);
        point.add_weighted_point(20, share);
        point
    };
    for (share, on_face) in [(4e-10, false), (1e-11, false), (1e-14, true)] {
        let feature = find_mesh_feature(&piece, &chord_point(share), |corner| corner);
        assert_eq!(feature.is_some(), on_face, "{share}: {feature:?}");
    }
}
