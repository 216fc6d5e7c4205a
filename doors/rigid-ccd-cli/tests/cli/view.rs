//! Tests pages of `ccd view` and `ccd query --html`.

use super::command::{CommandCall, Scene, assert_contains, stderr};
use serde_json::Value;
use std::path::Path;

const DROPS_TABLE: &str =
    "id,a_pz,a_vz,duration\nhit,4,-4,1\nshort,4,-1,1\nnever,4,1,1\nin,0,0,1\n\"<b>,\"\"\",4,-4,1\n";
const CUBE_AND_SLAB_OPTIONS: [&str; 4] = ["--a", "box:.5,.5,.5", "--b", "box:9,9,1"];

fn view(folder: &Path, more: &[&str]) -> Value {
    CommandCall::with_args(&["view"])
        .args(more)
        .folder(folder)
        .run_expecting_code(0);
    embedded_views(&folder.join("view.html"))
}

fn embedded_views(page: &Path) -> Value {
    let html = std::fs::read_to_string(page).unwrap();
    let (_, rest) = html.split_once("id=\"views\">").unwrap();
    serde_json::from_str(rest.split_once("</script>").unwrap().0).unwrap()
}

fn file(scene: &Scene, name: &str, text: &str) -> String {
    scene.file(name, text).to_str().unwrap().to_owned()
}

fn views(data: &Value) -> &Vec<Value> {
    data["groups"][0]["views"].as_array().unwrap()
}

fn names(data: &Value) -> Vec<&str> {
    views(data)
        .iter()
        .map(|view| view["name"].as_str().unwrap())
        .collect()
}

#[test]
fn rows_are_shown_with_their_verdict_and_their_proven_gap() {
    let scene = Scene::new("view");
    let motions = file(&scene, "motions.csv", DROPS_TABLE);
    let shown = view(
        &scene.directory,
        &[&CUBE_AND_SLAB_OPTIONS[..], &["--motions", &motions]].concat(),
    );
    let expected = [
        "hit (contact)",
        "short (free)",
        "never (free)",
        "in (overlapping)",
        "<b>,\" (contact)",
    ];
    assert_eq!(names(&shown), expected);
    let views = views(&shown);
    assert!(
        views[0]["verdict"]
            .as_str()
            .unwrap()
            .starts_with("First contact at 0.62")
    );
    let contact = &views[0]["contacts"][0];
    assert!((contact["time"].as_f64().unwrap() - 0.625).abs() < 1e-3);
    // The distance of a body that falls 2.5 at speed 4, and the proven bound below it.
    let gap = &views[0]["gap"];
    for point in gap["points"].as_array().unwrap() {
        let [time, upper] = ["time", "upper"].map(|name| point[name].as_f64().unwrap());
        let exact = ccd_core::order::greater(2.5 - 4.0 * time, 0.0);
        assert!((upper - exact).abs() < 2e-3, "{upper} at {time}");
    }
    for point in gap["proven"].as_array().unwrap() {
        let [time, proven] = [0, 1].map(|k| point[k].as_f64().unwrap());
        assert!(proven <= ccd_core::order::greater(2.5 - 4.0 * time, 0.0) + 1e-9);
    }
    // The gap shrinks to 1.5.
    assert!(
        views[1]["verdict"]
            .as_str()
            .unwrap()
            .contains("never nearer than 1.49999")
    );
    assert!(
        views[3]["verdict"]
            .as_str()
            .unwrap()
            .starts_with("Overlapping at the start")
    );
}

