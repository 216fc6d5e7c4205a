//! Tests that outputs are written completely, by one run at a time; a full disk destroys no older file.

use crate::command::{CommandCall, Scene, assert_contains, stderr};
use crate::resume::{motions, path, query, read, run_and_kill, run_to_end};
use ccd_file::Claim;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

const MOTIONS_CSV: &str = "id,a_pz,a_vz\nhit,4,-4\nfree,9,-1\n";

/// Writes the input files of the tests: a ball of many triangles, a table of 2 motions, one of 4,000 motions, and a
/// scene.
fn write_inputs(scene: &Scene) {
    let mut ball = String::new();
    for k in 0..=24 {
        for j in 0..48 {
            let (up, round) = (f64::from(k) * 7.5, f64::from(j) * 7.5);
            let (sin, cos) = up.to_radians().sin_cos();
            let (y, x) = round.to_radians().sin_cos();
            ball += &format!("v {} {} {}\n", sin * x, sin * y, cos);
        }
    }
    for k in 0..24 {
        for j in 0..48 {
            let corner = |k: i32, j: i32| 48 * k + j % 48 + 1;
            let [a, b, c, d] =
                [(k, j), (k + 1, j), (k + 1, j + 1), (k, j + 1)].map(|(k, j)| corner(k, j));
            ball += &format!("f {a} {b} {c}\nf {a} {c} {d}\n");
        }
    }
    scene.file("ball.obj", &ball);
    scene.file("motions.csv", MOTIONS_CSV);
    let mut many = String::from("id,a_pz,a_vz\n");
    for k in 0..4000 {
        many += &format!("row{k},4,-4\n");
    }
    scene.file("many.csv", &many);
    scene.file("scene.csv", "body,pz,vz\nsphere:1,0,0\nsphere:1,5,-5\n");
}

/// Each command that writes a file, after the name of that file.
const WRITING_COMMANDS: [(&str, &str); 7] = [
    (
        "r.csv",
        "query --a box:.5,.5,.5 --b box:9,9,1 --motions many.csv --out r.csv",
    ),
    (
        "c.csv",
        "query --a box:.5,.5,.5 --b box:9,9,1 --motions many.csv --out x.csv --contacts c.csv",
    ),
    (
        "q.html",
        "query --a box:.5,.5,.5 --b box:9,9,1 --motions motions.csv --out y.csv --html q.html",
    ),
    (
        "v.html",
        "view --a box:.5,.5,.5 --b box:9,9,1 --motions motions.csv --out v.html",
    ),
    ("s.html", "view --scene scene.csv --out s.html"),
    ("b.ccd", "decompose ball.obj --out b.ccd"),
    ("b.obj", "decompose ball.obj --pieces triangles --out b.obj"),
];

fn run(scene: &Scene, command: &str) -> Output {
    let args: Vec<&str> = command.split(' ').collect();
    CommandCall::with_args(&args)
        .folder(&scene.directory)
        .output()
}

fn names(scene: &Scene) -> Vec<String> {
    let entries = fs::read_dir(&scene.directory).unwrap();
    let mut names: Vec<String> = entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort_unstable();
    names
}

#[test]
fn one_run_at_a_time_writes_a_file() {
    let scene = Scene::new("one-at-a-time");
    write_inputs(&scene);
    let before = names(&scene);
    for (name, command) in WRITING_COMMANDS {
        let claim = Claim::new(path(&scene, name)).unwrap();
        fs::write(path(&scene, name), "good").unwrap();
        let output = run(&scene, command);
        let message = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{command}: {message}");
        let expected = format!("{name}: another run is writing it; wait for its end");
        assert_contains(&message, &expected);
        assert!(!message.contains("delete"), "{message}");
        assert_eq!(read(&path(&scene, name)), "good");
        fs::remove_file(path(&scene, name)).unwrap();
        drop(claim);
        assert_eq!(names(&scene), before, "{command}");
        let output = run(&scene, command);
        assert!(
            matches!(output.status.code(), Some(0 | 3)),
            "{command}: {}",
            stderr(&output)
        );
        assert!(read_bytes(&scene, name).len() > 8192, "{command}");
        for name in names(&scene) {
            if !before.contains(&name) {
                fs::remove_file(path(&scene, &name)).unwrap();
            }
        }
    }
    let claim = Claim::new(path(&scene, "k.csv")).unwrap();
    let scenes = "scene scene.csv --out k.csv";
    assert_eq!(run(&scene, scenes).status.code(), Some(2));
    drop(claim);
    assert!(run(&scene, scenes).status.success());
}

