//! Assembles polytopes from outlines of faces.

use super::facets::{Plane, sides_of_loop, unit_or_zero};
use super::{Edge, Face, FaceEdge, NO_FACE, OutgoingEdge, Polytope, Vertex};
use ccd_core::glam::DVec3;
use ccd_core::order::greater;

/// Assembles a polytope from the outlines of its faces, which close a surface. Without faces, `ends` are the ends of an
/// edge, or a point.
pub(crate) fn assemble_polytope(points: &[DVec3], ends: &[u32], loops: &[Vec<u32>]) -> Polytope {
    let mut numbers: Vec<u32> = loops.iter().flatten().copied().collect();
    if numbers.is_empty() {
        numbers.extend(ends);
    }
    numbers.sort_unstable();
    numbers.dedup();
    let origin = middle(points, &numbers);
    let local = |number: u32| points[number as usize] - origin;
    let corner = |number: u32| numbers.partition_point(|&other| other < number) as u32;
    let faces = loops.iter().map(|outline| Face {
        normal: Plane::new(points, outline).normal,
        first_side: 0,
        sides_end: 0,
    });
    let outline = |outline: &Vec<u32>| outline.iter().map(|&v| corner(v)).collect();
    let outlines: Vec<Vec<u32>> = loops.iter().map(outline).collect();
    let mut out = Polytope {
        origin_in_piece: origin,
        reach: numbers
            .iter()
            .map(|&v| local(v).length())
            .fold(0.0, greater),
        vertices: numbers
            .iter()
            .map(|&number| Vertex {
                point: local(number),
                point_index: number,
                first_outgoing_edge: 0,
                outgoing_edges_end: 0,
            })
            .collect(),
        outgoing_edges: Vec::new(),
        edges: Vec::new(),
        faces: faces.collect(),
        sides: Vec::with_capacity(loops.iter().map(Vec::len).sum()),
        start_vertex_table: None,
    };
    let at = |v: u32| points[numbers[v as usize] as usize];
    let edge = |v: u32, w: u32| Edge {
        start: out.vertices[v as usize].point,
        direction: unit_or_zero(at(w) - at(v)),
        length: at(w).distance(at(v)),
        inward_directions: [DVec3::ZERO; 2],
        ends: [v, w],
        faces: [NO_FACE; 2],
    };
    out.edges = match numbers.len() {
        2 if outlines.is_empty() => vec![edge(0, 1)],
        _ => edges_of(&outlines).map(|(v, w)| edge(v, w)).collect(),
    };
    add_sides(&mut out, &outlines);
    add_outgoing_edges(&mut out);
    out
}

/// Returns the center of the bounding box of the points with the given numbers.
fn middle(points: &[DVec3], numbers: &[u32]) -> DVec3 {
    let used = numbers.iter().map(|&v| points[v as usize]);
    let low = used.clone().reduce(DVec3::min).unwrap_or_default();
    let high = used.reduce(DVec3::max).unwrap_or_default();
    low + 0.5 * (high - low)
}

/// Returns every edge once, from its lower to its higher vertex, in ascending order.
fn edges_of(loops: &[Vec<u32>]) -> impl Iterator<Item = (u32, u32)> {
    let sides = loops.iter().flat_map(|outline| sides_of_loop(outline));
    let mut edges: Vec<(u32, u32)> = sides.filter(|(v, w)| v < w).collect();
    edges.sort_unstable();
    edges.into_iter()
}

fn add_sides(out: &mut Polytope, loops: &[Vec<u32>]) {
    for (outline, face) in loops.iter().zip(0u32..) {
        let first_side = out.sides.len() as u32;
        for (v, w) in sides_of_loop(outline) {
            let key = (v.min(w), v.max(w));
            let found = out
                .edges
                .binary_search_by_key(&key, |e| (e.ends[0], e.ends[1]));
            // Every side has its twin, so the edge exists.
            let Ok(number) = found else { continue };
            let normal = out.faces[face as usize].normal;
            let edge = &mut out.edges[number];
            let along = if v < w {
                edge.direction
            } else {
                -edge.direction
            };
            let inward = unit_or_zero(normal.cross(along));
            let slot = usize::from(v > w);
            edge.inward_directions[slot] = inward;
            edge.faces[slot] = face;
            out.sides.push(FaceEdge {
                inward_direction: inward,
                start: edge.start,
                edge: number as u32,
                vertex: v,
            });
        }
        let sides = &mut out.faces[face as usize];
        (sides.first_side, sides.sides_end) = (first_side, out.sides.len() as u32);
    }
}

fn add_outgoing_edges(out: &mut Polytope) {
    let mut spokes: Vec<(u32, OutgoingEdge)> = Vec::with_capacity(2 * out.edges.len());
    for (edge, number) in out.edges.iter().zip(0..) {
        let [start, end] = edge.ends;
        let spoke = |along, to| OutgoingEdge {
            edge_direction: along,
            edge: number,
            end_vertex: to,
        };
        spokes.push((start, spoke(edge.direction, end)));
        spokes.push((end, spoke(-edge.direction, start)));
    }
    spokes.sort_by_key(|&(from, _)| from);
    let mut at = 0;
    for (vertex, number) in out.vertices.iter_mut().zip(0u32..) {
        vertex.first_outgoing_edge = at;
        at += spokes[at as usize..]
            .iter()
            .take_while(|(from, _)| *from == number)
            .count() as u32;
        vertex.outgoing_edges_end = at;
    }
    out.outgoing_edges = spokes.into_iter().map(|(_, spoke)| spoke).collect();
}
