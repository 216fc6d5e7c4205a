//! Records casts as files for the command `ccd`.

use crate::scene::Scene;
use ccd_core::{Body, Motion, Settings, StartPolicy};
use ccd_tables::motions::{Motions, write};
use rigid_ccd::mesh::{PrepareError, StoreError, StoredBodyContent};
use std::path::{Path, PathBuf};
use std::{fs, io};

/// A cast that the command `ccd` can repeat: both bodies and their motions from the start of the interval on.
///
/// # Guarantee
/// The recording contains the query that the cast sends to the engine, with its tolerance, its slack and its polytopes
/// around round shapes. The command rounds orientations again. It does not ignore bodies that overlap at the start.
#[derive(Clone, Debug)]
pub struct Recording {
    bodies: [Body; 2],
    motions: [Motion; 2],
    duration: f64,
    settings: Settings,
}

/// The error of a recording that cannot be saved.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RecordError {
    /// A body has too many pieces.
    #[error(transparent)]
    TooManyPieces(#[from] PrepareError),
    /// A body cannot be written.
    #[error(transparent)]
    BodyWriteFailed(#[from] StoreError),
    /// The folder or the table cannot be written.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// The path of the folder or the file.
        path: PathBuf,
        /// The error of the operating system.
        source: io::Error,
    },
}

impl Recording {
    /// Records the bodies and motions of a scene.
    pub(crate) fn new(scene: &Scene<'_>) -> Self {
        Recording {
            bodies: scene.bodies.map(|body| body.body().clone()),
            motions: scene.motions,
            duration: scene.horizon.duration(),
            settings: scene.settings.clone(),
        }
    }

    /// Writes `a.ccd`, `b.ccd` and `motions.csv` to a folder, and returns the command that repeats the cast. The folder
    /// is created if necessary. Time 0 of the table is the start of the cast. Motions are relative to an observer who
    /// moves with the velocity of the second body.
    ///
    /// # Errors
    /// [`RecordError`].
    pub fn save(&self, folder: impl AsRef<Path>) -> Result<String, RecordError> {
        let folder = folder.as_ref();
        let write_error = |path: &Path| {
            let path = path.to_owned();
            move |source| RecordError::Write { path, source }
        };
        fs::create_dir_all(folder).map_err(write_error(folder))?;
        let [a, b, motions] = ["a.ccd", "b.ccd", "motions.csv"].map(|name| folder.join(name));
        StoredBodyContent::from_body(&self.bodies[0])?.save(&a)?;
        StoredBodyContent::from_body(&self.bodies[1])?.save(&b)?;
        let query = Motions {
            id: "cast".to_owned(),
            a: self.motions[0],
            b: self.motions[1],
            duration: self.duration,
        };
        ccd_file::write(&motions, |out| {
            write(out, &[query]).map_err(io::Error::other)
        })
        .map_err(write_error(&motions))?;
        let Settings {
            tolerance, margin, ..
        } = self.settings;
        let start_option = match self.settings.start_policy {
            StartPolicy::Leave => " --start leave",
            _ => "",
        };
        Ok(format!(
            "ccd query --a {} --b {} --motions {} --tolerance {tolerance:e} --margin {margin:e}{start_option}",
            a.display(),
            b.display(),
            motions.display(),
        ))
    }
}

#[cfg(test)]
mod tests;
