//! Tests `ccd edges`, `ccd clearance`, `ccd acm`, and `ccd view` of a robot.

use crate::command::{CommandCall, Row, Scene, assert_contains, parse, stderr};
use serde_json::Value;
use std::fs;
use std::path::Path;

/// Returns a folder with the arm of the examples: two links of 0.5 and 0.4 that turn about y, a ball of 0.06 as hand.
pub(crate) fn folder() -> Scene {
    let scene = Scene::new("robots");
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    for name in ["arm.urdf", "arm.srdf", "cell.toml", "moves.csv", "path.csv"] {
        fs::copy(examples.join(name), scene.directory.join(name)).unwrap();
    }
    scene
}

pub(crate) fn call(scene: &Scene, args: &[&str]) -> CommandCall {
    CommandCall::with_args(args).folder(&scene.directory)
}

pub(crate) const EDGES: [&str; 6] = [
    "edges",
    "arm.urdf",
    "--cell",
    "cell.toml",
    "--edges",
    "moves.csv",
];

#[test]
fn the_hand_meets_the_table_where_it_should() {
    let scene = folder();
    let rows = call(&scene, &EDGES)
        .args(&["--question", "first-contact"])
        .run_for_rows();
    let [up, _, down, _] = &rows[..] else {
        panic!("{} rows", rows.len());
    };
    assert_eq!(
        (up.text("id"), up.text("status"), up.number("time")),
        ("up", "free", 1.0)
    );
    assert_eq!(
        (down.text("a"), down.text("b"), down.text("status")),
        ("hand", "table", "contact")
    );
    // The shoulder is 0.2 high, the table's top at -0.1, the hand's middle 0.9 away: it touches at sin(angle) = 0.24 / 0.9.
    let exact = (0.24f64 / 0.9).asin() / 1.5;
    let early = exact - down.number("time");
    // The hand closes at 0.9 · cos(0.27) · 1.5 for each unit of time.
    assert!((0.0..=1e-4 / 1.3).contains(&early), "{early}");
    // The same, asked in the other ways.
    let free = call(&scene, &EDGES).run_for_rows();
    let statuses = |rows: &[Row]| {
        rows.iter()
            .map(|row| row.text("status").to_owned())
            .collect::<Vec<_>>()
    };
    assert_eq!(statuses(&free), ["free", "contact", "contact", "contact"]);
    assert_eq!(
        statuses(&rows),
        ["free", "overlapping", "contact", "contact"]
    );
    let message = call(&scene, &EDGES).args(&["--check"]).run_for_messages(3);
    assert_contains(&message, "3 of 4 rows are not proven free or kept");
    let kept = call(&scene, &EDGES)
        .args(&["--question", "closest-approach", "--clearance", "140mm"])
        .run_for_rows();
    assert_eq!(statuses(&kept)[0], "kept");
    assert!(kept[0].number("distance_lower") >= 0.14);
    assert_eq!(statuses(&kept)[2], "violated");
}

#[test]
fn joints_without_columns_rest_where_they_are_told() {
    let scene = folder();
    let query = ["edges", "arm.urdf", "--edges", "-"];
    let table = "from_shoulder,to_shoulder\n0,1.5\n";
    let rows = call(&scene, &query)
        .args(&["--joint", "elbow=30deg"])
        .stdin(table)
        .run_for_rows();
    assert_eq!(rows[0].text("status"), "free");
    let message = call(&scene, &query).stdin(table).run_for_messages(2);
    assert_contains(&message, "no column from_elbow, to_elbow");
}

#[test]
fn bad_rows_are_rows_and_good_ones_are_answered() {
    let scene = folder();
    scene.file(
        "moves.csv",
        "id,shoulder,elbow\na,0,x\nb,0,0\nb,9,0\nc,0,0\n",
    );
    let output = call(&scene, &EDGES).run_expecting_code(2);
    let rows = parse(&output.stdout);
    let found: Vec<_> = rows
        .iter()
        .map(|row| (row.text("id"), row.text("status")))
        .collect();
    assert_eq!(found, [("a", "error"), ("b", "error"), ("c", "free")]);
    assert_contains(rows[0].text("reason"), "`x` is not a finite number");
    assert_contains(
        rows[1].text("reason"),
        "configuration 1 of the path: joint `shoulder`",
    );
    assert_contains(&stderr(&output), "moves.csv, row 0 (line 2)");
}

