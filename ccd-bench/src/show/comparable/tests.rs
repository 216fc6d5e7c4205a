use super::*;
use crate::run::contest::{Verdict, summarise_trials};
use crate::show::tables::tests::trial;

const REFERENCE_METHOD: &str = "best-first direct";

/// Returns trials of the reference method on four rows, the last two of which are hard, and of a slow method on the
/// first two.
fn trials() -> Vec<Trial> {
    let of = |method: &str, times: &[f64]| {
        let rows = times.iter().enumerate();
        rows.map(|(row, micros)| trial("santa", method, &row.to_string(), *micros, Verdict::Right))
            .collect::<Vec<_>>()
    };
    [
        of(REFERENCE_METHOD, &[1.0, 2.0, 90.0, 110.0]),
        of("slow", &[3.0, 8.0]),
    ]
    .concat()
}

fn cell_of(trials: &[Trial], method: &str) -> MeasurementCell {
    let own = trials.iter().filter(|trial| trial.method == method);
    summarise_trials(&own.cloned().collect::<Vec<_>>())
}

#[test]
fn a_method_on_easy_rows_only_is_slower_than_the_reference() {
    let trials = trials();
    let cells = [cell_of(&trials, REFERENCE_METHOD), cell_of(&trials, "slow")];
    assert!(
        cells[1].median_us < cells[0].median_us,
        "the plain medians mislead"
    );
    let moved =
        ReferenceTimes::new(REFERENCE_METHOD, &trials).cells_with_comparable_medians(&cells);
    assert_eq!(moved[0], cells[0], "the reference keeps its median, 46");
    // The ratios are 3 and 4.
    assert_eq!(moved[1].median_us, 46.0 * 3.5);
    assert_eq!(moved[1].rows, 2);
}

#[test]
fn a_cell_keeps_its_median_where_there_is_nothing_to_compare() {
    let mut trials = trials();
    let slow = cell_of(&trials, "slow");
    let finer = MeasurementCell {
        tolerance: 1e-6,
        ..slow.clone()
    };
    let elsewhere = MeasurementCell {
        scene: "bunny".to_owned(),
        ..slow.clone()
    };
    let reference = ReferenceTimes::new(REFERENCE_METHOD, &trials);
    for cell in [&finer, &elsewhere] {
        assert_eq!(reference.median_time_ratio(cell), None);
    }
    let both = [finer, elsewhere];
    assert_eq!(reference.cells_with_comparable_medians(&both), both);
    trials.retain(|trial| trial.method != REFERENCE_METHOD);
    assert_eq!(
        ReferenceTimes::new(REFERENCE_METHOD, &trials)
            .cells_with_comparable_medians(std::slice::from_ref(&slow)),
        [slow]
    );
}
