//! Lists the files of this project, for the tests that read them.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Folders that hold no files of this project.
const FOREIGN: [&str; 4] = ["target", "node_modules", ".git", "__pycache__"];

pub(crate) fn project_root() -> PathBuf {
    fs::canonicalize(Path::new(env!("CARGO_MANIFEST_DIR")).join("..")).unwrap()
}

/// Returns the files of the project, relative to its root.
pub(crate) fn project_files(root: &Path) -> BTreeSet<PathBuf> {
    files_below(root, root)
}

fn files_below(root: &Path, folder: &Path) -> BTreeSet<PathBuf> {
    let mut files = BTreeSet::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap_or_default();
        if FOREIGN.iter().any(|foreign| name == *foreign) {
            continue;
        }
        if path.is_dir() {
            files.extend(files_below(root, &path));
        } else {
            files.insert(path.strip_prefix(root).unwrap().to_owned());
        }
    }
    files
}

pub(crate) fn has_extension(file: &Path, extension: &str) -> bool {
    file.extension().is_some_and(|found| found == extension)
}