#[test]
fn an_interrupted_run_goes_on() {
    let scene = folder();
    let mut table = "from_shoulder,from_elbow,to_shoulder,to_elbow\n".to_owned();
    for k in 0..6000 {
        table += &format!("0,{},{},0.1\n", f64::from(k) * 1e-4, f64::from(k % 7) * 0.1);
    }
    scene.file("moves.csv", &table);
    let args = ["--out", "results.csv", "--no-micros"];
    call(&scene, &EDGES).args(&args).run_expecting_code(0);
    let whole = fs::read(scene.directory.join("results.csv")).unwrap();
    let message = call(&scene, &EDGES)
        .args(&args)
        .args(&["--resume"])
        .run_for_messages(0);
    assert_contains(&message, "already has all rows");
    // As a run leaves it that ends after its first batch.
    let journal = fs::read_to_string(scene.directory.join("results.csv.resume")).unwrap();
    let lines: Vec<&str> = journal.split_inclusive('\n').collect();
    let saved_bytes = |line: &str| {
        let mark: Value = serde_json::from_str(line.rsplit_once(' ')?.0).ok()?;
        mark["results"]["bytes"].as_u64()
    };
    let is_in_the_middle = |line: &&str| saved_bytes(line).is_some_and(|bytes| bytes > 1000);
    let last = lines.iter().position(is_in_the_middle).unwrap();
    let (first, bytes) = (
        lines[..=last].concat(),
        saved_bytes(lines[last]).unwrap() as usize,
    );
    assert!(bytes < whole.len(), "{bytes}");
    fs::remove_file(scene.directory.join("results.csv")).unwrap();
    fs::write(
        scene.directory.join("results.csv.partial"),
        &whole[..bytes + 10],
    )
    .unwrap();
    fs::write(scene.directory.join("results.csv.resume"), first).unwrap();
    let changed = call(&scene, &EDGES)
        .args(&args)
        .args(&["--resume", "--clearance", "1mm"])
        .run_for_messages(2);
    assert_contains(&changed, "--clearance was 0 and is now 1mm");
    let message = call(&scene, &EDGES)
        .args(&args)
        .args(&["--resume"])
        .run_for_messages(0);
    assert_contains(&message, "continues at row");
    assert!(fs::read(scene.directory.join("results.csv")).unwrap() == whole);
}

#[test]
fn inputs_are_not_overwritten() {
    let scene = folder();
    for (file, option) in [
        ("arm.urdf", "ROBOT"),
        ("cell.toml", "--cell"),
        ("moves.csv", "--edges"),
    ] {
        let message = call(&scene, &EDGES)
            .args(&["--out", file])
            .run_for_messages(2);
        assert_contains(&message, &format!("overwrite the file of {option}"));
    }
    let message = call(&scene, &["acm", "arm.urdf", "--out", "arm.urdf"]).run_for_messages(2);
    assert_contains(&message, "overwrite the file of ROBOT");
    let message = call(
        &scene,
        &[
            "view", "arm.urdf", "--path", "path.csv", "--out", "path.csv",
        ],
    )
    .run_for_messages(2);
    assert_contains(&message, "overwrite the file of --path");
}

