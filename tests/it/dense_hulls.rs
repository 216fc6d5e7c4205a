//! Tests that convex solids with many corners give the same answers as one piece and as triangles.

use ccd_core::glam::DVec3;
use ccd_core::schedule::BestFirst;
use ccd_core::{Answer, Body, Motion, MovingBody, Outcome, Pose, Schedule, Settings};
use ccd_decomp::{PieceChoice, body_from_mesh};
use ccd_distance_gjk::{Direct, Gjk};
use ccd_tests::models::{Mesh, icosphere, torus};

fn body(mesh: &Mesh, choice: PieceChoice) -> Body {
    body_from_mesh(&mesh.to_triangle_mesh(), choice)
        .unwrap()
        .body
}

fn answer(a: &Body, b: &Body, velocity: DVec3, spin: DVec3) -> Answer {
    let start = Pose::at(DVec3::new(-4.0, 0.2, 0.1)).unwrap();
    let a = MovingBody::from((a, Motion::new(start, velocity, spin).unwrap()));
    let b = MovingBody::from((b, Motion::still(Pose::IDENTITY)));
    let problem = ccd_core::Query::new(a, b, 1.0, &Settings::DEFAULT).unwrap();
    let answers = [
        BestFirst::default()
            .first_contact(&problem, &mut Direct::default())
            .unwrap(),
        BestFirst::default()
            .first_contact(&problem, &mut Gjk)
            .unwrap(),
    ];
    let [one, other] = [0, 1].map(|k| contact_time(&answers[k]));
    assert!((one - other).abs() <= 1e-3);
    let [answer, _] = answers;
    answer
}

fn contact_time(answer: &Answer) -> f64 {
    match answer.outcome {
        Outcome::Contact { time, .. } => time,
        Outcome::Free { .. } => 1.0,
        ref other => panic!("{other:?}"),
    }
}

#[test]
fn a_dense_solid_answers_like_its_triangles() {
    let ball = icosphere(1.0, 4).mesh;
    let ring = torus(1.0, 0.4, 32, 16).mesh;
    let [one, triangles] =
        [PieceChoice::Hull, PieceChoice::Triangles].map(|choice| body(&ball, choice));
    assert!(one.pieces().len() == 1 && one.pieces().points().len() > 1_000);
    let others = [
        body(&ring, PieceChoice::Triangles),
        one.clone(),
        triangles.clone(),
    ];
    let mut contacts = 0;
    for (velocity, spin) in [
        (DVec3::new(5.0, 0.0, 0.0), DVec3::Z),
        (DVec3::new(4.0, 0.3, 0.0), DVec3::new(0.5, 1.0, 0.0)),
        (DVec3::new(3.0, 0.0, 0.1), DVec3::new(1.0, 0.0, 6.0)),
        (DVec3::new(3.0, 3.0, 0.0), DVec3::ZERO),
        (DVec3::new(6.0, 3.0, 0.0), DVec3::X),
    ] {
        for other in &others {
            let [found, twin] = [&one, &triangles].map(|a| answer(a, other, velocity, spin));
            // Both are early by less than the tolerance over the closing speed.
            assert!(
                (contact_time(&found) - contact_time(&twin)).abs() <= 2e-3,
                "{found:?} {twin:?}"
            );
            if let Outcome::Contact { contact, .. } = found.outcome {
                contacts += 1;
                assert_eq!(contact.piece_a, 0);
                let named = format!("{:?}", contact.feature_a);
                assert!(!named.contains("Piece"), "{named}");
            }
        }
    }
    assert!(contacts >= 9, "{contacts}");
}

/// Tests that a dense convex piece needs at most twice as many oracle calls near a mesh as its triangles do.
#[test]
fn a_solid_against_many_triangles_costs_as_much_as_triangles() {
    let ball = icosphere(1.0, 4).mesh;
    let ring = body(&torus(1.0, 0.4, 32, 16).mesh, PieceChoice::Triangles);
    let spin = DVec3::new(0.5, 1.0, 0.0);
    let [one, triangles] = [PieceChoice::Auto, PieceChoice::Triangles].map(|choice| {
        let answer = answer(&body(&ball, choice), &ring, DVec3::new(4.0, 0.0, 0.0), spin);
        answer.stats.oracle_calls
    });
    assert!(one <= 2 * triangles, "{one} {triangles}");
}
