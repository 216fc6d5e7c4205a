use super::*;
use crate::run::contest::summarise_trials;

/// Returns a trial at tolerance 1e-3, with the given time in microseconds and verdict.
pub(crate) fn trial(scene: &str, method: &str, id: &str, micros: f64, verdict: Verdict) -> Trial {
    Trial {
        scene: scene.to_owned(),
        method: method.to_owned(),
        tolerance: 1e-3,
        row: id.parse().unwrap(),
        id: id.to_owned(),
        micros,
        steps: 1,
        verdict: verdict.to_string(),
        error: (verdict == Verdict::Right).then_some(1e-4),
        time: None,
        note: String::new(),
    }
}

fn trials() -> Vec<Trial> {
    let right = Verdict::Right;
    vec![
        trial("santa", "best-first direct", "0", 10.0, right),
        trial("santa", "best-first direct", "1", 20.0, right),
        trial("santa", "best-first direct", "2", 1000.0, right),
        trial("santa", "C2A", "0", 30.0, right),
        trial("santa", "C2A", "1", 80.0, right),
        trial("santa", "discrete stepping", "1", 50.0, Verdict::Missed),
        trial("santa", "parry-f64", "0", 4e6, Verdict::CutOff),
        trial("santa", "coal-distance", "0", 5.0, Verdict::NotJudged),
    ]
}

#[test]
fn ratios_are_over_the_rows_common_to_both_methods() {
    let others = ["C2A", "discrete stepping", "parry-f64", "naive direct"];
    let table = time_ratio_table(&trials(), "best-first direct", &others, 1e-3);
    // The medians are over rows 0 and 1. The row with time 1000 ran on one method only.
    assert_eq!(
        table.rows,
        [[
            "santa",
            "3.50 (3.67) [2]",
            "2.50 (2.50) [1] †",
            "> 400000 (400000) [1]",
            "–"
        ]]
    );
    assert!(
        time_ratio_table(&trials(), "best-first direct", &others, 1e-6)
            .rows
            .is_empty()
    );
}

#[test]
fn answers_are_counted_per_method_without_distances() {
    let all = trials();
    let mut cells: Vec<MeasurementCell> = Vec::new();
    for method in ["C2A", "discrete stepping", "parry-f64", "coal-distance"] {
        let of: Vec<Trial> = all.iter().filter(|t| t.method == method).cloned().collect();
        cells.push(summarise_trials(&of));
    }
    let table = safety_table(&cells, &all);
    assert_eq!(
        table.rows,
        [
            ["C2A", "2", "0", "0", "0", "0", "0", "0", "0"],
            ["discrete stepping", "1", "0", "1", "0", "0", "0", "0", "0"],
            ["parry-f64", "1", "0", "0", "0", "0", "1", "1", "0"],
        ]
    );
}

#[test]
fn tables_are_laid_out_as_markdown() {
    let text = safety_table(&[summarise_trials(&trials()[3..5])], &trials()).to_string();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len(), 5, "{text}");
    assert_eq!(lines[1], "");
    assert!(lines[3].starts_with("|--"), "{text}");
    assert!(lines[4].starts_with("| C2A"), "{text}");
}
