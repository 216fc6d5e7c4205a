use super::*;
use crate::answer::Separation;
use crate::body::feature::Feature;
use crate::body::polytope::{Facet, FacetOrigin, Polytope};
use crate::body::{Body, Solidity};
use crate::math::order::{greater, lesser};
use crate::motion::Motion;
use crate::motion::pose::Pose;
use crate::query::MovingBody;
use crate::query::Query;
use crate::settings::Settings;
use crate::tests::scene::{
    Pcg64, RngExt, SoupKind, random_direction, random_point_in_ball, random_power_of_ten,
    random_rotation, random_triangle_soup, rng,
};
use glam::{DQuat, DVec3};
use twin::Mesh;

mod cuts;
mod twin;

/// Returns the contacts of two bodies at rest, A at its pose, B at the origin.
fn contacts(a: &Body, b: &Body, pose: Pose, tolerance: f64) -> Vec<Contact> {
    let config = Settings {
        tolerance,
        ..Settings::DEFAULT
    };
    problem_of_still_bodies(a, b, pose, &config)
        .contacts_at(0.25)
        .unwrap()
}

fn problem_of_still_bodies<'a>(
    a: &'a Body,
    b: &'a Body,
    pose: Pose,
    config: &'a Settings,
) -> Problem<'a> {
    let moving = |body, pose| MovingBody::from((body, Motion::still(pose)));
    Problem::of_moving_bodies(moving(a, pose), moving(b, Pose::IDENTITY), 1.0, config).unwrap()
}

fn pose_at(x: f64, y: f64, z: f64) -> Pose {
    Pose::at(DVec3::new(x, y, z)).unwrap()
}

fn with_rotation(pose: Pose, axis: DVec3, angle: f64) -> Pose {
    Pose::new(pose.translation(), DQuat::from_axis_angle(axis, angle)).unwrap()
}

fn feature_names(pairs: &[Contact]) -> Vec<String> {
    let name = |pair: &Contact| format!("{} {}", pair.feature_a, pair.feature_b);
    let mut names: Vec<String> = pairs.iter().map(name).collect();
    names.sort();
    names
}

/// Counts the pairs of a vertex and a face, of two edges, and of other features.
fn count_pair_kinds(pairs: &[Contact]) -> [usize; 3] {
    let mut counts = [0; 3];
    for pair in pairs {
        counts[match (pair.feature_a, pair.feature_b) {
            (Feature::Vertex(_), Feature::Face(_)) | (Feature::Face(_), Feature::Vertex(_)) => 0,
            (Feature::Edge(..), Feature::Edge(..)) => 1,
            _ => 2,
        }] += 1;
    }
    counts
}

/// Creates a box as two bodies: one of 12 triangles that share 8 vertices, and one of a single piece.
fn cuboid_as_triangles_and_as_piece(half: DVec3) -> [Body; 2] {
    let solid = Body::cuboid(half).unwrap();
    [Mesh::cuboid(half).body(Solidity::Solid), solid]
}

fn check_separations(pairs: &[Contact], distance: f64, normal: DVec3) {
    for pair in pairs {
        let Separation { lower, upper, .. } = pair.separation;
        assert!(
            lower <= distance && distance <= upper,
            "{distance} {pair:?}"
        );
        assert!(upper - lower < 1e-12, "{pair:?}");
        assert!(pair.separation.normal.distance(normal) < 1e-9, "{pair:?}");
        let way = pair.separation.witness_b - pair.separation.witness_a;
        assert!(way.distance(distance * normal) < 1e-12, "{pair:?}");
    }
}

