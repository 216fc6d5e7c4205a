use super::*;
use crate::motions::Motions;
use ccd_core::{Effort, Feature, Hit, Limit, Motion, Separation, Unresolved};

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

/// Returns a query of two bodies at rest with the given duration.
fn movements_at_rest(duration: f64) -> Movements {
    Movements::Motions(Motions {
        id: "a,b".into(),
        a: Motion::STILL,
        b: Motion::STILL,
        duration,
    })
}

/// Returns the table with one row as text.
fn table_text(columns: &[Column], row: &ResultRow) -> String {
    let mut writer = csv::WriterBuilder::new()
        .has_headers(false)
        .from_writer(Vec::new());
    writer.write_record(names(columns)).unwrap();
    writer.serialize(Line(columns, row)).unwrap();
    String::from_utf8(writer.into_inner().unwrap()).unwrap()
}

/// Returns the names of the columns, and the cells that are written for the outcome of a first contact.
fn written_cells(outcome: Outcome) -> Vec<(&'static str, String)> {
    cells_of((Question::FirstContact, outcome), None)
}

/// Returns the names of the columns, and the cells that are written for the outcome of any question.
fn cells_of(asked: (Question, Outcome), clearance: Option<f64>) -> Vec<(&'static str, String)> {
    let compared = ClearanceAndExcess {
        clearance,
        excess: 0.0,
    };
    cells_with_comparison(asked, compared)
}

fn cells_with_comparison(
    (question, outcome): (Question, Outcome),
    compared: ClearanceAndExcess,
) -> Vec<(&'static str, String)> {
    let row = ResultRow::new(
        &movements_at_rest(2.5),
        (question, &answer(outcome)),
        12.75,
        compared,
    );
    let columns = columns_with_counters(question);
    let text = table_text(&columns, &row);
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let names = names(&columns);
    assert_eq!(
        reader.headers().unwrap(),
        &csv::StringRecord::from(names.clone())
    );
    let record = reader.records().next().unwrap().unwrap();
    let cells = record.iter().map(str::to_owned);
    names.into_iter().zip(cells).collect()
}

fn cell(row: &[(&str, String)], column: &str) -> String {
    row.iter()
        .find(|(name, _)| *name == column)
        .unwrap()
        .1
        .clone()
}

fn columns_with_counters(question: Question) -> Vec<Column> {
    columns(question)
        .into_iter()
        .chain(COUNTER_COLUMNS)
        .collect()
}

