use super::*;
use ccd_core::{Effort, Feature, Limit, Separation};

fn answer(outcome: Outcome) -> Answer {
    Answer {
        outcome,
        tolerance: 1e-3,
        stats: Stats {
            iterations: 17,
            oracle_calls: 5,
            ..Stats::default()
        },
    }
}

fn contact() -> Contact {
    Contact {
        separation: Separation {
            lower: 0.1,
            upper: 0.2,
            normal: DVec3::new(0.0, -1.0, 0.0),
            witness_a: DVec3::new(1.0, 1.0 / 3.0, 1e-300),
            witness_b: DVec3::new(4.0, 5.0, 6.0),
        },
        feature_a: Feature::Edge(3, 7),
        feature_b: Feature::Face(12),
        piece_a: 0,
        piece_b: 0,
    }
}

/// A table of one row.
fn table(extent: Extent, row: &ResultRow) -> String {
    let mut writer = csv::WriterBuilder::new()
        .has_headers(false)
        .from_writer(Vec::new());
    writer.write_record(columns(extent)).unwrap();
    write(&mut writer, extent, row).unwrap();
    String::from_utf8(writer.into_inner().unwrap()).unwrap()
}

/// The cells of a row as written, by column.
fn written(outcome: Outcome) -> Vec<(&'static str, String)> {
    let row = ResultRow::new("a,b", 2.5, &answer(outcome), 12.75);
    let text = table(Extent::Results, &row);
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    assert_eq!(
        reader.headers().unwrap(),
        &csv::StringRecord::from(COLUMNS.to_vec())
    );
    let record = reader.records().next().unwrap().unwrap();
    COLUMNS
        .into_iter()
        .zip(record.iter().map(str::to_owned))
        .collect()
}

fn cell(row: &[(&str, String)], column: &str) -> String {
    row.iter()
        .find(|(name, _)| *name == column)
        .unwrap()
        .1
        .clone()
}

#[test]
fn a_contact_fills_every_cell() {
    let row = written(Outcome::Contact {
        time: 0.1 + 0.2,
        contact: contact(),
    });
    let values: Vec<&str> = row.iter().map(|(_, value)| value.as_str()).collect();
    assert_eq!(values[..3], ["a,b", "contact", "0.30000000000000004"]);
    assert_eq!(values[3..8], ["0.1", "0.2", "0.0", "-1.0", "0.0"]);
    assert_eq!(
        values[8..14],
        ["1.0", "0.3333333333333333", "1e-300", "4.0", "5.0", "6.0"]
    );
    assert_eq!(values[14..], ["e3-7", "f12", "17", "5", "12.75", ""]);
}

#[test]
fn a_free_row_has_the_duration_and_the_proven_gap() {
    let row = written(Outcome::Free { proven_gap: 0.25 });
    assert_eq!(cell(&row, "status"), "free");
    assert_eq!(cell(&row, "time"), "2.5");
    assert_eq!(cell(&row, "distance_lower"), "0.25");
    assert!(
        row[4..16].iter().all(|(_, value)| value.is_empty()),
        "{row:?}"
    );
}

#[test]
fn contacts_at_the_start_have_time_0() {
    let touching = written(Outcome::Touching { contact: contact() });
    assert_eq!(
        (cell(&touching, "status"), cell(&touching, "time")),
        ("touching".into(), "0.0".into())
    );
    assert_eq!(cell(&touching, "feature_a"), "e3-7");
    let inside = written(Outcome::Overlapping {
        overlap: Overlap::AInsideB(DVec3::new(1.0, 2.0, 3.0)),
    });
    assert_eq!(
        (cell(&inside, "status"), cell(&inside, "time")),
        ("overlapping".into(), "0.0".into())
    );
    assert_eq!(cell(&inside, "witness_a_z"), "3.0");
    assert_eq!(cell(&inside, "normal_x"), "");
}

#[test]
fn an_unresolved_row_has_its_safe_time_and_its_limit() {
    let row = written(Outcome::Unresolved {
        safe_until: 0.75,
        reason: Limit::Budget,
    });
    assert_eq!(
        (cell(&row, "status"), cell(&row, "time")),
        ("unresolved".into(), "0.75".into())
    );
    assert_eq!(cell(&row, "distance_lower"), "");
    assert_eq!(cell(&row, "reason"), "budget");
}

#[test]
fn status_names_are_as_written() {
    for status in Status::ALL {
        let mut writer = csv::Writer::from_writer(Vec::new());
        writer.serialize(status).unwrap();
        let text = String::from_utf8(writer.into_inner().unwrap()).unwrap();
        assert_eq!(text.trim(), status.name());
    }
}

#[test]
fn an_error_row_has_only_its_reason() {
    let problem = RowProblem::NotANumber {
        column: "a_px".into(),
        value: "x".into(),
    };
    let row = ResultRow::error("bad", &problem);
    let text = table(Extent::WithCounters, &row);
    let cells = text.lines().nth(1).unwrap();
    let reason = "column a_px: `x` is not a finite number";
    assert_eq!(cells, format!("bad,error{},{reason},,,,,", ",".repeat(17)));
}

#[test]
fn counters_follow_the_other_columns() {
    let answer = Answer {
        stats: Stats {
            peak_front: 11,
            advancements: 12,
            effort: Effort {
                steps: 13,
                cycles: 14,
                fallbacks: 15,
            },
            ..Stats::default()
        },
        ..answer(Outcome::Free { proven_gap: 0.25 })
    };
    let row = ResultRow::new("a", 2.5, &answer, 12.75);
    let text = |extent| table(extent, &row);
    let (plain, counted) = (text(Extent::Results), text(Extent::WithCounters));
    for (line, (with, more)) in plain.lines().zip(counted.lines().zip([
        "advancements,oracle_steps,cycles,fallbacks,front",
        "12,13,14,15,11",
    ])) {
        assert_eq!(format!("{line},{more}"), with);
    }
    assert_eq!((plain.lines().count(), counted.lines().count()), (2, 2));
}
