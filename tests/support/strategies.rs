//! Generates random cases: shapes, poses and motions such that hits, misses and overlaps all occur.

use crate::case::{Case, Model, MovingModel, StartPolicyText};
use ccd_core::glam::{DQuat, DVec3};
use proptest::prelude::*;
use proptest::test_runner::{RngSeed, TestRunner};
use rand_pcg::Pcg64;
use std::f64::consts::{PI, TAU};

/// Returns a test runner for `cases` cases, multiplied by the variable `CCD_TEST_CASES` if that is set.
///
/// The cases are always the same, unless `CCD_TEST_SEED` gives another seed.
pub fn runner(cases: u32) -> TestRunner {
    TestRunner::new(ProptestConfig {
        cases: cases * number_from_env("CCD_TEST_CASES", 1),
        rng_seed: RngSeed::Fixed(u64::from(number_from_env("CCD_TEST_SEED", 0))),
        failure_persistence: None,
        max_shrink_iters: 2_000,
        ..ProptestConfig::default()
    })
}

/// Returns the seeds of `cases` draws, multiplied by the variable `CCD_TEST_CASES`; the seeds depend on
/// `CCD_TEST_SEED`.
pub fn seeds(cases: u32) -> std::ops::Range<u64> {
    let first = u64::from(number_from_env("CCD_TEST_SEED", 0)) << 32;
    first..first + u64::from(cases) * u64::from(number_from_env("CCD_TEST_CASES", 1))
}

fn number_from_env(name: &str, default: u32) -> u32 {
    std::env::var(name)
        .ok()
        .and_then(|text| text.parse().ok())
        .unwrap_or(default)
}

/// Runs a check `law` on `cases` random cases drawn from `strategy`. A failure prints the shrunk case in the format of
/// the corpus.
///
/// # Panics
/// If the check fails for a case.
pub fn check_cases(
    cases: u32,
    strategy: impl Strategy<Value = Case>,
    law: impl Fn(&Case) -> Result<(), String>,
) {
    let result = runner(cases).run(&strategy, |case| {
        law(&case).map_err(|why| TestCaseError::fail(format!("{why}\n{}", case.to_toml())))
    });
    if let Err(error) = result {
        panic!("{error}");
    }
}

/// Generates two bodies of size about 1 that start a few units apart and are aimed at each other. Each may move and
/// rotate, up to three turns.
pub fn cases() -> impl Strategy<Value = Case> {
    aimed_cases(model(), model())
}

/// Generates [`cases`] with convex shapes only.
pub fn convex_cases() -> impl Strategy<Value = Case> {
    aimed_cases(convex_model(), convex_model())
}

/// Generates [`cases`] of very small to very large size, some of them far from the origin.
pub fn scaled_and_remote_cases() -> impl Strategy<Value = Case> {
    (
        cases(),
        -6.0..6.0f64,
        prop_oneof![Just(0.0), 1.0..6.0f64],
        direction(),
    )
        .prop_map(|(mut case, scale, offset, towards)| {
            let scale = 10.0f64.powf(scale);
            case.tolerance *= scale;
            // Offsets are relative to the size, since that costs digits.
            let offset = if offset > 0.0 {
                10.0f64.powf(offset)
            } else {
                0.0
            };
            for part in [&mut case.a, &mut case.b] {
                part.scale *= scale;
                let position = DVec3::from(part.position) + offset * towards;
                part.position = (scale * position).into();
                part.velocity = (scale * DVec3::from(part.velocity)).into();
                part.center = (scale * DVec3::from(part.center)).into();
            }
            case
        })
}

/// Generates [`cases`] so close together that many overlap at the start.
pub fn crowded_cases() -> impl Strategy<Value = Case> {
    (cases(), 0.0..0.4f64).prop_map(|(mut case, nearer)| {
        case.b.position = (nearer * DVec3::from(case.b.position)).into();
        case
    })
}

fn aimed_cases(
    a: impl Strategy<Value = Model>,
    b: impl Strategy<Value = Model>,
) -> impl Strategy<Value = Case> {
    let tolerance = prop_oneof![Just(1e-3), Just(1e-6)];
    let aim = (
        direction(),
        1.5..3.5f64,
        direction(),
        0.0..1.2f64,
        0.3..1.5f64,
    );
    (moving_model(a), moving_model(b), aim, tolerance, drift()).prop_map(
        |(a, mut b, aim, tolerance, drift)| {
            let (towards, apart, side, miss, haste) = aim;
            let position = apart * towards;
            // From the start of B to a point that misses A's center by up to `miss`.
            let travel = haste * (miss * side - position);
            b.position = position.into();
            let mut case = Case {
                name: String::new(),
                why: String::new(),
                duration: 1.0,
                tolerance,
                margin: 0.0,
                start: StartPolicyText::Report,
                a,
                b,
            };
            assign_velocity(&mut case, travel, drift);
            case
        },
    )
}

/// Gives the relative velocity to B, to A, or to B in addition to a common velocity along `drift`.
fn assign_velocity(case: &mut Case, travel: DVec3, drift: Option<DVec3>) {
    match drift {
        None => case.b.velocity = travel.into(),
        Some(drift) if drift.x > 0.0 => case.a.velocity = (-travel).into(),
        Some(drift) => {
            case.a.velocity = (10.0 * drift).into();
            case.b.velocity = (10.0 * drift + travel).into();
        }
    }
}