#[test]
fn a_cube_flat_on_a_slab_has_its_four_corners_on_the_face() {
    for cube in cuboid_as_triangles_and_as_piece(DVec3::splat(0.5)) {
        for slab in cuboid_as_triangles_and_as_piece(DVec3::new(3.0, 3.0, 1.0)) {
            // The places are over the diagonals of the slab's triangulation, and next to them; also in contact.
            for (x, y) in [(0.0, 0.0), (0.3, 0.1), (0.25, -0.75)] {
                for gap in [5e-4, 1e-6, 0.0] {
                    let pairs = contacts(&cube, &slab, pose_at(x, y, 1.5 + gap), 1e-3);
                    assert_eq!(
                        count_pair_kinds(&pairs),
                        [4, 0, 0],
                        "{x} {y} {gap}: {:?}",
                        feature_names(&pairs)
                    );
                    check_separations(&pairs, gap, -DVec3::Z);
                    let vertices: Vec<u32> = pairs
                        .iter()
                        .map(|pair| vertex_number(pair.feature_a))
                        .collect();
                    assert!((0..4).all(|v| vertices.contains(&v)), "{vertices:?}");
                }
            }
        }
    }
}

fn vertex_number(feature: Feature) -> u32 {
    match feature {
        Feature::Vertex(v) => v,
        other => panic!("{other} is no vertex"),
    }
}

#[test]
fn a_cube_over_the_side_of_a_slab_has_two_corners_and_two_crossings() {
    for cube in cuboid_as_triangles_and_as_piece(DVec3::splat(0.5)) {
        for slab in cuboid_as_triangles_and_as_piece(DVec3::new(3.0, 3.0, 1.0)) {
            let pairs = contacts(&cube, &slab, pose_at(3.1, 0.2, 1.5005), 1e-3);
            assert_eq!(
                count_pair_kinds(&pairs),
                [2, 2, 0],
                "{:?}",
                feature_names(&pairs)
            );
            check_separations(&pairs, 5e-4, -DVec3::Z);
        }
    }
}

#[test]
fn flush_squares_cross_along_their_outlines() {
    let square = || cuboid_as_triangles_and_as_piece(DVec3::new(1.0, 1.0, 0.2));
    for (a, b) in square().into_iter().zip(square()) {
        // A star has eight crossings, and a cross of two bars four.
        let star = with_rotation(pose_at(0.0, 0.0, 0.4005), DVec3::Z, 0.6);
        let pairs = contacts(&a, &b, star, 1e-3);
        assert_eq!(
            count_pair_kinds(&pairs),
            [0, 8, 0],
            "{:?}",
            feature_names(&pairs)
        );
        check_separations(&pairs, 5e-4, -DVec3::Z);
    }
    let bars = [DVec3::new(2.0, 0.5, 0.2), DVec3::new(0.5, 2.0, 0.2)];
    let [a, b] = bars.map(|half| Mesh::cuboid(half).body(Solidity::Solid));
    let pairs = contacts(&a, &b, pose_at(0.1, 0.0, 0.4), 1e-3);
    assert_eq!(
        count_pair_kinds(&pairs),
        [0, 4, 0],
        "{:?}",
        feature_names(&pairs)
    );
    check_separations(&pairs, 0.0, -DVec3::Z);
}

/// Tests that two equal squares on each other report only the pairs of their corners, not those of the edges and faces.
#[test]
fn equal_faces_meet_in_their_corners() {
    for (a, b) in cuboid_as_triangles_and_as_piece(DVec3::ONE)
        .into_iter()
        .zip(cuboid_as_triangles_and_as_piece(DVec3::ONE))
    {
        let pairs = contacts(&a, &b, pose_at(0.0, 0.0, 2.0005), 1e-3);
        assert_eq!(feature_names(&pairs), ["v0 v4", "v1 v5", "v2 v6", "v3 v7"]);
        check_separations(&pairs, 5e-4, -DVec3::Z);
        // One face is shifted along one side, and its corners are within edges.
        let pairs = contacts(&a, &b, pose_at(0.7, 0.0, 2.0005), 1e-3);
        assert_eq!(
            feature_names(&pairs),
            ["e0-1 v5", "e2-3 v7", "v0 e4-5", "v2 e6-7"]
        );
        check_separations(&pairs, 5e-4, -DVec3::Z);
    }
}

