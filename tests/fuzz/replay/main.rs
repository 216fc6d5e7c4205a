//! Runs every fuzz target on its corpus, and on random changes of it.
//!
//! `CCD_TEST_CASES` multiplies the number of random changes, and `CCD_TEST_SEED` picks other ones. With
//! `CCD_FUZZ_FILE=file`, only that file is run. An input that fails is kept in the folder `target/tmp`.

mod mutate;

use ccd_fuzz::targets::{self, Target};
use mutate::Mutator;
use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// The number of randomly changed files that are run for each corpus, in less than a second.
const CHANGED_FILES_PER_CORPUS: u64 = 100;

#[test]
fn query() {
    replay_target(targets::QUERY);
}

#[test]
fn stored() {
    replay_target(targets::STORED_BODY);
}

#[test]
fn obj() {
    replay_target(targets::OBJ);
}

#[test]
fn stl() {
    replay_target(targets::STL);
}

#[test]
fn ply() {
    replay_target(targets::PLY);
}

#[test]
fn off() {
    replay_target(targets::OFF);
}

#[test]
fn gltf() {
    replay_target(targets::GLTF);
}

#[test]
fn motions() {
    replay_target(targets::MOTIONS);
}

#[test]
fn paths() {
    replay_target(targets::PATHS);
}

#[test]
fn every_corpus_has_a_target() {
    let mut names: Vec<String> = files(&folder())
        .iter()
        .filter_map(|path| Some(path.file_name()?.to_str()?.to_owned()))
        .collect();
    let mut expected = targets::ALL.map(|target| target.name.to_owned());
    names.sort();
    expected.sort();
    assert_eq!(names, expected);
}

/// A lock that lets one target run at a time, because the memory limit holds for the whole process.
static TARGET_LOCK: Mutex<()> = Mutex::new(());

fn replay_target(target: Target) {
    let _one = TARGET_LOCK.lock().unwrap_or_else(PoisonError::into_inner);
    if let Ok(file) = std::env::var("CCD_FUZZ_FILE") {
        return (target.run)(&fs::read(file).expect("a readable file"));
    }
    let corpus: Vec<Vec<u8>> = files(&folder().join(target.name))
        .into_iter()
        .map(|path| {
            let bytes = fs::read(&path).expect("a readable file");
            run(target, &bytes, &path.display().to_string());
            bytes
        })
        .collect();
    assert!(!corpus.is_empty(), "no corpus of {}", target.name);
    let mut mutator = Mutator::new(number_from_environment("CCD_TEST_SEED", 1), &corpus);
    for number in 0..CHANGED_FILES_PER_CORPUS * number_from_environment("CCD_TEST_CASES", 1) {
        let bytes = mutator.next_changed_file();
        run(target, &bytes, &format!("change {number}"));
    }
}

/// Runs a target on an input. If the target panics, keeps the input in a file and names it.
fn run(target: Target, bytes: &[u8], name: &str) {
    if let Err(panic) = catch_unwind(AssertUnwindSafe(|| (target.run)(bytes))) {
        let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{}-fault", target.name));
        fs::write(&file, bytes).expect("a folder for files");
        let message = format!("{}, {name}: kept in {}\n", target.name, file.display());
        std::io::Write::write_all(&mut std::io::stderr(), message.as_bytes()).expect("an output");
        resume_unwind(panic);
    }
}

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("corpus")
}

fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("a folder");
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.expect("a file").path()).collect();
    files.sort();
    files
}

fn number_from_environment(name: &str, default: u64) -> u64 {
    let value = std::env::var(name).ok().and_then(|text| text.parse().ok());
    value.unwrap_or(default)
}