#[test]
fn a_clearance_has_exit_codes_and_ranges() {
    let scene = folder();
    // The hand comes near the base when the elbow folds; its least distance to the upper arm is where it is most bent.
    let clearance = [
        "clearance",
        "arm.urdf",
        "--rest",
        "--joint",
        "elbow=-30deg:160deg",
    ];
    let output = call(&scene, &clearance)
        .args(&["--require", "5mm"])
        .run_expecting_code(3);
    let text = String::from_utf8(output.stdout).unwrap();
    assert_contains(&text, "5 mm required: violated");
    assert_contains(&text, "  kept       elbow = -30.0000° to elbow = 146.");
    let half = [
        "clearance",
        "arm.urdf",
        "--rest",
        "--joint",
        "elbow=-30deg:60deg",
    ];
    let output = call(&scene, &half)
        .args(&["--require", "5mm", "--json"])
        .run_expecting_code(0);
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(report["verdict"], "kept");
    assert_eq!(report["ranges"].as_array().unwrap().len(), 1);
    let curve = report["curve"].as_array().unwrap();
    assert_eq!(curve.len(), 64);
    let least = report["closest"]["distance_lower"].as_f64().unwrap();
    for range in curve {
        let (lower, upper) = (&range["distance_lower"], &range["distance_upper"]);
        let (lower, upper) = (lower.as_f64().unwrap(), upper.as_f64().unwrap());
        assert!(lower >= least - 1e-6 && upper - lower < 1.1e-6, "{range}");
    }
    // Unverified: the tolerance is wider than what is asked for.
    let exact = report["closest"]["distance_upper"].as_f64().unwrap();
    let message = call(&scene, &half)
        .args(&[
            "--require",
            &format!("{}", exact - 1e-9),
            "--tolerance",
            "1mm",
        ])
        .run_for_messages(3);
    assert_contains(&message, "unverified");
    // What cannot be written and bad input have codes of their own.
    for (html, code) in [("/dev/full", 1), ("none/page.html", 1), ("arm.urdf", 2)] {
        call(&scene, &half)
            .args(&["--html", html])
            .run_expecting_code(code);
    }
}

#[test]
fn a_path_with_an_error_of_poses_widens_the_bounds() {
    let scene = folder();
    let distance = |error: &str| {
        let args = [
            "clearance",
            "arm.urdf",
            "--path",
            "path.csv",
            "--json",
            "--pose-error",
            error,
        ];
        let output = call(&scene, &args).run_expecting_code(0);
        let report: Value = serde_json::from_slice(&output.stdout).unwrap();
        ["distance_lower", "distance_upper"].map(|bound| report["closest"][bound].as_f64().unwrap())
    };
    let ([lower, upper], [wide_lower, wide_upper]) = (distance("0"), distance("2mm"));
    assert!(
        (lower - wide_lower - 0.004).abs() < 1e-12,
        "{lower} {wide_lower}"
    );
    assert!(
        (wide_upper - upper - 0.004).abs() < 1e-12,
        "{upper} {wide_upper}"
    );
}

#[test]
fn pairs_are_written_as_srdf() {
    let scene = folder();
    let args = [
        "acm",
        "arm.urdf",
        "--out",
        "acm.srdf",
        "--report",
        "pairs.csv",
    ];
    let message = call(&scene, &args).run_for_messages(0);
    assert_contains(&message, "6 pairs of links: 1 never touch");
    let srdf = fs::read_to_string(scene.directory.join("acm.srdf")).unwrap();
    assert_contains(
        &srdf,
        "link1=\"upper\" link2=\"hand\" reason=\"Never (proven)\"",
    );
    let pairs = parse(&fs::read(scene.directory.join("pairs.csv")).unwrap());
    let classes: Vec<_> = pairs.iter().map(|row| row.text("class")).collect();
    assert_eq!(classes.iter().filter(|class| **class == "never").count(), 1);
    // What it wrote is read.
    call(&scene, &EDGES)
        .args(&["--srdf", "acm.srdf"])
        .run_expecting_code(0);
    // It is of the robot, whatever the robot's file is called.
    let [urdf, model] = ["arm.urdf", "model.urdf"].map(|name| scene.directory.join(name));
    fs::rename(urdf, model).unwrap();
    call(&scene, &["acm", "model.urdf", "--out", "acm.srdf"]).run_for_messages(0);
    let edges = EDGES.map(|arg| if arg == "arm.urdf" { "model.urdf" } else { arg });
    let message = call(&scene, &edges)
        .args(&["--srdf", "acm.srdf"])
        .run_for_messages(0);
    assert!(!message.contains("another name"), "{message}");
}

