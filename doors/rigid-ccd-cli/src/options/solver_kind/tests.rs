use super::*;
use ccd_core::glam::DVec3;
use ccd_core::{Body, Motion, Outcome, Pose, Settings};
use ccd_decomp::{PatchOrder, PieceChoice, TriangleMesh, build_hull_tree, prepare};

/// Returns a trefoil knot split into patches, with its hull tree.
fn knot() -> Body {
    let file = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../rigid-ccd/tests/data/knot216.obj"
    );
    let mesh = TriangleMesh::read(file).expect("a mesh");
    let model = prepare(&mesh, PieceChoice::Patches(PatchOrder::default())).expect("a solid");
    let tree = build_hull_tree(&model.pieces).expect("a tree");
    let body = model.body().expect("a body");
    body.with_hull_tree(tree).expect("its own tree")
}

/// Returns all combinations of a schedule and a distance backend, each with the sound bound.
fn all_sound_kinds() -> impl Iterator<Item = SolverKind> {
    ScheduleKind::value_variants().iter().flat_map(|&schedule| {
        OracleKind::value_variants()
            .iter()
            .map(move |&oracle| SolverKind {
                schedule,
                oracle,
                motion_bound: BoundKind::Sound,
            })
    })
}

fn first_contact(kind: SolverKind, query: &Query<'_>) -> Answer {
    let mut solver = kind.solver();
    let answer = solver.answer(Question::FirstContact, query);
    answer
        .expect("all schedules find it")
        .expect("motions are in range")
}

/// Returns 24 motions of a knot towards another knot, which it hits or misses, at three speeds.
fn motions() -> impl Iterator<Item = Motion> {
    (0..24).map(|k| {
        let k = f64::from(k);
        let place = DVec3::new(k.sin(), k.cos(), 0.3 * (k * 0.7).sin()) * (1.2 + 0.05 * k);
        let speed = [0.02, 0.2, 2.0][k as usize % 3];
        let spin = DVec3::new(0.3, k.cos(), k.sin()) * speed;
        let pose = Pose::at(place).expect("near");
        Motion::new(pose, -speed * place, spin).expect("slow")
    })
}

#[test]
fn answers_are_the_same_bits_for_prepared_bodies() {
    let prepared = knot();
    for kind in all_sound_kinds() {
        kind.prepare_body(&prepared);
        // Each body has its own hulls and pieces, so nothing is prepared.
        let fresh = knot();
        for motion in motions().take(6) {
            let answers = [&fresh, &prepared].map(|body| {
                let query = ((body, motion), (body, Motion::STILL));
                let config = Settings::DEFAULT;
                let query = Query::new(query.0, query.1, 1.0, &config).expect("in range");
                first_contact(kind, &query)
            });
            assert_eq!(answers[0], answers[1], "{kind:?}");
        }
    }
}

#[test]
fn hull_trees_give_the_answers_of_boxes() {
    let body = knot();
    let config = Settings {
        tolerance: 1e-6,
        ..Settings::DEFAULT
    };
    let (mut met, mut free) = (0, 0);
    for motion in motions() {
        let query = ((&body, motion), (&body, Motion::STILL));
        let query = Query::new(query.0, query.1, 1.0, &config).expect("in range");
        let outcome = |schedule, oracle| {
            let kind = SolverKind {
                schedule,
                oracle,
                motion_bound: BoundKind::Sound,
            };
            first_contact(kind, &query).outcome
        };
        let boxes = outcome(ScheduleKind::BestFirst, OracleKind::Direct);
        for oracle in OracleKind::value_variants() {
            match (boxes, outcome(ScheduleKind::Fast, *oracle)) {
                (Outcome::Contact { time, .. }, Outcome::Contact { time: other, .. }) => {
                    met += 1;
                    assert!((time - other).abs() < 1e-3, "{time} {other}");
                }
                (Outcome::Free { .. }, Outcome::Free { .. }) => free += 1,
                (one, other) => assert_eq!(
                    std::mem::discriminant(&one),
                    std::mem::discriminant(&other),
                    "{one:?} {other:?}"
                ),
            }
        }
    }
    assert!(met > 5 && free > 5, "{met} {free}");
}
