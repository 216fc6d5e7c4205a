//! Matches the rows of a table with the proofs that hold: by what is stated, whatever the files are called.

use super::subject::Subject;
use crate::console::RunOutcome;
use crate::console::progress::Progress;
use crate::files::output::print_line;
use crate::files::{input_name, open_movement_rows};
use crate::robots::{JointsArgs, PathTable};
use crate::rows::bad_rows::BadRowCounter;
use crate::rows::resumable::RowRange;
use anyhow::{Context, Result, bail};
use ccd_prove::{Statement, Subject as Stated};
use ccd_tables::Excerpt;
use ccd_tables::courses::Movements;
use ccd_tables::motions::{RowError, RowPosition};
use ccd_tables::paths::Grouping;
use rigid_ccd::Question;
use std::collections::BTreeMap;
use std::path::Path;

/// The table whose rows have to be proven.
#[derive(Clone, Copy)]
pub(super) enum AskedTable<'a> {
    /// A table of motions of two bodies.
    Motions(&'a Path),
    /// A table of edges or paths, with the positions of joints that it has no columns for.
    Edges(&'a Path, &'a JointsArgs),
}

/// The proofs that hold, by what they state.
#[derive(Default)]
pub(super) struct Proofs {
    all: Vec<HeldProof>,
    by_subject: BTreeMap<Stated, Vec<usize>>,
}

struct HeldProof {
    name: String,
    statement: Statement,
    is_of_a_row: bool,
}

/// How far a segment of a row is proven.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Extent {
    /// There is no proof.
    Nothing,
    /// Nothing touches before a time, and no contact is proven.
    Part,
    /// Nothing touches before a time at which two points are near each other.
    UntilContact,
    /// Nothing touches.
    Whole,
}

/// A row of the table: for each segment what a proof has to state, if one can.
struct AskedRow {
    position: RowPosition,
    id: String,
    segments: Vec<Option<Statement>>,
}

impl Proofs {
    pub(super) fn add(&mut self, name: &str, statement: Statement) {
        let number = self.all.len();
        self.by_subject
            .entry(statement.subject())
            .or_default()
            .push(number);
        self.all.push(HeldProof {
            name: name.to_owned(),
            statement,
            is_of_a_row: false,
        });
    }