#[test]
fn a_page_shows_the_robot() {
    let scene = folder();
    let args = [
        "view",
        "arm.urdf",
        "--cell",
        "cell.toml",
        "--path",
        "moves.csv",
        "--ids",
        "up,down",
    ];
    call(&scene, &args).run_expecting_code(0);
    let page = fs::read_to_string(scene.directory.join("view.html")).unwrap();
    assert_contains(&page, "First contact: hand and table");
    assert_contains(&page, "Free, proven. Nearest: fore and post");
    assert!(!page.contains("fold"));
    let args = [
        "clearance",
        "arm.urdf",
        "--joint",
        "elbow=0:1",
        "--joint",
        "shoulder=0",
        "--html",
        "clearance.html",
    ];
    call(&scene, &args)
        .args(&["--require", "5mm", "--pose-error", "0.1mm"])
        .run_expecting_code(0);
    let page = fs::read_to_string(scene.directory.join("clearance.html")).unwrap();
    assert_contains(&page, "5 mm required: kept");
    assert_contains(&page, "\"required\":5.0,\"failing_ranges\":[]");
    let message = call(&scene, &["view", "arm.urdf", "--joint", "knee=1"]).run_for_messages(2);
    assert_contains(&message, "--joint knee");
}

#[test]
fn a_mechanism_without_pairs_is_no_proof() {
    let scene = folder();
    let link = |name: &str| {
        format!(
            "<link name='{name}'><collision><geometry><sphere radius='0.1'/></geometry></collision></link>"
        )
    };
    let hinge = format!(
        "<robot name='hinge'>{}{}<joint name='pivot' type='revolute'><origin xyz='0.15 0 0'/><parent link='frame'/>\
         <child link='lever'/><axis xyz='0 0 1'/><limit lower='-1' upper='1' effort='1' velocity='1'/></joint></robot>",
        link("frame"),
        link("lever")
    );
    scene.file("hinge.urdf", &hinge);
    let args = ["clearance", "hinge.urdf", "--require", "0.3mm"];
    let message = call(&scene, &args).run_for_messages(2);
    assert_contains(&message, "nothing is compared in this cell: 2 links");
    assert_contains(&message, "(adjacent): frame and lever");
    // Neighbours are checked if a file says so; here they overlap, over the whole range of the only joint.
    let srdf = "<robot name='hinge'><enable_collisions link1='frame' link2='lever'/></robot>";
    scene.file("hinge.srdf", srdf);
    call(&scene, &args)
        .args(&["--srdf", "hinge.srdf"])
        .run_expecting_code(3);
    scene.file(
        "hinge.toml",
        "[[clearance]]\nbetween = ['frame', 'lever']\ndistance = 0.01\n",
    );
    call(&scene, &args)
        .args(&["--cell", "hinge.toml"])
        .run_expecting_code(3);
}

#[test]
fn a_changed_mesh_is_not_resumed() {
    let scene = folder();
    let mesh = |size: f64| {
        format!(
            "v 0 0 0\nv {size} 0 0\nv 0 {size} 0\nv 0 0 {size}\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"
        )
    };
    scene.file("hand.obj", &mesh(0.1));
    let text = fs::read_to_string(scene.directory.join("arm.urdf")).unwrap();
    scene.file(
        "arm.urdf",
        &text.replace("<sphere radius=\"0.06\"/>", "<mesh filename='hand.obj'/>"),
    );
    let args = ["--out", "results.csv"];
    call(&scene, &EDGES).args(&args).run_expecting_code(0);
    scene.file("hand.obj", &mesh(0.2));
    let message = call(&scene, &EDGES)
        .args(&args)
        .args(&["--resume"])
        .run_for_messages(2);
    assert_contains(&message, "the file of meshes has changed since");
}

#[test]
fn options_that_do_not_apply_to_a_robot_are_refused() {
    let scene = folder();
    let view = ["view", "arm.urdf", "--path", "moves.csv"];
    for options in [
        ["--margin", "0.5"],
        ["--unit", "mm"],
        ["--duration", "9"],
        ["--results", "moves.csv"],
        ["--pieces", "hull"],
    ] {
        call(&scene, &view).args(&options).run_expecting_code(2);
    }
    for joint in ["elbow=5mm", "knee=1"] {
        let message =
            call(&scene, &["clearance", "arm.urdf", "--joint", joint]).run_for_messages(2);
        assert_contains(&message, "--joint");
    }
    let twice = ["--joint", "elbow=0", "--joint", "elbow=1"];
    let call_twice = call(&scene, &["edges", "arm.urdf", "--edges", "-"]).args(&twice);
    assert_contains(
        &call_twice.stdin("shoulder\n0\n").run_for_messages(2),
        "given twice",
    );
    let several = call(&scene, &["clearance", "arm.urdf", "--path", "moves.csv"]);
    assert_contains(&several.run_for_messages(2), "several paths");
    scene.file("moves.csv", "shoulder,elbow\n");
    assert_contains(
        &call(&scene, &EDGES).args(&["--check"]).run_for_messages(2),
        "no row",
    );
}

