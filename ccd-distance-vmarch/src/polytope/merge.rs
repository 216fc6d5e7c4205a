//! Merges coplanar facets into faces.

use super::facets::{Facets, distance_from_line, sides_of_loop};
use ccd_core::glam::DVec3;

/// Merges coplanar facets, and returns the outlines of the faces; `None` if a face has several outlines, or fewer than
/// three corners.
///
/// A face grows from its largest facet over neighbours with all corners within `rounding` of that
/// facet's plane, so that it never drifts off it. Corners where only two faces meet are dropped. In
/// a flat polygon, which has only two faces, only those within `rounding` of a side are.
pub(crate) fn merge(points: &[DVec3], facets: &Facets, rounding: f64) -> Option<Vec<Vec<u32>>> {
    let (faces, count) = group_coplanar_facets(points, facets, rounding);
    let mut outlines = outlines(facets, &faces, count, points.len())?;
    match count {
        0 | 1 => return None,
        2 => {
            // Both sides of one outline.
            let front = without_collinear_corners(points, &outlines[0], rounding);
            outlines[1] = front.iter().rev().copied().collect();
            outlines[0] = front;
        }
        _ => {
            let mut meeting = vec![0u32; points.len()];
            for &v in outlines.iter().flatten() {
                meeting[v as usize] += 1;
            }
            for outline in &mut outlines {
                outline.retain(|&v| meeting[v as usize] > 2);
            }
        }
    }
    let polygons = outlines.iter().all(|outline| outline.len() >= 3);
    polygons.then_some(outlines)
}

/// Groups coplanar facets: returns the face of each facet, and the number of faces.
fn group_coplanar_facets(points: &[DVec3], facets: &Facets, rounding: f64) -> (Vec<u32>, u32) {
    const NONE: u32 = u32::MAX;
    let mut order: Vec<u32> = (0..facets.loops.len() as u32).collect();
    let area = |f: u32| facets.planes[f as usize].area;
    order.sort_by(|&f, &g| area(g).total_cmp(&area(f)));
    let mut faces = vec![NONE; order.len()];
    let mut count = 0;
    for seed in order {
        if faces[seed as usize] != NONE {
            continue;
        }
        faces[seed as usize] = count;
        let normal = facets.planes[seed as usize].normal;
        let base = points[facets.loops[seed as usize][0] as usize];
        let joins = |facet: u32| {
            let plane = &facets.planes[facet as usize];
            // A facet no wider than rounding has no direction of its own.
            let alike = plane.normal.dot(normal) > 0.0 || !(plane.area_per_longest_side > rounding);
            let near = |&v: &u32| normal.dot(points[v as usize] - base).abs() <= rounding;
            alike && facets.loops[facet as usize].iter().all(near)
        };
        let mut grown = vec![seed];
        while let Some(facet) = grown.pop() {
            for &other in &facets.facets_across_sides[facet as usize] {
                if faces[other as usize] == NONE && joins(other) {
                    faces[other as usize] = count;
                    grown.push(other);
                }
            }
        }
        count += 1;
    }
    (faces, count)
}

/// Chains the sides between different faces into one outline for each face; `None` if a face has several outlines.
fn outlines(facets: &Facets, faces: &[u32], count: u32, points: usize) -> Option<Vec<Vec<u32>>> {
    const NONE: u32 = u32::MAX;
    let mut members = vec![Vec::new(); count as usize];
    for (facet, &face) in faces.iter().enumerate() {
        members[face as usize].push(facet);
    }
    // The next corner of the outline that is being chained.
    let mut next = vec![NONE; points];
    let mut out = Vec::with_capacity(members.len());
    for (face, members) in (0..).zip(&members) {
        let sides = members.iter().flat_map(|&facet| {
            let across = facets.facets_across_sides[facet].iter();
            sides_of_loop(&facets.loops[facet]).zip(across)
        });
        let outer = sides.filter(|&(_, &other)| faces[other as usize] != face);
        let outer: Vec<(u32, u32)> = outer.map(|(side, _)| side).collect();
        for &(v, w) in &outer {
            if next[v as usize] != NONE {
                return None;
            }
            next[v as usize] = w;
        }
        let mut outline = Vec::with_capacity(outer.len());
        let mut at = outer.first()?.0;
        while next[at as usize] != NONE {
            outline.push(at);
            at = std::mem::replace(&mut next[at as usize], NONE);
        }
        if outline.len() != outer.len() {
            return None;
        }
        out.push(outline);
    }
    Some(out)
}

/// Removes corners from an outline that are within `rounding` of the line between their neighbours.
fn without_collinear_corners(points: &[DVec3], outline: &[u32], rounding: f64) -> Vec<u32> {
    let at = |v: u32| points[v as usize];
    let mut kept: Vec<u32> = Vec::with_capacity(outline.len());
    // Starts at an extreme point, which is certainly a corner.
    let far = |v: &&u32| at(**v).distance_squared(at(outline[0]));
    let start = outline.iter().max_by(|v, w| far(v).total_cmp(&far(w)));
    let first = outline.iter().position(|v| Some(v) == start).unwrap_or(0);
    let turned = || outline.iter().cycle().skip(first).take(outline.len());
    for (&v, &after) in turned().zip(outline.iter().cycle().skip(first + 1)) {
        let straight = kept
            .last()
            .is_some_and(|&before| distance_from_line(at(v), [at(before), at(after)]) <= rounding);
        if !straight {
            kept.push(v);
        }
    }
    kept
}
