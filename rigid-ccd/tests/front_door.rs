//! Tests that the public interface gives the same answers as the engine.

use rigid_ccd::answer::{HitKind, Limit, Overlap};
use rigid_ccd::glam::DVec3;
use rigid_ccd::oracle::{Direct, DistanceOracle, Gjk};
use rigid_ccd::schedule::BestFirst;
use rigid_ccd::schedule::Schedule;
use rigid_ccd::{
    Answer, Body, Error, InputError, Motion, Outcome, Pose, Query, Settings, Solver, first_contact,
};

fn capsule() -> Body {
    Body::capsule(0.1, 0.6).unwrap()
}

fn cuboid() -> Body {
    Body::cuboid([0.5, 0.4, 0.3]).unwrap()
}

fn pose_at(x: f64) -> Pose {
    Pose::at([x, 0.1, 0.05]).unwrap()
}

fn motion_along_x(x: f64, speed: f64) -> Motion {
    Motion::new(pose_at(x), [speed, 0.0, 0.1], [0.3, 2.0, 1.0]).unwrap()
}

#[test]
fn hits_are_the_engines_bit_for_bit() {
    let (a, b) = (capsule(), cuboid());
    let config = Settings {
        tolerance: 1e-5,
        margin: 0.01,
        ..Settings::DEFAULT
    };
    let mut solver = Solver::new().with_settings(config.clone());
    let (mut schedule, mut oracle) = (BestFirst::default(), Direct::default());
    let (mut hits, mut misses) = (0, 0);
    for k in 0..50 {
        let flies = motion_along_x(-3.0, 0.1 * f64::from(k));
        let query = Query::new((&a, flies), (&b, Motion::STILL), 1.0, &config).unwrap();
        let answer = schedule.first_contact(&query, &mut oracle).unwrap();
        let found = solver.first_contact((&a, flies), (&b, Motion::STILL), 1.0);
        match (answer.outcome, found.unwrap().hit().unwrap()) {
            (Outcome::Contact { time, contact }, Some(hit)) => {
                assert_eq!((hit.time, hit.kind), (time, HitKind::Contact(contact)));
                assert_eq!(hit.witness_a(), contact.separation.witness_a);
                assert_eq!(hit.witness_b(), contact.separation.witness_b);
                hits += 1;
            }
            (Outcome::Free { .. }, None) => misses += 1,
            other => panic!("{other:?}"),
        }
    }
    assert!(hits > 10 && misses > 10, "{hits} hits, {misses} misses");
}

#[test]
fn contacts_at_the_start_are_hits_at_time_0() {
    let (a, b) = (cuboid(), cuboid());
    let touching = first_contact(
        (&a, Motion::still(shifted_pose(1.0))),
        (&b, Motion::STILL),
        1.0,
    );
    let touching = touching.unwrap().hit().unwrap().unwrap();
    assert_eq!(touching.time, 0.0);
    assert!(
        matches!(touching.kind, HitKind::Touching(_)),
        "{touching:?}"
    );
    let across = first_contact(
        (&a, Motion::still(shifted_pose(0.3))),
        (&b, Motion::STILL),
        1.0,
    );
    let across = across.unwrap().hit().unwrap().unwrap();
    assert_eq!(across.time, 0.0);
    let pieces = HitKind::Overlapping(Overlap::Pieces(across.contact().unwrap()));
    assert_eq!(across.kind, pieces);
}

fn shifted_pose(x: f64) -> Pose {
    Pose::at([x, 0.0, 0.0]).unwrap()
}

#[test]
fn a_limit_is_an_error_with_a_certified_time() {
    let (a, b) = (capsule(), cuboid());
    let mut solver = Solver::with_oracle(Gjk).with_settings(Settings {
        budget: 1,
        ..Settings::DEFAULT
    });
    let found = solver.first_contact((&a, motion_along_x(-3.0, 4.0)), (&b, Motion::STILL), 1.0);
    let known = found.unwrap().hit().unwrap_err();
    let (safe_until, limit) = (known.safe_until, known.limit);
    assert_eq!(limit, Limit::Budget);
    assert!((0.0..0.6).contains(&safe_until), "{safe_until}");
    let message = Error::from(known).to_string();
    assert!(message.starts_with("unresolved (budget): "), "{message}");
}

#[test]
fn invalid_input_is_an_error() {
    let ball = Body::sphere(0.5).unwrap();
    let found = first_contact((&ball, Motion::STILL), (&ball, Motion::STILL), -1.0);
    let out_of_range = |error| matches!(error, InputError::OutOfRange { .. });
    assert!(found.is_err_and(out_of_range));
    assert!(Pose::at([f64::NAN, 0.0, 0.0]).is_err());
}

#[test]
fn vectors_are_arrays_or_convert_into_them() {
    let (v, w) = ([1.0, 2.0, 3.0], [0.1, 0.2, 0.3]);
    let arrays = Motion::new(pose_at(0.0), v, w).unwrap();
    let vectors = Motion::new(pose_at(0.0), DVec3::from(v), DVec3::from(w)).unwrap();
    assert_eq!(arrays, vectors);
}

#[test]
fn backends_agree() {
    let (a, b) = (capsule(), cuboid());
    let query = ((&a, motion_along_x(-3.0, 4.0)), (&b, Motion::STILL));
    let time = |found: Result<Answer, InputError>| found.unwrap().hit().unwrap().unwrap().time;
    let by_default = time(first_contact(query.0, query.1, 1.0));
    let mut gjk = Solver::with_oracle(Gjk);
    let mut both = Solver::with_oracle(rigid_ccd::oracle::ClosedForm::default().or_else(Gjk));
    for other in [
        time(gjk.first_contact(query.0, query.1, 1.0)),
        time(both.first_contact(query.0, query.1, 1.0)),
    ] {
        assert!((other - by_default).abs() < 1e-3, "{other} {by_default}");
    }
}

#[cfg(feature = "meshes")]
#[test]
fn meshes_are_loaded_from_files() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/examples");
    let bracket = rigid_ccd::load(format!("{folder}/bracket.obj")).unwrap();
    let inside = Motion::still(Pose::at([0.2, 0.5, 1.0]).unwrap());
    let ball = Body::sphere(0.05).unwrap();
    let hit = first_contact((&ball, inside), (&bracket, Motion::STILL), 1.0).unwrap();
    let hit = hit.hit().unwrap().expect("the bracket is solid");
    let inside = HitKind::Overlapping(Overlap::AInsideB(hit.witness_a()));
    assert_eq!((hit.kind, hit.contact()), (inside, None));
    let missing = rigid_ccd::load(format!("{folder}/none.obj")).unwrap_err();
    assert!(missing.to_string().contains("none.obj"), "{missing}");
}
