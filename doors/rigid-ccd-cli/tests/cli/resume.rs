//! Tests interrupted runs: existing files are kept, and answered rows are not answered again.

use crate::command::{Scene, assert_contains, stderr};
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};

/// The default options of a query in these tests.
const DEFAULT_OPTIONS: [[&str; 2]; 5] = [
    ["--a", "box:.5,.5,.5"],
    ["--b", "box:9,9,1"],
    ["--motions", "-"],
    ["--out", "results.csv"],
    ["--contacts", "contacts.csv"],
];
const ROW_COUNT: usize = 20_000;

pub(crate) fn motions() -> String {
    let mut table = "id,a_px,a_pz,a_vz,a_wx\n".to_owned();
    for k in 0..ROW_COUNT {
        let bad = if k % 1000 == 7 { "x" } else { "" };
        table += &format!("r{k},{}{bad},4,-4,{}\n", k % 17, k % 5);
    }
    table
}

pub(crate) fn query(scene: &Scene, options: &[&str]) -> Command {
    let usual = DEFAULT_OPTIONS
        .iter()
        .filter(|[name, _]| !options.contains(name));
    let mut command = Command::new(crate::PROGRAM_PATH);
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

pub(crate) fn run_to_end(mut command: Command, input: &str) -> Output {
    let mut child = command.spawn().unwrap();
    let _ = child.stdin.take().unwrap().write_all(input.as_bytes());
    child.wait_with_output().unwrap()
}

/// Starts a run with a part of the table, and kills it after a few checkpoints.
pub(crate) fn run_and_kill(scene: &Scene, options: &[&str], some: &str) {
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

pub(crate) fn path(scene: &Scene, name: &str) -> PathBuf {
    scene.directory.join(name)
}

pub(crate) fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

const TABLE_FILE_NAMES: [&str; 2] = ["results.csv", "contacts.csv"];

#[test]
fn a_run_that_is_killed_twice_ends_with_the_same_bytes() {
    let table = motions();
    let whole = Scene::new("undisturbed");
    let output = run_to_end(query(&whole, &[]), &table);
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));

    let scene = Scene::new("killed");
    for name in TABLE_FILE_NAMES {
        fs::write(path(&scene, name), "of old").unwrap();
    }
    let third = table.match_indices('\n').nth(ROW_COUNT / 3).unwrap().0;
    run_and_kill(&scene, &[], &table[..third]);
    // A process that is killed while it writes leaves half a row.
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
    run_and_kill(&scene, &["--resume", "--threads", "2"], &table[..2 * third]);
    for name in TABLE_FILE_NAMES {
        assert_eq!(read(&path(&scene, name)), "of old");
    }
    let output = run_to_end(query(&scene, &["--resume"]), &table);
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    let message = stderr(&output);
    let count = |before: &str, after: &str| {
        let (_, rest) = message.split_once(before)?;
        rest.split_once(after)?.0.parse::<usize>().ok()
    };
    let done = count("continues at row ", " of standard input");
    let done = done.unwrap_or_else(|| panic!("{message}"));
    // The summary counts all rows of the table, and those of this run.
    assert_contains(&message, "\n20000 rows: ");
    let here = count(", 20 error; ", " in this run; median");
    assert_eq!(here, Some(ROW_COUNT - done), "{message}");
    for name in TABLE_FILE_NAMES {
        assert!(
            read(&path(&scene, name)) == read(&path(&whole, name)),
            "{name} differs"
        );
    }
    let left = fs::read_dir(&scene.directory).unwrap().count();
    assert_eq!(left, TABLE_FILE_NAMES.len() + 1, "only the journal is left");
    assert!(path(&scene, "results.csv.resume").exists());
}

#[test]
fn rows_without_their_record_are_kept() {
    let table = motions();
    let scene = Scene::new("no-record");
    let part = table.match_indices('\n').nth(ROW_COUNT / 3).unwrap().0;
    run_and_kill(&scene, &[], &table[..part]);
    let [rows, record] =
        ["results.csv.partial", "results.csv.resume"].map(|name| path(&scene, name));
    let kept = read(&rows);
    let whole = read(&record);
    let begun = &whole[..whole.find("marks:\n").unwrap() + "marks:\n".len()];
    for (damage, refuses) in [
        (None, true),
        (Some(""), true),
        (Some("not a record"), true),
        // A run that was killed before its first checkpoint.
        (Some(begun), false),
    ] {
        match damage {
            None => fs::remove_file(&record).unwrap(),
            Some(text) => fs::write(&record, text).unwrap(),
        }
        for more in [&[][..], &["--resume"]] {
            let output = run_to_end(query(&scene, more), &table[..part]);
            let refused = stderr(&output).contains("is missing or damaged; delete the first");
            assert_eq!(refused, refuses, "{damage:?}: {}", stderr(&output));
            if refuses {
                assert!(read(&rows) == kept);
            }
        }
    }
}

