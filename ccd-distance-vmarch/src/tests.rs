//! Compares claims about pairs of every kind with brute force, for empty caches, warm caches, and caches of other
//! pairs.
//!
//! To print the results: `CCD_TEST_SLOW=1 cargo test --release -p ccd-distance-vmarch agrees --
//! --nocapture`.

mod laws;
pub(crate) mod scene;
pub(crate) mod setting;
pub(crate) mod shape;
mod touching;
pub(crate) mod twin;

use crate::{Cache, Vmarch};
use ccd_core::glam::{DMat3, DQuat, DVec3};
use ccd_core::order::{greater, lesser};
use ccd_core::{Body, Claim, DistanceOracle, Frame, GiveUpReason, PiecePair};
use rstest::rstest;
use scene::{PairKind, Scene};
use shape::{Pcg64, SeedableRng, random_direction, random_magnitude};
use twin::ReferencePolytope;

/// Returns the number of scenes of each kind. `CCD_TEST_CASES` in the environment multiplies it, `CCD_TEST_SLOW` makes
/// it a million claims over all kinds.
fn case_count() -> u64 {
    let given = std::env::var("CCD_TEST_CASES").ok();
    let times: u64 = given.and_then(|text| text.parse().ok()).unwrap_or(1);
    match std::env::var_os("CCD_TEST_SLOW") {
        Some(_) => 40_000 * times,
        None => 600 * times,
    }
}

/// A summary of the claims about one kind of pair.
#[derive(Debug, Default)]
struct Tally {
    claim_count: u64,
    intersecting_pair_count: u64,
    give_up_count: u64,
    /// The largest relative error of a distance, among distances above a thousandth of the scene's reach.
    max_relative_error: f64,
    /// The largest error of a distance, in units of the unit roundoff times the scene's reach.
    max_rounding_error: f64,
    /// The largest excess of the distance over the support gap along the claimed axis, in the unit of `max_rounding_error`.
    max_gap_deficit: f64,
    /// The largest distance between the claimed witnesses of intersecting pieces, in the unit of `max_rounding_error`.
    max_intersecting_witness_distance: f64,
}

/// The largest relative rounding error of one operation in f64.
const UNIT_ROUNDOFF: f64 = f64::EPSILON / 2.0;

impl Tally {
    fn add(&mut self, scene: &Scene<'_>, answer: Result<Claim, GiveUpReason>) {
        let claim = match answer {
            Ok(claim) => claim,
            Err(_) => {
                self.give_up_count += 1;
                return;
            }
        };
        self.claim_count += 1;
        let place = |p: DVec3| scene.b_to_a.transform_point(p);
        let on_a = claim
            .a
            .position(&scene.a.shape.points)
            .expect("a point of A");
        let on_b = claim
            .b
            .position(&scene.b.shape.points)
            .map(place)
            .expect("a point of B");
        let distance = on_a.distance(on_b);
        let unit = UNIT_ROUNDOFF * scene.reach();
        if scene.gap == 0.0 {
            self.intersecting_pair_count += 1;
            self.max_intersecting_witness_distance =
                greater(self.max_intersecting_witness_distance, distance / unit);
            assert!(
                distance <= 200.0 * unit,
                "{distance:e}: {}",
                describe_claim(scene, &claim)
            );
            return;
        }
        let a = ReferencePolytope::new(&scene.a.shape, &Frame::IDENTITY);
        let b = ReferencePolytope::new(&scene.b.shape, &scene.b_to_a);
        let truth = twin::distance(&a, &b);
        let error = (distance - truth).abs();
        let gap = twin::gap(&a, &b, claim.axis.normalize_or_zero());
        let slack = 1e-12 * truth + 100.0 * unit;
        self.max_rounding_error = greater(self.max_rounding_error, error / unit);
        self.max_gap_deficit = greater(self.max_gap_deficit, (truth - gap) / unit);
        if truth > 1e-3 * scene.reach() {
            self.max_relative_error = greater(self.max_relative_error, error / truth);
        }
        assert!(
            error <= slack,
            "{distance:e}, not {truth:e}: {}",
            describe_claim(scene, &claim)
        );
        assert!(
            gap >= truth - slack,
            "gap {gap:e} of {truth:e}: {}",
            describe_claim(scene, &claim)
        );
    }
}

