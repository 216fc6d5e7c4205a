//! Makes medians comparable between methods that ran on different rows.
//!
//! A slow method is stopped after a few rows, which may be the easy ones. Its time is then estimated as that of a
//! reference that was asked more, times the median ratio of both over the rows that both were asked.

use crate::run::measured::{MeasurementCell, Trial};
use ccd_tables::batch::median;
use std::collections::HashMap;

/// The key of a row in a table of trials: scene, bits of the tolerance, index of the row.
type RowKey<'a> = (&'a str, u64, usize);

/// The times of the reference method, by row, with which the times of other methods are compared.
#[derive(Debug)]
pub struct ReferenceTimes<'a> {
    reference_method: &'a str,
    trials: &'a [Trial],
    times: HashMap<RowKey<'a>, f64>,
}

impl<'a> ReferenceTimes<'a> {
    /// Collects the times of the method with this name.
    pub fn new(name: &'a str, trials: &'a [Trial]) -> Self {
        let own = trials.iter().filter(|trial| trial.method == name);
        ReferenceTimes {
            reference_method: name,
            trials,
            times: own.map(|trial| (row_key(trial), trial.micros)).collect(),
        }
    }

    /// Returns the median ratio of a method's times to those of the reference, over the rows that both ran on; `None`
    /// without such rows.
    fn median_time_ratio(&self, cell: &MeasurementCell) -> Option<f64> {
        let of_cell = |trial: &&Trial| {
            trial.method == cell.method
                && trial.scene == cell.scene
                && trial.tolerance == cell.tolerance
        };
        let ratios = self.trials.iter().filter(of_cell).filter_map(|trial| {
            let ratio = trial.micros / self.times.get(&row_key(trial))?;
            ratio.is_finite().then_some(ratio)
        });
        let mut ratios: Vec<f64> = ratios.collect();
        (!ratios.is_empty()).then(|| median(&mut ratios))
    }

    /// Returns the cells with every median replaced by a comparable one: the reference's median times the median ratio.
    /// A cell keeps its own where the reference was not asked.
    pub fn cells_with_comparable_medians(&self, cells: &[MeasurementCell]) -> Vec<MeasurementCell> {
        let at = |cell: &&MeasurementCell| cell.method == self.reference_method;
        let medians: HashMap<(&str, u64), f64> = (cells.iter().filter(at))
            .map(|cell| {
                (
                    (cell.scene.as_str(), cell.tolerance.to_bits()),
                    cell.median_us,
                )
            })
            .collect();
        let moved = cells.iter().map(|cell| {
            let here = (cell.scene.as_str(), cell.tolerance.to_bits());
            let median_us = medians.get(&here).zip(self.median_time_ratio(cell));
            MeasurementCell {
                median_us: median_us.map_or(cell.median_us, |(time, ratio)| time * ratio),
                ..cell.clone()
            }
        });
        moved.collect()
    }
}

fn row_key(trial: &Trial) -> RowKey<'_> {
    (&trial.scene, trial.tolerance.to_bits(), trial.row)
}

#[cfg(test)]
mod tests;