fn read_bytes(scene: &Scene, name: &str) -> Vec<u8> {
    fs::read(path(scene, name)).unwrap()
}

/// Tests that a run refuses an output that another run is writing, under whatever name, and does not change it. The
/// first run lasts as long as its input is open.
#[test]
fn a_run_that_is_alive_is_left_alone() {
    let table = motions();
    let whole = Scene::new("alone");
    run_to_end(query(&whole, &[]), &table);
    let scene = Scene::new("alive");
    let mut first = query(&scene, &[]).spawn().unwrap();
    let mut input = first.stdin.take().unwrap();
    let half = table.len() / 2;
    std::io::Write::write_all(&mut input, &table.as_bytes()[..half]).unwrap();
    while fs::metadata(path(&scene, "results.csv.partial")).map_or(0, |there| there.len()) == 0 {
        std::thread::yield_now();
    }
    let own = format!(
        "../{}/results.csv",
        scene.directory.file_name().unwrap().to_str().unwrap()
    );
    #[cfg(unix)]
    std::os::unix::fs::symlink("results.csv", path(&scene, "link.csv")).unwrap();
    let link = if cfg!(unix) {
        "link.csv"
    } else {
        "results.csv"
    };
    for out in ["results.csv", "./results.csv", link, &own] {
        for more in [&[][..], &["--resume"]] {
            for contacts in ["contacts.csv", "others.csv"] {
                let options = [&["--out", out, "--contacts", contacts][..], more].concat();
                let output = run_to_end(query(&scene, &options), &table);
                let message = stderr(&output);
                assert_eq!(output.status.code(), Some(2), "{options:?}: {message}");
                assert_contains(&message, "another run is writing it");
                assert!(!message.contains("delete"), "{message}");
            }
        }
    }
    std::io::Write::write_all(&mut input, &table.as_bytes()[half..]).unwrap();
    drop(input);
    assert_eq!(first.wait_with_output().unwrap().status.code(), Some(2));
    for name in ["results.csv", "contacts.csv"] {
        assert!(
            read(&path(&scene, name)) == read(&path(&whole, name)),
            "{name} differs"
        );
    }
    let expected = [
        "contacts.csv",
        "link.csv",
        "results.csv",
        "results.csv.resume",
    ];
    let there = names(&scene).into_iter().filter(|name| name != "link.csv");
    assert!(there.eq(expected.into_iter().filter(|&name| name != "link.csv")));
}

/// Tests that of four runs that start together with one output, each one writes the whole table or refuses to start.
#[test]
fn runs_side_by_side_keep_all_rows() {
    let table = motions();
    let whole = Scene::new("side-alone");
    run_to_end(query(&whole, &[]), &table);
    let scene = Scene::new("side-by-side");
    scene.file("motions.csv", &table);
    let mut done = 0;
    for more in [&[][..], &["--resume"]] {
        let options = [&["--motions", "motions.csv", "--threads", "1"][..], more].concat();
        let runs: Vec<_> = (0..4)
            .map(|_| query(&scene, &options).spawn().unwrap())
            .collect();
        for run in runs {
            let output = run.wait_with_output().unwrap();
            let message = stderr(&output);
            // Some rows of the table are bad, which gives the same exit code as a refusal.
            assert_eq!(output.status.code(), Some(2), "{message}");
            if !message.contains("another run is writing it") {
                assert_contains(&message, "20000 rows: ");
                done += 1;
            }
        }
        for name in ["results.csv", "contacts.csv"] {
            assert!(
                read(&path(&scene, name)) == read(&path(&whole, name)),
                "{name} differs"
            );
        }
    }
    assert!(done >= 2, "{done}");
}