#[test]
fn rows_are_chosen_by_id_and_missing_ids_are_reported() {
    let scene = Scene::new("view-ids");
    let motions = file(&scene, "motions.csv", DROPS_TABLE);
    let args = [
        &CUBE_AND_SLAB_OPTIONS[..],
        &["--motions", &motions, "--ids", "never,hit,gone"],
    ]
    .concat();
    let message = CommandCall::with_args(&["view"])
        .args(&args)
        .folder(&scene.directory)
        .run_for_messages(2);
    assert_contains(&message, "no row has the id \"gone\"");
    assert_eq!(
        names(&embedded_views(&scene.directory.join("view.html"))),
        ["hit (contact)", "never (free)"]
    );
    let nothing = [
        &CUBE_AND_SLAB_OPTIONS[..],
        &["--motions", &motions, "--ids", "gone"],
    ]
    .concat();
    let message = CommandCall::with_args(&["view"])
        .args(&nothing)
        .folder(&scene.directory)
        .run_for_messages(2);
    assert_contains(&message, "no row to show");
}

#[test]
fn results_are_shown_as_they_are() {
    let scene = Scene::new("view-results");
    let motions = file(&scene, "motions.csv", DROPS_TABLE);
    let query = [
        &CUBE_AND_SLAB_OPTIONS[..],
        &[
            "--motions",
            &motions,
            "--out",
            "results.csv",
            "--html",
            "page.html",
        ],
    ]
    .concat();
    CommandCall::with_args(&["query"])
        .args(&query)
        .folder(&scene.directory)
        .run_expecting_code(0);
    let page = embedded_views(&scene.directory.join("page.html"));
    let args = [
        &CUBE_AND_SLAB_OPTIONS[..],
        &["--motions", &motions, "--results", "results.csv"],
    ]
    .concat();
    let shown = view(&scene.directory, &args);
    assert_eq!(names(&shown), names(&page));
    for (one, other) in views(&shown).iter().zip(views(&page)) {
        assert_eq!(one["contacts"], other["contacts"]);
    }
    let said = views(&shown)[0]["verdict"].as_str().unwrap();
    assert!(
        said.contains("as the table says") && !said.contains("Proven"),
        "{said}"
    );
    // The page shows what the table says.
    let table = std::fs::read_to_string(scene.directory.join("results.csv")).unwrap();
    let line = table
        .lines()
        .find(|line| line.starts_with("never,"))
        .unwrap();
    let changed = table.replace(line, "never,unresolved,0.25,,,,,,,,,,,,,,1,1,1,budget");
    file(&scene, "results.csv", &changed);
    let shown = view(&scene.directory, &args);
    let verdict = views(&shown)[2]["verdict"].as_str().unwrap();
    assert!(
        verdict.contains("(budget) after 0.25") && !verdict.contains("Proven"),
        "{verdict}"
    );
    // Another table is not a table of results.
    let wrong = [
        &CUBE_AND_SLAB_OPTIONS[..],
        &["--motions", &motions, "--results", &motions],
    ]
    .concat();
    let message = CommandCall::with_args(&["view"])
        .args(&wrong)
        .folder(&scene.directory)
        .run_for_messages(2);
    assert_contains(&message, "not the columns of results");
}

#[test]
fn results_of_other_bodies_are_not_shown() {
    let scene = Scene::new("view-other-bodies");
    let motions = file(&scene, "motions.csv", "id,a_pz,a_vz\nhit,4,-4\n");
    let query = [
        &["query", "--motions", &motions, "--out", "results.csv"],
        &CUBE_AND_SLAB_OPTIONS[..],
    ]
    .concat();
    assert!(
        CommandCall::with_args(&query)
            .folder(&scene.directory)
            .output()
            .status
            .success()
    );
    let view = [
        "view",
        "--a",
        "sphere:.1",
        "--b",
        "box:9,9,1",
        "--motions",
        &motions,
    ];
    let output = CommandCall::with_args(&view)
        .args(&["--results", "results.csv"])
        .folder(&scene.directory)
        .run_expecting_code(2);
    assert_contains(&stderr(&output), "row hit: at 0.62");
    assert_contains(&stderr(&output), "other bodies");
    let other = file(&scene, "other.csv", "id,a_pz\nelse,4\n");
    let view = [
        &["view", "--motions", &other, "--results", "results.csv"],
        &CUBE_AND_SLAB_OPTIONS[..],
    ]
    .concat();
    let output = CommandCall::with_args(&view)
        .folder(&scene.directory)
        .output();
    assert_contains(&stderr(&output), "no row of");
}

