//! Tests that no file has `unsafe` code but those that are listed.

use crate::project_files::{has_extension, project_files, project_root};
use std::collections::BTreeSet;
use std::fs;
use std::path::PathBuf;

/// The files and folders that may have `unsafe` code, each with the reason.
const ALLOWED: [(&str, &str); 4] = [
    (
        "doors/rigid-ccd-c",
        "follows pointers from C, and is tested as C calls it",
    ),
    (
        "ccd-bench/examples/c_interface",
        "calls the interface as C does",
    ),
    (
        "doors/rigid-ccd-cli/src/console/standard_output.rs",
        "looks at a stream before the runtime does",
    ),
    (
        "doors/python/src/table/capsule.rs",
        "takes arrays by the Arrow PyCapsule protocol",
    ),
];

#[test]
fn unsafe_code_is_only_where_a_reason_is_given() {
    let root = project_root();
    let sources: Vec<PathBuf> = project_files(&root)
        .into_iter()
        .filter(|file| has_extension(file, "rs"))
        .collect();
    assert!(sources.len() > 1000, "{}", sources.len());
    let mut used = BTreeSet::new();
    for file in sources {
        let text = fs::read_to_string(root.join(&file)).unwrap();
        if text.lines().any(has_unsafe_code) {
            let place = ALLOWED.iter().find(|(place, _)| file.starts_with(place));
            let (place, _) = place.unwrap_or_else(|| panic!("unsafe code in {}", file.display()));
            used.insert(place);
        }
    }
    assert_eq!(used.len(), ALLOWED.len(), "a place needs it no more");
}

#[test]
fn unsafe_code_is_found() {
    for line in [
        "unsafe { f() }",
        "    pub unsafe extern \"C\" fn f() {",
        "#[ctor::ctor(unsafe)]",
    ] {
        assert!(has_unsafe_code(line), "{line}");
    }
    for line in [
        "// unsafe",
        &format!("let a = {:?};", "unsafe"),
        "#![forbid(unsafe_code)]",
        "f(); // unsafe",
    ] {
        assert!(!has_unsafe_code(line), "{line}");
    }
}

/// Returns whether a line has the keyword `unsafe` outside of comments and strings.
fn has_unsafe_code(line: &str) -> bool {
    let code = line.split("//").next().unwrap_or_default();
    code.split('"').step_by(2).any(|code| {
        code.split(|c: char| !c.is_alphanumeric() && c != '_')
            .any(|word| word == "unsafe")
    })
}