#[test]
fn an_edited_byte_is_not_resumed_from() {
    let table = motions();
    let scene = Scene::new("edited");
    let part = &table[..table.len() / 2];
    run_and_kill(&scene, &[], part);
    let kept = [
        "results.csv.partial",
        "contacts.csv.partial",
        "results.csv.resume",
    ];
    let kept = kept.map(|name| (name, read_bytes(&scene, name)));
    let mut tried = 0;
    for (name, bytes) in &kept {
        let lines = kept[2].1.iter().filter(|&&b| b == b'\n').count();
        for fraction in 0..8 {
            // Everything after the last checkpoint is dropped; the last checkpoint of the tables is near the
            // end.
            let at = fraction * bytes.len() / 16 + 3;
            let mut edited = bytes.clone();
            edited[at] = if edited[at] == b'7' { b'8' } else { b'7' };
            fs::write(path(&scene, name), edited).unwrap();
            let output = run_to_end(query(&scene, &["--resume"]), part);
            let message = stderr(&output);
            let refused = [
                "is not as the interrupted run left it",
                "is missing or damaged",
            ];
            assert!(
                refused.iter().any(|text| message.contains(text)),
                "{name}, byte {at}, {lines} lines: {message}"
            );
            assert_eq!(output.status.code(), Some(2));
            fs::write(path(&scene, name), bytes).unwrap();
            tried += 1;
        }
    }
    assert_eq!(tried, 24);
    let output = run_to_end(query(&scene, &["--resume"]), &table);
    assert_contains(&stderr(&output), "20000 rows: ");
    // The same holds for a finished table.
    let mut results = read_bytes(&scene, "results.csv");
    let middle = results.len() / 2;
    results[middle] ^= 1;
    fs::write(path(&scene, "results.csv"), &results).unwrap();
    let output = run_to_end(query(&scene, &["--resume"]), &table);
    let message = stderr(&output);
    assert_contains(&message, "has changed since the run finished");
    assert_eq!(read_bytes(&scene, "results.csv"), results);
}

/// Tests that another command, or the other table of a query, does not overwrite the answers of an interrupted query.
#[test]
fn rows_of_an_interrupted_query_are_kept() {
    let scene = Scene::new("kept-rows");
    run_and_kill(&scene, &[], &motions());
    let rows = read_bytes(&scene, "results.csv.partial");
    scene.file("one.csv", "a_px\n9\n");
    let boxes = "--a box:1,1,1 --b box:1,1,1 --motions one.csv --out";
    let query = format!("query {boxes} x.csv --contacts results.csv");
    scene.file("scene.csv", "body,pz,vz\nsphere:1,0,0\nsphere:1,5,-5\n");
    for command in ["scene scene.csv --out results.csv", &query] {
        let output = run(&scene, command);
        let message = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert_contains(&message, "has rows of an interrupted query");
        assert_eq!(read_bytes(&scene, "results.csv.partial"), rows);
    }
}

#[cfg(unix)]
mod full {
    use super::*;

    /// Runs a command that can write at most about 4 KB to a file, as on a full disk.
    fn run_with_full_disk(scene: &Scene, command: &str) -> Output {
        let limit = "trap '' XFSZ; ulimit -f 8; exec \"$@\"";
        Command::new("sh")
            .current_dir(&scene.directory)
            .args(["-c", limit, "sh", crate::PROGRAM_PATH])
            .args(command.split(' '))
            .output()
            .unwrap()
    }

