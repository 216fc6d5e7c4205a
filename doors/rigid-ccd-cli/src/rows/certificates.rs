//! `--certificates`: machine-checkable proofs of answers, as files in a folder.

use crate::files::output::OutputError;
use crate::rows::resumable::Checkpoint;
use anyhow::{Context, Result, bail};
use ccd_core::{Answer, Outcome};
use ccd_file::Claim;
use ccd_prove::{Body, NotProven, Proof, ProvenCell, ProvenPair};
use ccd_tables::batch::BodyPair;
use ccd_tables::motions::Motions;
use rigid_ccd::Question;
use rigid_ccd::Settings;
use rigid_ccd_robot::{Cell, CellSolver};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// A folder of certificates, to which one run at a time writes.
pub(crate) struct CertificateFolder {
    path: PathBuf,
    /// Keeps other runs out of the folder.
    _claim: Claim,
}

/// What a proof is about: a row of a table, and a segment if the row begins a path of several.
pub(crate) type ProvenRow = (usize, Option<usize>);

impl CertificateFolder {
    fn create(path: &Path) -> Result<Self, OutputError> {
        let claim = fs::create_dir_all(path).and_then(|()| Claim::new(path.join("certificates")));
        Ok(CertificateFolder {
            path: path.to_owned(),
            _claim: claim.map_err(|source| OutputError::error_for_path(path, source))?,
        })
    }

    /// Writes meshes as `NAME.mesh`, and the certificates of their trees as `NAME.body`.
    ///
    /// # Errors
    /// If the folder has another mesh of a name: its proofs would be lost with it.
    fn write_bodies<'b>(&self, bodies: impl Iterator<Item = (String, &'b Body)>) -> Result<()> {
        for (path, bytes) in bodies.flat_map(|named| self.files_of(named)) {
            match ccd_file::read(&path) {
                Ok(there) if there == bytes => {}
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
            if !ccd_file::read(&path).is_ok_and(|there| there == bytes) {
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

    /// Writes the proof of a row as [`proof_file_name`] says.
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

/// Returns the name of the file with the proof of a row: `ROW-ID.proof`, or `ROW.SEGMENT-ID.proof`. The numbers alone tell all
/// proofs of a table apart. The id is for people: characters that a file name may not have are `_`, and a long id is cut.
fn proof_file_name((row, segment): ProvenRow, id: &str) -> String {
    let keep = |c: char| {
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
    let mut id: String = id.chars().map(keep).collect();
    id.truncate(id.floor_char_boundary(MAX_ID_BYTES));
    format!("{number}{segment}-{id}.proof")
}

/// The certificates of a run over the rows of a table.
pub(crate) trait RunCertificates {
    /// Writes the meshes that the proofs are about.
    fn begin(&self) -> Result<()>;

    /// Requires that an earlier run has written the meshes, which this run continues.
    fn resume(&self) -> Result<()>;
}

impl RunCertificates for PairCertificates {
    fn begin(&self) -> Result<()> {
        self.folder.write_bodies(self.named_bodies())
    }

    fn resume(&self) -> Result<()> {
        self.folder.require_bodies(self.named_bodies())
    }
}

impl RunCertificates for CellCertificates<'_> {
    fn begin(&self) -> Result<()> {
        self.folder.write_bodies(self.named_bodies())
    }

    fn resume(&self) -> Result<()> {
        self.folder.require_bodies(self.named_bodies())
    }
}

impl<C: RunCertificates> RunCertificates for Option<C> {
    fn begin(&self) -> Result<()> {
        self.as_ref().map_or(Ok(()), C::begin)
    }

    fn resume(&self) -> Result<()> {
        self.as_ref().map_or(Ok(()), C::resume)
    }
}

/// Begins or resumes certificates, as a run has begun or continues.
pub(crate) fn begin_or_resume(
    certificates: &impl RunCertificates,
    earlier: Option<Checkpoint>,
) -> Result<()> {
    match earlier {
        Some(earlier) if earlier.counts.row_count() > 0 => certificates.resume(),
        _ => certificates.begin(),
    }
}

/// Two bodies as proofs take them, and the folder for these.
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

    fn named_bodies(&self) -> impl Iterator<Item = (String, &Body)> {
        let names = ["a", "b"].map(str::to_owned).into_iter();
        names.zip(self.bodies.meshes())
    }

    /// Proves an answer to a question about the first contact, or about any; `None` if there is nothing to prove.
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

/// The bodies of a cell as proofs take them, and the folder for these.
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

    fn named_bodies(&self) -> impl Iterator<Item = (String, &Body)> {
        let bodies = self.cell.meshes().enumerate();
        bodies.map(|(number, body)| (format!("body{number}"), body))
    }

    /// Proves that each segment of a path is free until the first contact, and that contact. Returns each proof with the number
    /// of its segment if there are several. A path of one configuration is a segment at rest.
    ///
    /// # Errors
    /// Why a segment cannot be proven.
    pub(crate) fn prove(
        &self,
        solver: &mut CellSolver<'_>,
        path: &[Vec<f64>],
    ) -> Result<Vec<(Option<usize>, Proof)>> {
        let answer = solver.first_contact(path)?;
        let at_rest;
        let segments = match path {
            [only] => {
                at_rest = [only.clone(), only.clone()];
                &at_rest
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
mod tests {
    use super::proof_file_name;
    use std::collections::BTreeSet;

    /// Ids that are alike once they are cleaned or cut, equal ids, and those of segments of another row.
    #[test]
    fn no_two_proofs_have_one_name() {
        let long = "é".repeat(400);
        let ids = [
            "a/b", "a_b", "a_b", "", "p", "p-1", "1", "0-p", ".", "..", "a\nb", &long,
        ];
        let mut names = BTreeSet::new();
        for row in 0..30 {
            for id in ids {
                for segment in [None, Some(0), Some(1), Some(11)] {
                    let name = proof_file_name((row, segment), id);
                    assert!(name.len() < 200 && !name.contains(['/', '\n']), "{name}");
                    let own = (row, segment);
                    let other = names
                        .iter()
                        .find(|(of, known)| *known == name && *of != own);
                    assert_eq!(other, None);
                    names.insert((own, name));
                }
            }
        }
        assert_eq!(proof_file_name((3, None), "a/b"), "3-a_b.proof");
        assert_eq!(proof_file_name((3, Some(2)), "p"), "3.2-p.proof");
        assert_eq!(proof_file_name((3, None), "3"), "3.proof");
    }
}