/// Returns the verdict of the first row on a page that `ccd query` writes.
fn verdict(scene: &Scene, more: &[&str]) -> String {
    let motions = file(scene, "motions.csv", "id,a_pz,a_vz\nhit,4,-4\n");
    let args = [
        &CUBE_AND_SLAB_OPTIONS[..],
        &["--motions", &motions, "--out", "x.csv", "--html", "x.html"],
        more,
    ]
    .concat();
    CommandCall::with_args(&["query"])
        .args(&args)
        .folder(&scene.directory)
        .run_expecting_code(0);
    let page = embedded_views(&scene.directory.join("x.html"));
    views(&page)[0]["verdict"].as_str().unwrap().to_owned()
}

#[test]
fn a_verdict_matches_the_question_and_the_proof() {
    let scene = Scene::new("view-claims");
    let cases: [(&[&str], &str, &str); 8] = [
        (
            &[],
            "First contact at 0.62",
            "Proven: nothing touches before.",
        ),
        (
            &["--question", "is-free"],
            "Contact at ",
            "There may be an earlier one.",
        ),
        (
            &["--schedule", "naive", "--bound", "published"],
            "Contact at ",
            "Not certified: it may be late.",
        ),
        (
            &["--start", "leave"],
            "Contact at ",
            "except for a contact at the start, which was ignored until the bodies parted.",
        ),
        (
            &["--margin", "0.3"],
            "First within the margin of 0.3 at 0.5",
            "Proven: not within it before.",
        ),
        (
            &["--question", "contact-interval"],
            "First contact at 0.62",
            "Proven: nothing touches before, nor after 1.",
        ),
        (
            &["--question", "closest-approach", "--clearance", "0.3"],
            "The clearance of 0.3 is violated: at 0.",
            " apart.",
        ),
        (&["--question", "distance"], "At 0: between 2.49", "apart."),
    ];
    for (more, begins, ends) in cases {
        let verdict = verdict(&scene, more);
        assert!(
            verdict.starts_with(begins) && verdict.ends_with(ends),
            "{more:?}: {verdict}"
        );
        assert_eq!(
            verdict.contains("Proven"),
            ends.contains("Proven") || more.contains(&"leave"),
            "{verdict}"
        );
    }
}

#[test]
fn an_unwritable_page_is_an_error_before_the_work() {
    let scene = Scene::new("view-nowhere");
    let motions = file(&scene, "motions.csv", DROPS_TABLE);
    let both = [&CUBE_AND_SLAB_OPTIONS[..], &["--motions", &motions]].concat();
    for args in [
        [&["view", "--out", "nowhere/x.html"], &both[..]].concat(),
        [
            &["query", "--out", "x.csv", "--html", "nowhere/x.html"],
            &both[..],
        ]
        .concat(),
    ] {
        let message = CommandCall::with_args(&args)
            .folder(&scene.directory)
            .run_for_messages(1);
        assert_contains(&message, "create it first");
        assert!(!scene.directory.join("x.csv").exists());
    }
}

#[test]
fn rows_that_are_no_queries_are_left_out_and_counted() {
    let scene = Scene::new("view-left-out");
    let motions = file(
        &scene,
        "motions.csv",
        "id,a_pz,a_vz\nbad,x,0\nhit,4,-4\nfar,1e13,0\n",
    );
    let args = [&CUBE_AND_SLAB_OPTIONS[..], &["--motions", &motions]].concat();
    let message = CommandCall::with_args(&["view"])
        .args(&args)
        .folder(&scene.directory)
        .run_for_messages(2);
    assert_contains(&message, "2 rows are no valid queries");
    assert_eq!(
        names(&embedded_views(&scene.directory.join("view.html"))),
        ["hit (contact)"]
    );
}

