use super::*;
use glam::DVec3;
use std::collections::{HashMap, HashSet};

fn random_number_generator() -> impl FnMut(u32) -> u32 {
    let mut state = 1_u32;
    move |below| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 16) % below
    }
}

#[test]
fn edges_are_found_as_in_a_table() {
    let mut number = random_number_generator();
    let edges: Vec<((u32, u32), u32)> = (0..400).map(|k| ((number(12), number(30)), k)).collect();
    for some in [&edges[..20], &edges] {
        let table: HashMap<(u32, u32), u32> = some.iter().copied().collect();
        let map = EdgeMap::new(30, some.iter().copied());
        for edge in (0..30).flat_map(|from| (0..30).map(move |to| (from, to))) {
            assert_eq!(map.get(edge), table.get(&edge).copied());
        }
    }
}

/// Finds the first fault of facets that do not close a surface with a hash table of edges, as a reference.
fn find_fault_by_hash_set(hull: &Hull) -> Result<(), HullFault> {
    let exists = |&v: &u32| (v as usize) < hull.points.len();
    let mut edges = HashSet::new();
    for (facet, corners) in (0..).zip(hull.facets.iter()) {
        if corners.len() < 3 || !corners.iter().all(exists) {
            return Err(HullFault::BadFacet { facet });
        }
        for (from, to) in edges_of(corners) {
            if from == to || !edges.insert((from, to)) {
                return Err(HullFault::OpenSurface { facet });
            }
        }
    }
    for (facet, corners) in (0..).zip(hull.facets.iter()) {
        if edges_of(corners).any(|(from, to)| !edges.contains(&(to, from))) {
            return Err(HullFault::OpenSurface { facet });
        }
    }
    Ok(())
}

#[test]
fn the_first_fault_is_found_as_by_a_table() {
    let mut number = random_number_generator();
    let tetrahedron = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
    let mut closed = 0;
    for _ in 0..2000 {
        let mut facets = tetrahedron.map(Vec::from).to_vec();
        for _ in 0..number(3) {
            let (facet, corner) = (number(4) as usize, number(3) as usize);
            facets[facet][corner] = number(5);
        }
        let points = vec![DVec3::ZERO; 4];
        let facets = facets.iter().collect();
        let hull = Hull { points, facets };
        closed += u32::from(check_facets(&hull).is_ok());
        assert_eq!(check_facets(&hull), find_fault_by_hash_set(&hull));
    }
    assert!((200..1900).contains(&closed), "{closed}");
}
