//! `--certificates`: machine-checkable proofs of answers, as files in a folder.

use crate::output::OutputError;
use anyhow::{Context, Result, anyhow};
use ccd_core::{Answer, Outcome};
use ccd_prove::{Body, NotProven, Proof, ProvenCell, Scene, Witness, prove};
use rigid_ccd::batch::{BodyPair, Question};
use rigid_ccd::table::motions::Motions;
use rigid_ccd_robot::{Cell, CellSolver, PathOutcome};
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
    bodies: [(Body, f64); 2],
    margin: f64,
}

impl PairCertificates {
    /// Prepares both bodies, and writes their meshes.
    pub(crate) fn new(folder: &Path, pair: BodyPair<'_>, margin: f64) -> Result<Self> {
        let folder = CertificateFolder::create(folder)?;
        let prepare = |name: &str, body| -> Result<(Body, f64)> {
            let prepared = Body::of(body).with_context(|| {
                format!(
                    "--certificates: --{name} has no triangles, or is rounded by different radii"
                )
            })?;
            folder.write_body(name, &prepared.0)?;
            Ok(prepared)
        };
        let bodies = [prepare("a", pair.a)?, prepare("b", pair.b)?];
        Ok(PairCertificates {
            folder,
            bodies,
            margin,
        })
    }

    /// Proves an answer to a question about the first contact, or about any; `None` if there is nothing to prove.
    pub(crate) fn prove(
        &self,
        motions: &Motions,
        (question, answer): (Question, &Answer),
    ) -> Option<Result<Proof, NotProven>> {
        let (until, witness) = match &answer.outcome {
            Outcome::Free { .. } => (motions.duration, None),
            Outcome::Unresolved(left) if left.safe_until > 0.0 => (left.safe_until, None),
            Outcome::Contact { time, contact } if question == Question::FirstContact => {
                let witness = Witness::of_two(*time, answer.tolerance, contact);
                (*time, Some(witness))
            }
            _ => return None,
        };
        let [(a, radius_a), (b, radius_b)] = &self.bodies;
        let mut scene = Scene::of_two((a, motions.a), (b, motions.b), self.margin);
        for (body, radius) in scene.bodies.iter_mut().zip([radius_a, radius_b]) {
            body.radius = *radius;
        }
        Some(prove(&scene, until, witness))
    }
}

/// The bodies of a cell as proofs take them, and the folder for these.
pub(crate) struct CellCertificates<'c> {
    pub(crate) folder: CertificateFolder,
    cell: ProvenCell<'c>,
    clearance: f64,
    tolerance: f64,
}

impl<'c> CellCertificates<'c> {
    /// Prepares all bodies of a cell, and writes their meshes.
    pub(crate) fn new(
        folder: &Path,
        cell: &'c Cell,
        [clearance, tolerance]: [f64; 2],
    ) -> Result<Self> {
        let folder = CertificateFolder::create(folder)?;
        let proven = ProvenCell::new(cell).map_err(|number| {
            let item = cell
                .carried_bodies()
                .nth(number)
                .map(|body| body.item.name().to_owned());
            let name = item.unwrap_or_default();
            anyhow!("--certificates: {name} has no triangles, or is rounded by different radii")
        })?;
        for (number, body) in proven.meshes().enumerate() {
            folder.write_body(&format!("body{number}"), body)?;
        }
        Ok(CellCertificates {
            folder,
            cell: proven,
            clearance,
            tolerance,
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
        let last = path.len().saturating_sub(2);
        let (end, share, contact) = match &outcome {
            PathOutcome::Free => (last, 1.0, None),
            PathOutcome::Contact(contact) => (contact.at.segment, contact.at.share, Some(contact)),
            PathOutcome::Unresolved { free_until, .. } => {
                (free_until.segment, free_until.share, None)
            }
        };
        let mut proofs = Vec::new();
        for (segment, ends) in path.windows(2).enumerate().take(end + 1) {
            let scene = self.cell.edge(&ends[0], &ends[1], self.clearance)?;
            let is_end = segment == end;
            // What touches at the start of a segment is apart at no time of it.
            if is_end && share == 0.0 {
                break;
            }
            let witness = contact.filter(|_| is_end);
            let witness =
                witness.and_then(|contact| self.cell.witness(&scene, contact, self.tolerance));
            let proof = prove(&scene, if is_end { share } else { 1.0 }, witness)?;
            let name = if last == 0 {
                id.to_owned()
            } else {
                format!("{id}-{segment}")
            };
            proofs.push((name, proof));
        }
        Ok(proofs)
    }
}