    #[test]
    fn a_full_disk_loses_no_older_file() {
        let scene = Scene::new("full-disk");
        write_inputs(&scene);
        for (name, command) in WRITING_COMMANDS {
            fs::write(path(&scene, name), "good").unwrap();
            let output = run_with_full_disk(&scene, command);
            let message = stderr(&output);
            assert_eq!(output.status.code(), Some(1), "{command}: {message}");
            assert_contains(&message, "cannot write ");
            assert_eq!(read(&path(&scene, name)), "good", "{command}");
        }
        let tables = |name: &String| name.contains(".csv.") || name.ends_with(".csv");
        let left: Vec<String> = names(&scene).into_iter().filter(|n| !tables(n)).collect();
        assert_eq!(
            left,
            ["b.ccd", "b.obj", "ball.obj", "q.html", "s.html", "v.html"]
        );
        // The existing part of a table is continued once there is space.
        let output = run(&scene, &format!("{} --resume", WRITING_COMMANDS[0].1));
        assert!(output.status.success(), "{}", stderr(&output));
        let rows = read(&path(&scene, "r.csv"));
        let ids = rows
            .lines()
            .skip(1)
            .map(|row| row.split(',').next().unwrap());
        assert!(ids.eq((0..4000).map(|k| format!("row{k}"))));
    }

    #[test]
    fn a_full_disk_loses_no_pages() {
        let scene = Scene::new("full-pages");
        write_inputs(&scene);
        scene.file("hit.html", "good");
        let view = "view --a box:.5,.5,.5 --b box:9,9,1 --motions motions.csv --out hit.html";
        assert_eq!(run_with_full_disk(&scene, view).status.code(), Some(1));
        assert_eq!(read(&path(&scene, "hit.html")), "good");
        scene.file("ccd-query.1", "good");
        assert_eq!(run_with_full_disk(&scene, "man .").status.code(), Some(1));
        assert_eq!(read(&path(&scene, "ccd-query.1")), "good");
        assert!(names(&scene).iter().all(|name| !name.ends_with(".part")));
    }

    /// Tests that rows written to a file that the shell has opened for appending follow the file's earlier content.
    #[test]
    fn open_files_are_written_on() {
        let scene = Scene::new("open-files");
        write_inputs(&scene);
        let query = "query --a box:.5,.5,.5 --b box:9,9,1 --motions motions.csv --quiet --out";
        for out in ["-", "/dev/stdout", "/dev/fd/3"] {
            scene.file("all.csv", "before\n");
            let status = Command::new("sh")
                .current_dir(&scene.directory)
                .args([
                    "-c",
                    "exec \"$@\" >>all.csv 3>>all.csv",
                    "sh",
                    crate::PROGRAM_PATH,
                ])
                .args(query.split(' '))
                .arg(out)
                .status()
                .unwrap();
            assert!(status.success(), "{out}");
            let text = read(&path(&scene, "all.csv"));
            assert!(text.starts_with("before\nid,status"), "{out}: {text}");
            assert_eq!(text.lines().count(), 4, "{out}");
        }
        let output = run(&scene, &format!("{query} /dev/full"));
        assert_eq!(output.status.code(), Some(1));
        assert!(Path::new("/dev/full").exists());
    }

    #[test]
    fn a_table_for_a_closed_standard_output_is_not_lost_without_a_word() {
        let scene = Scene::new("closed-output");
        write_inputs(&scene);
        let query = "query --a box:.5,.5,.5 --b box:9,9,1 --motions motions.csv --quiet";
        let run_with = |redirection: &str, arguments: &str| {
            Command::new("sh")
                .current_dir(&scene.directory)
                .args(["-c", &format!("exec \"$@\" {redirection}"), "sh"])
                .arg(crate::PROGRAM_PATH)
                .args(arguments.split(' '))
                .output()
                .unwrap()
        };
        for arguments in [query, "completions bash"] {
            let output = run_with(">&-", arguments);
            assert_eq!(output.status.code(), Some(1), "{arguments}");
            let message = String::from_utf8(output.stderr).unwrap();
            assert!(
                message.contains("cannot write standard output"),
                "{message}"
            );
            let discarded = run_with(">/dev/null", arguments);
            assert_eq!(discarded.status.code(), Some(0), "{arguments}");
        }
        let to_a_file = run_with(">&-", &format!("{query} --out table.csv"));
        assert_eq!(to_a_file.status.code(), Some(0));
    }
}