#[test]
fn paths_are_shown_in_the_time_of_their_table() {
    let scene = Scene::new("view-paths");
    let motions = file(
        &scene,
        "paths.csv",
        "id,t,a_pz\nvisit,10,4\nvisit,12,4\nvisit,14,0\n",
    );
    let shown = view(
        &scene.directory,
        &[&CUBE_AND_SLAB_OPTIONS[..], &["--motions", &motions]].concat(),
    );
    let view = &views(&shown)[0];
    assert_eq!(
        (view["start"].as_f64(), view["duration"].as_f64()),
        (Some(10.0), Some(4.0))
    );
    assert!(
        view["verdict"]
            .as_str()
            .unwrap()
            .starts_with("First contact at 13.24")
    );
    assert_eq!(
        view["bodies"][0]["motion"]["keys"]
            .as_array()
            .unwrap()
            .len(),
        3
    );
}

#[test]
fn a_scene_shows_all_bodies_and_contacts_in_order_of_time() {
    let scene = Scene::new("view-scene");
    let table = "body,id,pz,vz,wx\n\"box:9,9,1\",table,0,0,0\nsphere:.5,ball,4,-4,1\nsphere:.5,slow,8,-5.5,0\n";
    let bodies = file(&scene, "scene.csv", table);
    let shown = view(&scene.directory, &["--scene", &bodies, "--duration", "2"]);
    let view = &views(&shown)[0];
    assert_eq!(view["bodies"].as_array().unwrap().len(), 3);
    // Both balls are one mesh.
    assert_eq!(shown["meshes"].as_array().unwrap().len(), 2);
    let contacts = view["contacts"].as_array().unwrap();
    let times: Vec<f64> = contacts
        .iter()
        .map(|contact| contact["time"].as_f64().unwrap())
        .collect();
    assert!(times.len() == 3 && times.is_sorted(), "{times:?}");
    assert!((times[0] - 0.625).abs() < 1e-3);
    assert!(
        contacts[0]["words"]
            .as_str()
            .unwrap()
            .ends_with("table and ball")
    );
    for (table, says) in [
        ("id,pz\na,1\n", "no column `body`"),
        ("body,pz\nbox:1,1\n", "line 2"),
        ("body,pz\nsphere:1,x\n", "pz"),
        ("body,vy\nsphere:1,x\n", "column vy"),
        ("body,velx\nsphere:1,1\n", "did you mean `vx`"),
        ("body,duration\nsphere:1,1\n", "give --duration"),
        ("body,pz\nbox:1,1,1,0\n", "is quoted"),
        ("body,pz\n", "no bodies"),
    ] {
        let bodies = file(&scene, "wrong.csv", table);
        let message = CommandCall::with_args(&["view", "--scene", &bodies])
            .folder(&scene.directory)
            .run_for_messages(2);
        assert_contains(&message, says);
    }
}

#[test]
fn a_page_overwrites_nothing_that_is_read() {
    let scene = Scene::new("view-overwrites");
    let motions = file(&scene, "motions.csv", DROPS_TABLE);
    let both = [&CUBE_AND_SLAB_OPTIONS[..], &["--motions", &motions]].concat();
    let bodies = file(&scene, "scene.csv", "body\nsphere:1\n");
    for args in [
        [&["view", "--out", &motions], &both[..]].concat(),
        [&["query", "--html", &motions], &both[..]].concat(),
        [&["query", "--out", "x.csv", "--html", "./x.csv"], &both[..]].concat(),
        vec!["view", "--scene", &bodies, "--out", &bodies],
    ] {
        CommandCall::with_args(&args)
            .folder(&scene.directory)
            .run_expecting_code(2);
        assert_eq!(std::fs::read_to_string(&motions).unwrap(), DROPS_TABLE);
    }
    for args in [
        &["view"][..],
        &["view", "--a", "sphere:1"],
        &["view", "--scene", &bodies, "--a", "sphere:1"],
    ] {
        CommandCall::with_args(args)
            .folder(&scene.directory)
            .run_expecting_code(2);
    }
}
