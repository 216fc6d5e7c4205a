//! The pairs of a cell with their own clearance, and the pairs that may touch.

use super::values::values;
use anyhow::{Context, Result, bail};
use rigid_ccd_robot::Cell;
use serde::Deserialize;
use std::collections::BTreeSet;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Clearance {
    between: Vec<String>,
    distance: f64,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct AllowedContact {
    between: Vec<String>,
}

/// The pairs that have a clearance so far; the names of a pair are sorted.
#[derive(Default)]
pub(super) struct PairsWithClearance<'f>(BTreeSet<[&'f str; 2]>);

impl<'f> PairsWithClearance<'f> {
    /// Sets clearances.
    ///
    /// # Errors
    /// If a name is not in the cell, or a pair has two clearances.
    pub(super) fn set(cell: &mut Cell, clearances: &'f [Clearance]) -> Result<Self> {
        let mut pairs = PairsWithClearance::default();
        for Clearance { between, distance } in clearances {
            let mut set = || -> Result<()> {
                let [a, b]: &[String; 2] = values("between", between)?;
                if !pairs.0.insert(ordered([a, b])) {
                    bail!("this pair has another clearance, too; give it one");
                }
                let pair = [cell.item_named(a)?, cell.item_named(b)?];
                Ok(cell.set_clearance(pair, *distance)?)
            };
            set().with_context(|| format!("clearance between {}", between.join(", ")))?;
        }
        Ok(pairs)
    }

    /// Allows contacts.
    ///
    /// # Errors
    /// If a name is not in the cell, or a pair has a clearance.
    pub(super) fn allow(&self, cell: &mut Cell, allowed: &[AllowedContact]) -> Result<()> {
        for AllowedContact { between } in allowed {
            let mut allow = || -> Result<()> {
                let [a, b]: &[String; 2] = values("between", between)?;
                self.refuse([a, b])?;
                let pair = [cell.item_named(a)?, cell.item_named(b)?];
                Ok(cell.allow_contact(pair)?)
            };
            allow().with_context(|| format!("allowed {}", between.join(", ")))?;
        }
        Ok(())
    }

    /// Refuses a pair that may touch if it has a clearance.
    pub(super) fn refuse(&self, pair: [&str; 2]) -> Result<()> {
        if self.0.contains(&ordered(pair)) {
            bail!("this pair has a [[clearance]], too; it either keeps a distance or may touch");
        }
        Ok(())
    }
}

fn ordered([a, b]: [&str; 2]) -> [&str; 2] {
    if a < b { [a, b] } else { [b, a] }
}
