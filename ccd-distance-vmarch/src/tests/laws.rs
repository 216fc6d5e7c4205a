//! Tests claims about pieces that touch, contain each other, spin, or are invalid.

use super::scene::{self, Body, PairKind, Scene};
use super::shape::{self, Pcg64, RngExt, SeedableRng, Shape, random_direction, random_magnitude};
use super::twin::{self, ReferencePolytope};
use super::{Tally, case_count};
use crate::{Cache, Vmarch};
use ccd_core::glam::{DMat3, DQuat, DVec3};
use ccd_core::order::{greater, lesser};
use ccd_core::{Claim, ConvexCombination, DistanceOracle, Frame, GiveUpReason, Piece, PiecePair};
use rstest::rstest;

/// Tests that claims about pieces that barely intersect, touch, or are barely apart are exact up to rounding.
#[rstest]
fn touching_is_exact_up_to_rounding(
    #[values(-1e-9, -1e-13, -1e-16, 0.0, 1e-16, 1e-13, 1e-9)] gap: f64,
    #[values(
        DVec3::new(0.0, 0.0, 1.0),
        DVec3::new(0.3, -0.4, 1.0),
        DVec3::new(2.0, 0.3, 1.0),
        DVec3::new(2.0, 2.0, 1.0)
    )]
    at: DVec3,
) {
    let cube = Body::new(shape::cuboid(DVec3::ONE));
    for pointed in [
        shape::cuboid(DVec3::ONE),
        shape::bipyramid(6),
        shape::shape_of_points(&[-DVec3::Z, DVec3::Z]),
    ] {
        let other = Body::new(pointed);
        // As far outside of the cube's top as above it, where it overhangs.
        let beside = DVec3::new(greater(0.0, at.x - 1.0), greater(0.0, at.y - 1.0), 0.0) * gap;
        let b_to_a = Frame {
            translation: DVec3::new(at.x, at.y, 2.0 + gap) + beside,
            ..Frame::IDENTITY
        };
        let scene = Scene {
            a: &cube,
            b: &other,
            b_to_a,
            gap: 1.0,
        };
        let claim = Vmarch::default().separation(&scene.pair(), &mut Cache::default());
        let claim = claim.unwrap_or_else(|why| panic!("{why:?}"));
        let on_a = claim.a.position(&cube.shape.points).expect("a point of A");
        let on_b =
            b_to_a.transform_point(claim.b.position(&other.shape.points).expect("a point of B"));
        let (a, b) = (
            ReferencePolytope::new(&cube.shape, &Frame::IDENTITY),
            ReferencePolytope::new(&other.shape, &b_to_a),
        );
        let certified = twin::gap(&a, &b, claim.axis.normalize_or_zero());
        let distance = on_a.distance(on_b);
        assert!(
            distance - greater(0.0, certified) <= 2e-15,
            "{distance:e} {certified:e} {gap:e}"
        );
        if gap <= 0.0 && at.x <= 1.0 {
            assert!(
                distance <= 2e-15 && certified <= 2e-15,
                "{distance:e} {certified:e}"
            );
        }
    }
}

/// Tests that a small polytope inside a large one is claimed to intersect it, though their surfaces are apart.
#[test]
fn pieces_inside_intersect() {
    let (large, small) = (
        shape::uv_sphere(9, 16),
        shape::antiprism(5).with_mapped_points(|p| 0.05 * p),
    );
    let (large, small) = (Body::new(large), Body::new(small));
    let mut rng = Pcg64::seed_from_u64(3);
    let mut oracle = Vmarch::default();
    for _ in 0..500 {
        let b_to_a = Frame {
            rotation: DMat3::from_quat(scene::random_rotation(&mut rng)),
            translation: 0.8 * shape::random_vector(&mut rng).clamp_length_max(1.0),
        };
        let mut tally = Tally::default();
        let inside = Scene {
            a: &large,
            b: &small,
            b_to_a,
            gap: 0.0,
        };
        tally.add(
            &inside,
            oracle.separation(&inside.pair(), &mut Cache::default()),
        );
        let frame = Frame {
            rotation: b_to_a.rotation.transpose(),
            translation: -(b_to_a.rotation.transpose() * b_to_a.translation),
        };
        let around = Scene {
            a: &small,
            b: &large,
            b_to_a: frame,
            gap: 0.0,
        };
        tally.add(
            &around,
            oracle.separation(&around.pair(), &mut Cache::default()),
        );
        assert_eq!((tally.intersecting_pair_count, tally.give_up_count), (2, 0));
    }
    assert_eq!(oracle.counters().penetrations, 1000);
}