fn describe_claim(scene: &Scene<'_>, claim: &Claim) -> String {
    let (a, b, frame) = (&scene.a.shape, &scene.b.shape, scene.b_to_a);
    format!("{claim:?} of {a:?}, {b:?}, {frame:?}")
}

/// Moves the scene to the next pose of a coherent sequence.
fn move_to_next_pose(scene: &mut Scene<'_>, rng: &mut Pcg64) {
    let step = lesser(random_magnitude(rng, -16.0, -2.0), 0.01 * scene.gap);
    scene.gap -= 8.0 * step;
    let turn = DQuat::from_scaled_axis(step * random_direction(rng));
    let about = scene.b_to_a.transform_point(scene.b.shape.points[0]);
    let frame = &mut scene.b_to_a;
    frame.rotation = ccd_core::glam::DMat3::from_quat(turn) * frame.rotation;
    frame.translation = about + turn * (frame.translation - about) + step * random_direction(rng);
}

#[rstest]
#[allow(
    clippy::print_stdout,
    reason = "the figures of a long run are to be read"
)]
fn agrees_with_brute_force(
    #[values(
        PairKind::Random,
        PairKind::NearParallel,
        PairKind::Coplanar,
        PairKind::Sliver,
        PairKind::Grid,
        PairKind::Plates,
        PairKind::Prisms,
        PairKind::Balls,
        PairKind::FewPoints,
        PairKind::Flat
    )]
    kind: PairKind,
) {
    let mut rng = Pcg64::seed_from_u64(kind as u64);
    let pool = scene::body_pool(kind, &mut rng);
    let (mut oracle, mut tally, mut foreign) =
        (Vmarch::default(), Tally::default(), Cache::default());
    // Those of a thousand corners take brute force a while.
    let cases = if kind == PairKind::Balls {
        case_count() / 10
    } else {
        case_count()
    };
    for _ in 0..cases {
        let mut scene = scene::draw(kind, &pool, &mut rng);
        let mut cache = Cache::default();
        tally.add(&scene, oracle.separation(&scene.pair(), &mut cache));
        tally.add(&scene, oracle.separation(&scene.pair(), &mut foreign));
        if scene.gap > 0.0 {
            move_to_next_pose(&mut scene, &mut rng);
            tally.add(&scene, oracle.separation(&scene.pair(), &mut cache));
        }
    }
    report(kind, &tally, oracle);
    assert!(
        tally.give_up_count * 10_000 <= tally.claim_count,
        "{tally:?}"
    );
}

#[allow(
    clippy::print_stdout,
    reason = "the figures of a long run are to be read"
)]
fn report(kind: PairKind, tally: &Tally, oracle: Vmarch) {
    let counters = oracle.counters();
    let steps = counters.steps as f64 / counters.calls as f64;
    println!("{kind:?}: {tally:?}, {steps:.2} steps, {counters:?}");
}

#[test]
fn claims_are_the_same_bits_for_prepared_bodies() {
    let mut rng = Pcg64::seed_from_u64(31);
    let fresh = Body::cuboid([1.0, 0.5, 0.25]).expect("a box");
    let prepared = fresh.clone();
    Vmarch::prepare(&prepared);
    for _ in 0..200 {
        let translation = random_magnitude(&mut rng, -1.0, 1.0) * random_direction(&mut rng);
        let turn = DQuat::from_rotation_arc(DVec3::Z, random_direction(&mut rng));
        let b_to_a = Frame {
            translation,
            rotation: DMat3::from_quat(turn),
        };
        // A copy starts from nothing.
        let claims = [&fresh.clone(), &prepared].map(|body| {
            let piece = body.pieces().get(0);
            let pair = PiecePair {
                a: piece,
                b: piece,
                b_to_a,
            };
            let mut oracle = Vmarch::default();
            let claim = oracle.separation(&pair, &mut Cache::default());
            (claim, oracle.counters())
        });
        assert_eq!(claims[0], claims[1]);
    }
}
