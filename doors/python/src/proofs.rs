//! The Python functions that write and check machine-checkable proofs.

use crate::body::extract_body;
use crate::cell_remarks::{AskedPaths, warn_of_question};
use crate::errors::{
    input_error, interruption_error, path_limit_error, time_interruption, unresolved_error,
    with_attribute, wrong_type_error,
};
use crate::interruptible::{run_interruptibly, run_or_leave};
use crate::movement::{GivenBodyAndMotion, GivenMovement, Pair};
use crate::numbers::read_optional_number;
use crate::path_array::GivenPath;
use crate::progress::{GivenProgress, run_with_progress};
use crate::queries::ask;
use crate::settings::{REPORTING_START, names, read};
use ccd_prove::{Body, CellNotProvable, NoMesh, Proof, ProvenCell, ProvenPair, Statement};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyBytes, PyDict, PyType};
use rigid_ccd::Question;
use rigid_ccd::{Motion, Outcome, Settings};
use rigid_ccd_robot::{Cell, PathAnswer, PathOutcome};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// Makes Python `Proof` objects that share the same meshes.
fn proof_objects<'a, 'py>(
    py: Python<'py>,
    proofs: &[Proof],
    meshes: impl IntoIterator<Item = &'a Body>,
) -> PyResult<Vec<Bound<'py, PyAny>>> {
    static CLASS: PyOnceLock<Py<PyType>> = PyOnceLock::new();
    let bytes = |bytes: &[u8]| PyBytes::new(py, bytes);
    let pair = |body: &Body| (bytes(body.mesh()), bytes(body.certificate()));
    // All proofs share the bytes of the meshes.
    let meshes: Vec<_> = meshes.into_iter().map(pair).collect();
    let class = CLASS.import(py, "rigid_ccd._proofs", "Proof")?;
    let object = |proof: &Proof| class.call1((bytes(&proof.bytes), meshes.clone()));
    proofs.iter().map(object).collect()
}

/// Finds the first contact of two moving bodies, and proves the answer: nothing touches before it, or nothing touches
/// at all.
///
/// Arguments and exceptions are those of `first_contact`, except that each motion is a `Motion` or None. The proof is
/// about triangles only: it does not prove that no body is inside another one.
///
/// Raises:
///     InputError: a body has no triangles, the bodies touch at the start, or the answer cannot be proven.
///     UnresolvedError: a limit was reached first. `results` has the proof until `safe_until`, if there is one.
///
/// >>> from rigid_ccd import Body, Motion, prove
/// >>> wall = Body.box(0.1, 5, 5)
/// >>> proof = prove(Body.sphere(0.5), wall, Motion([-3, 0, 0], velocity=[4, 0, 0]))
/// >>> proof.check()
/// 'holds'
#[pyfunction]
#[pyo3(signature = (a, b, motion_a = None, motion_b = None, duration = None, **settings))]
pub(crate) fn prove<'py>(
    py: Python<'py>,
    a: &Bound<'_, PyAny>,
    b: &Bound<'_, PyAny>,
    motion_a: Option<&Bound<'_, PyAny>>,
    motion_b: Option<&Bound<'_, PyAny>>,
    #[pyo3(from_py_with = read_optional_number)] duration: Option<f64>,
    settings: Option<&Bound<'_, PyDict>>,
) -> PyResult<Bound<'py, PyAny>> {
    let settings = read(settings, &names(Question::FirstContact, REPORTING_START))?;
    let motions = [
        constant_motion((a, motion_a), "motion_a")?,
        constant_motion((b, motion_b), "motion_b")?,
    ];
    let bodies = [(a, motion_a), (b, motion_b)];
    let duration = Pair::extract(bodies)?.duration(duration)?;
    let answer = ask(
        py,
        Question::FirstContact,
        bodies,
        Some(duration),
        &settings,
    )?;
    let [a, b] = [extract_body(a, "a")?, extract_body(b, "b")?];
    let work = |stop: &Arc<_>| {
        let settings = settings.stopped_by(stop);
        let prove = |pair: ProvenPair| {
            let proof = pair.prove(motions, duration, &settings, &answer);
            (pair, proof)
        };
        let pair = ProvenPair::unless_stopped(a, b, stop)?;
        Some(pair.map(prove))
    };
    let (proven, interruption) = run_interruptibly(py, work, |_| Ok(()))?;
    let safe_until = match answer.outcome {
        Outcome::Free { .. } => Some(duration),
        Outcome::Contact { time, .. } => Some(time),
        Outcome::Unresolved(known) => Some(known.safe_until),
        _ => None,
    };
    interruption.map_err(|cause| time_interruption(py, cause, safe_until))?;
    let proven = proven.ok_or_else(|| input_error("the proof was stopped"))?;
    let (pair, proof) = proven.map_err(|error: NoMesh| input_error(error))?;
    let proof = proof.transpose().map_err(input_error)?;
    let mut objects = proof_objects(py, proof.as_slice(), pair.meshes())?;
    match answer.outcome {
        Outcome::Unresolved(known) => {
            let error = unresolved_error(py, &known);
            Err(with_attribute(py, error, "results", objects.pop()))
        }
        _ => objects
            .pop()
            .ok_or_else(|| input_error("a and b touch at the start, so there is nothing to prove")),
    }
}

