//! `--certificates`: machine-checkable proofs of answers, as files in a folder.

use crate::output::OutputError;
use anyhow::{Context, Result};
use ccd_core::{Answer, Outcome};
use ccd_prove::{Body, NotProven, Proof, ProvenCell, ProvenPair};
use rigid_ccd::Settings;
use rigid_ccd::batch::{BodyPair, Question};
use rigid_ccd::table::motions::Motions;
use rigid_ccd_robot::{Cell, CellSolver};
use std::fs;
use std::path::{Path, PathBuf};

/// A folder of certificates.
pub(crate) struct CertificateFolder(PathBuf);

impl CertificateFolder {
    pub(crate) fn create(path: &Path) -> Result<Self> {
        fs::create_dir_all(path).with_context(|| format!("--certificates {}", path.display()))?;
        Ok(CertificateFolder(path.to_owned()))
    }

    /// Writes a mesh as `NAME.mesh`, and the certificate of its tree as `NAME.body`.
    pub(crate) fn write_body(&self, name: &str, body: &Body) -> Result<(), OutputError> {
        self.write(&format!("{name}.mesh"), body.mesh())?;
        self.write(&format!("{name}.body"), body.certificate())
    }

    /// Writes the proof of a row as `ID.proof`.
    pub(crate) fn write_proof(&self, id: &str, proof: &Proof) -> Result<(), OutputError> {
        // An id may be any text, a file name may not.
        let keep = |c: char| {
            if c.is_alphanumeric() || "._-+".contains(c) {
                c
            } else {
                '_'
            }
        };
        let name: String = id.trim_start_matches('.').chars().map(keep).collect();
        self.write(&format!("{name}.proof"), &proof.bytes)
    }

    fn write(&self, name: &str, bytes: &[u8]) -> Result<(), OutputError> {
        let path = self.0.join(name);
        fs::write(&path, bytes).map_err(|source| OutputError::error_for_path(&path, source))
    }
}

/// Two bodies as proofs take them, and the folder for these.
pub(crate) struct PairCertificates {
    pub(crate) folder: CertificateFolder,
    bodies: ProvenPair,
    settings: Settings,
}

impl PairCertificates {
    /// Prepares both bodies, and writes their meshes.
    pub(crate) fn new(folder: &Path, pair: BodyPair<'_>, settings: Settings) -> Result<Self> {
        let folder = CertificateFolder::create(folder)?;
        let bodies = ProvenPair::new(pair.a, pair.b).context("--certificates")?;
        for (name, body) in ["a", "b"].into_iter().zip(bodies.meshes()) {
            folder.write_body(name, body)?;
        }
        Ok(PairCertificates {
            folder,
            bodies,
            settings,
        })
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
    /// Prepares all bodies of a cell, and writes their meshes.
    pub(crate) fn new(folder: &Path, cell: &'c Cell, settings: Settings) -> Result<Self> {
        let folder = CertificateFolder::create(folder)?;
        let proven = ProvenCell::new(cell).context("--certificates")?;
        for (number, body) in proven.meshes().enumerate() {
            folder.write_body(&format!("body{number}"), body)?;
        }
        Ok(CellCertificates {
            folder,
            cell: proven,
            settings,
        })
    }

    /// Proves that each segment of a path is free until the first contact, and that contact; names each proof after the path, and
    /// the segment if there are several.
    ///
    /// # Errors
    /// Why a segment cannot be proven.
    pub(crate) fn prove(
        &self,
        solver: &mut CellSolver<'_>,
        (id, path): (&str, &[Vec<f64>]),
    ) -> Result<Vec<(String, Proof)>> {
        let outcome = solver.first_contact(path)?;
        let proofs = self.cell.prove_path(path, &outcome, &self.settings)?;
        let is_edge = path.len() <= 2;
        let named = proofs.into_iter().enumerate().map(|(segment, proof)| {
            let name = if is_edge {
                id.to_owned()
            } else {
                format!("{id}-{segment}")
            };
            (name, proof)
        });
        Ok(named.collect())
    }
}
