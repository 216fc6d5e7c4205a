use super::*;
use ccd_core::glam::DVec3;
use ccd_core::{Feature, Limit, Separation, Stats, Unresolved};
use ccd_tables::motions::Motions;
use ccd_tables::results::{Line, names};

fn pair() -> Contact {
    Contact {
        feature_a: Feature::Vertex(3),
        feature_b: Feature::Edge(4, 7),
        piece_a: 0,
        piece_b: 0,
        separation: Separation {
            lower: 0.1,
            upper: 0.2,
            normal: DVec3::new(0.0, -1.0, 0.0),
            witness_a: DVec3::new(1.0, 1.0 / 3.0, 1e-300),
            witness_b: DVec3::new(4.0, 5.0, 6.0),
        },
    }
}

#[test]
fn a_pair_fills_a_row() {
    let mut writer = csv::WriterBuilder::new()
        .has_headers(false)
        .from_writer(Vec::new());
    let row = ResultRow::from_feature_pair("a,b", 0.1 + 0.2, &pair());
    let columns = columns();
    let header = [
        "id,time,feature_a,feature_b,distance_lower,distance_upper,normal_x,normal_y,normal_z",
        "witness_a_x,witness_a_y,witness_a_z,witness_b_x,witness_b_y,witness_b_z",
    ];
    assert_eq!(names(&columns).join(","), header.join(","));
    writer.serialize(Line(&columns, &row)).unwrap();
    let line = String::from_utf8(writer.into_inner().unwrap()).unwrap();
    assert_eq!(
        line,
        "\"a,b\",0.30000000000000004,v3,e4-7,0.1,0.2,0.0,-1.0,0.0,\
         1.0,0.3333333333333333,1e-300,4.0,5.0,6.0\n"
    );
    let cells = csv::Reader::from_reader(line.as_bytes())
        .headers()
        .unwrap()
        .len();
    assert_eq!(cells, columns.len());
}

#[test]
fn outcomes_without_a_contact_have_no_rows() {
    let body = ccd_core::Body::sphere(1.0).unwrap();
    let bodies = BodyPair { a: &body, b: &body };
    let still = ccd_core::Motion::still(ccd_core::Pose::IDENTITY);
    let course = Movements::Motions(Motions {
        id: String::new(),
        a: still,
        b: still,
        duration: 1.0,
    });
    let unresolved = Outcome::Unresolved(Unresolved::from_safe_until(0.5, Limit::Budget));
    for outcome in [Outcome::Free { proven_gap: 1.0 }, unresolved] {
        let answer = Answer {
            outcome,
            tolerance: 1e-3,
            stats: Stats::default(),
        };
        let rows = contact_rows(
            bodies,
            &course,
            &Settings::DEFAULT,
            (Question::FirstContact, &answer),
        );
        assert_eq!(rows.unwrap(), Vec::new());
    }
}
