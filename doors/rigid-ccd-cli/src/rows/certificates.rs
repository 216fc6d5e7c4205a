//! `--certificates`: machine-checkable proofs of answers, as files in a folder.

use crate::files::output::OutputError;
use crate::rows::resumable::Checkpoint;
use anyhow::{Context, Result, bail};
use ccd_core::{Answer, Outcome};
use ccd_file::Claim;
use ccd_prove::{Body, NotProven, Proof, ProvenCell, ProvenPair};
use ccd_tables::batch::BodyPair;
use ccd_tables::motions::Motions;
use rigid_ccd::{Question, Settings};
use rigid_ccd_robot::{Cell, CellSolver};
use std::path::{Path, PathBuf};
use std::{fs, io};

/// A folder of certificates, to which one run at a time writes.
pub(crate) struct CertificateFolder {
    path: PathBuf,
    /// Keeps other runs out of the folder.
    _claim: Claim,
}

/// The row of a table that a proof is about, and the number of the segment if the row begins a path of several segments.
pub(crate) type ProvenRow = (usize, Option<usize>);

impl CertificateFolder {
    fn create(path: &Path) -> Result<Self, OutputError> {
        let claim = fs::create_dir_all(path).and_then(|()| Claim::new(path.join("certificates")));
        Ok(CertificateFolder {
            path: path.to_owned(),
            _claim: claim.map_err(|source| OutputError::error_for_path(path, source))?,
        })
    }

    /// Writes the meshes that the proofs of a run are about. A run that continues an earlier one requires them instead.
    fn begin_or_resume<'b>(
        &self,
        bodies: impl Iterator<Item = (String, &'b Body)>,
        earlier: Option<Checkpoint>,
    ) -> Result<()> {
        match earlier {
            Some(earlier) if earlier.counts.row_count() > 0 => self.require_bodies(bodies),
            _ => self.write_bodies(bodies),
        }
    }

    /// Writes meshes as `NAME.mesh`, and the certificates of their trees as `NAME.body`.
    ///
    /// # Errors
    /// If the folder has another mesh of the same name: without it, its proofs could not be checked.
    fn write_bodies<'b>(&self, bodies: impl Iterator<Item = (String, &'b Body)>) -> Result<()> {
        for (path, bytes) in bodies.flat_map(|named| self.files_of(named)) {
            match ccd_file::read(&path) {
                Ok(content) if content == bytes => {}
                Err(error) if error.kind() == io::ErrorKind::NotFound => {
                    self.write(&path, bytes)?;
                }
                Ok(_) => bail!(
                    "--certificates: {} is of other bodies, whose proofs need it; give another folder",
                    path.display()
                ),
                Err(error) => {
                    return Err(error)
                        .with_context(|| format!("--certificates {}", path.display()));
                }
            }
        }
        Ok(())
    }

    /// Refuses a folder that does not have the meshes of a run that is continued.
    fn require_bodies<'b>(&self, bodies: impl Iterator<Item = (String, &'b Body)>) -> Result<()> {
        for (path, bytes) in bodies.flat_map(|named| self.files_of(named)) {
            if !ccd_file::read(&path).is_ok_and(|content| content == bytes) {
                bail!(
                    "--resume: {} does not have the proofs of the earlier run; give the same folder, or omit --resume to \
                     start over",
                    self.path.display()
                );
            }
        }
        Ok(())
    }

    fn files_of<'b>(&self, (name, body): (String, &'b Body)) -> [(PathBuf, &'b [u8]); 2] {
        let path = |ending| self.path.join(format!("{name}.{ending}"));
        [
            (path("mesh"), body.mesh()),
            (path("body"), body.certificate()),
        ]
    }

    /// Writes the proof of a row to the file that [`proof_file_name`] names.
    pub(crate) fn write_proof(
        &self,
        row: ProvenRow,
        id: &str,
        proof: &Proof,
    ) -> Result<(), OutputError> {
        self.write(&self.path.join(proof_file_name(row, id)), &proof.bytes)
    }

    fn write(&self, path: &Path, bytes: &[u8]) -> Result<(), OutputError> {
        ccd_file::write(path, |out| out.write_all(bytes))
            .map_err(|source| OutputError::error_for_path(path, source))
    }
}

/// The greatest number of bytes of an id in the name of a file.
const MAX_ID_BYTES: usize = 100;

