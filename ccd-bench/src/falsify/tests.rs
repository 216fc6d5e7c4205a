use super::aim::FAILURE;
use super::examiner::Examined;
use super::shrink::shrink;
use super::space::{draw, neighbour};
use super::*;
use crate::method::guarded::Asked;
use crate::method::solver::{Claim, Reply};
use crate::run::contest::{Judged, Verdict};
use crate::truth::{Referee, Surface, Truth};
use ccd_core::glam::{DVec3, dvec3};
use rand::SeedableRng;
use rand_pcg::Pcg64;
use rstest::rstest;

fn drawn(count: u64) -> Vec<Attempt> {
    let draw = |seed| draw(&mut Pcg64::seed_from_u64(seed)).unwrap();
    (0..count).map(draw).collect()
}

fn truth(attempt: &Attempt) -> Truth {
    let [a, b] = attempt.meshes().unwrap().map(|mesh| Surface::new(&mesh));
    let query = attempt.query().unwrap();
    Referee::new(&a, &b).within(300_000).first_contact(&query)
}

#[test]
fn draws_hit_and_miss() {
    let truths: Vec<Truth> = drawn(200).iter().map(truth).collect();
    let hits = truths.iter().filter(|t| matches!(t, Truth::Hit { .. }));
    let free = truths.iter().filter(|t| matches!(t, Truth::Free));
    let (hits, free) = (hits.count(), free.count());
    assert!(hits > 60 && free > 10, "{hits} hits, {free} free");
}

#[test]
fn neighbours_differ_and_most_are_valid() {
    let mut rng = Pcg64::seed_from_u64(1);
    let mut valid = 0;
    for attempt in drawn(500) {
        let next = neighbour(&mut rng, &attempt);
        valid += usize::from(next != attempt && next.meshes().is_ok() && next.query().is_ok());
    }
    assert!(valid > 400, "{valid} of 500");
}

#[test]
fn other_views_of_an_attempt_have_the_same_answer() {
    let mut hits = 0;
    for attempt in drawn(60) {
        let Truth::Hit { lo, .. } = truth(&attempt) else {
            continue;
        };
        for view in [attempt.seen_from_b(), attempt.unturned()] {
            let Truth::Hit { lo: same, .. } = truth(&view) else {
                panic!("{:?}", truth(&view))
            };
            assert!((lo - same).abs() < 1e-9, "{lo} {same}");
        }
        hits += 1;
    }
    assert!(hits > 15, "{hits}");
}

#[test]
fn bodies_lose_unused_vertices() {
    let [mut body, _] = drawn(1).remove(0).bodies;
    body.vertices = vec![DVec3::X, DVec3::ZERO, DVec3::Y, DVec3::Z];
    body.faces = vec![[3, 1, 2]];
    body.compact();
    assert_eq!(body.vertices, [DVec3::Z, DVec3::ZERO, DVec3::Y]);
    assert_eq!(body.faces, [[0, 1, 2]]);
}

#[test]
fn only_what_a_failure_needs_is_left() {
    let fast = |attempt: &Attempt| attempt.bodies[0].motion.velocity.x > 2.5;
    let mut shrunk = 0;
    for attempt in drawn(100).into_iter().filter(fast) {
        let small = shrink(attempt, 4_000, |attempt| Ok(fast(attempt))).unwrap();
        assert_eq!((small.triangles(), small.flat_faces()), (2, 0));
        let [a, b] = small.bodies;
        assert_eq!(b.motion, Course::default());
        assert!(!format!("{:e}", a.motion.velocity.x).contains('.'));
        assert_eq!(a.motion.velocity.y, 0.0);
        shrunk += 1;
    }
    assert!(shrunk > 20, "{shrunk}");
}

#[test]
fn shrinking_ends_at_its_limit() {
    let mut tries = 0;
    let attempt = drawn(1).remove(0);
    let same = shrink(attempt.clone(), 10, |_| {
        tries += 1;
        Ok(false)
    });
    assert_eq!(same.unwrap(), attempt);
    // Two other views come before the limit counts.
    assert_eq!(tries, 12);
}

fn examined(claim: Claim, truth: Truth, ratio: Option<f64>, verdict: Verdict) -> Examined {
    Examined {
        asked: Asked::Answered {
            reply: Reply::new(claim, 10),
            micros: 1.0,
        },
        truth,
        judged: Judged::plain(verdict),
        duration: 1.0,
        ratio,
    }
}

const HIT: Truth = Truth::Hit { lo: 0.4, hi: 0.5 };

#[rstest]
#[case(Aim::Late, Claim::Contact { time: 0.6 }, Some(0.0), Verdict::Late, 1.1)]
#[case(Aim::Late, Claim::Free, None, Verdict::Missed, 1.5)]
#[case(Aim::Late, Claim::Unresolved { safe_until: 0.7 }, None, Verdict::Late, 1.2)]
#[case(Aim::Late, Claim::Contact { time: 0.4 }, Some(0.25), Verdict::Right, 0.75)]
#[case(Aim::Early, Claim::Contact { time: 0.1 }, Some(3.0), Verdict::Early, 3.0)]
#[case(Aim::Early, Claim::Contact { time: 0.4 }, Some(0.5), Verdict::Right, 0.5)]
fn worse_answers_score_more(
    #[case] aim: Aim,
    #[case] claim: Claim,
    #[case] ratio: Option<f64>,
    #[case] verdict: Verdict,
    #[case] score: f64,
) {
    let examined = examined(claim, HIT, ratio, verdict);
    assert!((aim.score(&examined) - score).abs() < 1e-12);
    assert_eq!(aim.is_met(&examined), score > FAILURE);
    assert!(!Aim::Stuck.is_met(&examined) && Aim::Stuck.score(&examined) < FAILURE);
}

#[test]
fn a_query_without_an_end_is_the_worst() {
    let stuck = Examined {
        asked: Asked::CutOff,
        ..examined(Claim::Free, Truth::Free, None, Verdict::CutOff)
    };
    assert!(Aim::Stuck.is_met(&stuck) && Aim::Stuck.score(&stuck) > FAILURE);
    assert!(!Aim::Late.is_met(&stuck) && Aim::Late.score(&stuck) < 0.0);
}

#[test]
fn all_numbers_can_be_changed() {
    let mut attempt = drawn(1).remove(0);
    let vertices: usize = attempt.bodies.iter().map(|body| body.vertices.len()).sum();
    let numbers = attempt.numbers();
    assert_eq!(numbers.len(), 3 * (vertices + 10));
    for number in numbers {
        *number = 2.0;
    }
    let of_a = &attempt.bodies[0];
    assert_eq!(of_a.motion.spin, dvec3(2.0, 2.0, 2.0));
    assert_eq!(of_a.vertices[0], DVec3::splat(2.0));
}
