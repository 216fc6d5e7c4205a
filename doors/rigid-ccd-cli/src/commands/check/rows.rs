//! Matches the rows of a table with the proofs that hold, by the statements of the proofs, not by the names of their files.

use super::subject::Subject;
use crate::console::RunOutcome;
use crate::console::progress::Progress;
use crate::files::output::print_line;
use crate::files::{input_name, open_movement_rows};
use crate::robots::{JointsArgs, PathTable};
use crate::rows::bad_rows::BadRowCounter;
use crate::rows::resumable::RowRange;
use anyhow::{Context, Result, bail};
use ccd_prove::{Statement, Subject as StatementSubject};
use ccd_tables::Excerpt;
use ccd_tables::motions::{RowError, RowPosition};
use ccd_tables::movements::Movements;
use ccd_tables::paths::Grouping;
use rigid_ccd::Question;
use std::collections::BTreeMap;
use std::path::Path;

/// The table whose rows have to be proven.
#[derive(Clone, Copy)]
pub(super) enum TableToProve<'a> {
    /// A table of motions of two bodies.
    Motions(&'a Path),
    /// A table of edges or paths, with the options for joints without columns.
    Edges(&'a Path, &'a JointsArgs),
}

/// The proofs that hold, indexed by the subjects of their statements.
#[derive(Default)]
pub(super) struct Proofs {
    all: Vec<CheckedProof>,
    by_subject: BTreeMap<StatementSubject, Vec<usize>>,
}

struct CheckedProof {
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

/// A row of the table, with the statement that a proof of each segment must have; `None` if no proof can state it.
struct RowToProve {
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
        self.all.push(CheckedProof {
            name: name.to_owned(),
            statement,
            is_of_a_row: false,
        });
    }

    /// Prints for each selected row of a table which proofs are about it, and which proofs belong to no row.
    pub(super) fn match_rows(
        mut self,
        (table, row_range): (TableToProve<'_>, RowRange),
        subject: &Subject<'_>,
    ) -> Result<RunOutcome> {
        let mut counts = BTreeMap::new();
        let mut bad_rows = BadRowCounter::new(input_name(table.path()));
        let no_progress = Progress::for_rows(None, true);
        let mut number = 0;
        table.for_each_row(subject, |row| {
            number += 1;
            if !row_range.contains(number - 1) {
                // Its proofs belong to a row, too.
                let segments = row.iter().flat_map(|row| &row.segments);
                segments.for_each(|expected| drop(self.best_proof(expected.as_ref())));
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
        let proofs_of_no_row = self.all.iter().filter(|proof| !proof.is_of_a_row);
        let proofs_of_no_row: Vec<&str> = proofs_of_no_row.map(|proof| &*proof.name).collect();
        for name in &proofs_of_no_row {
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
            proofs_of_no_row.len()
        ))?;
        let is_proven = count(Extent::Part) + count(Extent::Nothing) + proofs_of_no_row.len() == 0;
        Ok(if bad_rows.count() > 0 || rows == 0 {
            RunOutcome::SomeRowsBad
        } else if is_proven {
            RunOutcome::AllAnswered
        } else {
            RunOutcome::SomeRowsUnproven
        })
    }

    /// Prints which proofs are about a row, and returns how far it is proven.
    fn match_row(&mut self, row: &RowToProve) -> Result<Extent> {
        let mut proof_names = Vec::new();
        let mut extent = Extent::Whole;
        let mut text = String::new();
        for (number, expected) in row.segments.iter().enumerate() {
            let proof = self.best_proof(expected.as_ref());
            extent = proof
                .as_ref()
                .map_or(Extent::Nothing, |(extent, _)| *extent);
            let segment_label = if row.segments.len() > 1 {
                format!("segment {number} ")
            } else {
                String::new()
            };
            if let Some((_, name)) = proof {
                proof_names.push(name);
            }
            let Some(expected) = expected else {
                text = format!("{segment_label}cannot be stated in a proof");
                break;
            };
            text = match extent {
                Extent::Whole => "to the end".to_owned(),
                Extent::UntilContact => format!("{segment_label}until a contact"),
                Extent::Part => format!("{segment_label}in part, not to {}", expected.until),
                Extent::Nothing => format!("{segment_label}has no proof"),
            };
            if extent != Extent::Whole {
                break;
            }
        }
        let RowToProve { position, id, .. } = row;
        let names = proof_names.join(" ");
        let separator = if names.is_empty() { "" } else { ": " };
        print_line(&format!(
            "{position} {}: {text}{separator}{names}",
            Excerpt(id)
        ))?;
        // Earlier segments are proven, so the row is proven in part.
        let has_more = row.segments.len() > 1 && !proof_names.is_empty();
        Ok(if extent == Extent::Nothing && has_more {
            Extent::Part
        } else {
            extent
        })
    }

    /// Returns the name of the proof that covers most of a segment, with its extent. Marks all proofs of the segment as
    /// belonging to a row.
    fn best_proof(&mut self, expected: Option<&Statement>) -> Option<(Extent, String)> {
        let expected = expected?;
        let mut best: Option<(Extent, String)> = None;
        for &number in self.by_subject.get(&expected.subject())? {
            let proof = &mut self.all[number];
            if !proof.statement.keeps_margins_of(expected) {
                continue;
            }
            proof.is_of_a_row = true;
            let extent = extent(&proof.statement, expected.until);
            if best.as_ref().is_none_or(|(most, _)| *most < extent) {
                best = Some((extent, proof.name.clone()));
            }
        }
        best
    }
}

/// Returns how far a proof covers a segment that ends at a time.
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

impl TableToProve<'_> {
    fn path(&self) -> &Path {
        match self {
            TableToProve::Motions(path) | TableToProve::Edges(path, _) => path,
        }
    }

    /// Calls a function for each row, with the row or with its error.
    fn for_each_row(
        self,
        subject: &Subject<'_>,
        mut each: impl FnMut(Result<RowToProve, RowError>) -> Result<()>,
    ) -> Result<()> {
        let name = || input_name(self.path());
        match (self, subject) {
            (TableToProve::Motions(path), Subject::Pair(pair, margin)) => {
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
                        let expected = match &movements {
                            Movements::Motions(motions) => {
                                pair.statement([motions.a, motions.b], motions.duration, *margin)
                            }
                            Movements::Path(_) => None,
                        };
                        RowToProve {
                            position,
                            id: movements.id().to_owned(),
                            segments: vec![expected],
                        }
                    });
                    each(row)?;
                }
            }
            (TableToProve::Edges(path, joints), Subject::Cell(cell, clearance)) => {
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
                                    .map(|ends| statement([&ends[0], &ends[1]]))
                                    .collect::<Result<_, _>>()?,
                            };
                            Ok(RowToProve {
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