#[test]
fn a_contact_fills_every_cell() {
    let row = written_cells(Outcome::Contact {
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
    assert_eq!(values[14..20], ["e3-7", "f12", "17", "5", "12.75", ""]);
    assert_eq!(values[20..], ["0"; 5]);
}

#[test]
fn a_free_row_has_the_duration_and_no_distance() {
    let row = written_cells(Outcome::Free { proven_gap: 0.25 });
    assert_eq!(cell(&row, "status"), "free");
    assert_eq!(cell(&row, "time"), "2.5");
    assert!(
        row[3..16].iter().all(|(_, value)| value.is_empty()),
        "{row:?}"
    );
}

#[test]
fn contacts_at_the_start_have_time_0() {
    let touching = written_cells(Outcome::Touching { contact: contact() });
    assert_eq!(
        (cell(&touching, "status"), cell(&touching, "time")),
        ("touching".into(), "0.0".into())
    );
    assert_eq!(cell(&touching, "feature_a"), "e3-7");
    let inside = written_cells(Outcome::Overlapping {
        overlap: Overlap::AInsideB(DVec3::new(1.0, 2.0, 3.0)),
        upper: 0.0,
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
    let row = written_cells(Outcome::Unresolved(Unresolved::from_safe_until(
        0.75,
        Limit::Budget,
    )));
    assert_eq!(
        (cell(&row, "status"), cell(&row, "time")),
        ("unresolved".into(), "0.75".into())
    );
    assert_eq!(cell(&row, "distance_lower"), "");
    assert_eq!(cell(&row, "reason"), "budget");
}

#[test]
fn statuses_are_read_as_written() {
    for status in Status::ALL {
        let record = csv::StringRecord::from(vec![status.name()]);
        assert_eq!(record.deserialize::<Status>(None).unwrap(), status);
    }
}

#[test]
fn an_error_row_has_only_its_reason() {
    let problem = RowProblem::NotANumber {
        column: "a_px".into(),
        value: "x".into(),
    };
    let row = ResultRow::error("bad", &problem);
    let text = table_text(&columns_with_counters(Question::FirstContact), &row);
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
            oracle_effort: Effort {
                steps: 13,
                cycle_count: 14,
                fallbacks: 15,
            },
            ..Stats::default()
        },
        ..answer(Outcome::Free { proven_gap: 0.25 })
    };
    let row = ResultRow::new(
        &movements_at_rest(2.5),
        (Question::FirstContact, &answer),
        12.75,
        ClearanceAndExcess::default(),
    );
    let plain = table_text(&COLUMNS, &row);
    let counted = table_text(&columns_with_counters(Question::FirstContact), &row);
    for (line, (with, more)) in plain.lines().zip(counted.lines().zip([
        "advancements,oracle_steps,cycles,fallbacks,front",
        "12,13,14,15,11",
    ])) {
        assert_eq!(format!("{line},{more}"), with);
    }
    assert_eq!((plain.lines().count(), counted.lines().count()), (2, 2));
}

#[test]
fn an_interval_has_its_last_time_after_the_other_columns() {
    let hit = |time, kind| Hit { time, kind };
    let later = |time| hit(time, HitKind::Contact(contact()));
    let interval = |first, last| (Question::ContactInterval, Outcome::Interval { first, last });
    let row = cells_of(interval(later(0.5), later(2.0)), None);
    let [status, time, last] = ["status", "time", "last_time"].map(|name| cell(&row, name));
    assert_eq!([&*status, &*time, &*last], ["contact", "0.5", "2.0"]);
    assert_eq!(row[COLUMNS.len()].0, "last_time");
    assert_eq!(row.len(), COLUMNS.len() + 1 + COUNTER_COLUMNS.len());
    let overlap = Overlap::AInsideB(DVec3::X);
    let (upper, contact) = (0.0, contact());
    for (first, outcome) in [
        (
            HitKind::Overlapping(overlap),
            Outcome::Overlapping { overlap, upper },
        ),
        (HitKind::Touching(contact), Outcome::Touching { contact }),
    ] {
        let row = cells_of(interval(hit(0.0, first), later(2.0)), None);
        // Except for the last time, the row is that of a first contact.
        assert_eq!(
            row[..COLUMNS.len()],
            written_cells(outcome)[..COLUMNS.len()]
        );
        assert_eq!(cell(&row, "last_time"), "2.0");
    }
    let free = (
        Question::ContactInterval,
        Outcome::Free { proven_gap: 0.25 },
    );
    let row = cells_of(free, None);
    assert_eq!(
        (cell(&row, "time"), cell(&row, "last_time")),
        ("2.5".into(), String::new())
    );
}

#[test]
fn answers_are_listed_in_the_order_of_the_questions() {
    assert_eq!(ANSWERS.map(|answers| answers.question), Question::ALL);
    for answers in ANSWERS {
        assert_eq!(
            QuestionAnswers::of(answers.question).question,
            answers.question
        );
        assert_eq!(
            !answers.compared_statuses.is_empty(),
            answers.question.is_for_a_distance()
        );
    }
}

#[test]
fn distances_are_compared_to_the_clearance() {
    let measured = |lower| Outcome::LeastDistance {
        lower,
        time: 1.5,
        contact: contact(),
    };
    let (nearest, at_zero) = (measured(0.05), measured(0.0));
    let unresolved = Outcome::Unresolved(Unresolved {
        lower: 0.01,
        upper: contact().separation.upper,
        nearest_contact: Some((1.5, contact())),
        ..Unresolved::from_safe_until(0.0, Limit::Budget)
    });
    let farther = Outcome::Free { proven_gap: 0.3 };
    let nearer = Outcome::Contact {
        time: 1.5,
        contact: contact(),
    };
    let overlapping = Outcome::Overlapping {
        overlap: Overlap::AInsideB(DVec3::ZERO),
        upper: 0.0,
    };
    let within =
        "--clearance is within the bounds of the distance; a smaller --tolerance may decide";
    let touch = "--clearance is within the bounds of the distance: the bodies may touch";
    for (found, clearance, status, lower, reason) in [
        (nearest, None, "measured", "0.05", ""),
        (nearest, Some(0.05), "kept", "0.05", ""),
        (nearest, Some(0.1), "unverified", "0.05", within),
        (at_zero, Some(0.0), "unverified", "0.0", touch),
        (nearest, Some(0.25), "violated", "0.05", ""),
        (unresolved, None, "unresolved", "0.01", "budget"),
        (unresolved, Some(0.005), "kept", "0.01", "budget"),
        (unresolved, Some(0.05), "unverified", "0.01", "budget"),
        (unresolved, Some(0.25), "violated", "0.01", "budget"),
        (farther, Some(0.25), "kept", "0.3", ""),
        (nearer, Some(0.25), "violated", "0.0", ""),
        (overlapping, None, "overlapping", "", ""),
        (overlapping, Some(0.0), "violated", "", ""),
    ] {
        let row = cells_of((Question::Distance, found), clearance);
        let cells = ["status", "distance_lower", "reason"].map(|name| cell(&row, name));
        assert_eq!(cells, [status, lower, reason].map(str::to_owned));
    }
}

/// Tests that bodies which overlap leave a clearance of at most their excess unverified, and that the reason names the
/// excess.
#[test]
fn the_excess_of_bodies_is_reported() {
    let overlapping = |overlap| Outcome::Overlapping {
        overlap,
        upper: 0.01,
    };
    let inside = overlapping(Overlap::AInsideB(DVec3::ZERO));
    let pieces = overlapping(Overlap::Pieces(contact()));
    let upper = contact().separation.upper.to_string();
    for (found, clearance, status, upper) in [
        (inside, None, "overlapping", "0.01"),
        (inside, Some(0.02), "violated", "0.01"),
        (inside, Some(0.005), "unverified", "0.01"),
        (pieces, Some(0.005), "unverified", upper.as_str()),
    ] {
        let compared = ClearanceAndExcess {
            clearance,
            excess: 0.01,
        };
        let row = cells_with_comparison((Question::Distance, found), compared);
        let cells = ["status", "distance_upper"].map(|name| cell(&row, name));
        assert_eq!(cells, [status, upper].map(str::to_owned));
        let names = cell(&row, "reason").contains("excess of the bodies over their shapes");
        assert_eq!(names, status == "unverified");
    }
}
