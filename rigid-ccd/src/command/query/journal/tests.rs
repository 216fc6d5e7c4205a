use super::*;

fn recorded_options(values: [&str; 3]) -> RecordedOptions {
    let options = ["ccd", "--a", "content-of:--a"];
    let pairs = options.iter().zip(values);
    RecordedOptions(
        pairs
            .map(|(o, v)| ((*o).to_owned(), v.to_owned()))
            .collect(),
    )
}

#[test]
fn changes_are_described() {
    let before = recorded_options(["1", "a \nb.obj", "12"]).to_text();
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
        let changes = recorded_options(values).describe_changes(&before);
        assert_eq!(changes.as_deref(), expected, "{values:?}");
    }
    let older = "ccd 1\nQueryArgs {\n    a: \"x\",\n}";
    let changes = recorded_options(["1", "x", "12"])
        .describe_changes(older)
        .unwrap();
    assert_eq!(changes, "another version of ccd wrote it");
}