fn query_three_times(oracle: &mut Vmarch, scene: &Scene<'_>, cache: &mut Cache) {
    for _ in 0..3 {
        if let Ok(claim) = oracle.separation(&scene.pair(), cache) {
            for (named, body) in [(claim.a, scene.a), (claim.b, scene.b)] {
                let known = |&k: &u32| (k as usize) < body.shape.points.len();
                assert!(named.point_indices().iter().all(known), "{claim:?}");
            }
        }
    }
}

/// Tests that marches end for coordinates of very different magnitudes, and that claims name existing points.
#[test]
fn odd_coordinates_end() {
    const EXTREME_VALUES: [f64; 7] = [0.0, -0.0, 1.0, 1e-300, 1e11, -1e11, f64::MIN_POSITIVE];
    let mut rng = Pcg64::seed_from_u64(4);
    let mut point = || {
        DVec3::from_array(std::array::from_fn(|_| {
            EXTREME_VALUES[rng.random_range(0..7)]
        }))
    };
    let mut oracle = Vmarch::default();
    for k in 0..case_count() {
        let [a, b] = [1 + k as usize % 3, 3].map(|count| {
            let points: Vec<DVec3> = (0..count).map(|_| point()).collect();
            Body::new(shape::shape_of_points(&points))
        });
        for b in [&a, &b] {
            let b_to_a = Frame {
                translation: point(),
                ..Frame::IDENTITY
            };
            let scene = Scene {
                a: &a,
                b,
                b_to_a,
                gap: 0.0,
            };
            query_three_times(&mut oracle, &scene, &mut Cache::default());
        }
    }
}

/// Tests that degenerate frames and empty pieces do not make a march hang or fail.
#[test]
fn nonsense_ends() {
    let shapes = [
        shape::cuboid(DVec3::ONE),
        shape::polygon(5),
        shape::shape_of_points(&[DVec3::ZERO]),
        shape::shape_of_points(&[DVec3::X, DVec3::Y]),
        Shape {
            loops: Vec::new(),
            ..shape::cuboid(DVec3::ONE)
        },
    ];
    let bodies = shapes.map(Body::new);
    let (mut oracle, mut cache) = (Vmarch::default(), Cache::default());
    for a in &bodies {
        for b in &bodies {
            for wrong in [0.0, f64::NAN, f64::INFINITY, 1e300, 1e-300] {
                let b_to_a = Frame {
                    translation: DVec3::new(wrong, 0.0, -wrong),
                    rotation: wrong * DMat3::IDENTITY,
                };
                let scene = Scene {
                    a,
                    b,
                    b_to_a,
                    gap: 0.0,
                };
                query_three_times(&mut oracle, &scene, &mut cache);
            }
        }
    }
    let nothing = Piece::from_points(&[]);
    let pair = PiecePair {
        a: nothing,
        b: nothing,
        b_to_a: Frame::IDENTITY,
    };
    assert_eq!(
        oracle.separation(&pair, &mut cache),
        Err(GiveUpReason::BadFacets)
    );
}

