//! Counts of verdicts, as a table.

use crate::judge::{Allowance, Fault, Reply, judge};
use crate::rows::Row;
use crate::{Call, Precision};
use ccd_core::order::greater;
use comfy_table::presets::ASCII_MARKDOWN;
use std::collections::BTreeMap;
use std::fmt;

/// The counts of one suite.
#[derive(Default)]
pub(crate) struct Tally {
    rows: u32,
    same: u32,
    /// Rows of which only our answer is right, by what is wrong about the other.
    better: Faults,
    contract: u32,
    worse: Faults,
    both_wrong: u32,
    ours_late: u32,
    theirs_late: u32,
}

impl Tally {
    /// Counts a row, and returns what is said of it.
    pub(crate) fn add(
        &mut self,
        row: &Row,
        ours: Reply,
        theirs: Reply,
        allowed: Allowance,
    ) -> String {
        let faults = [ours, theirs].map(|reply| judge(row, reply, allowed));
        self.rows += 1;
        self.ours_late += u32::from(is_late(faults[0]));
        // Bodies let go at the start are late by nobody's contract.
        self.theirs_late += u32::from(is_late(faults[1]) && !row.leave);
        let count = match (row.leave && ours != theirs, faults) {
            (true, _) => {
                self.contract += 1;
                "contract"
            }
            (false, [None, None]) => {
                self.same += 1;
                "same"
            }
            (false, [None, Some(fault)]) => {
                self.better.add(fault);
                "better"
            }
            (false, [Some(fault), None]) => {
                self.worse.add(fault);
                "worse"
            }
            (false, [Some(_), Some(_)]) => {
                self.both_wrong += 1;
                "both wrong"
            }
        };
        let told =
            |fault: Option<Fault>| fault.map_or("right".to_owned(), |fault| fault.to_string());
        let [a, b] = faults.map(told);
        format!(
            "{count}; expected {:?}; ours {ours} ({a}), parry {theirs} ({b})",
            row.expected
        )
    }
}

/// How often each fault is found, and the largest amount of it.
#[derive(Default)]
struct Faults(BTreeMap<&'static str, (u32, Option<f64>)>);

impl Faults {
    fn add(&mut self, fault: Fault) {
        let (count, most) = self.0.entry(fault.name()).or_default();
        *count += 1;
        *most = match (*most, fault.amount()) {
            (Some(most), Some(by)) => Some(greater(most, by)),
            (most, by) => most.or(by),
        };
    }

    fn count(&self) -> u32 {
        self.0.values().map(|(count, _)| count).sum()
    }
}

impl fmt::Display for Faults {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let word = |(name, (count, most)): (&&str, &(u32, Option<f64>))| match most {
            Some(most) => format!("{name} {count} (by up to {most:.0e})"),
            None => format!("{name} {count}"),
        };
        f.write_str(&self.0.iter().map(word).collect::<Vec<_>>().join(", "))
    }
}

fn is_late(fault: Option<Fault>) -> bool {
    match fault {
        Some(Fault::Late(_) | Fault::Missed) => true,
        Some(Fault::Failed(by)) => by > 0.0,
        _ => false,
    }
}

/// The counts of all suites.
pub(crate) struct Table {
    title: String,
    rows: comfy_table::Table,
}

impl Table {
    pub(crate) fn new(call: Call, precision: Precision) -> Self {
        let function = match call {
            Call::Nonlinear => "cast_shapes_nonlinear",
            Call::Linear => "cast_shapes",
        };
        let number = match precision {
            Precision::Single => "f32",
            Precision::Double => "f64",
        };
        let mut rows = comfy_table::Table::new();
        rows.load_style(ASCII_MARKDOWN);
        rows.set_header([
            "suite",
            "rows",
            "same",
            "better",
            "because parry is",
            "contract",
            "worse",
            "both wrong",
            "ours late",
            "parry late",
        ]);
        Table {
            title: format!("{function}, {number}"),
            rows,
        }
    }

    pub(crate) fn push(&mut self, suite: &str, tally: &Tally) {
        let worse = match tally.worse.count() {
            0 => "0".to_owned(),
            n => format!("{n}: {}", tally.worse),
        };
        self.rows.add_row([
            suite.to_owned(),
            tally.rows.to_string(),
            tally.same.to_string(),
            tally.better.count().to_string(),
            tally.better.to_string(),
            tally.contract.to_string(),
            worse,
            tally.both_wrong.to_string(),
            tally.ours_late.to_string(),
            tally.theirs_late.to_string(),
        ]);
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}\n{}", self.title, self.rows)
    }
}