/// Finds the first contact of a cell on a path of configurations, and writes a proof for each segment.
pub(crate) fn prove_path<'py>(
    py: Python<'py>,
    cell: &Cell,
    path: &Bound<'_, PyAny>,
    progress: Option<&Bound<'_, PyAny>>,
    settings: Settings,
) -> PyResult<Vec<Bound<'py, PyAny>>> {
    let path = GivenPath::read(path, cell.robot())?;
    warn_of_question(py, cell, &AskedPaths::Path(&path), settings.tolerance)?;
    let path = match path {
        GivenPath::Configurations(path) => path,
        GivenPath::Curve(_) => {
            return Err(input_error(
                "path: only a path of configurations can be proven, not a curve",
            ));
        }
    };
    let mut path = path.configurations();
    if let [only] = path[..] {
        // A path of one configuration is a static robot.
        path.push(only);
    }
    let progress = GivenProgress {
        progress,
        total: Some(path.len() - 1),
    };
    let work =
        |stop: &Arc<_>, done: &AtomicUsize| PathProofs::find(cell, &path, (settings, stop), done);
    let (path_proofs, interruption) = run_with_progress(py, progress, work)?;
    let PathProofs {
        meshes,
        proofs,
        error,
    } = path_proofs.map_err(input_error)?;
    let proofs = proof_objects(py, &proofs, &meshes)?;
    match (interruption, error) {
        (Err(cause), _) => Err(interruption_error(py, cause, proofs)),
        (Ok(()), Some(error)) => Err(with_attribute(py, error, "results", proofs)),
        (Ok(()), None) => Ok(proofs),
    }
}

/// The proofs of the segments of a path, up to the first missing one.
#[derive(Default)]
struct PathProofs {
    meshes: Vec<Body>,
    proofs: Vec<Proof>,
    /// The exception for the missing proof, if one is missing.
    error: Option<PyErr>,
}

/// Returns the exception if proofs do not cover an answer to its end.
fn missing_proof_error(answer: &PathAnswer<'_>, proofs: &[Proof]) -> Option<PyErr> {
    match &answer.outcome {
        PathOutcome::Contact(contact) => {
            let last = proofs.get(contact.at.segment);
            let last = last.and_then(|proof| Statement::read(&proof.bytes));
            if last.is_some_and(|statement| statement.witness.is_some()) {
                return None;
            }
            let [a, b] = contact.items.map(|item| item.name());
            Some(input_error(format!(
                "path: {a} and {b} touch at {}, and no proof can show it; `results` has the proofs of the segments before",
                contact.at.time()
            )))
        }
        PathOutcome::Free => None,
        outcome => Some(match outcome.limit() {
            Some(limit) => path_limit_error(limit, answer.free_until.time()),
            None => input_error("path: this answer has no proof"),
        }),
    }
}

