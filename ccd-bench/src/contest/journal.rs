//! What has been measured so far, on disk, so that an interrupted evaluation goes on where it stopped.

use crate::measured::{Cell, Trial, read, write};
use serde::Serialize;
use std::collections::HashSet;
use std::fs::{self, OpenOptions};
use std::path::{Path, PathBuf};

/// `chart.csv` and `trials.csv` in a folder, grown by one cell at a time.
pub struct Journal {
    cells: Vec<Cell>,
    trials: Vec<Trial>,
    done: HashSet<(String, String, u64)>,
    folder: PathBuf,
}

/// Why a journal cannot be kept.
#[derive(Debug, thiserror::Error)]
#[error("{}: {source}", path.display())]
pub struct JournalError {
    path: PathBuf,
    source: csv::Error,
}

/// Says what the figures of a folder were measured with.
const STAMP: &str = "measured-with.txt";
const CHART: &str = "chart.csv";
const TRIALS: &str = "trials.csv";

impl Journal {
    /// Opens the one in a folder, and keeps what it holds when that was measured with the same stamp.
    ///
    /// # Errors
    /// [`JournalError`] when the folder cannot be written to.
    pub fn open(folder: &Path, stamp: &str) -> Result<Self, JournalError> {
        fs::create_dir_all(folder).map_err(|e| failed(folder)(e.into()))?;
        let stamp_file = folder.join(STAMP);
        let same = fs::read_to_string(&stamp_file).is_ok_and(|kept| kept == stamp);
        let journal = match same {
            true => Journal::read(folder),
            false => Journal::empty(folder),
        };
        fs::write(&stamp_file, stamp).map_err(|e| failed(&stamp_file)(e.into()))?;
        for (name, written) in [
            (CHART, write(&folder.join(CHART), &journal.cells)),
            (TRIALS, write(&folder.join(TRIALS), &journal.trials)),
        ] {
            written.map_err(failed(&folder.join(name)))?;
        }
        Ok(journal)
    }

    /// What a folder holds, whatever it was measured with.
    pub fn read(folder: &Path) -> Self {
        // A file that was cut off while it was written is begun anew.
        let mut cells: Vec<Cell> = read(&folder.join(CHART)).unwrap_or_default();
        let mut trials: Vec<Trial> = read(&folder.join(TRIALS)).unwrap_or_default();
        // Trials are written before their cell, so that a cell stands for all of its trials.
        let counted = |cell: &Cell| trials.iter().filter(|t| is_of(t, cell)).count();
        cells.retain(|cell| counted(cell) == cell.rows);
        let done: HashSet<_> = cells.iter().map(key).collect();
        trials
            .retain(|t| done.contains(&(t.scene.clone(), t.method.clone(), t.tolerance.to_bits())));
        Journal {
            cells,
            trials,
            done,
            folder: folder.to_owned(),
        }
    }

    fn empty(folder: &Path) -> Self {
        Journal {
            cells: Vec::new(),
            trials: Vec::new(),
            done: HashSet::new(),
            folder: folder.to_owned(),
        }
    }

    /// Whether a cell has been measured.
    pub fn has(&self, scene: &str, method: &str, tolerance: f64) -> bool {
        let key = (scene.to_owned(), method.to_owned(), tolerance.to_bits());
        self.done.contains(&key)
    }

    /// Adds a cell and its trials, on disk too.
    ///
    /// # Errors
    /// When they cannot be written.
    pub fn add(&mut self, cell: Cell, trials: Vec<Trial>) -> Result<(), JournalError> {
        let (trials_file, chart_file) = (self.folder.join(TRIALS), self.folder.join(CHART));
        append(&trials_file, &trials).map_err(failed(&trials_file))?;
        append(&chart_file, std::slice::from_ref(&cell)).map_err(failed(&chart_file))?;
        self.done.insert(key(&cell));
        self.cells.push(cell);
        self.trials.extend(trials);
        Ok(())
    }

    /// All cells so far, in the order in which they were measured.
    pub fn cells(&self) -> &[Cell] {
        &self.cells
    }

    /// All trials so far.
    pub fn trials(&self) -> &[Trial] {
        &self.trials
    }
}

fn key(cell: &Cell) -> (String, String, u64) {
    (
        cell.scene.clone(),
        cell.method.clone(),
        cell.tolerance.to_bits(),
    )
}

fn is_of(trial: &Trial, cell: &Cell) -> bool {
    (&trial.scene, &trial.method, trial.tolerance) == (&cell.scene, &cell.method, cell.tolerance)
}

fn failed(path: &Path) -> impl Fn(csv::Error) -> JournalError {
    let path = path.to_owned();
    move |source| JournalError {
        path: path.clone(),
        source,
    }
}

fn append<T: Serialize>(path: &Path, rows: &[T]) -> Result<(), csv::Error> {
    let file = OpenOptions::new().append(true).open(path)?;
    let mut writer = csv::WriterBuilder::new()
        .has_headers(file.metadata()?.len() == 0)
        .from_writer(file);
    for row in rows {
        writer.serialize(row)?;
    }
    writer.flush()?;
    Ok(())
}
