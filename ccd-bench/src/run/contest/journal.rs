//! Stores measurements on disk, so that an interrupted evaluation resumes where it stopped.

use crate::run::measured::{MeasurementCell, Trial, write};
use anyhow::{Context, Result};
use ccd_file::Claim;
use rigid_ccd_cli::print_error;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::collections::{HashMap, HashSet};
use std::fs::{self, OpenOptions};
use std::path::{Path, PathBuf};

/// The measurements in the files `chart.csv` and `trials.csv` of a folder, to which one cell is added at a time.
#[derive(Debug)]
pub struct Journal {
    cells: Vec<MeasurementCell>,
    trials: Vec<Trial>,
    folder: PathBuf,
    /// The claim that keeps other processes from writing to the folder; `None` if the journal is only read.
    _folder_lock: Option<Claim>,
}

/// The name of the file that describes the program and settings of the measurements in a folder.
const FINGERPRINT_FILE: &str = "measured-with.txt";
const CHART_FILE: &str = "chart.csv";
const TRIALS_FILE: &str = "trials.csv";

/// The key of a cell: its scene, its method, and the bits of its tolerance.
type CellKey = (String, String, u64);

impl Journal {
    /// Opens the journal in a folder for writing. Keeps its content if it was measured with the same stamp, and
    /// otherwise moves it aside.
    ///
    /// # Errors
    /// If the folder cannot be written to, or another process writes to it.
    pub fn open(folder: &Path, stamp: &str) -> Result<Self> {
        fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
        let chart = folder.join(CHART_FILE);
        let claim = Claim::new(chart.clone()).with_context(|| chart.display().to_string())?;
        let stamp_file = folder.join(FINGERPRINT_FILE);
        if !fs::read_to_string(&stamp_file).is_ok_and(|kept| kept == stamp) {
            for name in [CHART_FILE, TRIALS_FILE] {
                let path = folder.join(name);
                if path.exists() {
                    let aside = folder.join(format!("{name}.old"));
                    fs::rename(&path, &aside).with_context(|| path.display().to_string())?;
                    let (path, aside) = (path.display(), aside.display());
                    print_error(&format!(
                        "{path} is of another build, or of other settings: it is now {aside}"
                    ));
                }
            }
            ccd_file::write(&stamp_file, |out| out.write_all(stamp.as_bytes()))
                .with_context(|| stamp_file.display().to_string())?;
        }
        let journal = Journal {
            _folder_lock: Some(claim),
            ..Journal::read(folder)
        };
        journal.write_tables()?;
        Ok(journal)
    }

    /// Reads the journal in a folder, whatever settings its measurements were made with.
    pub fn read(folder: &Path) -> Self {
        let mut cells: Vec<MeasurementCell> = read_rows_until_invalid(&folder.join(CHART_FILE));
        let mut trials: Vec<Trial> = read_rows_until_invalid(&folder.join(TRIALS_FILE));
        // Trials are written before their cell, so a cell implies all of its trials.
        let mut counts: HashMap<CellKey, usize> = HashMap::new();
        for trial in &trials {
            *counts.entry(cell_key_of_trial(trial)).or_default() += 1;
        }
        cells.retain(|cell| counts.get(&cell_key(cell)) == Some(&cell.rows));
        let done: HashSet<CellKey> = cells.iter().map(cell_key).collect();
        trials.retain(|trial| done.contains(&cell_key_of_trial(trial)));
        Journal {
            cells,
            trials,
            folder: folder.to_owned(),
            _folder_lock: None,
        }
    }

    /// Returns true if the journal has the cell of this scene, method and tolerance.
    pub fn has_cell(&self, scene: &str, method: &str, tolerance: f64) -> bool {
        let is = |cell: &MeasurementCell| {
            cell.scene == scene && cell.method == method && cell.tolerance == tolerance
        };
        self.cells.iter().any(is)
    }

    /// Adds a cell and its trials to the journal and to its files.
    ///
    /// # Errors
    /// If they cannot be written.
    pub fn add(&mut self, cell: MeasurementCell, trials: Vec<Trial>) -> Result<()> {
        append_rows(&self.folder.join(TRIALS_FILE), &trials)?;
        append_rows(&self.folder.join(CHART_FILE), std::slice::from_ref(&cell))?;
        self.cells.push(cell);
        self.trials.extend(trials);
        Ok(())
    }

    fn write_tables(&self) -> Result<()> {
        write(&self.folder.join(TRIALS_FILE), &self.trials)?;
        write(&self.folder.join(CHART_FILE), &self.cells)
    }

    /// Returns all cells in the journal, in the order of measurement.
    pub fn cells(&self) -> &[MeasurementCell] {
        &self.cells
    }

    /// Returns all trials in the journal.
    pub fn trials(&self) -> &[Trial] {
        &self.trials
    }
}

/// Returns a line of text that identifies this build of the program by a checksum.
pub fn program_fingerprint() -> String {
    let program = std::env::current_exe().and_then(fs::read);
    let program = program.map_or(0, |bytes| crc32fast::hash(&bytes));
    format!("program {program:08x}\n")
}

fn cell_key(cell: &MeasurementCell) -> CellKey {
    let tolerance = cell.tolerance.to_bits();
    (cell.scene.clone(), cell.method.clone(), tolerance)
}

fn cell_key_of_trial(trial: &Trial) -> CellKey {
    let tolerance = trial.tolerance.to_bits();
    (trial.scene.clone(), trial.method.clone(), tolerance)
}

/// Reads the rows of a table up to the first invalid row, which an interruption may have truncated.
fn read_rows_until_invalid<T: DeserializeOwned>(path: &Path) -> Vec<T> {
    let Ok(reader) = csv::Reader::from_path(path) else {
        return Vec::new();
    };
    reader.into_deserialize().map_while(Result::ok).collect()
}

fn append_rows<T: Serialize>(path: &Path, rows: &[T]) -> Result<()> {
    let file = OpenOptions::new().append(true).open(path);
    let file = file.with_context(|| path.display().to_string())?;
    let mut writer = csv::WriterBuilder::new()
        .has_headers(file.metadata()?.len() == 0)
        .from_writer(file);
    for row in rows {
        writer.serialize(row)?;
    }
    writer.flush()?;
    Ok(())
}