#[test]
fn balls_and_capsules_touch_with_their_surfaces() {
    let slab = Body::cuboid(DVec3::new(3.0, 3.0, 1.0)).unwrap();
    let ball = Body::sphere(0.5).unwrap();
    let pairs = contacts(&ball, &slab, pose_at(0.3, 0.1, 1.5005), 1e-3);
    assert_eq!(feature_names(&pairs), ["v0 f5"]);
    check_separations(&pairs, 5e-4, -DVec3::Z);
    let pairs = contacts(
        &ball,
        &Body::sphere(0.7).unwrap(),
        pose_at(0.0, 1.2005, 0.0),
        1e-3,
    );
    assert_eq!(feature_names(&pairs), ["v0 v0"]);
    check_separations(&pairs, 5e-4, -DVec3::Y);

    let capsule = Body::capsule(0.25, 1.0).unwrap();
    let lying = with_rotation(
        pose_at(0.0, 0.0, 1.2505),
        DVec3::X,
        std::f64::consts::FRAC_PI_2,
    );
    let pairs = contacts(&capsule, &slab, lying, 1e-3);
    assert_eq!(feature_names(&pairs), ["v0 f5", "v1 f5"]);
    check_separations(&pairs, 5e-4, -DVec3::Z);
    // The edges cross each other, or are side by side.
    let across = with_rotation(pose_at(0.5005, 0.0, 0.0), DVec3::X, 1.0);
    let pairs = contacts(&capsule, &capsule, across, 1e-3);
    assert_eq!(feature_names(&pairs), ["e0-1 e0-1"]);
    check_separations(&pairs, 5e-4, -DVec3::X);
    let pairs = contacts(&capsule, &capsule, pose_at(0.5005, 0.0, 0.5), 1e-3);
    assert_eq!(feature_names(&pairs), ["e0-1 v1", "v0 e0-1"]);
    check_separations(&pairs, 5e-4, -DVec3::X);
}

/// Tests that a corner without a mesh number is named by its piece, or by its point if the piece has no facets.
#[test]
fn features_without_a_number_are_named_by_their_piece() {
    let slab = Body::cuboid(DVec3::new(3.0, 3.0, 1.0)).unwrap();
    let cube = Mesh::cuboid(DVec3::splat(0.5));
    let facet = |face: &[u32; 3]| Facet {
        origin: FacetOrigin::Virtual,
        corners: face.to_vec(),
    };
    let hull = Polytope {
        points: cube.points.clone(),
        facets: cube.faces.iter().map(facet).collect(),
        ..Polytope::default()
    };
    let bare = Polytope {
        facets: Vec::new(),
        ..hull.clone()
    };
    for (polytope, name) in [(hull, "p0 f5"), (bare, "v")] {
        let body = Body::polytope(polytope).unwrap();
        let pairs = contacts(&body, &slab, pose_at(0.3, 0.1, 1.5005), 1e-3);
        assert_eq!(pairs.len(), 4, "{:?}", feature_names(&pairs));
        assert!(feature_names(&pairs).iter().all(|it| it.starts_with(name)));
        check_separations(&pairs, 5e-4, -DVec3::Z);
    }
}

/// Tests that contacts are reported up to the margin plus the tolerance, and not beyond.
#[test]
fn a_margin_is_reached_across() {
    let cube = Mesh::cuboid(DVec3::splat(0.5)).body(Solidity::Solid);
    let config = Settings {
        margin: 0.25,
        ..Settings::DEFAULT
    };
    for (height, count) in [(0.2505, 4), (0.2515, 0)] {
        let problem =
            problem_of_still_bodies(&cube, &cube, pose_at(0.0, 0.0, 1.0 + height), &config);
        let pairs = problem.contacts_at(0.5).unwrap();
        assert_eq!(pairs.len(), count, "{:?}", feature_names(&pairs));
        check_separations(&pairs, height, -DVec3::Z);
    }
}

