//! Checks the properties in [`laws`] for every backend, on random pairs of pieces from [`scene`].

mod laws;
pub(crate) mod scene;
mod twin;

use crate::{ClosedForm, Direct, Gjk};
use ccd_core::glam::{DMat3, DVec3};
use ccd_core::{DistanceOracle, Frame, Piece, PiecePair};
use rstest::rstest;
use scene::{NearestFeatures, Pcg64, Scene, SeedableRng};

/// Returns the number of scenes per law; the environment variable `CCD_CASES` overrides it.
fn case_count() -> u64 {
    let given = std::env::var("CCD_CASES").ok();
    given.and_then(|text| text.parse().ok()).unwrap_or(2000)
}

/// Checks a law for the scenes that `draw` makes from the seeds 0, 1, …
fn check_scenes(draw: impl Fn(&mut Pcg64) -> Scene, law: impl Fn(&Scene)) {
    for seed in 0..case_count() {
        law(&draw(&mut Pcg64::seed_from_u64(seed)));
    }
}

/// Generates the tests of all laws for one backend.
macro_rules! obeys {
    ($backend:ident, $oracle:ty) => {
        mod $backend {
            use super::*;

            #[test]
            fn random_triangles() {
                check_random_hulls::<$oracle>(3, 3);
            }

            #[test]
            fn intersecting_triangles() {
                check_scenes(
                    |rng| scene::intersecting_hulls(rng, 3, 3),
                    |scene| laws::check_common_point::<$oracle>(scene, 1e-12),
                );
            }

            #[rstest]
            fn near_contact(
                #[values(
                    NearestFeatures::CornerFace,
                    NearestFeatures::CrossedEdges,
                    NearestFeatures::ParallelFaces,
                    NearestFeatures::CornerEdge,
                    NearestFeatures::CornerCorner
                )]
                meeting: NearestFeatures,
                #[values(1e-3, 1e-6, 1e-9, 1e-11)] gap: f64,
            ) {
                super::check_near_contact::<$oracle>(meeting, gap);
            }

            #[test]
            fn touching() {
                check_scenes(
                    scene::touching_triangles,
                    laws::check_touching_pieces::<$oracle>,
                );
            }

            #[test]
            fn degenerate() {
                super::check_degenerate_hulls::<$oracle>();
            }

            #[test]
            fn far_from_the_origin() {
                super::check_far_from_origin::<$oracle>();
            }

            #[test]
            fn any_scale() {
                super::check_hulls_of_any_scale::<$oracle>();
            }

            #[test]
            fn history() {
                super::check_history_independence::<$oracle>(3);
            }
        }
    };
}

obeys!(closed_form, ClosedForm);
obeys!(gjk, Gjk);
obeys!(direct, Direct);

#[rstest]
fn hulls_of_few_points_obey_all_laws(
    #[values(1, 2, 3, 4, 5, 6)] a: usize,
    #[values(4, 5, 6)] b: usize,
) {
    check_random_hulls::<Gjk>(a, b);
    check_random_hulls::<Direct>(a, b);
}

#[rstest]
fn intersecting_hulls_have_a_common_point(#[values(4, 7, 30)] a: usize, #[values(4, 30)] b: usize) {
    let draw = |rng: &mut Pcg64| scene::intersecting_hulls(rng, a, b);
    check_scenes(draw, |scene| {
        laws::check_common_point::<Gjk>(scene, 1e-12);
    });
}

/// Tests that flattened intersecting hulls get a common point to 1e-6 of their size. Flat pieces lose digits: the worst
/// error of these was 1.7e-7.
#[rstest]
fn flattened_hulls_have_a_common_point(
    #[values(3, 4, 8, 30)] a: usize,
    #[values(3, 4, 30)] b: usize,
) {
    let draw = |rng: &mut Pcg64| scene::flattened_hulls(rng, a, b);
    check_scenes(draw, |scene| laws::check_common_point::<Gjk>(scene, 1e-6));
    check_scenes(draw, |scene| {
        laws::check_common_point::<Direct>(scene, 1e-6);
    });
}

