use super::*;
use crate::math::order::greater;
use crate::tests::scene::{
    Pcg64, RngExt, random_direction, random_point_in_ball, random_rotation, rng,
};
use glam::DQuat;

const SLACK: f64 = 1e-13;

fn common_normals(a: &[DVec3], b: &[DVec3]) -> CommonNormals {
    let mut normals = CommonNormals::default();
    normals.reset(SLACK);
    a.iter()
        .for_each(|&offset| normals.add_constraint_of_a(offset));
    b.iter()
        .for_each(|&offset| normals.add_constraint_of_b(offset));
    normals.sort_constraints();
    normals
}

/// Returns the edge vectors of a cube at one of its corners; `side` has their signs.
fn cube_corner_offsets(side: DVec3) -> Vec<DVec3> {
    vec![side.x * DVec3::X, side.y * DVec3::Y, side.z * DVec3::Z]
}

fn rotated_offsets(turn: DQuat, offsets: &[DVec3]) -> Vec<DVec3> {
    offsets.iter().map(|&offset| turn * offset).collect()
}

/// Returns vectors from a point of the plane z = 0 to points around it in that plane.
fn offsets_in_xy_plane() -> Vec<DVec3> {
    vec![DVec3::X, -DVec3::X, 0.1 * DVec3::Y, -3.0 * DVec3::Y]
}

#[test]
fn cubes_that_stand_on_each_other_have_one_normal() {
    let rng = &mut rng(81);
    for _ in 0..200 {
        let turn = random_rotation(rng);
        let below = rotated_offsets(turn, &cube_corner_offsets(DVec3::new(1.0, 1.0, -1.0)));
        let above = rotated_offsets(turn, &cube_corner_offsets(DVec3::new(1.0, 1.0, 1.0)));
        let normals = common_normals(&above, &below);
        let expected = -(turn * DVec3::Z);
        for towards in [random_direction(rng), expected, random_direction(rng)] {
            // A direction away from the cone is turned towards it, unless there is none but the opposite.
            let found = normals.nearest_normal(towards).unwrap();
            assert!(found.distance(expected) < 1e-14, "{found} {expected}");
        }
        assert_eq!(
            normals.nearest_normal_parallel_to(expected, 1e-12 * random_direction(rng)),
            None
        );
        assert!(
            normals
                .nearest_normal_parallel_to(expected, 1e-12 * expected)
                .is_some()
        );
    }
}

/// Draws up to 11 vectors, most of which point along `about`. The normals of both bundles are opposite.
fn random_cone_vectors(rng: &mut Pcg64, about: DVec3) -> Vec<DVec3> {
    let count = rng.random_range(1..12);
    let offsets =
        (0..count).map(|_| (about + random_point_in_ball(rng, 1.5)) * rng.random_range(0.01..10.0));
    offsets.collect()
}

/// Tests that the projection onto a cone of normals is as good as the best one found by trying all sides and edges of
/// the cone.
#[test]
fn the_nearest_normal_is_the_best_of_all_candidates() {
    let rng = &mut rng(82);
    let (mut some, mut none) = (0, 0);
    for _ in 0..2000 {
        let [a, b] = [-DVec3::Z, DVec3::Z].map(|about| random_cone_vectors(rng, about));
        let normals = common_normals(&a, &b);
        let towards = random_direction(rng);
        let offsets = normals.constraint_vectors.clone();
        let flat = |offset: DVec3| towards.reject_from(offset);
        let line = |one: DVec3, other: DVec3| towards.project_onto(one.cross(other));
        let lines = offsets
            .iter()
            .flat_map(|&one| offsets.iter().map(move |&other| line(one, other)));
        let all = offsets
            .iter()
            .map(|&offset| flat(offset))
            .chain(lines)
            .chain([towards]);
        let good = all.filter(|n| {
            n.is_finite()
                && offsets
                    .iter()
                    .all(|offset| n.dot(*offset) >= -1e-12 * offset.length())
        });
        let best = good.map(|n| n.length()).fold(0.0, greater);
        match normals.project_onto_cone(towards) {
            Some(n) => {
                assert!(
                    (n.dot(towards) - best).abs() < 1e-9,
                    "{} {best}",
                    n.dot(towards)
                );
                assert!((n.length() - 1.0).abs() < 1e-15);
                some += 1;
            }
            None => {
                assert!(best < 1e-5, "{best}");
                none += 1;
            }
        }
    }
    assert!(some > 300 && none > 300, "{some} {none}");
}

#[test]
fn surfaces_that_enclose_each_other_have_no_common_normal() {
    let normals = common_normals(&offsets_in_xy_plane(), &[DVec3::Z, -DVec3::Z]);
    assert_eq!(normals.nearest_normal(DVec3::Z), None);
    assert_eq!(
        common_normals(&[DVec3::NAN], &[]).nearest_normal(DVec3::X),
        None
    );
}
