//! Stores the exact first contacts of the scenes, so that each is computed once.

use super::Contest;
use crate::method::MotionKind;
use crate::run::measured::{read, write};
use crate::truth::{Truth, TruthRow};
use anyhow::{Context, Result};
use ccd_decomp::TriangleMesh;
use rayon::iter::{IntoParallelIterator, ParallelIterator};
use rigid_ccd::command::Progress;
use std::collections::BTreeMap;
use std::path::Path;

/// The known first contacts of all scenes, by scene, meshes and motions, and row.
#[derive(Debug, Default)]
pub struct Truths {
    known: BTreeMap<String, TruthRow>,
}

impl Truths {
    /// Reads the truths in a file; without the file there are none.
    ///
    /// # Errors
    /// If the file is no table of truths.
    pub fn read(file: &Path) -> Result<Self> {
        let mut truths = Truths::default();
        if file.exists() {
            truths.add(read(file).context("truths")?);
        }
        Ok(truths)
    }

    /// Writes all known exact answers to a file.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn write(&self, file: &Path) -> Result<()> {
        let rows: Vec<&TruthRow> = self.known.values().collect();
        write(file, &rows).context("truths")
    }

    /// Computes the unknown truths of some rows of a scene, on all processors. Returns their number.
    pub fn find(
        &mut self,
        contest: &Contest<'_>,
        kind: MotionKind,
        rows: &[usize],
        progress: &Progress,
    ) -> usize {
        let fingerprint = fingerprint(contest, kind);
        let key = |row: usize| key(contest, fingerprint, kind, row);
        let unknown: Vec<usize> = rows
            .iter()
            .copied()
            .filter(|&row| !self.known.contains_key(&key(row)))
            .collect();
        let referee = contest.referee();
        let found: Vec<TruthRow> = unknown
            .into_par_iter()
            .map(|row| {
                let query = &contest.queries(kind)[row];
                let truth = referee.first_contact(query);
                progress.tick();
                TruthRow::new(key(row), query.duration, truth)
            })
            .collect();
        let count = found.len();
        self.add(found);
        count
    }

    /// Returns the truth of each row of a scene; undecided if it has not been computed.
    pub fn of_scene<'t>(
        &'t self,
        contest: &'t Contest<'_>,
        kind: MotionKind,
    ) -> impl Fn(usize) -> Truth + 't {
        let fingerprint = fingerprint(contest, kind);
        move |row| {
            let known = self.known.get(&key(contest, fingerprint, kind, row));
            known.map_or(Truth::Undecided { lo: 0.0 }, TruthRow::truth)
        }
    }

    fn add(&mut self, rows: Vec<TruthRow>) {
        self.known
            .extend(rows.into_iter().map(|row| (row.id.clone(), row)));
    }
}

/// Returns the key of a row's truth in the table. It includes the meshes and motions, since the truth depends on them.
fn key(contest: &Contest<'_>, fingerprint: u32, kind: MotionKind, row: usize) -> String {
    let scene = &contest.scene().name;
    let id = &contest.queries(kind)[row].id;
    format!("{scene}/{fingerprint:08x}/{id}")
}

/// Returns a hash of the exact meshes and motions.
fn fingerprint(contest: &Contest<'_>, kind: MotionKind) -> u32 {
    let mut hash = crc32fast::Hasher::new();
    for body in [&contest.scene().a, &contest.scene().b] {
        hash_mesh(body.mesh(), &mut hash);
    }
    for query in contest.queries(kind) {
        for motion in [&query.a, &query.b] {
            let start = motion.start();
            let vectors = [
                start.translation(),
                motion.velocity(),
                motion.spin(),
                motion.centre(),
            ];
            let numbers = vectors.into_iter().flat_map(|v| v.to_array());
            hash_numbers(numbers.chain(start.rotation().to_array()), &mut hash);
        }
        hash_numbers([query.duration], &mut hash);
    }
    hash.finalize()
}

fn hash_mesh(mesh: &TriangleMesh, hash: &mut crc32fast::Hasher) {
    hash_numbers(mesh.vertices().iter().flat_map(|v| v.to_array()), hash);
    for corner in mesh.faces().iter().flatten() {
        hash.update(&corner.to_le_bytes());
    }
}

fn hash_numbers(numbers: impl IntoIterator<Item = f64>, hash: &mut crc32fast::Hasher) {
    for number in numbers {
        hash.update(&number.to_bits().to_le_bytes());
    }
}