#[rstest]
fn stacked_boxes_are_certified_at_their_gap(#[values(1e-3, 1e-6, 1e-9, 1e-11)] gap: f64) {
    let draw = |rng: &mut Pcg64| scene::stacked_boxes(rng, gap);
    check_scenes(draw, |scene| {
        check_certified_distance::<Gjk>(scene, gap, 1e-9);
    });
}

#[rstest]
fn balls_of_many_points_are_certified_apart(
    #[values(50, 500)] count: usize,
    #[values(1e-2, 1.0)] gap: f64,
) {
    for seed in 0..100 {
        let scene = scene::balls(&mut Pcg64::seed_from_u64(seed), count, gap);
        laws::check_separation::<Gjk>(&scene);
        laws::check_symmetry::<Gjk>(&scene);
    }
    check_history_independence::<Gjk>(count);
}

/// Checks that separate random hulls are certified apart at the distance that brute force finds, in either order of the
/// pieces. Separate and intersecting hulls both occur often enough.
fn check_random_hulls<O: DistanceOracle + Default>(a: usize, b: usize) {
    let apart = std::cell::Cell::new(0);
    let law = |scene: &Scene| {
        laws::check_finite_distance_and_gap::<O>(scene);
        laws::check_symmetry::<O>(scene);
        let checked = laws::measure_claim(scene, &laws::claim_with_empty_cache::<O>(scene));
        if checked.distance > 1e-12 * scene.size {
            apart.set(apart.get() + 1);
            laws::check_separation::<O>(scene);
            laws::check_against_brute_force::<O>(scene);
        }
    };
    check_scenes(|rng| scene::random_hulls(rng, a, b), law);
    let share = f64::from(apart.get()) / case_count() as f64;
    assert!((0.3..=1.0).contains(&share), "{share} are apart");
    // A point or an edge hardly ever hits.
    assert!(a < 3 || share < 0.97, "{share} are apart");
}

fn check_near_contact<O: DistanceOracle + Default>(meeting: NearestFeatures, gap: f64) {
    // Tilted faces are nearest at a corner, which may be outside the other face's prism.
    let slack = match meeting {
        NearestFeatures::ParallelFaces => 1e-8,
        _ => 0.0,
    };
    let law = |scene: &Scene| {
        check_certified_distance::<O>(scene, gap, slack);
        laws::check_against_brute_force::<O>(scene);
    };
    check_scenes(|rng| scene::near_contact(rng, meeting, gap), law);
}

/// Checks that pieces are certified apart at the distance `gap`, or up to `slack` more.
fn check_certified_distance<O: DistanceOracle + Default>(scene: &Scene, gap: f64, slack: f64) {
    let checked = laws::check_separation::<O>(scene);
    let range = gap - 1e-13..=gap + slack + 1e-13;
    assert!(
        range.contains(&checked.distance),
        "{checked:?} of {scene:?}"
    );
}

fn check_degenerate_hulls<O: DistanceOracle + Default>() {
    let law = |scene: &Scene| {
        laws::check_symmetry::<O>(scene);
        laws::check_finite_distance_and_gap::<O>(scene);
        if laws::measure_claim(scene, &laws::claim_with_empty_cache::<O>(scene)).distance > 1e-6 {
            laws::check_separation::<O>(scene);
            laws::check_against_brute_force::<O>(scene);
        }
    };
    check_scenes(scene::degenerate_pieces, law);
}

/// Checks that pieces 1e6 from the origin get their distance of 1e-6 to within 2e-9, and an axis that certifies half of
/// it.
fn check_far_from_origin<O: DistanceOracle + Default>() {
    let draw = |rng: &mut Pcg64| {
        scene::near_contact(rng, NearestFeatures::CornerFace, 1e-6).in_random_frames(rng, 1e6)
    };
    let law = |scene: &Scene| {
        let checked = laws::measure_claim(scene, &laws::claim_with_empty_cache::<O>(scene));
        assert!(
            (checked.distance - 1e-6).abs() <= 2e-9,
            "{checked:?} of {scene:?}"
        );
        assert!(
            checked.gap >= 0.5 * checked.distance,
            "{checked:?} of {scene:?}"
        );
    };
    check_scenes(draw, law);
}

