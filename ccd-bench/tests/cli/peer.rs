//! Tests that a guard stops a peer program that hangs, and restarts a peer program that has died.

use ccd_bench::method::Method;
use ccd_bench::method::guarded::{GuardedMethod, GuardedMethodSettings, QueryOutcome};
use ccd_bench::method::peer::PeerKind;
use ccd_bench::method::solver::{ContactClaim, TimedReply};
use ccd_bench::scene::model::cuboid;
use ccd_core::glam::DVec3;
use ccd_core::{Motion, Pose};
use ccd_decomp::TriangleMesh;
use ccd_tables::motions::Motions;
use std::io::ErrorKind;
#[cfg(unix)]
use std::path::Path;
use std::time::{Duration, Instant};

/// A time limit that no query in these tests reaches.
const QUERY_TIME_LIMIT: Duration = Duration::from_secs(60);

fn cube() -> TriangleMesh {
    cuboid(0.5, 0.5, 0.5).unwrap()
}

/// Returns a query in which a cube falls at speed 4 onto another cube across a gap of 2.
fn falling_cube_query() -> Motions {
    let above = Pose::at(3.0 * DVec3::Z).unwrap();
    Motions {
        id: "drop".into(),
        a: Motion::new(above, -4.0 * DVec3::Z, DVec3::ZERO).unwrap(),
        b: Motion::still(Pose::IDENTITY),
        duration: 1.0,
    }
}

fn guarded_peer(kind: PeerKind) -> GuardedMethod {
    guarded_method(GuardedMethodSettings::new(Method::Peer(kind), 1e-3))
}

fn guarded_method(setting: GuardedMethodSettings) -> GuardedMethod {
    GuardedMethod::with_program(crate::PROGRAM_PATH.into(), setting, [&cube(), &cube()]).unwrap()
}

/// Returns a guarded method whose program is replaced by a script of this folder.
#[cfg(unix)]
fn guarded_script(script: &str) -> GuardedMethod {
    let script = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/cli")
        .join(script);
    let setting = GuardedMethodSettings::new(Method::Peer(PeerKind::ParryF64), 1e-3);
    GuardedMethod::with_program(script, setting, [&cube(), &cube()]).unwrap()
}

fn assert_contact_at_half(outcome: QueryOutcome) {
    let QueryOutcome::Answered(TimedReply { reply, micros }) = outcome else {
        panic!("{outcome:?}");
    };
    let ContactClaim::Contact { time } = reply.claim else {
        panic!("{reply:?}");
    };
    assert!((-2.6e-4..=1e-6).contains(&(time - 0.5)), "{time}");
    assert!(micros > 0.0);
}

#[test]
fn every_method_answers_behind_a_guard() {
    let is_script = |method: &Method| matches!(method, Method::Script(_));
    for method in Method::known_methods()
        .into_iter()
        .filter(|method| !is_script(method))
    {
        let mut guarded = guarded_method(GuardedMethodSettings::new(method, 1e-3));
        assert_contact_at_half(
            guarded
                .run_query(&falling_cube_query(), QUERY_TIME_LIMIT)
                .unwrap(),
        );
    }
}

#[test]
fn a_margin_is_kept_or_refused() {
    let ask = |method: Method| {
        let mut guarded = guarded_method(GuardedMethodSettings {
            margin: 0.5,
            ..GuardedMethodSettings::new(method, 1e-3)
        });
        guarded.run_query(&falling_cube_query(), QUERY_TIME_LIMIT)
    };
    for method in Method::built_in_methods() {
        let outcome = ask(method);
        match method {
            Method::ThisProject(..) => {
                let Ok(QueryOutcome::Answered(TimedReply { reply, .. })) = outcome else {
                    panic!("{method}: {outcome:?}");
                };
                let ContactClaim::Contact { time } = reply.claim else {
                    panic!("{method}: {reply:?}");
                };
                // The gap of 2 closes to 0.5 at speed 4.
                assert!(
                    (-2.6e-4..=1e-12).contains(&(time - 0.375)),
                    "{method}: {time}"
                );
            }
            Method::Rival(_) | Method::Peer(_) | Method::Script(_) => {
                let error = outcome.unwrap_err();
                assert_eq!(error.kind(), ErrorKind::Unsupported, "{method}");
                assert!(error.to_string().contains("margin"), "{method}: {error}");
            }
        }
    }
}

#[cfg(unix)]
#[test]
fn a_hanging_peer_is_cut_off_and_restarted() {
    let mut hanging = guarded_script("hanging");
    let start = Instant::now();
    for _ in 0..2 {
        let outcome = hanging
            .run_query(&falling_cube_query(), Duration::from_millis(50))
            .unwrap();
        assert_eq!(outcome, QueryOutcome::CutOff);
    }
    assert!(start.elapsed() < QUERY_TIME_LIMIT);
}

#[test]
fn the_query_after_a_cut_off_one_is_answered() {
    let mut peer = guarded_peer(PeerKind::ParryF64);
    assert_eq!(
        peer.run_query(&falling_cube_query(), Duration::ZERO)
            .unwrap(),
        QueryOutcome::CutOff
    );
    assert_contact_at_half(
        peer.run_query(&falling_cube_query(), QUERY_TIME_LIMIT)
            .unwrap(),
    );
    assert_contact_at_half(
        peer.run_query(&falling_cube_query(), QUERY_TIME_LIMIT)
            .unwrap(),
    );
}

#[cfg(unix)]
#[test]
fn a_dying_peer_is_reported_and_restarted() {
    let mut dying = guarded_script("dying");
    for _ in 0..2 {
        assert_eq!(
            dying
                .run_query(&falling_cube_query(), QUERY_TIME_LIMIT)
                .unwrap(),
            QueryOutcome::Crashed
        );
    }
}

#[test]
fn a_tolerance_is_passed_on() {
    let mut peer = guarded_peer(PeerKind::ParrySweepF64);
    peer.set_tolerance(1e-6);
    let QueryOutcome::Answered(TimedReply { reply, .. }) = peer
        .run_query(&falling_cube_query(), QUERY_TIME_LIMIT)
        .unwrap()
    else {
        panic!("no answer");
    };
    let ContactClaim::Contact { time } = reply.claim else {
        panic!("{reply:?}");
    };
    assert!((-2.6e-7..=1e-12).contains(&(time - 0.5)), "{time}");
}

#[test]
fn a_program_that_is_no_peer_does_not_start() {
    let missing = "no/such/program".into();
    let setting = GuardedMethodSettings::new(Method::Peer(PeerKind::ParryF64), 1e-3);
    let mut peer = GuardedMethod::with_program(missing, setting, [&cube(), &cube()]).unwrap();
    assert!(
        peer.run_query(&falling_cube_query(), QUERY_TIME_LIMIT)
            .is_err()
    );
}
