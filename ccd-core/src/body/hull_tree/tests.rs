//! Tests on small hull trees that facets inherit the right data, and that invalid nodes are refused.

use super::*;
use crate::body::feature::Feature;
use crate::body::polytope::{Facet, FacetOrigin, Polytope};
use crate::body::{Body, Solidity};
use crate::error::InputError;
use glam::DVec3;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The facets of a box: bits 0, 1 and 2 of a corner's number choose the upper bound of x, y and z.
const BOX_FACETS: [[u32; 4]; 6] = [
    [0, 4, 6, 2],
    [1, 3, 7, 5],
    [0, 1, 5, 4],
    [2, 6, 7, 3],
    [0, 2, 3, 1],
    [4, 5, 7, 6],
];

fn corners(lo: DVec3, hi: DVec3) -> Vec<DVec3> {
    let pick = |k: u32, bit: usize| if k >> bit & 1 == 1 { hi[bit] } else { lo[bit] };
    (0..8)
        .map(|k| DVec3::new(pick(k, 0), pick(k, 1), pick(k, 2)))
        .collect()
}

/// Creates a box between two values of x, with y and z from 0 to 1. Its faces are numbered from `first` on.
fn box_between(from: f64, to: f64, first: u32) -> Polytope {
    let facet = |(k, corners): (usize, &[u32; 4])| Facet {
        origin: FacetOrigin::Face(first + k as u32),
        corners: corners.to_vec(),
    };
    Polytope {
        points: corners(DVec3::new(from, 0.0, 0.0), DVec3::new(to, 1.0, 1.0)),
        vertex_ids: (0..8).map(|k| 10 * first + k).collect(),
        facets: BOX_FACETS.iter().enumerate().map(facet).collect(),
        ..Polytope::default()
    }
}

fn box_hull(from: f64, to: f64) -> Hull {
    let block = box_between(from, to, 0);
    Hull {
        points: block.points,
        facets: block
            .facets
            .into_iter()
            .map(|facet| facet.corners)
            .collect(),
    }
}

fn tree(pieces: &[Polytope], hull: Hull) -> Result<HullTree, HullTreeError> {
    let pieces = Pieces::from_polytopes(pieces).unwrap();
    let nodes = [
        HullNode::Inner([1, 2], hull),
        HullNode::Leaf(0),
        HullNode::Leaf(1),
    ];
    HullTree::new(&pieces, &nodes)
}

fn fault(pieces: &[Polytope], hull: Hull) -> HullFault {
    match tree(pieces, hull) {
        Err(HullTreeError::Node { node: 0, fault }) => fault,
        other => panic!("{other:?}"),
    }
}

#[test]
fn facets_are_a_childs_or_tiled_or_bridges() {
    use FacetClass::{Bridge, OnMesh};
    // The boxes are end to end: the sides are tiled, though the corners between them are hidden.
    let whole = tree(
        &[box_between(0.0, 1.0, 0), box_between(1.0, 3.0, 6)],
        box_hull(0.0, 3.0),
    )
    .unwrap();
    assert_eq!(whole.facet_classes(0), [OnMesh; 6]);
    let root = whole.hulls().get(0);
    let origins = [FacetOrigin::Face(0), FacetOrigin::Face(7)];
    assert_eq!(root.facets.origins_in_mesh()[..2], origins);
    assert_eq!(root.facets.origins_in_mesh()[2..], [FacetOrigin::Faces; 4]);
    // The mesh's faces are found again on a tiled side.
    let top = ConvexCombination::of_two_points([4, 7], 0.25);
    assert_eq!(whole.hulls().feature(0, &top), Feature::Face(5));
    let top = ConvexCombination::of_two_points([4, 7], 0.75);
    assert_eq!(whole.hulls().feature(0, &top), Feature::Face(11));
    assert_eq!(
        whole
            .hulls()
            .feature(0, &ConvexCombination::from_single_point(7)),
        Feature::Vertex(67)
    );
    // The boxes are apart: the sides are bridges.
    let gap = tree(
        &[box_between(0.0, 1.0, 0), box_between(2.0, 3.0, 6)],
        box_hull(0.0, 3.0),
    )
    .unwrap();
    assert_eq!(
        gap.facet_classes(0),
        [OnMesh, OnMesh, Bridge, Bridge, Bridge, Bridge]
    );
    assert_eq!(gap.facet_classes(2), [OnMesh; 6]);
}

