//! The table of a scene: a row for each body.

use super::meshes::MeshArgs;
use super::pieces::PiecesArgs;
use super::tell;
use crate::picture::Shown;
use crate::table::motions::MotionTable;
use crate::{Impact, PairError, Scene};
use anyhow::{Context, Result, bail};
use ccd_core::{Body, Config, Motion};
use ccd_decomp::BodySource;
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// The column that names a body.
const BODY: &str = "body";

/// How the bodies of a scene are loaded.
#[derive(Clone, Copy, Debug)]
pub(super) struct SceneArgs<'a> {
    pub(super) meshes: &'a MeshArgs,
    pub(super) pieces: &'a PiecesArgs,
}

/// The bodies of a scene.
pub(super) struct SceneTable {
    /// By description.
    bodies: HashMap<String, Body>,
    files: Vec<PathBuf>,
    /// What was found about each.
    reports: Vec<String>,
    rows: Vec<Row>,
}

/// A body of a scene.
struct Row {
    /// What it is.
    text: String,
    id: String,
    /// The id, with what it is if the id is a number.
    name: String,
    motion: Motion,
}

/// Reads a table, and loads each body once.
pub(super) fn read(path: &Path, how: SceneArgs<'_>) -> Result<SceneTable> {
    let name = || path.display().to_string();
    let (described, table) = read_motions(path)?;
    if table.rows.is_empty() {
        bail!("{}: has no bodies", name());
    }
    let mut scene = SceneTable {
        bodies: HashMap::new(),
        files: Vec::new(),
        reports: Vec::new(),
        rows: Vec::new(),
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

/// Reads a table as descriptions of bodies beside motions.
fn read_motions(path: &Path) -> Result<(Vec<String>, MotionTable)> {
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
    if header.iter().any(|column| column == "duration") {
        bail!(
            "{}: all motions of a scene end together: give --duration in place of the column",
            name()
        );
    }
    // The other columns are those of body A in a table of motions.
    let mut motions = csv::Writer::from_writer(Vec::new());
    let others = |record: &csv::StringRecord, prefix: &dyn Fn(&str) -> String| -> Vec<String> {
        let cells = record.iter().enumerate().filter(|(k, _)| *k != column);
        cells.map(|(_, cell)| prefix(cell)).collect()
    };
    let prefixed = |cell: &str| match cell {
        "id" => cell.to_owned(),
        _ => format!("a_{cell}"),
    };
    motions.write_record(others(&header, &prefixed))?;
    let mut described = Vec::new();
    for record in reader.records() {
        let record = record.with_context(|| {
            format!(
                "{}: a body with commas in it is quoted: \"box:1,1,0.1\"",
                name()
            )
        })?;
        described.push(record.get(column).unwrap_or_default().to_owned());
        motions.write_record(others(&record, &str::to_owned))?;
    }
    // The columns have no prefix here.
    let plain = |error: String| error.replace("`a_", "`").replace("column a_", "column ");
    let table = match MotionTable::read(motions.into_inner()?.as_slice()) {
        Ok(table) => table,
        Err(error) => bail!("{}: {}", name(), plain(error.to_string())),
    };
    if let Some(error) = table.errors.first() {
        bail!("{}: {}", name(), plain(error.to_string()));
    }
    Ok((described, table))
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

    /// Returns the files that were read, each with what names it.
    pub(super) fn files(&self) -> impl Iterator<Item = (&'static str, &Path)> {
        let files = self.files.iter();
        files.map(|path| ("a body of the scene", path.as_path()))
    }

    /// Prints what was found about each body.
    pub(super) fn report(&self) {
        for report in &self.reports {
            tell(report);
        }
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
    pub(super) fn contacts(&self, config: Config, duration: f64) -> Vec<Result<Impact, PairError>> {
        let mut scene = Scene::new().with_config(config);
        for body in self.shown() {
            scene.add(body.body, body.motion);
        }
        scene.contacts(duration)
    }
}
