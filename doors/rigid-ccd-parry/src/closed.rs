//! Tests whether a triangle mesh is closed.

use ccd_core::glam::DVec3;
use std::cmp::Ordering;
use std::collections::HashMap;

/// Returns an edge that triangles use more often in one direction than in the other; `None` for a closed mesh.
///
/// Vertices at the same position count as one vertex.
pub(crate) fn find_open_edge(vertices: &[DVec3], triangles: &[[u32; 3]]) -> Option<[u32; 2]> {
    let mut first_at: HashMap<[u64; 3], u32> = HashMap::new();
    // Adding 0 turns -0 into 0.
    let position_bits = |v: u32| {
        vertices
            .get(v as usize)
            .map(|p| p.to_array().map(|x| (x + 0.0).to_bits()))
    };
    let mut balance: HashMap<[u32; 2], i64> = HashMap::new();
    for triangle in triangles {
        let mut corners = [0; 3];
        for (corner, &v) in corners.iter_mut().zip(triangle) {
            *corner = *first_at.entry(position_bits(v)?).or_insert(v);
        }
        for k in 0..3 {
            let (from, to) = (corners[k], corners[(k + 1) % 3]);
            match from.cmp(&to) {
                Ordering::Less => *balance.entry([from, to]).or_default() += 1,
                Ordering::Greater => *balance.entry([to, from]).or_default() -= 1,
                Ordering::Equal => {}
            }
        }
    }
    let open_edges = balance.into_iter().filter(|(_, balance)| *balance != 0);
    open_edges.map(|(edge, _)| edge).min()
}

#[cfg(test)]
mod tests;