/// Returns the name of the file with the proof of a row: `ROW-ID.proof`, or `ROW.SEGMENT-ID.proof`. The numbers alone
/// make the name unique in a table. The id is for readers: characters that a file name cannot have become `_`, and a
/// long id is cut.
fn proof_file_name((row, segment): ProvenRow, id: &str) -> String {
    let allowed_or_underscore = |c: char| {
        if c.is_alphanumeric() || "._-+".contains(c) {
            c
        } else {
            '_'
        }
    };
    let number = row.to_string();
    let segment = segment.map_or(String::new(), |segment| format!(".{segment}"));
    if id == number {
        return format!("{number}{segment}.proof");
    }
    let mut id: String = id.chars().map(allowed_or_underscore).collect();
    id.truncate(id.floor_char_boundary(MAX_ID_BYTES));
    format!("{number}{segment}-{id}.proof")
}

/// Two bodies in the form for proofs, and the folder of their proofs.
pub(crate) struct PairCertificates {
    pub(crate) folder: CertificateFolder,
    bodies: ProvenPair,
    settings: Settings,
}

impl PairCertificates {
    /// Prepares both bodies.
    pub(crate) fn new(folder: &Path, pair: BodyPair<'_>, settings: Settings) -> Result<Self> {
        let bodies = ProvenPair::new(pair.a, pair.b).context("--certificates")?;
        Ok(PairCertificates {
            folder: CertificateFolder::create(folder)?,
            bodies,
            settings,
        })
    }

    /// Writes both meshes, or requires the meshes of the earlier run that this run continues.
    pub(crate) fn begin_or_resume(&self, earlier: Option<Checkpoint>) -> Result<()> {
        let names = ["a", "b"].map(str::to_owned).into_iter();
        (self.folder).begin_or_resume(names.zip(self.bodies.meshes()), earlier)
    }

    /// Proves an answer to a question about the first contact or about any contact; `None` if there is nothing to prove.
    pub(crate) fn prove(
        &self,
        motions: &Motions,
        (question, answer): (Question, &Answer),
    ) -> Option<Result<Proof, NotProven>> {
        // Any contact need not be the first one.
        let is_proven = question == Question::FirstContact
            || !matches!(answer.outcome, Outcome::Contact { .. });
        let bodies = [motions.a, motions.b];
        is_proven.then(|| {
            self.bodies
                .prove(bodies, motions.duration, &self.settings, answer)
        })?
    }
}

/// The bodies of a cell in the form for proofs, and the folder of their proofs.
pub(crate) struct CellCertificates<'c> {
    pub(crate) folder: CertificateFolder,
    cell: ProvenCell<'c>,
    settings: Settings,
}

impl<'c> CellCertificates<'c> {
    /// Prepares all bodies of a cell.
    pub(crate) fn new(folder: &Path, cell: &'c Cell, settings: Settings) -> Result<Self> {
        let proven = ProvenCell::new(cell).context("--certificates")?;
        Ok(CellCertificates {
            folder: CertificateFolder::create(folder)?,
            cell: proven,
            settings,
        })
    }

    /// Writes all meshes, or requires the meshes of the earlier run that this run continues.
    pub(crate) fn begin_or_resume(&self, earlier: Option<Checkpoint>) -> Result<()> {
        let bodies = self.cell.meshes().enumerate();
        let named = bodies.map(|(number, body)| (format!("body{number}"), body));
        self.folder.begin_or_resume(named, earlier)
    }

    /// Proves that each segment of a path is free until the first contact, and that contact. Returns each proof with the number
    /// of its segment if there are several. A path of one configuration is a segment at rest.
    ///
    /// # Errors
    /// The reason why a segment cannot be proven.
    pub(crate) fn prove(
        &self,
        solver: &mut CellSolver<'_>,
        path: &[Vec<f64>],
    ) -> Result<Vec<(Option<usize>, Proof)>> {
        let answer = solver.first_contact(path)?;
        let resting_segment;
        let segments = match path {
            [only] => {
                resting_segment = [only.clone(), only.clone()];
                &resting_segment
            }
            _ => path,
        };
        let proofs = self.cell.prove_path(segments, &answer, &self.settings)?;
        let number = |segment| (segments.len() > 2).then_some(segment);
        let numbered = proofs.into_iter().enumerate();
        Ok(numbered.map(|(k, proof)| (number(k), proof)).collect())
    }
}

#[cfg(test)]
mod tests;