#[test]
fn virtual_facets_stay_contained() {
    let mut left = box_between(0.0, 1.0, 0);
    left.facets[5].origin = FacetOrigin::Virtual;
    let whole = tree(&[left, box_between(1.0, 3.0, 6)], box_hull(0.0, 3.0)).unwrap();
    assert_eq!(whole.facet_classes(1)[5], FacetClass::InsideSolid);
    assert_eq!(whole.facet_classes(0)[5], FacetClass::InsideSolid);
    assert_eq!(
        whole.hulls().get(0).facets.origins_in_mesh()[5],
        FacetOrigin::Virtual
    );
}

#[test]
fn features_take_the_best_class_of_their_facets() {
    let gap = tree(
        &[box_between(0.0, 1.0, 0), box_between(2.0, 3.0, 6)],
        box_hull(0.0, 3.0),
    )
    .unwrap();
    let class = |node, support: &[u32]| {
        let mut point = ConvexCombination::EMPTY;
        support
            .iter()
            .for_each(|&v| point.add_weighted_point(v, 1.0));
        gap.facet_class_at(node, &point)
    };
    use FacetClass::{Bridge, InsideSolid, OnMesh};
    assert_eq!(class(0, &[]), Bridge);
    assert_eq!(class(0, &[5]), OnMesh);
    // The points are along the end, across the end, along the bridge, and across the inside.
    assert_eq!(class(0, &[0, 2]), OnMesh);
    assert_eq!(class(0, &[0, 6]), OnMesh);
    assert_eq!(class(0, &[0, 4, 6]), OnMesh);
    assert_eq!(class(0, &[4, 5]), Bridge);
    assert_eq!(class(0, &[4, 5, 7]), Bridge);
    assert_eq!(class(0, &[0, 7]), Bridge);
    // A point inside a piece belongs to the piece.
    assert_eq!(class(1, &[0, 7]), InsideSolid);
}

#[test]
fn thick_and_thin_pieces_are_bridged_everywhere() {
    let thick = Polytope {
        radius: 0.5,
        ..box_between(1.0, 3.0, 6)
    };
    let whole = tree(&[box_between(0.0, 1.0, 0), thick], box_hull(0.0, 3.0)).unwrap();
    assert_eq!(whole.hulls().get(0).radius, 0.5);
    assert_eq!(whole.facet_classes(0), [FacetClass::Bridge; 6]);
    assert_eq!(
        whole.facet_class_at(0, &ConvexCombination::from_single_point(0)),
        FacetClass::Bridge
    );
    assert_eq!(whole.facet_classes(2), [FacetClass::OnMesh; 6]);
}

fn polytope_without_facets(points: &[DVec3]) -> Polytope {
    Polytope {
        points: points.to_vec(),
        ..Polytope::default()
    }
}

#[test]
fn triangles_segments_and_points_join() {
    let [a, b, c, d] = [DVec3::ZERO, DVec3::X, DVec3::X + DVec3::Y, DVec3::Y];
    let pieces = Pieces::from_triangles(&[a, b, c, d], &[[0, 1, 2], [0, 2, 3]], &[8, 9]).unwrap();
    let square = Hull {
        points: vec![a, b, c, d],
        facets: PolygonList::from_iter([[0, 1, 2, 3], [3, 2, 1, 0]]),
    };
    let nodes = |hull| {
        vec![
            HullNode::Inner([1, 2], hull),
            HullNode::Leaf(0),
            HullNode::Leaf(1),
        ]
    };
    let whole = HullTree::new(&pieces, &nodes(square)).unwrap();
    assert_eq!(whole.facet_classes(0), [FacetClass::OnMesh; 2]);
    let inside = ConvexCombination::of_two_points([1, 3], 0.25);
    assert_eq!(whole.hulls().feature(0, &inside), Feature::Face(8));

    let along = |x: f64| x * DVec3::X;
    let segment = Hull {
        points: vec![along(0.0), along(3.0)],
        facets: PolygonList::default(),
    };
    let beads = [
        polytope_without_facets(&[along(0.0), along(1.0)]),
        polytope_without_facets(&[along(3.0), along(2.0)]),
    ];
    assert!(tree(&beads, segment.clone()).is_ok());
    let beads = [
        polytope_without_facets(&[along(0.0), along(3.0)]),
        polytope_without_facets(&[along(2.0)]),
    ];
    assert!(tree(&beads, segment.clone()).is_ok());
    let off = [
        polytope_without_facets(&[along(0.0), along(3.0)]),
        polytope_without_facets(&[DVec3::new(2.0, 1e-300, 0.0)]),
    ];
    assert!(matches!(
        tree(&off, segment.clone()),
        Err(HullTreeError::Node {
            node: 2,
            fault: HullFault::CoordinateTooSmall { point: 0 }
        })
    ));
    let off = [
        polytope_without_facets(&[along(0.0), along(3.0)]),
        polytope_without_facets(&[DVec3::new(2.0, 1e-80, 0.0)]),
    ];
    let outside = HullFault::ChildOutside { child: 2, point: 0 };
    assert_eq!(fault(&off, segment), outside);
    let same = [polytope_without_facets(&[c]), polytope_without_facets(&[c])];
    let point = Hull {
        points: vec![c],
        facets: PolygonList::default(),
    };
    assert!(tree(&same, point).is_ok());
}