/// Compares the contacts of random triangle soups with those of a brute-force search. Positions are random, so no
/// distance is close to the tolerance.
#[test]
fn no_pair_of_random_soups_is_missed() {
    let rng = &mut rng(71);
    let mut found = [0; 3];
    for round in 0..240 {
        let size = random_power_of_ten(rng, -3.0, 3.0);
        let [look_a, look_b] = [0; 2].map(|_| SoupKind::ALL[rng.random_range(0..5)]);
        let tame = |look| {
            if look == SoupKind::Needles {
                SoupKind::WellShaped
            } else {
                look
            }
        };
        let count = |rng: &mut Pcg64| rng.random_range(1..40);
        let (count_a, count_b) = (count(rng), count(rng));
        let a = Mesh::from_triangles(random_triangle_soup(rng, tame(look_a), count_a, size));
        let b = Mesh::from_triangles(random_triangle_soup(rng, tame(look_b), count_b, size));
        let place = random_point_in_ball(rng, size);
        let pose = Pose::new(place, random_rotation(rng)).unwrap();
        let tolerance = size * random_power_of_ten(rng, -2.5, -0.5);
        compare_with_brute_force(&a, &b, pose, tolerance, &mut found, round);
    }
    assert!(found.iter().all(|&count| count > 120), "{found:?}");
}

/// Compares the contacts of a box that nearly rests on a terrain with those of a brute-force search. Faces, edges and
/// corners of the box lie on the terrain.
#[test]
fn no_pair_of_meshes_that_nearly_rest_is_missed() {
    let rng = &mut rng(72);
    let mut found = [0; 3];
    for round in 0..160 {
        let half = DVec3::from_array(std::array::from_fn(|_| rng.random_range(0.2..1.5)));
        let rough = [0.0, 1e-3, 0.3][round % 3];
        let (a, b) = (Mesh::cuboid(half), Mesh::terrain(rng, 8, 3.0, rough));
        let lean = [0.0, 1e-6, 1e-4, 1e-2, 0.7][rng.random_range(0..5)];
        let turn = DQuat::from_axis_angle(random_direction(rng), lean)
            * DQuat::from_rotation_z(rng.random_range(0.0..3.0));
        let lowest = a
            .points
            .iter()
            .map(|&p| (turn * p).z)
            .fold(f64::INFINITY, lesser);
        let place = DVec3::new(
            rng.random_range(-1.0..1.0),
            rng.random_range(-1.0..1.0),
            5e-4 - lowest,
        );
        let tolerance = [1e-3, 1e-2, 0.1][rng.random_range(0..3)];
        compare_with_brute_force(
            &a,
            &b,
            Pose::new(place, turn).unwrap(),
            tolerance,
            &mut found,
            round,
        );
    }
    assert!(found[0] > 400 && found[1] > 400, "{found:?}");
}