    /// Prints for each asked row of a table which proofs are about it, and which proofs are of no row of the table.
    pub(super) fn match_rows(
        mut self,
        (table, asked): (AskedTable<'_>, RowRange),
        subject: &Subject<'_>,
    ) -> Result<RunOutcome> {
        let mut counts = BTreeMap::new();
        let mut bad_rows = BadRowCounter::new(input_name(table.path()));
        let no_progress = Progress::for_rows(None, true);
        let mut number = 0;
        table.for_each_row(subject, |row| {
            number += 1;
            if !asked.contains(number - 1) {
                // Its proofs are of a row, too.
                let segments = row.iter().flat_map(|row| &row.segments);
                segments.for_each(|wanted| drop(self.best_proof(wanted.as_ref())));
                return Ok(());
            }
            match row {
                Ok(row) => {
                    let extent = self.match_row(&row)?;
                    *counts.entry(extent).or_insert(0) += 1;
                }
                Err(error) => bad_rows.report(error.position, &error.problem, &no_progress),
            }
            Ok(())
        })?;
        bad_rows.print_total();
        let of_no_row = self.all.iter().filter(|proof| !proof.is_of_a_row);
        let of_no_row: Vec<&str> = of_no_row.map(|proof| &*proof.name).collect();
        for name in &of_no_row {
            print_line(&format!("{name}: is of no row"))?;
        }
        let count = |extent| counts.get(&extent).copied().unwrap_or(0);
        let rows: usize = counts.values().sum();
        print_line(&format!(
            "rows: {rows}; proven to the end: {}, until a contact: {}, in part: {}, without a proof: {}; proofs of no row: {}",
            count(Extent::Whole),
            count(Extent::UntilContact),
            count(Extent::Part),
            count(Extent::Nothing),
            of_no_row.len()
        ))?;
        let is_proven = count(Extent::Part) + count(Extent::Nothing) + of_no_row.len() == 0;
        Ok(if bad_rows.count() > 0 || rows == 0 {
            RunOutcome::SomeRowsBad
        } else if is_proven {
            RunOutcome::AllAnswered
        } else {
            RunOutcome::SomeRowsUnproven
        })
    }

    /// Prints which proofs are about a row, and returns how far it is proven.
    fn match_row(&mut self, row: &AskedRow) -> Result<Extent> {
        let mut found = Vec::new();
        let mut extent = Extent::Whole;
        let mut text = String::new();
        for (number, wanted) in row.segments.iter().enumerate() {
            let proof = self.best_proof(wanted.as_ref());
            extent = proof
                .as_ref()
                .map_or(Extent::Nothing, |(extent, _)| *extent);
            let of_segment = if row.segments.len() > 1 {
                format!("segment {number} ")
            } else {
                String::new()
            };
            if let Some((_, name)) = proof {
                found.push(name);
            }
            let Some(wanted) = wanted else {
                text = format!("{of_segment}cannot be stated in a proof");
                break;
            };
            text = match extent {
                Extent::Whole => "to the end".to_owned(),
                Extent::UntilContact => format!("{of_segment}until a contact"),
                Extent::Part => format!("{of_segment}in part, not to {}", wanted.until),
                Extent::Nothing => format!("{of_segment}has no proof"),
            };
            if extent != Extent::Whole {
                break;
            }
        }
        let AskedRow { position, id, .. } = row;
        let names = found.join(" ");
        let gap = if names.is_empty() { "" } else { ": " };
        print_line(&format!("{position} {}: {text}{gap}{names}", Excerpt(id)))?;
        // What is proven of the segments before leaves the row proven in part.
        let has_more = row.segments.len() > 1 && !found.is_empty();
        Ok(if extent == Extent::Nothing && has_more {
            Extent::Part
        } else {
            extent
        })
    }

    /// Returns the proof that says most of a segment; all that are about it are proofs of a row.
    fn best_proof(&mut self, wanted: Option<&Statement>) -> Option<(Extent, String)> {
        let wanted = wanted?;
        let mut best: Option<(Extent, String)> = None;
        for &number in self.by_subject.get(&wanted.subject())? {
            let proof = &mut self.all[number];
            if !proof.statement.keeps_margins_of(wanted) {
                continue;
            }
            proof.is_of_a_row = true;
            let extent = extent(&proof.statement, wanted.until);
            if best.as_ref().is_none_or(|(most, _)| *most < extent) {
                best = Some((extent, proof.name.clone()));
            }
        }
        best
    }
}

/// Returns how far a proof goes of a segment that ends at a time.
fn extent(statement: &Statement, end: f64) -> Extent {
    let witness = statement.witness.as_ref();
    if witness.is_some_and(|witness| witness.time == statement.until) {
        Extent::UntilContact
    } else if statement.until >= end {
        Extent::Whole
    } else {
        Extent::Part
    }
}

impl AskedTable<'_> {
    fn path(&self) -> &Path {
        match self {
            AskedTable::Motions(path) | AskedTable::Edges(path, _) => path,
        }
    }

    /// Calls a function for each row, or with what is wrong with it.
    fn for_each_row(
        self,
        subject: &Subject<'_>,
        mut each: impl FnMut(Result<AskedRow, RowError>) -> Result<()>,
    ) -> Result<()> {
        let name = || input_name(self.path());
        match (self, subject) {
            (AskedTable::Motions(path), Subject::Pair(pair, margin)) => {
                let Some(pair) = pair.proven()? else {
                    bail!("--motions needs --a and --b");
                };
                let grouping = Grouping::of_question(Question::FirstContact);
                let (rows, _) = open_movement_rows(path, grouping)?;
                if rows.is_path_table() {
                    bail!("--motions needs a table of motions, not of paths");
                }
                for row in rows {
                    let row = row.with_context(name)?.map(|(position, movements)| {
                        let wanted = match &movements {
                            Movements::Motions(motions) => {
                                pair.statement([motions.a, motions.b], motions.duration, *margin)
                            }
                            Movements::Path(_) => None,
                        };
                        AskedRow {
                            position,
                            id: movements.id().to_owned(),
                            segments: vec![wanted],
                        }
                    });
                    each(row)?;
                }
            }
            (AskedTable::Edges(path, joints), Subject::Cell(cell, clearance)) => {
                let (table, _) = PathTable::open("--edges", path, cell.cell().robot(), joints)
                    .with_context(name)?;
                for row in table {
                    let row = match row.with_context(name)? {
                        Ok(path) => {
                            let statement = |ends: [&Vec<f64>; 2]| {
                                cell.statement(ends.map(Vec::as_slice), *clearance)
                            };
                            let segments = match &path.configurations[..] {
                                [only] => vec![statement([only, only])?],
                                several => several
                                    .windows(2)
                                    .map(|two| statement([&two[0], &two[1]]))
                                    .collect::<Result<_, _>>()?,
                            };
                            Ok(AskedRow {
                                position: path.position,
                                id: path.id,
                                segments,
                            })
                        }
                        Err(error) => Err(error),
                    };
                    each(row)?;
                }
            }
            // The parser prevents this.
            _ => bail!("--motions needs --a and --b, --edges needs --robot"),
        }
        Ok(())
    }
}
