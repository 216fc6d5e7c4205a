//! Tests that unit vectors come only from `ccd_core::vector`. Those of glam are not of unit length if squares
//! underflow, and a distance along them is not proven.

use std::path::{Path, PathBuf};

/// The files that may normalise vectors by themselves, each with the reason why no proof uses the result as an axis.
const FILES_ALLOWED_TO_NORMALISE: [(&str, &str); 2] = [
    ("ccd-core/src/motion/pose.rs", "a quaternion, scaled first"),
    ("ccd-core/src/motion/interop.rs", "a quaternion of nalgebra"),
];

#[test]
fn no_proof_uses_a_vector_normalised_elsewhere() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut files = Vec::new();
    for member in [
        "ccd-core",
        "ccd-distance-gjk",
        "ccd-distance-vmarch",
        "ccd-decomp",
    ] {
        collect_sources(&root.join(member).join("src"), &mut files);
    }
    assert!(files.len() > 100, "{}", files.len());
    let mut allowed = 0;
    for file in files {
        let text = std::fs::read_to_string(&file).expect("a source file");
        // Unit tests at the end of a file are not part of a proof.
        let code = text.split("#[cfg(test)]").next().unwrap_or_default();
        let normalises = |line: &&str| {
            let line = line.trim_start();
            // A function that takes a normalised vector does not normalise it.
            let code = line.replace("normalized", "");
            !line.starts_with("//") && (code.contains("normalize") || code.contains("length_recip"))
        };
        if let Some(line) = code.lines().find(normalises) {
            let elsewhere = FILES_ALLOWED_TO_NORMALISE
                .iter()
                .any(|(path, _)| file.ends_with(path));
            assert!(elsewhere, "{}: {line}", file.display());
            allowed += 1;
        }
    }
    assert_eq!(
        allowed,
        FILES_ALLOWED_TO_NORMALISE.len(),
        "a file on the list needs it no more"
    );
}

/// Collects all source files in a folder, except tests.
fn collect_sources(folder: &Path, files: &mut Vec<PathBuf>) {
    const TEST_FILE_NAMES: [&str; 2] = ["tests", "tests.rs"];
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if TEST_FILE_NAMES.iter().any(|name| path.ends_with(name)) {
            continue;
        }
        if path.is_dir() {
            collect_sources(&path, files);
        } else {
            files.extend((path.extension() == Some("rs".as_ref())).then_some(path));
        }
    }
}
