use super::*;
use ccd_core::{Answer, Effort, Outcome, Stats};
use ccd_tables::batch::median;

fn sum<'t>(answers: impl IntoIterator<Item = &'t TimedAnswer>, tolerance: f64) -> Summary {
    let mut summary = Summary::new(tolerance);
    answers
        .into_iter()
        .for_each(|timed| summary.add(Status::Free, timed));
    summary
}

fn sample_timed_answer(micros: f64, tolerance: f64) -> TimedAnswer {
    TimedAnswer {
        answer: Answer {
            outcome: Outcome::Free { proven_gap: 1.0 },
            tolerance,
            stats: Stats {
                iterations: 10,
                oracle_calls: 2,
                advancements: 3,
                oracle_effort: Effort {
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
fn times_and_visits_are_summed() {
    let answers: Vec<TimedAnswer> = (1..=100)
        .rev()
        .map(|micros| sample_timed_answer(f64::from(micros), 1e-3))
        .collect();
    let summary = sum(&answers, 1e-3);
    let counts: Vec<(Status, usize)> = summary.counts.nonzero_counts().collect();
    assert_eq!(counts, [(Status::Free, 100)]);
    assert_eq!(
        (
            summary.time_histogram.median(),
            summary.time_histogram.mean()
        ),
        (50.5, 50.5)
    );
    assert_eq!(
        (summary.visited_node_pairs, summary.oracle_calls),
        (1000, 200)
    );
    assert_eq!(
        summary.to_string(),
        "100 rows: 100 free; median 50.5 µs, mean 50.5 µs; 1000 iterations, 200 oracle calls"
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
    let answers = [
        sample_timed_answer(1.0, 1e-9),
        sample_timed_answer(1.0, 4e-8),
        sample_timed_answer(1.0, 3e-8),
    ];
    let summary = sum(&answers, 1e-9);
    assert_eq!(
        (
            summary.raised_tolerances.count,
            summary.raised_tolerances.largest
        ),
        (2, 4e-8)
    );
    let text = summary.to_string();
    assert!(
        text.contains("raised for 2 rows, to at most 4.00e-8"),
        "{text}"
    );
}

#[test]
fn means_are_per_row() {
    let answers = [
        sample_timed_answer(1.0, 1e-3),
        sample_timed_answer(2.0, 1e-3),
    ];
    assert_eq!(
        sum(&answers, 1e-3).describe_means().as_deref(),
        Some("means: 3.0 advancements, 2.0 oracle calls, 7.0 oracle steps")
    );
    assert_eq!(sum([], 1e-3).describe_means(), None);
}

#[test]
fn a_summary_without_rows_has_no_times() {
    assert_eq!(sum([], 1e-3).to_string(), "0 rows");
}

#[test]
fn the_median_of_many_times_has_a_relative_error_below_a_thousandth() {
    let mut times: Vec<f64> = (0..9999).map(|k| 0.37 * 1.003_f64.powi(k % 4001)).collect();
    let answers: Vec<TimedAnswer> = times
        .iter()
        .map(|&micros| sample_timed_answer(micros, 1e-3))
        .collect();
    let exact = median(&mut times);
    let reported = sum(&answers, 1e-3).time_histogram.median();
    assert!(
        (0.999 * exact..=exact).contains(&reported),
        "{reported} {exact}"
    );
}

#[test]
fn rows_of_earlier_runs_are_counted_separately() {
    let mut earlier = sum(&[sample_timed_answer(3.0, 1e-3)], 1e-3);
    earlier.counts.add(Status::Error);
    let mut summary = Summary::new(1e-3).with_earlier_counts(earlier.counts);
    assert_eq!(
        summary.to_string(),
        "2 rows: 1 free, 1 error; 0 in this run"
    );
    assert_eq!(summary.describe_means(), None);
    summary.add(Status::Free, &sample_timed_answer(5.0, 1e-3));
    assert_eq!(
        (summary.counts.row_count(), summary.time_histogram.median()),
        (3, 5.0)
    );
    let text = summary.to_string();
    let begin = "3 rows: 2 free, 1 error; 1 in this run; median 5.0";
    assert!(text.starts_with(begin), "{text}");
    let means = "means: 3.0 advancements, 2.0 oracle calls, 7.0 oracle steps";
    assert_eq!(summary.describe_means().as_deref(), Some(means));
}

#[test]
fn invalid_rows_take_no_time() {
    let mut summary = sum(&[sample_timed_answer(3.0, 1e-3)], 1e-3);
    summary.counts.add(Status::Error);
    assert_eq!(
        (summary.counts.row_count(), summary.time_histogram.median()),
        (2, 3.0)
    );
    let text = summary.to_string();
    assert!(
        text.starts_with("2 rows: 1 free, 1 error; median 3.0"),
        "{text}"
    );
    let mut none = Summary::new(1e-3);
    none.counts.add(Status::Error);
    assert_eq!(none.to_string(), "1 row: 1 error");
}
