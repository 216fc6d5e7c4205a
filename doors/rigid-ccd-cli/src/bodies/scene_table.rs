//! Reads the table of a scene: one row for each body.

use crate::bodies::meshes::MeshArgs;
use crate::console::{print_error, print_escaped_to_stderr, print_remarks};
use crate::files::{input_name, open_table, refuse_overwriting_input};
use crate::picture::DrawnBody;
use anyhow::{Context, Result, anyhow, bail};
use ccd_core::order::lesser;
use ccd_core::{Body, Settings};
use ccd_decomp::BodySource;
use ccd_tables::columns::{BODY_COLUMN_NAME, Columns, TableKind};
use ccd_tables::motions::{BodyRow, RowPosition, RowProblem, body_row};
use ccd_tables::records::Records;
use ccd_tables::table_records::TableRecords;
use rigid_ccd::scene::{Impact, PairError};
use rigid_ccd::{Remark, Scene};
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// The time at which all motions end by default.
const DEFAULT_DURATION: f64 = 1.0;

/// The bodies of a scene, loaded from its table.
pub(crate) struct SceneTable {
    /// The loaded bodies, by their descriptions in the column `body`.
    bodies: HashMap<String, Body>,
    files: Vec<PathBuf>,
    /// The messages from loading the bodies' files.
    load_messages: Vec<String>,
    /// The remarks about probable mistakes in the motions.
    remarks: Vec<Remark>,
    rows: Vec<BodyRow>,
    /// The time at which all motions end.
    pub(crate) duration: f64,
    /// Whether `duration` is the default because none was given.
    is_default_duration: bool,
}

/// Reads the table that the command-line option `option` names, and loads each distinct body once. All motions end at
/// `duration`, or at the default if that is `None`. Refuses an output that would overwrite a file that is read.
pub(crate) fn read(
    (option, path): (&str, &Path),
    (meshes, duration_arg): (&MeshArgs, Option<f64>),
    out: &Path,
) -> Result<SceneTable> {
    refuse_overwriting_input((option, path), ("--out", out))?;
    let name = || input_name(path);
    let duration = duration_arg.unwrap_or(DEFAULT_DURATION);
    let (records, _) = open_table(option, path)?;
    let (rows, remarks) = read_rows(records, duration).with_context(name)?;
    let mut scene = SceneTable {
        bodies: HashMap::new(),
        files: Vec::new(),
        load_messages: Vec::new(),
        remarks,
        rows: Vec::new(),
        duration,
        is_default_duration: duration_arg.is_none(),
    };
    for (position, row) in rows {
        scene
            .load_body_once(&row.body_text, meshes)
            .with_context(|| format!("{}: {position}", name()))?;
        scene.rows.push(row);
    }
    for file in &scene.files {
        refuse_overwriting_input(("a body of the scene", file), ("--out", out))?;
    }
    Ok(scene)
}

/// A parsed row of a table, with its position for messages.
type RowWithPosition = (RowPosition, BodyRow);

/// Reads the rows of a table, and returns them with remarks about probable mistakes.
fn read_rows(
    mut records: TableRecords,
    duration: f64,
) -> Result<(Vec<RowWithPosition>, Vec<Remark>)> {
    let header = records.header()?;
    if !header.iter().any(|column| column == BODY_COLUMN_NAME) {
        bail!(
            "has no column `{BODY_COLUMN_NAME}`; a table of motions is shown with --a, --b and --motions"
        );
    }
    let is_time = |column: &&String| LIKELY_TIME_COLUMNS.contains(&column.as_str());
    if let Some(time) = header.iter().find(is_time) {
        bail!(
            "all motions of a scene end together: give --duration in place of the column `{time}`"
        );
    }
    let columns = Columns::from_header(&header, TableKind::Scene)?;
    let mut rows: Vec<RowWithPosition> = Vec::new();
    while let Some(position) = records.advance()? {
        let row = body_row(&columns, records.current(), position.row, duration);
        let row =
            row.map_err(|problem| anyhow!("{position}: {}", row_problem_message(&problem)))?;
        rows.push((position, row));
    }
    if rows.is_empty() {
        bail!("has no bodies");
    }
    refuse_equal_ids(&rows)?;
    Ok((rows, columns.remarks()))
}

/// Likely names of a column of times; a scene's table with such a column is refused.
const LIKELY_TIME_COLUMNS: [&str; 3] = ["duration", "t", "time"];

/// Returns the message for a bad row of a scene's table, which names the option `--duration` in place of a column.
fn row_problem_message(problem: &RowProblem) -> String {
    let message = problem.to_string().replace("column duration", "--duration");
    match problem {
        RowProblem::WrongCellCount { .. } => {
            format!("{message}; a body with commas in it is quoted: \"box:1,1,0.1\"")
        }
        _ => message,
    }
}

/// Returns an error if two rows have the same id, because the table of contacts names bodies by their ids.
fn refuse_equal_ids(rows: &[RowWithPosition]) -> Result<()> {
    let mut first_positions = HashMap::new();
    for (position, BodyRow { id, .. }) in rows {
        if let Some(first) = first_positions.insert(id, position) {
            bail!("{first} and {position} have the same id {id:?}; give each body its own");
        }
    }
    Ok(())
}

impl SceneTable {
    fn load_body_once(&mut self, text: &str, meshes: &MeshArgs) -> Result<()> {
        if self.bodies.contains_key(text) {
            return Ok(());
        }
        let source: BodySource = text.parse()?;
        let prepared = source.load_adjusted(&meshes.adjustments(), meshes.choice())?;
        self.load_messages
            .push(format!("{text}: {}", prepared.report));
        self.bodies.insert(text.to_owned(), prepared.body);
        self.files.extend(source.file_paths()?);
        Ok(())
    }

    /// Prints the messages from loading, the duration if it is the default, and the remarks.
    pub(crate) fn print_load_report(&self, tolerance: f64) {
        for report in &self.load_messages {
            print_escaped_to_stderr(report);
        }
        if self.is_default_duration {
            let end = self.duration;
            print_error(&format!("without --duration, all motions end at {end}"));
        }
        let sizes = self.bodies.values().map(Remark::body_size);
        let least = sizes.filter(|&size| size > 0.0).fold(f64::INFINITY, lesser);
        let remarks = self.remarks.iter().copied();
        print_remarks(remarks.chain(Remark::remark_on_tolerance(tolerance, [least; 2])));
    }

    /// Returns the bodies to draw, in the order of their rows.
    pub(crate) fn bodies_to_draw(&self) -> Vec<DrawnBody<'_>> {
        let bodies = self.rows.iter().filter_map(|row| {
            let BodyRow {
                id,
                body_text: text,
                motion,
            } = row;
            Some(DrawnBody {
                // A number alone tells little.
                name: match id.parse::<usize>() {
                    Ok(_) => format!("{id} {text}"),
                    Err(_) => id.clone(),
                },
                body: self.bodies.get(text)?,
                motion: *motion,
            })
        });
        bodies.collect()
    }

    /// Returns the ids of the bodies, in the order of their rows.
    pub(crate) fn ids(&self) -> impl Iterator<Item = &str> {
        self.rows.iter().map(|row| row.id.as_str())
    }

    /// Finds the first contact of each pair of bodies that touch, in order of time.
    pub(crate) fn contacts(&self, settings: Settings) -> Vec<Result<Impact, PairError>> {
        let mut scene = Scene::new().with_settings(settings);
        for body in self.bodies_to_draw() {
            scene.add(body.body, body.motion);
        }
        scene.contacts(self.duration)
    }
}
