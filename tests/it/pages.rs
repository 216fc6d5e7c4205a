//! Tests that each source file that a page names exists, and each file that it links.

use crate::project_files::{has_extension, project_files, project_root};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Component, Path, PathBuf};

/// A name of a source file is found if it is the end of a path below the page's folder, or of any path if the page is at the top or in
/// `docs`. A name alone is not that of a file of tests.
#[test]
fn pages_name_files_that_exist() {
    let root = project_root();
    let files = project_files(&root);
    let mut names = 0;
    for page in files.iter().filter(|file| has_extension(file, "md")) {
        let text = fs::read_to_string(root.join(page)).unwrap();
        let missing: Vec<String> = source_names(&text)
            .inspect(|_| names += 1)
            .filter(|name| !is_known(&files, page, Path::new(name)))
            .chain(links(&text).filter(|link| !is_link_to_file(&root, page, link)))
            .map(str::to_owned)
            .collect();
        assert!(missing.is_empty(), "{}: {missing:?}", page.display());
    }
    assert!(names > 100, "{names}");
}

#[test]
fn a_missing_file_is_found() {
    let files = [
        "README.md",
        "core/src/answer/hit.rs",
        "core/src/tests/one.rs",
        "core/README.md",
    ];
    let files: BTreeSet<PathBuf> = files.into_iter().map(PathBuf::from).collect();
    let is_known = |page: &str, name: &str| is_known(&files, Path::new(page), Path::new(name));
    assert!(is_known("README.md", "answer/hit.rs") && is_known("core/README.md", "hit.rs"));
    assert!(is_known("core/README.md", "tests/one.rs") && !is_known("README.md", "one.rs"));
    assert!(!is_known("README.md", "answer/miss.rs") && !is_known("README.md", "swer/hit.rs"));
    assert!(
        !is_known("other/README.md", "hit.rs")
            && is_known("other/README.md", "core/src/answer/hit.rs")
    );

    let text =
        "`a/b.rs` and `c.rs`, not `d.rs f` nor\n```\n`e.rs`\n```\n[x](y.md#z) [u](https://v)";
    assert_eq!(source_names(text).collect::<Vec<_>>(), ["a/b.rs", "c.rs"]);
    assert_eq!(links(text).collect::<Vec<_>>(), ["y.md"]);
}

fn is_known(files: &BTreeSet<PathBuf>, page: &Path, name: &Path) -> bool {
    let folder = page.parent().unwrap_or(Path::new(""));
    let is_of_all = folder == Path::new("") || folder.starts_with("docs");
    let is_alone = name.components().count() == 1;
    let is_test = |file: &Path| {
        file.components()
            .any(|part| part == Component::Normal("tests".as_ref()))
    };
    files.contains(name)
        || files.iter().any(|file| {
            (is_of_all || file.starts_with(folder))
                && file.ends_with(name)
                && !(is_alone && is_test(file))
        })
}

/// Iterates over the parts of a page that are not blocks of code.
fn prose(text: &str) -> impl Iterator<Item = &str> {
    text.split("```").step_by(2)
}

/// Iterates over the names of source files in a page.
fn source_names(text: &str) -> impl Iterator<Item = &str> {
    let code = prose(text).flat_map(|part| part.split('`').skip(1).step_by(2));
    let is_name = |c: char| c.is_ascii_alphanumeric() || "_-./".contains(c);
    code.filter(move |code| code.ends_with(".rs") && code.chars().all(is_name))
}

/// Iterates over the files that a page links, without those of other sites and other places of the page.
fn links(text: &str) -> impl Iterator<Item = &str> {
    let targets = prose(text).flat_map(|part| part.split("](").skip(1));
    let targets = targets.filter_map(|rest| rest.split_once(')').map(|(target, _)| target));
    let files = targets.filter_map(|target| target.split('#').next());
    files.filter(|file| !file.is_empty() && !file.contains(':'))
}

fn is_link_to_file(root: &Path, page: &Path, link: &str) -> bool {
    let folder = page.parent().unwrap_or(Path::new(""));
    root.join(folder).join(link).exists()
}
