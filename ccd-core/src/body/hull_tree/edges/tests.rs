use super::*;
use glam::DVec3;
use std::collections::HashMap;

fn numbers() -> impl FnMut(u32) -> u32 {
    let mut state = 1_u32;
    move |below| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 16) % below
    }
}

#[test]
fn edges_are_found_as_in_a_table() {
    let mut number = numbers();
    let edges: Vec<((u32, u32), u32)> = (0..400).map(|k| ((number(12), number(30)), k)).collect();
    for some in [&edges[..20], &edges] {
        let table: HashMap<(u32, u32), u32> = some.iter().copied().collect();
        let map = EdgeMap::new(30, some.iter().copied());
        for edge in (0..30).flat_map(|from| (0..30).map(move |to| (from, to))) {
            assert_eq!(map.get(edge), table.get(&edge).copied());
        }
    }
}

#[test]
fn surfaces_that_are_closed_have_no_fault() {
    let mut number = numbers();
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
        closed += u32::from(is_closed(&hull));
        assert_eq!(is_closed(&hull), find_fault(&hull).is_ok());
    }
    assert!((200..1900).contains(&closed), "{closed}");
}