/// Compares the contacts of two meshes with a brute-force search, by features and distances, and counts them in
/// `found`.
fn compare_with_brute_force(
    a: &Mesh,
    b: &Mesh,
    pose: Pose,
    tolerance: f64,
    found: &mut [usize; 3],
    round: usize,
) {
    let (body_a, body_b) = (a.body(Solidity::Surface), b.body(Solidity::Surface));
    let config = Settings {
        tolerance,
        ..Settings::DEFAULT
    };
    let problem = problem_of_still_bodies(&body_a, &body_b, pose, &config);
    let pairs = problem.contacts_at(0.0).unwrap();
    let placed = a.at_pose(&pose);
    let expected = twin::contacts(&placed, b, tolerance, problem.rounding);
    let reported: Vec<(String, f64)> = pairs
        .iter()
        .map(|pair| {
            (
                format!("{} {}", pair.feature_a, pair.feature_b),
                pair.separation.upper,
            )
        })
        .collect();
    for (name, distance) in &expected.certain_pairs {
        let same = reported.iter().find(|(other, _)| other == name);
        let Some((_, upper)) = same else {
            panic!("round {round}: {name} at {distance} of {tolerance} is missed");
        };
        let off = upper - problem.rounding - distance;
        assert!(
            off.abs() <= 1e-9 * greater(tolerance, *distance) + 4.0 * problem.rounding,
            "{name} {off}"
        );
    }
    for (name, distance) in &reported {
        assert!(
            expected.certain_pairs.contains_key(name) || expected.uncertain_pairs.contains(name),
            "round {round}: {name} at {distance} of {tolerance} is no pair"
        );
    }
    assert!(pairs.is_sorted_by(|one, two| one.separation.upper <= two.separation.upper));
    for pair in &pairs {
        let Separation {
            lower,
            upper,
            normal,
            ..
        } = pair.separation;
        assert!(
            lower <= upper && lower <= tolerance && (normal.length() - 1.0).abs() < 1e-12,
            "{pair:?}"
        );
        let loose = upper - lower > 1e-9 * tolerance + 16.0 * problem.rounding;
        assert!(!loose, "round {round}: not the nearest points: {pair:?}");
    }
    for (count, more) in found.iter_mut().zip(count_pair_kinds(&pairs)) {
        *count += more;
    }
    let mut unique = feature_names(&pairs);
    unique.dedup();
    assert_eq!(
        unique.len(),
        pairs.len(),
        "round {round}: a pair is reported twice"
    );
    assert_eq!(pairs, problem.contacts_at(0.0).unwrap());
}

/// Tests that the contacts of two plates with 52 million pairs of triangles are found within the default budget.
#[test]
fn fine_plates_face_to_face_are_no_trouble() {
    let rng = &mut rng(73);
    let plate = Mesh::terrain(rng, 60, 3.0, 0.0);
    let body = plate.body(Solidity::Surface);
    // The plate is shifted by half a cell: every vertex is over a face, except those beyond the other plate.
    let cell = 6.0 / 60.0;
    let pairs = contacts(&body, &body, pose_at(0.3 * cell, 0.2 * cell, 5e-4), 1e-3);
    // Along two sides, 61 and 60 vertices of either plate hang over.
    assert_eq!(count_pair_kinds(&pairs)[0], 2 * 60 * 60);
    assert_eq!(
        count_pair_kinds(&pairs)[1],
        2,
        "{:?}",
        &feature_names(&pairs)[..8]
    );
    assert_eq!(pairs.len(), 2 * 60 * 60 + 2);
}

#[test]
fn times_beyond_the_duration_and_budgets_are_refused() {
    let cube = Mesh::cuboid(DVec3::ONE).body(Solidity::Solid);
    let problem = problem_of_still_bodies(&cube, &cube, pose_at(0.0, 0.0, 2.0), &Settings::DEFAULT);
    let (place, settings) = (Pose::at([0.0, 0.0, 2.0]).unwrap(), Settings::DEFAULT);
    let query = Query::new((&cube, place), (&cube, Pose::IDENTITY), 1.0, &settings).unwrap();
    for time in [-1e-9, 1.0 + 1e-9, f64::NAN, f64::INFINITY] {
        let refused = query.contacts_at(time);
        assert!(
            matches!(refused, Err(ContactsError::NotInDuration { .. })),
            "{time}"
        );
    }
    assert_eq!(problem.contacts_at(0.0).unwrap().len(), 4);
    assert_eq!(problem.contacts_at(1.0).unwrap().len(), 4);
    for budget in 1..4 {
        let config = Settings {
            budget,
            ..Settings::DEFAULT
        };
        let problem = problem_of_still_bodies(&cube, &cube, pose_at(0.0, 0.0, 2.0), &config);
        assert_eq!(
            problem.contacts_at(0.5),
            Err(ContactsError::TooManyPairs { budget })
        );
    }
}