#[test]
fn a_run_continues_only_with_the_same_options_and_rows() {
    let table = motions();
    let scene = Scene::new("other-question");
    let part = &table[..table.len() / 2];
    run_and_kill(&scene, &[], part);
    let kept = read(&path(&scene, "results.csv.partial"));
    let other_rows = table.replace(",4,-4,", ",4,-5,");
    for (options, input, expected) in [
        (
            &["--tolerance", "1e-6", "--resume"][..],
            &table,
            "had other options: --tolerance was 0.001 and is now 1e-6; give the same",
        ),
        (
            &["--b", "box:9,9,2", "--deadline", "1.5", "--resume"],
            &table,
            "--b was box:9,9,1 and is now box:9,9,2, --deadline was not given and is now 1.5;",
        ),
        (&["--resume"], &other_rows, "not the rows"),
        (&[], &table, "rows of an interrupted run; add --resume"),
    ] {
        let output = run_to_end(query(&scene, options), input);
        assert_eq!(output.status.code(), Some(2), "{options:?}");
        let message = stderr(&output);
        assert_contains(&message, expected);
        assert!(
            !message.contains("Some(") && !message.contains(" {"),
            "{message}"
        );
        assert_eq!(
            read(&path(&scene, "results.csv.partial")),
            kept,
            "{options:?}"
        );
    }
}

#[test]
fn resuming_without_an_interrupted_run_starts_a_new_one() {
    let scene = Scene::new("nothing-to-resume");
    let one = "a_pz\n4\n";
    let output = run_to_end(query(&scene, &["--resume"]), one);
    assert!(output.status.success(), "{}", stderr(&output));
    assert_contains(&stderr(&output), "found no interrupted run");
    let output = run_to_end(query(&scene, &["--resume", "--out", "-"]), one);
    assert_eq!(output.status.code(), Some(2));
}

/// Returns the text and the modification time of each table.
fn tables_and_modification_times(scene: &Scene) -> Vec<(String, std::time::SystemTime)> {
    let table = |name: &&str| {
        let path = path(scene, name);
        let written = fs::metadata(&path).unwrap().modified().unwrap();
        (read(&path), written)
    };
    TABLE_FILE_NAMES.iter().map(table).collect()
}

#[test]
fn a_finished_run_is_left_unchanged() {
    for (name, table, code) in [
        ("finished", "id,a_pz,a_vz\nx,4,-4\ny,9,-1\n", 0),
        ("finished-bad", "id,a_pz,a_vz\nx,4,-4\ny,9,z\n", 2),
        ("finished-empty", "id,a_pz,a_vz\n", 0),
    ] {
        let scene = Scene::new(name);
        let output = run_to_end(query(&scene, &[]), table);
        assert_eq!(output.status.code(), Some(code), "{}", stderr(&output));
        let before = tables_and_modification_times(&scene);
        let output = run_to_end(query(&scene, &["--resume"]), table);
        assert_eq!(output.status.code(), Some(code), "{}", stderr(&output));
        let message = stderr(&output);
        assert_contains(
            &message,
            "results.csv already has all rows of this query; it is unchanged",
        );
        assert_eq!(
            message.contains("2 rows: "),
            !name.ends_with("empty"),
            "{message}"
        );
        assert!(!message.contains("median"), "{message}");
        assert_eq!(tables_and_modification_times(&scene), before);
        // Without the option, a new run starts.
        let output = run_to_end(query(&scene, &[]), table);
        assert_eq!(output.status.code(), Some(code));
        assert_ne!(tables_and_modification_times(&scene)[0].1, before[0].1);
    }
}