fn drift() -> impl Strategy<Value = Option<DVec3>> {
    prop_oneof![Just(None), direction().prop_map(Some)]
}

fn moving_model(model: impl Strategy<Value = Model>) -> impl Strategy<Value = MovingModel> {
    (model, vector_up_to_length(PI), spin(), center()).prop_map(|(shape, turned, spin, center)| {
        MovingModel {
            turned: turned.into(),
            spin: spin.into(),
            center: center.into(),
            ..MovingModel::new(shape)
        }
    })
}

/// Generates an angular velocity: zero, tiny, up to half a turn, or up to three turns per unit of time.
fn spin() -> impl Strategy<Value = DVec3> {
    prop_oneof![
        2 => Just(DVec3::ZERO),
        3 => vector_up_to_length(PI),
        1 => vector_up_to_length(3.0 * TAU),
        1 => vector_up_to_length(1e-6),
    ]
}

fn center() -> impl Strategy<Value = DVec3> {
    prop_oneof![2 => Just(DVec3::ZERO), 1 => vector_up_to_length(1.0)]
}

/// Generates a vector of length up to `most`, in any direction.
fn vector_up_to_length(most: f64) -> impl Strategy<Value = DVec3> {
    (direction(), 0.0..=most).prop_map(|(n, length)| length * n)
}

/// Generates a unit vector. The coordinate axes occur more often.
pub fn direction() -> impl Strategy<Value = DVec3> {
    let any = (-1.0..1.0f64, 0.0..TAU).prop_map(|(z, angle)| {
        let r = (1.0 - z * z).sqrt();
        DVec3::new(r * angle.cos(), r * angle.sin(), z)
    });
    prop_oneof![4 => any, 1 => prop::sample::select(&DVec3::AXES[..])]
}

/// Returns a random unit vector, uniformly distributed.
pub fn random_direction(rng: &mut Pcg64) -> DVec3 {
    loop {
        let v = DVec3::from_array([(); 3].map(|()| rng.random_range(-1.0..1.0)));
        if (0.1..1.0).contains(&v.length()) {
            return v.normalize();
        }
    }
}

/// Generates a rotation about a random axis by up to half a turn.
pub fn rotation() -> impl Strategy<Value = DQuat> {
    vector_up_to_length(PI).prop_map(DQuat::from_scaled_axis)
}

/// Generates a half extent between 0.05 and 1, uniformly on a logarithmic scale.
fn half_extent() -> impl Strategy<Value = f64> {
    (-1.3..0.0f64).prop_map(|x| 10.0f64.powf(x))
}

/// Generates a convex shape of size at most about 1.
pub fn convex_model() -> impl Strategy<Value = Model> {
    let extents = || [half_extent(), half_extent(), half_extent()];
    prop_oneof![
        2 => extents().prop_map(|half| Model::Cuboid { half }),
        1 => (extents(), 0..2u32).prop_map(|(radii, levels)| Model::Ellipsoid { radii, levels }),
    ]
}

/// Generates any shape of size at most about 1, with at most about 100 triangles.
pub fn model() -> impl Strategy<Value = Model> {
    let ring =
        (4..9usize, 3..6usize, 0.05..0.3f64).prop_map(|(rings, sides, minor)| Model::Torus {
            major: 0.6,
            minor,
            rings,
            sides,
        });
    prop_oneof![
        3 => convex_model(),
        1 => ring,
        1 => Just(Model::LPrism),
        1 => Just(Model::UHook),
        3 => nonconvex_model(),
        1 => prop::collection::vec(triangle(), 1..24).prop_map(|triangles| Model::Soup { triangles }),
        1 => (1..12usize, -9.0..-1.0f64)
            .prop_map(|(count, width)| Model::Needles { count, width: 10.0f64.powf(width) }),
    ]
}

/// Generates a non-convex solid.
fn nonconvex_model() -> impl Strategy<Value = Model> {
    prop_oneof![
        1 => (0.2..0.6f64, 0.1..0.9f64)
            .prop_map(|(half, deep)| Model::DentedCube { half, depth: 2.0 * half * deep }),
        1 => (0.3..0.7f64, 0.3..0.9f64)
            .prop_map(|(half, thin)| Model::HollowCube { half, cavity: half * thin }),
        2 => (0..2u32, 0.0..0.6f64, any::<u32>()).prop_map(|(levels, roughness, seed)| {
            Model::Boulder { levels, roughness, seed }
        }),
        1 => (1..4usize, any::<u32>()).prop_map(|(size, seed)| Model::Pile { size, seed }),
    ]
}

/// Generates small and large triangles, some of them degenerate to a segment or a point.
fn triangle() -> impl Strategy<Value = [[f64; 3]; 3]> {
    let point = || prop::array::uniform3(-0.7..0.7f64);
    let size = prop_oneof![Just(0.05), Just(0.4), Just(1.0)];
    (point(), point(), point(), size, 0..20u32).prop_map(|(a, b, c, size, which)| {
        let near = |p: [f64; 3]| (DVec3::from(a) + size * DVec3::from(p)).into();
        match which {
            0 => [a, a, a],
            1 => [a, near(b), a],
            _ => [a, near(b), near(c)],
        }
    })
}
