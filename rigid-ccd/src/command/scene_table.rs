//! The table of a scene: one row for each body.

use super::meshes::MeshArgs;
use super::pieces::PiecesArgs;
use super::{complain, complain_of, print_line};
use crate::picture::Shown;
use crate::scene::{Impact, PairError};
use crate::table::motions::{MotionTable, Motions, RowPosition, TableError};
use crate::text::Number;
use crate::{Remark, Scene};
use anyhow::{Context, Result, bail};
use ccd_core::order::lesser;
use ccd_core::{Body, Motion, Settings};
use ccd_decomp::BodySource;
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// The column that names a body.
const BODY: &str = "body";

/// The default end of all motions.
const DURATION: f64 = 1.0;

/// The options for loading a scene.
#[derive(Clone, Copy, Debug)]
pub(super) struct SceneArgs<'a> {
    pub(super) meshes: &'a MeshArgs,
    pub(super) pieces: &'a PiecesArgs,
    /// The end of all motions, if given.
    pub(super) duration: Option<f64>,
}

/// The bodies of a scene.
pub(super) struct SceneTable {
    /// The bodies, by their descriptions.
    bodies: HashMap<String, Body>,
    files: Vec<PathBuf>,
    /// The messages from loading the bodies.
    reports: Vec<String>,
    /// The remarks about the motions.
    remarks: Vec<Remark>,
    rows: Vec<Row>,
    /// The end of all motions.
    pub(super) duration: f64,
    /// Whether the duration is the default.
    is_usual: bool,
}

/// A body of a scene.
struct Row {
    /// The description of the body.
    text: String,
    id: String,
    /// The id, with the description if the id is a number.
    name: String,
    motion: Motion,
}

/// Reads a table, and loads each distinct body once.
pub(super) fn read(path: &Path, how: SceneArgs<'_>) -> Result<SceneTable> {
    let name = || path.display().to_string();
    let duration = how.duration.unwrap_or(DURATION);
    let (described, table) = read_motions(path, duration)?;
    if table.rows.is_empty() {
        bail!("{}: has no bodies", name());
    }
    if let Some(problem) = duplicate_ids(&table.rows) {
        bail!("{}: {problem}", name());
    }
    let mut scene = SceneTable {
        bodies: HashMap::new(),
        files: Vec::new(),
        reports: Vec::new(),
        remarks: table.remarks,
        rows: Vec::new(),
        duration,
        is_usual: how.duration.is_none(),
    };
    for (text, (position, query)) in described.into_iter().zip(table.rows) {
        scene
            .load(&text, how)
            .with_context(|| format!("{}: line {}", name(), position.line))?;
        let name = match query.id.parse::<usize>() {
            Ok(_) => format!("{} {}", query.id, text),
            Err(_) => query.id.clone(),
        };
        scene.rows.push(Row {
            text,
            id: query.id,
            name,
            motion: query.a,
        });
    }
    Ok(scene)
}

/// Names the rows with the same id, which contacts could not distinguish.
fn duplicate_ids(rows: &[(RowPosition, Motions)]) -> Option<String> {
    let mut known: HashMap<&str, RowPosition> = HashMap::new();
    rows.iter().find_map(|(position, query)| {
        let first = known.insert(&query.id, *position)?;
        let [one, other] =
            [first, *position].map(|RowPosition { row, line }| format!("row {row} (line {line})"));
        Some(format!(
            "{one} and {other} have the same id {:?}; give each body its own",
            query.id
        ))
    })
}