/// Tests that one rule is about joints without a position, in all commands: an error, unless they are told to rest.
#[test]
fn joints_without_a_position_are_refused_unless_they_are_told_to_rest() {
    let scene = folder();
    scene.file("path.csv", "elbow\n0\n1\n");
    for args in [
        &["edges", "arm.urdf", "--edges", "path.csv"][..],
        &["clearance", "arm.urdf", "--path", "path.csv"],
        &["clearance", "arm.urdf", "--joint", "elbow=0:1"],
        &["view", "arm.urdf", "--path", "path.csv"],
        &["view", "arm.urdf", "--joint", "elbow=0:1"],
    ] {
        let message = call(&scene, args).run_for_messages(2);
        assert_contains(&message, "shoulder");
        assert_contains(&message, "--rest");
        call(&scene, args).args(&["--rest"]).run_expecting_code(0);
        call(&scene, args)
            .args(&["--joint", "shoulder=0"])
            .run_expecting_code(0);
    }
}

/// Tests that all outputs have the times of the table.
#[test]
fn times_of_a_clearance_are_those_of_the_table() {
    let scene = folder();
    scene.file(
        "path.csv",
        "t,shoulder,elbow\n0,0,0\n0.1,0,0.1\n0.2,1.2,0.1\n",
    );
    let clearance = [
        "clearance",
        "arm.urdf",
        "--cell",
        "cell.toml",
        "--path",
        "path.csv",
    ];
    let require = ["--require", "5mm"];
    let output = call(&scene, &clearance)
        .args(&require)
        .args(&["--json"])
        .run_expecting_code(3);
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    let ranges = report["ranges"].as_array().unwrap();
    let number = |value: &Value| value.as_f64().unwrap();
    assert_eq!(number(&ranges[0]["from"]), 0.0);
    assert_eq!(number(&ranges.last().unwrap()["to"]), 0.2);
    let violated = ranges.iter().find(|range| range["clearance"] == "violated");
    let violated = number(&violated.unwrap()["from"]);
    assert!((0.1..0.2).contains(&violated), "{violated}");
    for two in ranges.windows(2) {
        let gap = number(&two[1]["from"]) - number(&two[0]["to"]);
        assert!((0.0..1e-14).contains(&gap), "{gap}");
    }
    let nearest = number(&report["closest"]["nearest"]["time"]);
    assert!((0.1..=0.2).contains(&nearest), "{nearest}");
    let curve = report["curve"].as_array().unwrap();
    assert_eq!(number(&curve.last().unwrap()["to"]), 0.2);
}

#[test]
fn a_curve_has_a_bounded_number_of_ranges() {
    let scene = folder();
    let mut table = "shoulder,elbow\n".to_owned();
    for k in 0..721 {
        table += &format!("{},0\n", 1e-3 * f64::from(k % 50));
    }
    scene.file("path.csv", &table);
    let clearance = ["clearance", "arm.urdf", "--path", "path.csv", "--json"];
    let output = call(&scene, &clearance).run_expecting_code(0);
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    let curve = report["curve"].as_array().unwrap();
    assert_eq!(curve.len(), 360);
    assert!(output.stdout.len() < 1 << 20, "{}", output.stdout.len());
    assert_eq!(
        (&curve[0]["from"], &curve[359]["to"]),
        (&0.0.into(), &720.0.into())
    );
    for two in curve.windows(2) {
        assert_eq!(two[0]["to"], two[1]["from"]);
    }
    let least = |name: &str| {
        let bounds = curve.iter().map(|range| range[name].as_f64().unwrap());
        bounds.fold(f64::INFINITY, ccd_core::order::lesser)
    };
    let closest = &report["closest"];
    let [lower, upper] =
        ["distance_lower", "distance_upper"].map(|name| closest[name].as_f64().unwrap());
    assert!(least("distance_lower") >= lower - 1e-6 && least("distance_upper") <= upper + 1e-6);
}