#[test]
fn flat_hulls_contain_only_points_in_their_plane_and_outline() {
    let square = Hull {
        points: corners(DVec3::ZERO, DVec3::new(1.0, 1.0, 0.0))[..4].to_vec(),
        facets: PolygonList::from_iter([[0, 1, 3, 2], [2, 3, 1, 0]]),
    };
    let plate = polytope_without_facets(&square.points);
    let holds = |p: DVec3| {
        tree(
            &[plate.clone(), polytope_without_facets(&[p])],
            square.clone(),
        )
        .is_ok()
    };
    assert!(holds(DVec3::new(0.5, 0.25, 0.0)));
    assert!(holds(DVec3::new(1.0, 0.25, 0.0)));
    assert!(holds(DVec3::new(0.5, 0.25, -0.0)));
    assert!(!holds(DVec3::new(0.5, 0.25, 1e-80)));
    assert!(!holds(DVec3::new(1f64.next_up(), 0.25, 0.0)));
    assert!(!holds(DVec3::new(2.0, 0.0, 0.0)));
}

#[test]
fn containment_is_exact() {
    // The slanted facet x + 2 y + 3 z = 6 is parallel to no coordinate axis.
    let tetrahedron = [6.0 * DVec3::X, 3.0 * DVec3::Y, 2.0 * DVec3::Z, DVec3::ZERO];
    let hull = Hull {
        points: tetrahedron.to_vec(),
        facets: PolygonList::from_iter([[0, 1, 2], [1, 0, 3], [2, 1, 3], [0, 2, 3]]),
    };
    let holds = |p: DVec3| {
        tree(
            &[
                polytope_without_facets(&tetrahedron),
                polytope_without_facets(&[p]),
            ],
            hull.clone(),
        )
        .is_ok()
    };
    let on = DVec3::new(1.0, 1.0, 1.0);
    assert!(holds(on));
    for k in 0..3 {
        let mut p = on;
        p[k] = 1f64.next_down();
        assert!(holds(p));
        p[k] = 1f64.next_up();
        assert!(!holds(p));
    }
    assert!(!holds(DVec3::new(0.5, 0.5, -1e-80)));
}

#[test]
fn invalid_hulls_are_refused() {
    let pieces = [box_between(0.0, 1.0, 0), box_between(1.0, 3.0, 6)];
    let good = box_hull(0.0, 3.0);
    let refused = |change: &dyn Fn(&mut Vec<Vec<u32>>)| {
        let points = good.points.clone();
        let mut facets = good.facets.iter().map(Vec::from).collect();
        change(&mut facets);
        let facets = facets.into();
        fault(&pieces, Hull { points, facets })
    };
    let mut foreign = good.clone();
    foreign.points[3] *= 2.0;
    assert_eq!(
        fault(&pieces, foreign),
        HullFault::ForeignPoint { point: 3 }
    );
    assert_eq!(
        refused(&|facets| facets[2][1] = 8),
        HullFault::BadFacet { facet: 2 }
    );
    assert_eq!(
        refused(&|facets| facets[4].truncate(2)),
        HullFault::BadFacet { facet: 4 }
    );
    assert_eq!(
        refused(&|facets| drop(facets.pop())),
        HullFault::OpenSurface { facet: 0 }
    );
    assert_eq!(
        refused(&|facets| facets.push(BOX_FACETS[0].to_vec())),
        HullFault::OpenSurface { facet: 6 }
    );
    // The hulls are inside out, too small, or without facets.
    let outside = |child, point| HullFault::ChildOutside { child, point };
    assert_eq!(
        refused(&|facets| facets.iter_mut().for_each(|f| f.reverse())),
        outside(1, 1)
    );
    let small = fault(&pieces, box_hull(0.0, 1.0));
    assert_eq!(small, outside(2, 1));
    assert_eq!(refused(&|facets| facets.clear()), outside(1, 1));
}

