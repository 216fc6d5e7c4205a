//! What is said of input that is not what it should be, and of bodies that hardly belong together.

use crate::command::{Run, Scene, parse, stderr};

const SPHERES: [&str; 4] = ["--a", "sphere:1", "--b", "sphere:1"];

/// What a query of such a table says.
fn told_of(table: &str) -> String {
    let output = Run::query(&SPHERES)
        .args(&["--quiet"])
        .stdin(table)
        .output();
    assert_eq!(output.status.code(), Some(2));
    stderr(&output)
}

#[test]
fn lines_are_counted_whatever_ends_them() {
    for end in ["\n", "\r\n", "\r"] {
        let table = "\u{feff}a_px\n1\n2\n\n3\nx\n".replace('\n', end);
        let told = told_of(&table);
        assert!(told.contains("row 3 (line 6): column a_px: `x`"), "{told}");
    }
}

#[test]
fn everything_is_said_once() {
    let scene = Scene::new("said-once");
    let table = scene.directory.join("motions.csv");
    std::fs::write(&table, b"PAR1\x15\x04\xff\xfe\n").unwrap();
    let folder = scene.directory.to_str().unwrap();
    for (motions, a, expected) in [
        (table.to_str().unwrap(), "sphere:1", "is Parquet, not CSV"),
        (folder, "sphere:1", "is a folder"),
        ("-", folder, "is a folder; name a mesh in it"),
    ] {
        let run = Run::bare(&["query", "--motions", motions, "--a", a, "--b", "sphere:1"]);
        let output = run.stdin("id\n1\n").output();
        assert_eq!(output.status.code(), Some(2));
        let told = stderr(&output);
        let lines: Vec<&str> = told
            .lines()
            .filter(|line| line.starts_with("ccd: "))
            .collect();
        assert_eq!(lines.len(), 1, "{told}");
        assert_eq!(lines[0].matches(expected).count(), 1, "{told}");
        assert!(
            !told.contains("os error") && !told.contains("utf-8"),
            "{told}"
        );
    }
}

/// By their names and in words, without the numbers that the system has for them.
#[test]
fn what_is_not_there_is_told_once() {
    let scene = Scene::new("not-there");
    let there = scene.file("there.csv", "id\n1\n");
    let there = there.to_str().unwrap();
    for (motions, a, out) in [
        ("gone.csv", "sphere:1", "-"),
        (there, "gone.obj", "-"),
        (there, "gone.ccd", "-"),
        (there, "sphere:1", "gone/out.csv"),
        (there, "sphere:1", "/dev/null/gone.csv"),
    ] {
        let run = Run::bare(&["query", "--quiet", "--motions", motions, "--out", out]);
        let output = run.args(&["--a", a, "--b", "sphere:1"]).stdin("").output();
        assert!(!output.status.success());
        let told = stderr(&output);
        assert!(
            told.contains("gone") && !told.contains("os error"),
            "{told}"
        );
        let mut parts: Vec<&str> = told.trim().split(": ").collect();
        let all = parts.len();
        parts.sort_unstable();
        parts.dedup();
        assert_eq!(parts.len(), all, "{told}");
    }
}

#[test]
fn a_table_without_a_header_is_told_so() {
    let told = told_of("1,2,3\n4,5,6\n");
    assert!(
        told.contains("`1` is a number: the first line has to name the columns"),
        "{told}"
    );
}

#[test]
fn help_says_how_rows_count_and_which_way_half_a_turn_goes() {
    let output = Run::bare(&["query", "--help"]).stdin("").output();
    let text = String::from_utf8(output.stdout).unwrap();
    for words in ["Rows count from 0 everywhere", "Half a turn can go either"] {
        assert!(text.contains(words), "{words}");
    }
}

#[test]
fn other_separators_are_told() {
    let told = told_of("id;a_px\n1;2,5\n");
    assert!(
        told.contains("separated by ';'; separate them by commas"),
        "{told}"
    );
}

#[test]
fn sizes_are_told_and_compared() {
    let motions = "a_px\n3\n";
    let output = Run::query(&["--a", "box:.5,1,2", "--b", "sphere:1"])
        .stdin(motions)
        .output();
    let told = stderr(&output);
    assert!(
        told.contains("--a box:.5,1,2: 1 primitive, solid, size 1 × 2 × 4\n"),
        "{told}"
    );
    assert!(!told.contains("times as large"), "{told}");
    let output = Run::query(&["--a", "box:150,50,50", "--b", "sphere:1"])
        .stdin(motions)
        .output();
    assert!(output.status.success());
    let told = stderr(&output);
    assert!(told.contains("--a is 150 times as large as --b"), "{told}");
}

#[test]
fn some_rows_are_answered_as_among_all() {
    let motions = "a_px\n5\n6\nbad\n8\n9\n";
    let answers = |rows: &str| {
        let run = Run::query(&SPHERES).args(&["--no-micros", "--rows", rows]);
        let output = run.stdin(motions).output();
        let text = String::from_utf8(output.stdout).unwrap();
        let lines: Vec<String> = text.lines().skip(1).map(str::to_owned).collect();
        (output.status.code(), lines)
    };
    let (_, all) = answers("..");
    assert_eq!(answers("0..2"), (Some(0), all[..2].to_vec()));
    assert_eq!(answers("2..4"), (Some(2), all[2..4].to_vec()));
    assert_eq!(answers("3.."), (Some(0), all[3..].to_vec()));
    assert_eq!(answers("7.."), (Some(0), Vec::new()));
    let none = Run::query(&SPHERES)
        .args(&["--rows", "7.."])
        .stdin(motions)
        .output();
    assert!(stderr(&none).contains("none of its 5 rows is in --rows 7.."));
    for bad in ["3", "4..4", "a..b", "-1..2"] {
        let output = Run::query(&SPHERES).args(&["--rows", bad]).output();
        assert_eq!(output.status.code(), Some(2), "{bad}");
    }
    assert_eq!(parse(all.join("\n").as_bytes()).len(), 4);
}