/// Tests that the page has the good rows, and that what is left out is said.
#[test]
fn a_page_of_a_robot_leaves_out_bad_rows() {
    let scene = folder();
    scene.file(
        "moves.csv",
        "id,from_shoulder,from_elbow,to_shoulder,to_elbow\ngood,0,0,-0.2,0.5\nbad,0,x,0,0\nfar,0,0,9,0\nfine,0,0,0,0.1\n",
    );
    let args = [
        "view",
        "arm.urdf",
        "--cell",
        "cell.toml",
        "--path",
        "moves.csv",
    ];
    let message = call(&scene, &args).run_for_messages(2);
    assert_contains(
        &message,
        "not shown: moves.csv: row 1 (line 3): column from_elbow: `x` is not a finite number",
    );
    assert_contains(
        &message,
        "not shown: path \"far\": configuration 1 of the path: joint `shoulder`",
    );
    let page = fs::read_to_string(scene.directory.join("view.html")).unwrap();
    assert!(page.contains("\"good\"") && page.contains("\"fine\"") && !page.contains("\"far\""));
    fs::remove_file(scene.directory.join("view.html")).unwrap();
    let message = call(&scene, &args)
        .args(&["--ids", "bad,none"])
        .run_for_messages(2);
    assert_contains(&message, "no path to show has the id \"none\"");
    assert_contains(&message, "there is no row to show, so no page is written");
    assert!(!scene.directory.join("view.html").exists());
}

/// Tests that a body of a cell or a mesh of a robot that may never end is refused.
#[cfg(unix)]
#[test]
fn endless_files_are_refused_at_once() {
    let scene = folder();
    let link = |name: &str, to: &str| {
        let link = scene.directory.join(name);
        let _ = fs::remove_file(&link);
        std::os::unix::fs::symlink(to, link).unwrap();
    };
    let pipe = scene.directory.join("pipe");
    let made = std::process::Command::new("mkfifo")
        .arg(&pipe)
        .status()
        .unwrap();
    assert!(made.success());
    for endless in ["/dev/zero", "pipe"] {
        for name in [
            "zero.stl",
            "zero.ccd",
            "zero.urdf",
            "zero.toml",
            "zero.srdf",
            "zero.json",
        ] {
            link(name, endless);
        }
        scene.file(
            "zeros.toml",
            "[[obstacle]]\nname = 'wall'\nbody = 'zero.stl'\n",
        );
        for args in [
            &[
                "edges",
                "arm.urdf",
                "--edges",
                "moves.csv",
                "--cell",
                "zeros.toml",
            ][..],
            &[
                "edges",
                "arm.urdf",
                "--edges",
                "moves.csv",
                "--cell",
                "zero.toml",
            ],
            &[
                "edges",
                "arm.urdf",
                "--edges",
                "moves.csv",
                "--srdf",
                "zero.srdf",
            ],
            &["edges", "zero.urdf", "--edges", "moves.csv"],
            &[
                "replay",
                "arm.urdf",
                "--cell",
                "cell.toml",
                "--record",
                "zero.json",
            ],
            &[
                "query",
                "--motions",
                "-",
                "--a",
                "zero.stl",
                "--b",
                "box:1,1,1",
            ],
            &[
                "query",
                "--motions",
                "-",
                "--a",
                "zero.ccd",
                "--b",
                "box:1,1,1",
            ],
            &["check", "zero.json", "--bodies", "."],
            &["decompose", "zero.stl"],
        ] {
            let message = call(&scene, args).stdin("a_px\n5\n").run_for_messages(2);
            let is_refused =
                message.contains("may never end") || message.contains("has no file NAME.mesh");
            assert!(is_refused, "{args:?}: {message}");
        }
    }
}