#[test]
fn nodes_that_are_no_hierarchy_are_refused() {
    let pieces =
        Pieces::from_polytopes(&[box_between(0.0, 1.0, 0), box_between(1.0, 3.0, 6)]).unwrap();
    let refused = |nodes: &[HullNode]| HullTree::new(&pieces, nodes).unwrap_err();
    let root = |children| HullNode::Inner(children, box_hull(0.0, 3.0));
    let missing = refused(&[HullNode::Leaf(0)]);
    assert_eq!(missing, InputError::BadHierarchy { index: 1 }.into());
    let twice = refused(&[root([1, 2]), HullNode::Leaf(1), HullNode::Leaf(1)]);
    assert_eq!(twice, InputError::BadHierarchy { index: 1 }.into());
    let cycle = refused(&[root([1, 0]), HullNode::Leaf(0)]);
    assert_eq!(cycle, InputError::BadHierarchy { index: 0 }.into());
    assert_eq!(refused(&[]), InputError::BadHierarchy { index: 0 }.into());
}

#[test]
fn bodies_take_the_trees_of_their_pieces_only() {
    let polytopes = [box_between(5.0, 7.0, 0), box_between(0.0, 1.0, 6)];
    let nodes = [
        HullNode::Inner([1, 2], box_hull(0.0, 7.0)),
        HullNode::Leaf(0),
        HullNode::Leaf(1),
    ];
    let pieces = Pieces::from_polytopes(&polytopes).unwrap();
    let tree = HullTree::new(&pieces, &nodes).unwrap();
    let body = Body::new(&pieces, Solidity::Surface).unwrap();
    let body = body.with_hull_tree(tree.clone()).unwrap();
    // The order of the body's pieces does not matter.
    let kept = body.hull_tree().unwrap();
    for (at, node) in kept.hierarchy().nodes().iter().enumerate() {
        if let HierarchyNode::Leaf(piece) = node {
            let piece = body.pieces().get(*piece as usize);
            assert_eq!(piece.points, kept.hulls().get(at).points);
        }
    }
    let others = Pieces::from_polytopes(&[polytopes[0].clone(), box_between(0.0, 2.0, 6)]).unwrap();
    let other = Body::new(&others, Solidity::Surface).unwrap();
    let refused = other.with_hull_tree(tree.clone()).unwrap_err();
    assert_eq!(refused, HullFault::NotAPiece.at_node(2));
    let single = Body::new(
        &Pieces::from_polytopes(&polytopes[..1]).unwrap(),
        Solidity::Surface,
    );
    let refused = single.unwrap().with_hull_tree(tree).unwrap_err();
    assert_eq!(refused, HullFault::NotAPiece.at_node(2));
}

#[test]
fn values_are_made_ahead_for_pieces_and_hulls_once() {
    struct PointCount(usize);
    let polytopes = [box_between(0.0, 1.0, 0), box_between(2.0, 3.0, 6)];
    let pieces = Pieces::from_polytopes(&polytopes).unwrap();
    let body = Body::new(&pieces, Solidity::Surface).unwrap();
    let tree = tree(&polytopes, box_hull(0.0, 3.0)).unwrap();
    let body = body.with_hull_tree(tree).unwrap();
    let made = AtomicUsize::new(0);
    let make = |piece: &Piece<'_>| {
        made.fetch_add(1, Ordering::Relaxed);
        PointCount(piece.points.len())
    };
    body.precompute_cached_values(make);
    assert_eq!(made.load(Ordering::Relaxed), 2 + 3);
    body.precompute_cached_values(make);
    assert_eq!(made.load(Ordering::Relaxed), 2 + 3);
    let never = |_: &Piece<'_>| -> PointCount { panic!("it is there") };
    for list in [body.pieces(), body.hull_tree().unwrap().hulls()] {
        assert!(list.iter().all(|p| p.cached_value(never).unwrap().0 == 8));
    }
    // A copy has its own pieces, and shares the hulls.
    body.clone().precompute_cached_values(make);
    assert_eq!(made.load(Ordering::Relaxed), 2 + 3 + 2);
}

#[test]
fn nodes_are_given_back() {
    let pieces =
        Pieces::from_polytopes(&[box_between(0.0, 1.0, 0), box_between(2.0, 3.0, 6)]).unwrap();
    let nodes = vec![
        HullNode::Inner([2, 1], box_hull(0.0, 3.0)),
        HullNode::Leaf(1),
        HullNode::Leaf(0),
    ];
    let tree = HullTree::new(&pieces, &nodes).unwrap();
    assert_eq!(tree.to_nodes(), nodes);
}

#[cfg(feature = "serde")]
mod stored;