/// Reads a table as descriptions of bodies and their motions.
fn read_motions(path: &Path, duration: f64) -> Result<(Vec<String>, MotionTable)> {
    let name = || path.display().to_string();
    let mut reader = csv::ReaderBuilder::new()
        .trim(csv::Trim::All)
        .from_path(path)
        .with_context(name)?;
    let header = reader.headers().with_context(name)?.clone();
    let Some(column) = header.iter().position(|column| column == BODY) else {
        bail!(
            "{}: has no column `{BODY}`; a table of motions is shown with --a, --b and --motions",
            name()
        );
    };
    if let Some(time) = header.iter().find(|column| TIMES.contains(column)) {
        bail!(
            "{}: all motions of a scene end together: give --duration in place of the column `{time}`",
            name()
        );
    }
    // The other columns are those of body A in a table of motions, with a common duration.
    let mut motions = csv::Writer::from_writer(Vec::new());
    let others = |record: &csv::StringRecord, prefix: &dyn Fn(&str) -> String| -> Vec<String> {
        let cells = record.iter().enumerate().filter(|(k, _)| *k != column);
        cells.map(|(_, cell)| prefix(cell)).collect()
    };
    let prefixed = |cell: &str| match cell {
        "id" => cell.to_owned(),
        _ => format!("a_{cell}"),
    };
    let mut names = others(&header, &prefixed);
    names.push("duration".to_owned());
    motions.write_record(names)?;
    let mut described = Vec::new();
    for record in reader.records() {
        let record = record.with_context(|| {
            format!(
                "{}: a body with commas in it is quoted: \"box:1,1,0.1\"",
                name()
            )
        })?;
        described.push(record.get(column).unwrap_or_default().to_owned());
        let mut cells = others(&record, &str::to_owned);
        cells.push(Number(duration).to_string());
        motions.write_record(cells)?;
    }
    let table = match MotionTable::read(motions.into_inner()?.as_slice()) {
        Ok(table) => table,
        Err(error) => bail!("{}: {}", name(), reworded(&error)),
    };
    if let Some(error) = table.errors.first() {
        bail!("{}: {}", name(), without_prefix(&error.to_string()));
    }
    Ok((described, table))
}

/// Likely names of a column of times, which a scene does not have.
const TIMES: [&str; 3] = ["duration", "t", "time"];

/// Rewords an error of a table of motions for the table of a scene.
fn reworded(error: &TableError) -> String {
    match error {
        TableError::UnknownColumn {
            column,
            nearest: None,
            ..
        } => without_prefix(&format!(
            "header: unknown column `{column}`; known columns of a scene are body, id, px py pz, qw qx qy qz, vx vy vz, \
             wx wy wz, end_px end_py end_pz, end_qw end_qx end_qy end_qz, cx cy cz"
        )),
        error => without_prefix(&error.to_string()),
    }
}

/// Removes the prefix of body A from column names in a message, because a scene has none.
fn without_prefix(error: &str) -> String {
    let error = error.replace("column duration", "--duration");
    let words = error.split_inclusive([' ', '`']);
    words
        .map(|word| word.strip_prefix("a_").unwrap_or(word))
        .collect()
}

impl SceneTable {
    fn load(&mut self, text: &str, how: SceneArgs<'_>) -> Result<()> {
        if self.bodies.contains_key(text) {
            return Ok(());
        }
        let source: BodySource = text.parse()?;
        let detail = how.pieces.detail()?;
        let prepared = source.load_adjusted(&how.meshes.adjustments(), detail)?;
        self.reports.push(format!("{text}: {}", prepared.report));
        self.bodies.insert(text.to_owned(), prepared.body);
        self.files.extend(source.files()?);
        Ok(())
    }

    /// Returns the files that were read, each with its option or body.
    pub(super) fn files(&self) -> impl Iterator<Item = (&'static str, &Path)> {
        let files = self.files.iter();
        files.map(|path| ("a body of the scene", path.as_path()))
    }

    /// Prints the messages about the bodies, the duration and the remarks.
    pub(super) fn report(&self, tolerance: f64) {
        for report in &self.reports {
            print_line(report);
        }
        if self.is_usual {
            complain(&format!(
                "without --duration, all motions end at {}",
                self.duration
            ));
        }
        let sizes = self.bodies.values().map(Remark::size);
        let least = sizes.filter(|&size| size > 0.0).fold(f64::INFINITY, lesser);
        let remarks = self.remarks.iter().copied();
        complain_of(remarks.chain(Remark::of_tolerance(tolerance, [least; 2])));
    }

    /// Returns the bodies in the order of their rows.
    pub(super) fn shown(&self) -> Vec<Shown<'_>> {
        let shown = self.rows.iter().filter_map(|row| {
            let body = self.bodies.get(&row.text)?;
            Some(Shown {
                name: &row.name,
                body,
                motion: row.motion,
            })
        });
        shown.collect()
    }

    /// Returns the ids of the bodies, in the order of their rows.
    pub(super) fn ids(&self) -> impl Iterator<Item = &str> {
        self.rows.iter().map(|row| row.id.as_str())
    }

    /// Finds the first contact of each pair of bodies that touch, in order of time.
    pub(super) fn contacts(&self, settings: Settings) -> Vec<Result<Impact, PairError>> {
        let mut scene = Scene::new().with_settings(settings);
        for body in self.shown() {
            scene.add(body.body, body.motion);
        }
        scene.contacts(self.duration)
    }
}
