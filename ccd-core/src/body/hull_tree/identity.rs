//! Which points of two children and their parent's hull are at one place.

use super::Hull;
use super::error::HullFault;
use super::node::Node;
use glam::DVec3;

/// Which points of the children are the same, and which of them are the hull's.
///
/// Numbers below the hull's count of points name those; the others name hidden points.
pub(super) struct Identity {
    pub(super) of_left: Vec<u32>,
    pub(super) of_right: Vec<u32>,
    /// Where they are.
    pub(super) places: Vec<DVec3>,
    /// In the mesh, of the hull's points.
    pub(super) vertex_ids: Vec<u32>,
}

impl Identity {
    /// O(n log n).
    pub(super) fn new(hull: &Hull, [left, right]: [&Node<'_>; 2]) -> Result<Self, HullFault> {
        let own = hull.points.len();
        let all = [&hull.points[..], &left.points, &right.points];
        let same = representatives(all, own);
        let mut numbers = same.clone();
        let mut places = hull.points.clone();
        let points = left.points.iter().chain(right.points.iter());
        for (k, point) in (own..).zip(points) {
            numbers[k] = match same[k] as usize {
                first if first == k => {
                    places.push(*point);
                    places.len() as u32 - 1
                }
                first => numbers[first],
            };
        }
        let mut vertex_ids = vec![None; own];
        let names = left.vertex_ids.iter().chain(&right.vertex_ids);
        for (&id, &vertex) in numbers[own..].iter().zip(names) {
            if let Some(known) = vertex_ids.get_mut(id as usize) {
                *known = Some(vertex);
            }
        }
        let vertex_id = |k: usize| {
            let point = k as u32;
            vertex_ids[same[k] as usize].ok_or(HullFault::ForeignPoint { point })
        };
        let vertex_ids = (0..own).map(vertex_id).collect::<Result<_, _>>()?;
        let middle = own + left.points.len();
        Ok(Identity {
            of_left: numbers[own..middle].to_vec(),
            of_right: numbers[middle..].to_vec(),
            places,
            vertex_ids,
        })
    }
}

/// For every point of some lists in a row the one that stands for its place: of the first `own` the last
/// one there, else the first one.
fn representatives(lists: [&[DVec3]; 3], own: usize) -> Vec<u32> {
    // Adding zero makes −0 a 0.
    let place = |p: &DVec3| p.to_array().map(|x| (x + 0.0).to_bits());
    let points = lists.into_iter().flatten();
    let mut sorted: Vec<([u64; 3], u32)> = points.map(place).zip(0..).collect();
    sorted.sort_unstable();
    let mut same = vec![0; sorted.len()];
    for group in sorted.chunk_by(|one, other| one.0 == other.0) {
        let last_own = group.iter().rev().find(|(_, k)| (*k as usize) < own);
        let first = last_own.unwrap_or(&group[0]).1;
        for &(_, k) in group {
            same[k as usize] = first;
        }
    }
    same
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::hull_tree::Loops;
    use std::collections::HashMap;

    /// The same by a table, point after point.
    fn twin(hull: &[DVec3], children: [&[DVec3]; 2]) -> (Vec<u32>, Vec<DVec3>) {
        let place = |p: &DVec3| p.to_array().map(|x| (x + 0.0).to_bits());
        let mut numbers: HashMap<[u64; 3], u32> = hull.iter().map(place).zip(0..).collect();
        let mut places = hull.to_vec();
        let points = children.into_iter().flatten();
        let number = |point: &DVec3| {
            *numbers.entry(place(point)).or_insert_with(|| {
                places.push(*point);
                places.len() as u32 - 1
            })
        };
        (points.map(number).collect(), places)
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
                facets: Loops::default(),
            };
            let found = Identity::new(&hull, [&left, &right]).unwrap();
            let (numbers, places) = twin(&hull.points, [&left.points, &right.points]);
            assert_eq!([found.of_left, found.of_right].concat(), numbers);
            assert_eq!(found.places, places);
        }
    }
}
