//! Runs that are interrupted: nothing of what was there is lost, and what was done is not done again.

use crate::command::{Scene, stderr};
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};

/// What is asked unless a test says otherwise.
const USUAL: [[&str; 2]; 5] = [
    ["--a", "box:.5,.5,.5"],
    ["--b", "box:9,9,1"],
    ["--motions", "-"],
    ["--out", "results.csv"],
    ["--contacts", "contacts.csv"],
];
const ROWS: usize = 20_000;

fn motions() -> String {
    let mut table = "id,a_px,a_pz,a_vz,a_wx\n".to_owned();
    for k in 0..ROWS {
        let bad = if k % 1000 == 7 { "x" } else { "" };
        table += &format!("r{k},{}{bad},4,-4,{}\n", k % 17, k % 5);
    }
    table
}

/// A folder of its own, with nothing of earlier tests.
fn fresh(name: &str) -> Scene {
    let scene = Scene::new(name);
    fs::remove_dir_all(&scene.directory).unwrap();
    Scene::new(name)
}

fn query(scene: &Scene, options: &[&str]) -> Command {
    let usual = USUAL.iter().filter(|[name, _]| !options.contains(name));
    let mut command = Command::new(env!("CARGO_BIN_EXE_ccd"));
    command
        .current_dir(&scene.directory)
        .args(["query", "--no-micros"])
        .args(usual.flatten())
        .args(options)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    command
}

fn finished(mut command: Command, input: &str) -> Output {
    let mut child = command.spawn().unwrap();
    let _ = child.stdin.take().unwrap().write_all(input.as_bytes());
    child.wait_with_output().unwrap()
}

/// Gives it some of the table and no end, until rows are kept; then kills it.
fn killed(scene: &Scene, options: &[&str], some: &str) {
    let marks = || {
        let journal = fs::read_to_string(path(scene, "results.csv.resume"));
        journal.unwrap_or_default().matches("\"rows\":").count()
    };
    let begun = marks();
    let mut child: Child = query(scene, options).spawn().unwrap();
    let mut input = child.stdin.take().unwrap();
    input.write_all(some.as_bytes()).unwrap();
    input.flush().unwrap();
    while marks() < begun.max(1) + 2 {
        assert!(child.try_wait().unwrap().is_none(), "it ended by itself");
        std::thread::yield_now();
    }
    child.kill().unwrap();
    child.wait().unwrap();
}

fn path(scene: &Scene, name: &str) -> PathBuf {
    scene.directory.join(name)
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

const TABLES: [&str; 2] = ["results.csv", "contacts.csv"];

#[test]
fn a_run_that_is_killed_twice_ends_with_the_same_bytes() {
    let table = motions();
    let whole = fresh("undisturbed");
    let output = finished(query(&whole, &[]), &table);
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));

    let scene = fresh("killed");
    for name in TABLES {
        fs::write(path(&scene, name), "of old").unwrap();
    }
    let third = table.match_indices('\n').nth(ROWS / 3).unwrap().0;
    killed(&scene, &[], &table[..third]);
    // Half a row, as a process leaves it that is killed while it writes.
    for name in [
        "results.csv.partial",
        "contacts.csv.partial",
        "results.csv.resume",
    ] {
        let mut file = fs::File::options()
            .append(true)
            .open(path(&scene, name))
            .unwrap();
        file.write_all(b"r9,con").unwrap();
    }
    killed(&scene, &["--resume", "--threads", "2"], &table[..2 * third]);
    for name in TABLES {
        assert_eq!(read(&path(&scene, name)), "of old");
    }
    let output = finished(query(&scene, &["--resume"]), &table);
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    assert!(
        stderr(&output).contains("goes on behind row"),
        "{}",
        stderr(&output)
    );
    for name in TABLES {
        assert!(
            read(&path(&scene, name)) == read(&path(&whole, name)),
            "{name} differs"
        );
    }
    let left = fs::read_dir(&scene.directory).unwrap().count();
    assert_eq!(left, TABLES.len(), "nothing else is left");
}

#[test]
fn a_run_goes_on_only_with_the_same_question() {
    let table = motions();
    let scene = fresh("other-question");
    let part = &table[..table.len() / 2];
    killed(&scene, &[], part);
    let kept = read(&path(&scene, "results.csv.partial"));
    let other_rows = table.replace(",4,-4,", ",4,-5,");
    for (options, input, expected) in [
        (
            &["--tolerance", "1e-6", "--resume"][..],
            &table,
            "`tolerance: 0.001,`, not `tolerance: 1e-6,`",
        ),
        (&["--b", "box:9,9,2", "--resume"], &table, "box:9,9,2"),
        (&["--resume"], &other_rows, "not the rows"),
        (&[], &table, "rows of an interrupted run; --resume goes on"),
    ] {
        let output = finished(query(&scene, options), input);
        assert_eq!(output.status.code(), Some(2), "{options:?}");
        assert!(
            stderr(&output).contains(expected),
            "{expected}: {}",
            stderr(&output)
        );
        assert_eq!(
            read(&path(&scene, "results.csv.partial")),
            kept,
            "{options:?}"
        );
    }
}

#[test]
fn nothing_to_resume_is_no_failure() {
    let scene = fresh("nothing-to-resume");
    let one = "a_pz\n4\n";
    let output = finished(query(&scene, &["--resume"]), one);
    assert!(output.status.success(), "{}", stderr(&output));
    assert!(stderr(&output).contains("nothing to go on with"));
    let output = finished(query(&scene, &["--resume", "--out", "-"]), one);
    assert_eq!(output.status.code(), Some(2));
}

#[test]
fn tables_take_the_place_of_files_alone() {
    let scene = fresh("no-files");
    let one = "a_pz\n4\n";
    fs::create_dir(path(&scene, "folder")).unwrap();
    for out in ["folder", "no/such/file"] {
        let output = finished(query(&scene, &["--out", out]), one);
        assert_eq!(output.status.code(), Some(1), "{out}: {}", stderr(&output));
    }
    let output = finished(query(&scene, &["--out", ""]), one);
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    let mesh = path(&scene, "part.obj");
    fs::write(&mesh, crate::TETRAHEDRON).unwrap();
    let over = ["--out", "part.obj", "--a", "part.obj"];
    let output = finished(query(&scene, &over), one);
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    assert_eq!(read(&mesh), crate::TETRAHEDRON);
}

#[cfg(unix)]
#[test]
fn devices_stay_what_they_are() {
    use std::os::unix::fs::FileTypeExt;
    let scene = fresh("devices");
    let output = finished(query(&scene, &["--out", "/dev/null"]), "a_pz\n4\n");
    assert!(output.status.success(), "{}", stderr(&output));
    assert!(
        fs::metadata("/dev/null")
            .unwrap()
            .file_type()
            .is_char_device()
    );
}