/// Tests that the distance of a tessellated ball that spins over a plate is that of the ball's lowest corner.
#[test]
fn spinning_balls_are_as_near_as_their_lowest_corner() {
    let (ball, plate) = (
        shape::uv_sphere(19, 26),
        shape::cuboid(DVec3::new(3.0, 3.0, 0.1)),
    );
    let (ball, plate) = (Body::new(ball), Body::new(plate));
    let (mut oracle, mut cache) = (Vmarch::default(), Cache::default());
    for k in 0..2_000 {
        let turn = DQuat::from_scaled_axis(f64::from(k) * 0.01 * DVec3::new(0.6, 0.3, 0.2));
        let b_to_a = Frame {
            rotation: DMat3::from_quat(turn),
            translation: DVec3::new(0.1, 0.2, 1.5),
        };
        let scene = Scene {
            a: &plate,
            b: &ball,
            b_to_a,
            gap: 0.1,
        };
        let claim = oracle
            .separation(&scene.pair(), &mut cache)
            .expect("no give-up");
        let low = ball
            .shape
            .points
            .iter()
            .map(|p| b_to_a.transform_point(*p).z)
            .fold(f64::MAX, lesser);
        let on_a = claim.a.position(&plate.shape.points).expect("a point of A");
        let on_b =
            b_to_a.transform_point(claim.b.position(&ball.shape.points).expect("a point of B"));
        assert!((on_a.distance(on_b) - (low - 0.1)).abs() < 1e-15);
    }
    let counters = oracle.counters();
    assert!(counters.steps < 4 * counters.calls, "{counters:?}");
}

/// Tests that distances stay accurate at displacements where the nearest features of two cubes change. Bisection finds
/// such a displacement, until the last bit decides: V-Clip's own hardest test.
#[test]
fn changes_of_features_are_exact_to_the_last_bit() {
    let mut rng = Pcg64::seed_from_u64(8);
    let cube = Body::new(shape::cuboid(DVec3::ONE));
    let (mut oracle, mut tally) = (Vmarch::default(), Tally::default());
    for _ in 0..case_count() / 4 {
        let tilt = DQuat::from_scaled_axis(
            random_magnitude(&mut rng, -12.0, 0.0) * random_direction(&mut rng),
        );
        let pose = |offset: DVec3| Frame {
            rotation: DMat3::from_quat(tilt),
            translation: offset,
        };
        let far = |rng: &mut Pcg64| 4.0 * random_direction(rng);
        let (mut from, mut to) = (far(&mut rng), far(&mut rng));
        let mut ask = |offset: DVec3, cache: &mut Cache| {
            let scene = Scene {
                a: &cube,
                b: &cube,
                b_to_a: pose(offset),
                gap: 0.1,
            };
            let answer = oracle.separation(&scene.pair(), cache);
            tally.add(&scene, answer);
        };
        let (mut at_from, mut at_to) = (Cache::default(), Cache::default());
        ask(from, &mut at_from);
        ask(to, &mut at_to);
        for _ in 0..60 {
            let middle = 0.5 * (from + to);
            // Cubes of this size may meet halfway.
            if at_from == at_to || middle.length() < 3.9 {
                break;
            }
            let mut at_middle = at_from;
            ask(middle, &mut at_middle);
            if at_middle == at_from {
                from = middle;
            } else {
                (to, at_to) = (middle, at_middle);
            }
        }
    }
    assert!(
        tally.claim_count > case_count() && tally.give_up_count == 0,
        "{tally:?}"
    );
}

/// Tests that the claimed combinations are the same bits if both pieces are scaled by a power of two.
#[test]
fn size_does_not_matter() {
    let mut rng = Pcg64::seed_from_u64(6);
    for kind in [
        PairKind::Random,
        PairKind::Coplanar,
        PairKind::Sliver,
        PairKind::Flat,
    ] {
        let pool = scene::body_pool(kind, &mut rng);
        for _ in 0..300 {
            let scene = scene::draw(kind, &pool, &mut rng);
            let power = [-150, -40, 30][(random_magnitude(&mut rng, 0.0, 1.0) as usize) % 3];
            let scale = 2f64.powi(power);
            let [a, b] = [scene.a, scene.b]
                .map(|body| Body::new(body.shape.clone().with_mapped_points(|p| scale * p)));
            let mut b_to_a = scene.b_to_a;
            b_to_a.translation *= scale;
            let scaled = Scene {
                a: &a,
                b: &b,
                b_to_a,
                gap: 0.0,
            };
            let [one, other] = [&scene, &scaled].map(|scene| {
                let claim = Vmarch::default().separation(&scene.pair(), &mut Cache::default());
                claim.unwrap_or_else(|why| panic!("{why:?}"))
            });
            assert_eq!((one.a, one.b), (other.a, other.b), "2^{power}");
        }
    }
}

