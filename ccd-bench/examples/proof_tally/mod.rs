//! Figures of proofs: bytes, leaves, and the times for proving and checking divided by the time for solving.

use anyhow::Result;
use ccd_prove::{Body, Proof};
use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::fmt::{self, Display};
use std::fs::write;
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// The figures of many proofs, and the failures.
#[derive(Default)]
pub(crate) struct Tally {
    /// The folder to which the proofs are written.
    folder: Option<PathBuf>,
    /// The meshes as the checker reads them, by the exponent of the unit of length.
    checker_meshes: HashMap<i32, Vec<ccd_check::Body>>,
    bytes: Vec<f64>,
    leaves: Vec<f64>,
    proving: Vec<f64>,
    checking: Vec<f64>,
    failed: Vec<String>,
}

impl Tally {
    /// Creates an empty tally, which writes the proofs to `folder` if there is one.
    pub(crate) fn new(folder: Option<PathBuf>) -> Self {
        Tally {
            folder,
            ..Tally::default()
        }
    }

    pub(crate) fn fail(&mut self, text: String) {
        self.failed.push(text);
    }

    /// Proves an answer and checks the proof. `solved` is the time that the engine took for the answer.
    pub(crate) fn prove_and_check<'b, E: Display>(
        &mut self,
        name: &str,
        solved: Duration,
        prove: impl FnOnce() -> Option<Result<Proof, E>>,
        meshes: impl IntoIterator<Item = &'b Body>,
    ) -> Result<()> {
        let over_solving = |start: Instant| start.elapsed().as_secs_f64() / solved.as_secs_f64();
        let start = Instant::now();
        let proof = match prove() {
            Some(Ok(proof)) => proof,
            None => {
                self.fail(format!("{name}: the bodies are in contact at the start"));
                return Ok(());
            }
            Some(Err(error)) => {
                self.fail(format!("{name}: {error}"));
                return Ok(());
            }
        };
        self.proving.push(over_solving(start));
        if let Some(folder) = &self.folder {
            write(folder.join(format!("{name}.proof")), &proof.bytes)?;
        }
        let meshes = match self.checker_meshes.entry(proof.unit) {
            Entry::Occupied(read) => read.into_mut(),
            Entry::Vacant(place) => {
                let read = meshes.into_iter().map(|body| {
                    ccd_check::Body::new(body.mesh(), body.certificate(), &proof.bytes)
                });
                place.insert(read.collect::<Result<_, _>>()?)
            }
        };
        // Takes the faster of two checks, as the first one fills the processor's caches.
        let mut least = f64::INFINITY;
        for _ in 0..2 {
            let start = Instant::now();
            let verdict = ccd_check::check(meshes, &proof.bytes);
            least = ccd_core::order::lesser(least, over_solving(start));
            if let Err(verdict) = verdict {
                self.fail(format!("{name}: {verdict}"));
                return Ok(());
            }
        }
        self.checking.push(least);
        self.bytes.push(proof.bytes.len() as f64);
        self.leaves.push(proof.leaves as f64);
        Ok(())
    }
}

impl Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} hold, {} failed; median, 90 % and most:",
            self.bytes.len(),
            self.failed.len()
        )?;
        let rows = [
            ("bytes", &self.bytes),
            ("leaves", &self.leaves),
            ("checking / solving", &self.checking),
            ("proving / solving", &self.proving),
        ];
        for (name, numbers) in rows {
            let mut numbers = numbers.clone();
            numbers.sort_by(f64::total_cmp);
            let last = numbers.len().saturating_sub(1);
            let at = |fraction: usize| {
                numbers
                    .get(last * fraction / 100)
                    .copied()
                    .unwrap_or(f64::NAN)
            };
            write!(f, " {name} {:.1} {:.1} {:.1};", at(50), at(90), at(100))?;
        }
        for text in self.failed.iter().take(3) {
            write!(f, "\n  {text}")?;
        }
        Ok(())
    }
}