/// A can is picked from a table and carried onto a shelf beside another arm: free, and each other way ends at what is in it.
#[test]
fn a_can_is_lifted_carried_and_placed() {
    let scene = Scene::new("carry");
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    for name in ["scara.urdf", "carry.toml", "carry.csv"] {
        fs::copy(examples.join(name), scene.directory.join(name)).unwrap();
    }
    let args = [
        "edges",
        "scara.urdf",
        "--cell",
        "carry.toml",
        "--edges",
        "carry.csv",
        "--no-micros",
        "--joint",
        "finger=0.033",
        "--joint",
        "other/elbow=0",
        "--joint",
        "other/finger=0.02",
    ];
    let run = |more: &[&str]| call(&scene, &args).args(more).run_for_rows();
    let found = run(&["--start", "leave", "--question", "first-contact"]);
    let row = |name: &str| found.iter().find(|row| row.text("id") == name).unwrap();
    let over = row("over the shelf");
    assert_eq!((over.text("status"), over.number("time")), ("free", 3.0));
    for (name, [a, b], times) in [
        ("onto the shelf", ["can", "shelf"], 0.665..0.667),
        ("into the shelf", ["right finger", "shelf"], 1.1..2.0),
        (
            "into the other arm",
            ["other/fore", "right finger"],
            1.1..2.0,
        ),
        ("into the table", ["can", "table"], 0.0..0.001),
    ] {
        let row = row(name);
        let texts = ["status", "a", "b"].map(|column| row.text(column));
        assert_eq!(texts, ["contact", a, b], "{name}");
        assert!(
            times.contains(&row.number("time")),
            "{name} {}",
            row.number("time")
        );
    }
    // Without it the can touches the table, unless that is allowed.
    let statuses = || {
        run(&[])
            .iter()
            .map(|row| row.text("status").to_owned())
            .collect::<Vec<_>>()
    };
    assert_eq!(statuses()[0], "contact");
    let cell = fs::read_to_string(examples.join("carry.toml")).unwrap();
    let allowed = format!("{cell}\n[[allowed]]\nbetween = [\"can\", \"table\"]\n");
    let named = cell.replace(
        "\"right finger\"]",
        "\"right finger\", \"table\", \"base\"]",
    );
    for text in [allowed, named] {
        scene.file("carry.toml", &text);
        assert_eq!(
            statuses(),
            ["free", "contact", "contact", "contact", "contact"]
        );
    }
    let message = call(&scene, &args)
        .args(&["--start", "leave", "--question", "closest-approach"])
        .run_for_messages(2);
    assert_contains(&message, "--start leave is for");
    scene.file(
        "carry.toml",
        &cell.replace("\"left finger\",", "\"thumb\","),
    );
    let message = call(&scene, &args).run_for_messages(2);
    assert_contains(&message, "no link, attached body or obstacle `thumb`");
}

