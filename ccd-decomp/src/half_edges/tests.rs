use super::{HalfEdge, SortedHalfEdges, twins};
use proptest::prelude::*;

/// Generates lists of triangles over few vertices; in half of the lists the vertex numbers are multiples of
/// 100,000,000.
fn triangles() -> impl Strategy<Value = Vec<[u32; 3]>> {
    let corner = prop_oneof![0u32..6, 0u32..40];
    let faces = prop::collection::vec(prop::array::uniform3(corner), 0..30);
    (faces, prop_oneof![Just(1u32), Just(100_000_000)])
        .prop_map(|(faces, step)| faces.into_iter().map(|f| f.map(|v| v * step)).collect())
}

/// Returns all half-edges sorted by their ends, each as smaller end, larger end, half-edge, and whether it starts at
/// the larger end.
fn sorted_half_edges(triangles: &[[u32; 3]]) -> Vec<([u32; 2], HalfEdge, bool)> {
    let mut all = Vec::new();
    for (t, [a, b, c]) in (0..).zip(triangles.iter().copied()) {
        for (k, (v, w)) in (0..).zip([(a, b), (b, c), (c, a)]) {
            all.push(([v.min(w), v.max(w)], 3 * t + k, v > w));
        }
    }
    all.sort_unstable();
    all
}

proptest! {
    #[test]
    fn edges_are_those_of_a_sorted_list(triangles in triangles()) {
        let mut listed = Vec::new();
        for (ends, uses) in SortedHalfEdges::new(&triangles).iter() {
            prop_assert!(!uses.is_empty());
            listed.extend(uses.iter().map(|u| (ends, u.half_edge, u.is_backward)));
        }
        let mut expected = sorted_half_edges(&triangles);
        expected.retain(|&([v, w], ..)| v != w);
        prop_assert_eq!(listed, expected);
    }

    #[test]
    fn twins_pair_all_half_edges_or_none(mut triangles in triangles(), mirrored: bool) {
        if mirrored {
            triangles.dedup();
            let mirror: Vec<_> = triangles.iter().map(|&[a, b, c]| [a, c, b]).collect();
            triangles.extend(mirror);
        }
        let all = sorted_half_edges(&triangles);
        let pairs = all.chunk_by(|one, next| one.0 == next.0);
        let mut expected = Some(vec![0; all.len()]);
        for pair in pairs {
            match (pair, &mut expected) {
                (&[(ends, one, from), (_, other, back)], Some(twins)) if from != back && ends[0] != ends[1] => {
                    (twins[one as usize], twins[other as usize]) = (other, one);
                }
                _ => expected = None,
            }
        }
        prop_assert_eq!(twins(&triangles), expected);
    }
}
