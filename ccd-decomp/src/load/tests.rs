use super::load_body;
use crate::{Adjustments, PieceChoice};

#[test]
fn a_mesh_that_is_not_what_was_asked_for_is_named_with_its_file() {
    let file = std::env::temp_dir().join(format!("ccd-open-{}.obj", std::process::id()));
    std::fs::write(&file, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    let error = load_body(&file, &Adjustments::NONE, PieceChoice::Hull).unwrap_err();
    std::fs::remove_file(&file).unwrap();
    let expected = format!(
        "{}: open; edges with one face: 3 (e0-1, e0-2, e1-2)",
        file.display()
    );
    assert!(error.to_string().starts_with(&expected), "{error}");
}