/// Tests that moving both pieces far from the origin adds only the rounding errors of their coordinates.
#[test]
fn place_does_not_matter() {
    let mut rng = Pcg64::seed_from_u64(7);
    let pool = scene::body_pool(PairKind::Random, &mut rng);
    for _ in 0..500 {
        let scene = scene::draw(PairKind::Random, &pool, &mut rng);
        let shift = 1e6 * shape::random_vector(&mut rng);
        let [a, b] = [scene.a, scene.b]
            .map(|body| Body::new(body.shape.clone().with_mapped_points(|p| p + shift)));
        let mut b_to_a = scene.b_to_a;
        b_to_a.translation += shift - b_to_a.rotation * shift;
        let far = Scene {
            a: &a,
            b: &b,
            b_to_a,
            gap: scene.gap,
        };
        let mut tally = Tally::default();
        tally.add(
            &far,
            Vmarch::default().separation(&far.pair(), &mut Cache::default()),
        );
        assert_eq!(tally.give_up_count, 0);
    }
}

/// Tests that a second oracle answers where the march gives up, and that calls, steps and fallbacks are counted.
#[test]
fn other_oracles_take_over_and_counts_are_kept() {
    /// An oracle that always claims the first points of both pieces as witnesses.
    struct FirstPointsOracle;
    impl DistanceOracle for FirstPointsOracle {
        type Cache = ();
        fn separation(&mut self, _: &PiecePair<'_>, (): &mut ()) -> Result<Claim, GiveUpReason> {
            Ok(Claim {
                axis: DVec3::X,
                a: ConvexCombination::from_single_point(0),
                b: ConvexCombination::from_single_point(0),
            })
        }
    }
    let cube = shape::cuboid(DVec3::ONE);
    let bare = Shape {
        loops: Vec::new(),
        ..cube.clone()
    };
    let (cube, bare) = (Body::new(cube), Body::new(bare));
    let scene = |b| Scene {
        a: &cube,
        b,
        b_to_a: Frame {
            translation: DVec3::new(3.0, 0.2, 0.1),
            ..Frame::IDENTITY
        },
        gap: 1.0,
    };
    let (known, unknown) = (scene(&cube), scene(&bare));
    let mut alone = Vmarch::default();
    let refused = alone.separation(&unknown.pair(), &mut Cache::default());
    assert_eq!(refused, Err(GiveUpReason::BadFacets));
    let mut oracle = Vmarch::default().or_else(FirstPointsOracle);
    let mut cache = Default::default();
    for (scene, fallbacks) in [(&known, 0), (&unknown, 1), (&known, 1), (&unknown, 2)] {
        assert!(oracle.separation(&scene.pair(), &mut cache).is_ok());
        assert_eq!(oracle.fallbacks(), fallbacks);
    }
    assert!(oracle.effort().steps >= 2 && oracle.effort().fallbacks == 2);
    let mut counted = Vmarch::default();
    let mut cache = Cache::default();
    for calls in 1..5 {
        assert!(counted.separation(&known.pair(), &mut cache).is_ok());
        assert_eq!(counted.counters().calls, calls);
    }
    assert_eq!(counted.effort().steps, counted.counters().steps);
    // A converged cache does not change.
    let before = counted.counters().steps;
    assert!(counted.separation(&known.pair(), &mut cache).is_ok());
    assert_eq!(counted.counters().steps, before + 1);
}

/// Tests that the same call gives the same bits, independent of earlier calls.
#[test]
fn answers_repeat() {
    let mut rng = Pcg64::seed_from_u64(12);
    let pool = scene::body_pool(PairKind::Coplanar, &mut rng);
    let mut used = Vmarch::default();
    for _ in 0..500 {
        let scene = scene::draw(PairKind::Coplanar, &pool, &mut rng);
        let fresh = Vmarch::default().separation(&scene.pair(), &mut Cache::default());
        assert_eq!(used.separation(&scene.pair(), &mut Cache::default()), fresh);
    }
}
