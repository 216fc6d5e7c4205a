//! Tests `ccd-bench falsify` and `judge`: a method that is late is found, and the printed command repeats it.

use std::fs;
use std::process::Command;

#[test]
fn a_failure_is_found_and_repeated() {
    let folder = std::env::temp_dir().join(format!("ccd-falsify-{}", std::process::id()));
    let mut search = Command::new(crate::PROGRAM);
    search
        .args([
            "falsify",
            "--methods",
            "discrete stepping,best-first direct",
        ])
        .args(["--aims", "late", "--tries", "150", "--finds", "1", "--out"])
        .arg(&folder);
    let output = search.output().unwrap();
    let table = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success(), "{table}");
    let line = |method: &str| table.lines().find(|line| line.contains(method)).unwrap();
    assert!(line("best-first direct").contains("none"), "{table}");
    let gallery = fs::read_to_string(folder.join("gallery.md")).unwrap();
    assert!(gallery.contains("discrete stepping: "), "{gallery}");
    assert!(folder.join("index.html").exists());
    // The command as it is printed.
    let command = gallery.split("```").nth(1).unwrap();
    let command = command.trim_start_matches("sh").trim();
    let repeated = Command::new("sh")
        .arg("-c")
        .arg(command.replacen("ccd-bench", crate::PROGRAM, 1))
        .output()
        .unwrap();
    let verdict = String::from_utf8(repeated.stdout).unwrap();
    let mut lines = verdict.lines();
    assert_eq!(lines.next(), Some("id,status,lo,hi,verdict,answer,time"));
    let row = lines.next().unwrap();
    assert!(
        row.contains(",late,contact,") || row.contains(",missed,free,"),
        "{row}"
    );
    fs::remove_dir_all(&folder).unwrap();
}