fn check_hulls_of_any_scale<O: DistanceOracle + Default>() {
    let draw = |rng: &mut Pcg64| {
        let scale = scene::random_magnitude(rng, -45.0, 15.0);
        let mut scene = scene::random_hulls(rng, 3, 3).scaled(scale);
        // One of the pieces may be almost a point, or almost a half-space.
        let other = scene::random_magnitude(rng, -12.0, 0.0);
        if other < 1e-6 {
            scene.b.iter_mut().for_each(|y| *y *= other);
        }
        scene
    };
    let law = |scene: &Scene| {
        laws::check_finite_distance_and_gap::<O>(scene);
        laws::check_symmetry::<O>(scene);
    };
    check_scenes(draw, law);
    let draw = |rng: &mut Pcg64| {
        let scale = scene::random_magnitude(rng, -45.0, 15.0);
        scene::intersecting_hulls(rng, 3, 3).scaled(scale)
    };
    check_scenes(draw, |scene| laws::check_common_point::<O>(scene, 1e-12));
}

fn check_history_independence<O: DistanceOracle + Default>(count: usize) {
    let mut rng = Pcg64::seed_from_u64(7);
    // Pieces of changing sizes, so that the caches' indices repeatedly go out of range.
    let scenes: Vec<Scene> = (0..200)
        .map(|k| match k % 4 {
            0 => scene::random_hulls(&mut rng, count, count),
            1 => scene::degenerate_pieces(&mut rng),
            2 => scene::intersecting_hulls(&mut rng, count.max(3), 3.min(count)),
            _ => scene::near_contact(&mut rng, NearestFeatures::CrossedEdges, 1e-9),
        })
        .filter(|scene| count > 3 || scene.a.len().max(scene.b.len()) <= 3)
        .collect();
    laws::check_independence_of_history::<O>(&scenes);
}

/// Checks that claims name only existing points of the pieces, in three successive calls.
fn check_claimed_points_exist<O: DistanceOracle + Default>(pair: &PiecePair<'_>) {
    let (mut oracle, mut cache) = (O::default(), O::Cache::default());
    for _ in 0..3 {
        if let Ok(claim) = oracle.separation(pair, &mut cache) {
            for (named, piece) in [(claim.a, &pair.a), (claim.b, &pair.b)] {
                let known = |&k: &u32| (k as usize) < piece.points.len();
                assert!(named.point_indices().iter().all(known), "{claim:?}");
            }
        }
    }
}

fn check_searches_terminate(a: &[DVec3], b: &[DVec3], b_to_a: Frame) {
    let (a, b) = (Piece::from_points(a), Piece::from_points(b));
    for (a, b) in [(a, b), (b, a), (a, a)] {
        let pair = PiecePair { a, b, b_to_a };
        check_claimed_points_exist::<ClosedForm>(&pair);
        check_claimed_points_exist::<Gjk>(&pair);
        check_claimed_points_exist::<Direct>(&pair);
    }
}

#[test]
fn odd_coordinates_end() {
    for seed in 0..case_count() {
        let mut rng = Pcg64::seed_from_u64(seed);
        for count in [1, 2, 3, 8, 20] {
            let [a, b] = [count, 3].map(|count| scene::extreme_coordinate_points(&mut rng, count));
            let translation = scene::extreme_coordinate_points(&mut rng, 1)[0];
            check_searches_terminate(&a, &b, Frame::IDENTITY);
            check_searches_terminate(
                &a,
                &b,
                Frame {
                    translation,
                    ..Frame::IDENTITY
                },
            );
        }
    }
}

/// Tests that degenerate and infinite frames, and pieces without points, do not make a search hang or fail.
#[test]
fn nonsense_ends() {
    let mut rng = Pcg64::seed_from_u64(3);
    for count in [0, 1, 2, 3, 4, 20] {
        let (a, b) = (scene::points(&mut rng, count), scene::points(&mut rng, 3));
        for wrong in [0.0, f64::NAN, f64::INFINITY, 1e300] {
            let b_to_a = Frame {
                translation: DVec3::new(wrong, 0.0, -wrong),
                rotation: wrong * DMat3::IDENTITY,
            };
            check_searches_terminate(&a, &b, b_to_a);
        }
    }
}
