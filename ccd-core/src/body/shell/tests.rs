//! Tests that pieces belong to the same connected part exactly if shared points connect them.

use super::{DisjointSets, ExtremePoints, part_extreme_points};
use crate::body::pieces::Pieces;
use crate::tests::meshes::{cube, translated_triangles};
use crate::tests::scene::{RngExt, pieces, random_direction, rng};
use glam::DVec3;

#[test]
fn parts_are_found_and_their_extremes() {
    let mut parts = Vec::new();
    for x in [0.0, 5.0, -7.0] {
        parts.extend(translated_triangles(&cube(1.0, 3), x * DVec3::X));
    }
    let found = part_extreme_points(&pieces(&parts));
    assert_eq!(found.len(), 3);
    for shell in &found {
        let middle = 0.5 * (shell[0].x + shell[3].x);
        assert!([0.0, 5.0, -7.0].contains(&middle));
        for (side, point) in shell.iter().enumerate() {
            let sign = if side < 3 { 1.0 } else { -1.0 };
            let offset = if side % 3 == 0 { middle } else { 0.0 };
            assert_eq!(point[side % 3], offset + sign);
        }
    }
}

#[test]
fn one_point_in_common_connects_and_negative_zero_is_zero() {
    let corner = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let touching = [-DVec3::ZERO, -DVec3::X, -DVec3::Y];
    assert_eq!(part_extreme_points(&pieces(&[corner, touching])).len(), 1);
    let beside = touching.map(|p| p - 1e-300 * DVec3::ONE);
    assert_eq!(part_extreme_points(&pieces(&[corner, beside])).len(), 2);
}

#[test]
fn a_chain_of_many_is_one_part_in_any_order() {
    let mut rng = rng(1);
    let mut chain = Vec::new();
    let mut at = DVec3::ZERO;
    for _ in 0..2_000 {
        let next = at + random_direction(&mut rng);
        chain.push([at, next, at + random_direction(&mut rng)]);
        at = next;
    }
    assert_eq!(part_extreme_points(&pieces(&chain)).len(), 1);
    chain.reverse();
    assert_eq!(part_extreme_points(&pieces(&chain)).len(), 1);
    let every_other: Vec<_> = chain.iter().step_by(2).copied().collect();
    assert_eq!(part_extreme_points(&pieces(&every_other)).len(), 1_000);
}

/// Finds the connected parts by comparing all pairs of points, as a reference.
fn part_extreme_points_by_brute_force(pieces: &Pieces) -> Vec<ExtremePoints> {
    let points = pieces.points();
    let mut parts = DisjointSets::new(points.len());
    for piece in 0..pieces.len() {
        let range = pieces.point_range(piece);
        let first = range.start as u32;
        (first..range.end as u32).for_each(|k| _ = parts.join(first, k));
    }
    for (k, point) in points.iter().enumerate() {
        (0..k)
            .filter(|&j| points[j] == *point)
            .for_each(|j| _ = parts.join(j as u32, k as u32));
    }
    let mut found: Vec<(u32, ExtremePoints)> = Vec::new();
    for (k, &point) in points.iter().enumerate() {
        let root = parts.root(k as u32);
        let known = found.iter().position(|shell| shell.0 == root);
        let at = known.unwrap_or_else(|| {
            found.push((root, [point; 6]));
            found.len() - 1
        });
        for (side, extreme) in found[at].1.iter_mut().enumerate() {
            let sign = if side < 3 { 1.0 } else { -1.0 };
            if sign * point[side % 3] > sign * extreme[side % 3] {
                *extreme = point;
            }
        }
    }
    found.into_iter().map(|shell| shell.1).collect()
}

#[test]
fn numbers_of_any_kind_give_the_same_parts() {
    let mut rng = rng(2);
    for count in [1, 2, 5, 40, 120] {
        let mut at = || f64::from(rng.random_range(-3i32..3)) * 0.5;
        let vertices: Vec<DVec3> = (0..count).map(|_| DVec3::new(at(), at(), at())).collect();
        let faces: Vec<[u32; 3]> = (0..count)
            .map(|_| [(); 3].map(|()| rng.random_range(0..count)))
            .collect();
        let ids: Vec<u32> = (0..count).collect();
        let pieces = Pieces::from_triangles(&vertices, &faces, &ids).unwrap();
        assert_eq!(
            part_extreme_points(&pieces),
            part_extreme_points_by_brute_force(&pieces)
        );
        // One number belongs to several places, and numbers are far above the count of points.
        for number in [&|k: u32| k % 2, &|k: u32| u32::MAX - k] as [&dyn Fn(u32) -> u32; 2] {
            let polytopes: Vec<_> = (0..pieces.len())
                .map(|k| pieces.polytope(k))
                .map(|polytope| crate::Polytope {
                    vertex_ids: (0..3).map(number).collect(),
                    ..polytope
                })
                .collect();
            let pieces = Pieces::from_polytopes(&polytopes).unwrap();
            assert_eq!(
                part_extreme_points(&pieces),
                part_extreme_points_by_brute_force(&pieces)
            );
        }
    }
}
