use super::*;
use ccd_core::order::lesser;
use proptest::prelude::*;

proptest! {
    /// Tests that the search tree and a scan of all boxes find the same boxes that meet a given box. Coordinates are
    /// whole numbers, so that many boxes touch.
    #[test]
    fn boxes_that_meet_a_box_are_those_of_the_twin(
        size in prop::sample::select(vec![[30, 2, 2], [2, 2, 30], [6, 6, 6]]),
        corners in prop::collection::vec([0..30_i32, 0..30, 0..30], 26),
    ) {
        let corner = |c: &[i32; 3]| DVec3::from_array([0, 1, 2].map(|k| f64::from(c[k] % size[k])));
        let corners: Vec<DVec3> = corners.iter().map(corner).collect();
        let boxes: Vec<[DVec3; 2]> = corners[2..].as_chunks().0.to_vec();
        let tree = BoundingBoxTree::new(boxes.iter().map(|&ends| BoundingBox::enclosing(ends)).collect());
        // A point, and a box.
        for [p, q] in [[corners[0]; 2], [corners[0], corners[1]]] {
            let mut found = Vec::new();
            let all = tree.all_meeting_boxes_satisfy(&BoundingBox::enclosing([p, q]), |k| {
                found.push(k);
                true
            });
            prop_assert!(all);
            found.sort_unstable();
            let apart = |[a, b]: [DVec3; 2], k: usize| {
                lesser(a[k], b[k]) > greater(p[k], q[k]) || greater(a[k], b[k]) < lesser(p[k], q[k])
            };
            let meets = |ends: [DVec3; 2]| !(0..3).any(|k| apart(ends, k));
            let twin = (0..).zip(&boxes).filter(|&(_, &ends)| meets(ends));
            prop_assert_eq!(found, twin.map(|(k, _)| k).collect::<Vec<u32>>());
        }
    }
}
