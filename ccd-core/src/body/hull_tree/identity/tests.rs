use super::*;
use crate::body::hull_tree::PolygonList;
use std::collections::HashMap;

/// Numbers the points with a hash table, one point after the other, as a reference.
fn reference_numbering(hull: &[DVec3], children: [&[DVec3]; 2]) -> (Vec<u32>, Vec<DVec3>) {
    let place = |p: &DVec3| p.to_array().map(|x| (x + 0.0).to_bits());
    let mut numbers: HashMap<[u64; 3], u32> = hull.iter().map(place).zip(0..).collect();
    let mut positions = hull.to_vec();
    let points = children.into_iter().flatten();
    let number = |point: &DVec3| {
        *numbers.entry(place(point)).or_insert_with(|| {
            positions.push(*point);
            positions.len() as u32 - 1
        })
    };
    (points.map(number).collect(), positions)
}

#[test]
fn points_get_the_numbers_that_a_table_gives() {
    let mut state = 1_u32;
    let mut coordinate = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        [-1.0, -0.0, 0.0, 1.0, 2.0][(state >> 16) as usize % 5]
    };
    for _ in 0..200 {
        let mut points = |count: usize| -> Vec<DVec3> {
            let mut point = |_| DVec3::new(coordinate(), coordinate(), 0.0);
            (0..count).map(&mut point).collect()
        };
        let node = |points: Vec<DVec3>| Node {
            vertex_ids: (0..points.len() as u32).collect(),
            points: points.into(),
            ..Node::default()
        };
        let [left, right] = [points(7), points(9)].map(node);
        let hull = Hull {
            points: [&left.points[..4], &right.points[3..5]].concat(),
            facets: PolygonList::default(),
        };
        let found = PointNumbering::new(&hull, [&left, &right]).unwrap();
        let (numbers, positions) = reference_numbering(&hull.points, [&left.points, &right.points]);
        assert_eq!(found.child_point_numbers.concat(), numbers);
        assert_eq!(found.positions, positions);
    }
}