#[test]
fn a_finished_run_with_other_options_is_refused() {
    let table = "id,a_pz,a_vz\nx,4,-4\ny,9,-1\n";
    let scene = Scene::new("finished-other");
    let output = run_to_end(query(&scene, &[]), table);
    assert!(output.status.success(), "{}", stderr(&output));
    let before = tables_and_modification_times(&scene);
    for (options, input, expected) in [
        (
            &["--tolerance", "1e-6"][..],
            table,
            "the finished run had other options: --tolerance was 0.001 and is now 1e-6",
        ),
        (
            &["--contacts", "other.csv"],
            table,
            "--contacts was contacts.csv and is now other.csv",
        ),
        (&["--rows", "..1"], table, "--rows was 0.. and is now 0..1"),
        (&[], "id,a_pz,a_vz\nx,4,-4\ny,9,-2\n", "not the rows of the"),
        (&[], "id,a_pz,a_vz\nx,4,-4\n", "not the rows of the"),
        (&[], &format!("{table}z,9,-1\n"), "not the rows of the"),
    ] {
        let mut command = query(&scene, options);
        command.arg("--resume");
        let output = run_to_end(command, input);
        assert_eq!(output.status.code(), Some(2), "{options:?}");
        let message = stderr(&output);
        assert_contains(&message, expected);
        assert_eq!(tables_and_modification_times(&scene), before);
    }
    // A file of another program is not mistaken for the table.
    fs::write(path(&scene, "results.csv"), "mine").unwrap();
    let output = run_to_end(query(&scene, &["--resume"]), table);
    assert_eq!(output.status.code(), Some(2));
    let message = stderr(&output);
    assert_contains(&message, "has changed since the run finished");
    assert_eq!(read(&path(&scene, "results.csv")), "mine");
    // Without a table, all rows are answered.
    fs::remove_file(path(&scene, "results.csv")).unwrap();
    let output = run_to_end(query(&scene, &["--resume"]), table);
    assert!(output.status.success(), "{}", stderr(&output));
    assert_eq!(read(&path(&scene, "results.csv")), before[0].0);
}

/// Tests that `--resume` renames the complete tables of a run that was killed before it renamed them.
#[test]
fn complete_tables_are_renamed() {
    let table = "id,a_pz,a_vz\nx,4,-4\ny,9,-1\n";
    let scene = Scene::new("nameless");
    let output = run_to_end(query(&scene, &[]), table);
    assert!(output.status.success(), "{}", stderr(&output));
    let before = tables_and_modification_times(&scene);
    for names in [&TABLE_FILE_NAMES[..], &TABLE_FILE_NAMES[1..]] {
        for name in names {
            let partial = path(&scene, &format!("{name}.partial"));
            fs::rename(path(&scene, name), partial).unwrap();
        }
        let output = run_to_end(query(&scene, &["--resume"]), table);
        assert!(output.status.success(), "{}", stderr(&output));
        assert_eq!(tables_and_modification_times(&scene), before);
    }
}

#[test]
fn a_changed_mesh_is_reported_with_its_option() {
    let scene = Scene::new("changed-mesh");
    let mesh = path(&scene, "part.obj");
    let options = ["--a", "part.obj"];
    fs::write(&mesh, crate::TETRAHEDRON_OBJ).unwrap();
    let table = "a_pz\n9\n";
    assert!(run_to_end(query(&scene, &options), table).status.success());
    fs::write(&mesh, crate::TETRAHEDRON_OBJ.replace("v 1 0 0", "v 2 0 0")).unwrap();
    let mut command = query(&scene, &options);
    command.arg("--resume");
    let output = run_to_end(command, table);
    assert_eq!(output.status.code(), Some(2));
    let message = stderr(&output);
    assert_contains(&message, ": the file of --a has changed since; give");
}

#[test]
fn folders_and_inputs_are_never_overwritten() {
    let scene = Scene::new("no-files");
    let one = "a_pz\n4\n";
    fs::create_dir(path(&scene, "folder")).unwrap();
    for out in ["folder", "no/such/file"] {
        let output = run_to_end(query(&scene, &["--out", out]), one);
        assert_eq!(output.status.code(), Some(1), "{out}: {}", stderr(&output));
    }
    let output = run_to_end(query(&scene, &["--out", ""]), one);
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    let mesh = path(&scene, "part.obj");
    fs::write(&mesh, crate::TETRAHEDRON_OBJ).unwrap();
    let over = ["--out", "part.obj", "--a", "part.obj"];
    let output = run_to_end(query(&scene, &over), one);
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    assert_eq!(read(&mesh), crate::TETRAHEDRON_OBJ);
}

#[cfg(unix)]
#[test]
fn devices_are_not_replaced() {
    use std::os::unix::fs::FileTypeExt;
    let scene = Scene::new("devices");
    let output = run_to_end(query(&scene, &["--out", "/dev/null"]), "a_pz\n4\n");
    assert!(output.status.success(), "{}", stderr(&output));
    assert!(
        fs::metadata("/dev/null")
            .unwrap()
            .file_type()
            .is_char_device()
    );
}
