use super::*;
use ccd_core::{Answer, Effort, Outcome, Stats};

fn timed(micros: f64, tolerance: f64) -> Timed {
    Timed {
        answer: Answer {
            outcome: Outcome::Free { clearance: 1.0 },
            tolerance,
            stats: Stats {
                node_visits: 10,
                oracle_calls: 2,
                advancements: 3,
                effort: Effort {
                    steps: 7,
                    ..Effort::default()
                },
                ..Stats::default()
            },
        },
        micros,
    }
}

#[test]
fn times_and_visits_are_summed_up() {
    let answers: Vec<Timed> = (1..=100)
        .rev()
        .map(|micros| timed(f64::from(micros), 1e-3))
        .collect();
    let summary = Summary::new(&answers, 1e-3);
    assert_eq!((summary.rows(), summary.count(Status::Free)), (100, 100));
    assert_eq!(summary.count(Status::Contact), 0);
    assert_eq!((summary.median_micros, summary.mean_micros), (50.5, 50.5));
    assert_eq!(summary.p95_micros, 95.0);
    assert_eq!((summary.node_visits, summary.oracle_calls), (1000, 200));
    assert_eq!(
        summary.to_string(),
        "100 rows: 100 free; median 50.5 µs, mean 50.5 µs; 1000 node visits, 200 oracle calls"
    );
}

#[test]
fn the_median_of_an_odd_number_is_the_middle_one() {
    assert_eq!(median(&mut [9.0, 1.0, 2.0]), 2.0);
    assert_eq!(median(&mut [7.0]), 7.0);
    assert!(median(&mut []).is_nan());
}

#[test]
fn raised_tolerances_are_counted() {
    let answers = [timed(1.0, 1e-9), timed(1.0, 4e-8), timed(1.0, 3e-8)];
    let summary = Summary::new(&answers, 1e-9);
    assert_eq!((summary.raised, summary.largest_tolerance), (2, 4e-8));
    let text = summary.to_string();
    assert!(
        text.contains("raised in 2 rows, to at most 4.00e-8"),
        "{text}"
    );
}

#[test]
fn means_are_per_row() {
    let answers = [timed(1.0, 1e-3), timed(2.0, 1e-3)];
    assert_eq!(
        Summary::new(&answers, 1e-3).means().as_deref(),
        Some("means: 3.0 advancements, 2.0 oracle calls, 7.0 oracle steps")
    );
    assert_eq!(Summary::new([], 1e-3).means(), None);
}

#[test]
fn no_rows_have_no_times() {
    assert_eq!(Summary::new([], 1e-3).to_string(), "0 rows");
}