impl PathProofs {
    /// Searches a path, and proves the answer. Counts proven segments in `done`. If another thread sets the flag `stop`
    /// before the first proof, returns no proofs and an error.
    fn find(
        cell: &Cell,
        path: &[&[f64]],
        (settings, stop): (Settings, &Arc<AtomicBool>),
        done: &AtomicUsize,
    ) -> Result<Self, CellNotProvable> {
        let Some(proven) = ProvenCell::unless_stopped(cell, stop).transpose()? else {
            return Ok(PathProofs {
                error: Some(input_error("the proof was stopped")),
                ..PathProofs::default()
            });
        };
        let settings = settings.stopped_by(stop);
        let mut path_proofs = PathProofs {
            meshes: proven.meshes().cloned().collect(),
            ..PathProofs::default()
        };
        let mut solver = cell.solver().with_settings(settings.clone());
        match solver.first_contact(path) {
            Ok(answer) => {
                for proof in proven.path_proofs(path, &answer, &settings) {
                    match proof {
                        Ok(proof) => path_proofs.proofs.push(proof),
                        Err(error) => path_proofs.error = Some(input_error(error)),
                    }
                    done.fetch_add(1, Ordering::Relaxed);
                }
                let missing = || missing_proof_error(&answer, &path_proofs.proofs);
                path_proofs.error = path_proofs.error.or_else(missing);
            }
            Err(error) => path_proofs.error = Some(input_error(error)),
        }
        Ok(path_proofs)
    }
}

/// Reads a motion at constant velocities. Only these have proofs.
fn constant_motion(
    (_, motion): GivenBodyAndMotion<'_, '_>,
    argument_name: &str,
) -> PyResult<Motion> {
    match (GivenMovement::extract(motion, argument_name)?, motion) {
        (GivenMovement::Motion(motion, _), _) => Ok(motion),
        (_, Some(movement)) => Err(wrong_type_error(
            argument_name,
            "a Motion for a proof",
            movement,
        )),
        (_, None) => Ok(Motion::STILL),
    }
}

/// Checks a proof with the crate `ccd-check`, which shares no code with the engine or the prover.
///
/// Args:
///     proof: the bytes of the proof.
///     meshes: for each mesh its bytes and the bytes of its tree. Meshes that the proof does not need are ignored.
///
/// Returns:
///     "holds", or the reason why it does not: "broken: …", or "unverifiable: …" for numbers beyond the range of the
///         checker.
#[pyfunction]
pub(crate) fn check_proof(
    py: Python<'_>,
    proof: Vec<u8>,
    meshes: Vec<(Vec<u8>, Vec<u8>)>,
) -> PyResult<String> {
    let mesh_sizes = meshes.iter().map(|(mesh, tree)| mesh.len() + tree.len());
    let bytes = proof.len() + mesh_sizes.sum::<usize>();
    let check = move || {
        let read = |(mesh, tree): &(Vec<u8>, Vec<u8>)| ccd_check::Body::new(mesh, tree, &proof);
        let bodies = meshes.iter().map(read).collect::<Result<Vec<_>, _>>()?;
        ccd_check::check(&bodies, &proof)
    };
    let verdict = run_or_leave(py, bytes as u64, check)?;
    Ok(verdict.map_or_else(|stop| stop.to_string(), |()| "holds".to_owned()))
}

/// Returns the statement of a proof: the time until which nothing touches, whether a contact ends it, and the digests
/// of its meshes. Fails if the bytes are not a proof.
#[pyfunction]
pub(crate) fn read_proof(proof: &[u8]) -> PyResult<(f64, bool, Vec<String>)> {
    let statement = read_statement(proof)?;
    let hex = |digest: [u8; 32]| digest.iter().map(|byte| format!("{byte:02x}")).collect();
    let digests = statement.bodies.iter().map(|(digest, _)| hex(*digest));
    Ok((
        statement.until,
        statement.witness.is_some(),
        digests.collect(),
    ))
}

fn read_statement(proof: &[u8]) -> PyResult<Statement> {
    Statement::read(proof).ok_or_else(|| input_error("these bytes are not a proof"))
}

/// Returns the statement of a proof as a text. Fails if the bytes are not a proof.
#[pyfunction]
pub(crate) fn proof_statement(proof: &[u8]) -> PyResult<String> {
    Ok(read_statement(proof)?.to_string())
}