/// What is not checked is said, and a warning if that is most of a robot.
#[test]
fn what_is_not_checked_is_printed() {
    let scene = Scene::new("unchecked");
    let geom = |attributes: &str| format!("<geom type='box' size='0.1 0.1 0.1' {attributes}/>");
    let body = |name: &str, rest: &str| {
        format!(
            "<body name='{name}' pos='0 0 1'><joint name='to {name}' axis='0 1 0'/>{rest}</body>"
        )
    };
    // Masks as of robosuite's arms: geoms meet obstacles, and not each other.
    let own = geom("contype='0'");
    let inner = body("c", &own);
    let links = body(
        "a",
        &format!("{own}{}", body("b", &format!("{own}{inner}"))),
    );
    scene.file(
        "masked.xml",
        &format!("<mujoco><worldbody>{links}</worldbody></mujoco>"),
    );
    let bare = body("a", &body("b", &body("c", &geom(""))));
    scene.file(
        "bare.xml",
        &format!("<mujoco><worldbody>{bare}</worldbody></mujoco>"),
    );
    scene.file(
        "far.toml",
        "[[obstacle]]\nname = \"far\"\nbody = \"sphere:0.1\"\nposition = [90, 0, 0]\n",
    );
    scene.file(
        "moves.csv",
        "from_to a,from_to b,from_to c,to_to a,to_to b,to_to c\n0,0,0,1,1,1\n",
    );
    let edges = ["--edges", "moves.csv", "--out", "out.csv"];
    let masked = call(&scene, &["edges", "masked.xml"])
        .args(&edges)
        .run_for_messages(2);
    assert_contains(
        &masked,
        "nothing is compared in this cell: 4 links, 1 without bodies",
    );
    assert_contains(&masked, "contype and conaffinity");
    let warned = call(
        &scene,
        &["edges", "masked.xml", "--cell", "far.toml", "--quiet"],
    )
    .args(&edges)
    .run_for_messages(0);
    assert_contains(
        &warned,
        "warning: most of the robot is not checked against itself: 2 of 3 moving links",
    );
    let bare = call(&scene, &["edges", "bare.xml", "--cell", "far.toml"])
        .args(&edges)
        .run_for_messages(0);
    assert_contains(
        &bare,
        "warning: most of the robot is not checked: 2 of 3 moving links have no bodies: a, b",
    );
    assert_contains(
        &bare,
        "3 links without bodies, compared with nothing: world, a, b",
    );
    let acm = call(&scene, &["acm", "masked.xml", "--out", "out.srdf"]).run_for_messages(0);
    assert_contains(
        &acm,
        "warning: most of the robot is not checked against itself",
    );
    let ranges = [
        "clearance",
        "bare.xml",
        "--cell",
        "far.toml",
        "--joint",
        "to a=0:1",
        "--rest",
    ];
    let clearance = call(&scene, &ranges).run_for_messages(0);
    assert_contains(&clearance, "2 of 3 moving links have no bodies");
}

/// Tests that each mistake gives one warning, whichever command reads the cell, and that `--quiet` leaves only warnings.
#[test]
fn remarks_are_told_once() {
    let scene = folder();
    let arm = fs::read_to_string(scene.directory.join("arm.urdf")).unwrap();
    let turned = arm.replacen("xyz=\"0.25 0 0\"", "xyz=\"0.25 0 0\" rpy=\"90 0 0\"", 1);
    assert_ne!(turned, arm);
    scene.file("turned.urdf", &turned);
    scene.file("leg.srdf", "<robot name=\"leg\"/>");
    scene.file(
        "hall.toml",
        "[[obstacle]]\nname = \"crate\"\nbody = \"box:600,400,375\"\nposition = [5000, 0, 0]\n",
    );
    let cell = ["turned.urdf", "--srdf", "leg.srdf", "--cell", "hall.toml"];
    let warnings = [
        "link upper: roll, pitch or yaw",
        "It is of `leg`, and the robot is `arm`",
        "crate is 1200 long",
    ];
    let notes = "pairs of links not checked (adjacent)";
    let of_tolerance = "the tolerance is large against";
    let edges = [
        &["edges"][..],
        &cell,
        &["--edges", "moves.csv", "--tolerance", "0.5"],
    ]
    .concat();
    let clearance = [
        &["clearance"][..],
        &cell,
        &["--path", "path.csv", "--tolerance", "0.5"],
    ]
    .concat();
    let view = [
        &["view"][..],
        &cell,
        &[
            "--path",
            "path.csv",
            "--out",
            "out.html",
            "--tolerance",
            "0.5",
        ],
    ]
    .concat();
    for args in [edges, clearance, view] {
        for quiet in [&[][..], &["--quiet"]] {
            let output = call(&scene, &args).args(quiet).output();
            let message = stderr(&output);
            for warning in warnings {
                assert_eq!(message.matches(warning).count(), 1, "{args:?}: {message}");
            }
            let expected = usize::from(quiet.is_empty());
            assert_eq!(message.matches(notes).count(), expected, "{message}");
            if quiet.is_empty() {
                assert_eq!(message.matches(of_tolerance).count(), 1, "{message}");
            }
        }
    }
    let acm = call(&scene, &["acm", "turned.urdf", "--out", "out.srdf"]).run_for_messages(0);
    assert_eq!(acm.matches(warnings[0]).count(), 1, "{acm}");
    // What is usual has no warning.
    let usual = call(&scene, &EDGES).output();
    let message = stderr(&usual);
    assert!(
        !message.contains("warning: ") && !message.contains(of_tolerance),
        "{message}"
    );
}
