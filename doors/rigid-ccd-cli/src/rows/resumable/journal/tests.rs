use super::*;

fn recorded_options(values: [&str; 3]) -> String {
    let options = ["ccd", "--a", "content-of:--a"].into_iter();
    options_text(
        options
            .zip(values)
            .map(|(o, v)| (o.to_owned(), v.to_owned())),
    )
}

fn earlier_run_with_options(options: &str) -> EarlierRun {
    EarlierRun {
        options: options.to_owned(),
        checkpoint: Checkpoint::default(),
    }
}

#[test]
fn changes_are_described() {
    let before = earlier_run_with_options(&recorded_options(["1", "a \nb.obj", "12"]));
    for (values, expected) in [
        (["1", "a \nb.obj", "12"], None),
        (
            ["1", "c.obj", "13"],
            Some("--a was a \\nb.obj and is now c.obj"),
        ),
        (
            ["1", "a \nb.obj", "13"],
            Some("the file of --a has changed since"),
        ),
        (
            ["2", "a \nb.obj", "12"],
            Some("another version of ccd wrote it"),
        ),
    ] {
        let changes = before.describe_changes(&recorded_options(values));
        assert_eq!(changes.as_deref(), expected, "{values:?}");
    }
    let older = earlier_run_with_options("ccd 1\nQueryArgs {\n    a: \"x\",\n}");
    let changes = older.describe_changes(&recorded_options(["1", "x", "12"]));
    assert_eq!(changes.unwrap(), "another version of ccd wrote it");
}
