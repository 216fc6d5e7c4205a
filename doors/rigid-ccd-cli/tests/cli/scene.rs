//! Tests `ccd scene`.

use crate::command::{CommandCall, Row, Scene, assert_contains, parse, stderr};
use std::path::Path;

/// A table of bodies: two balls that fall onto a slab, listed in an order other than that of their contacts, and one
/// that moves away.
const BODIES_TABLE: &str = "body,id,px,pz,vz\n\
    \"box:9,9,1\",table,0,0,0\n\
    sphere:.5,fast,0,8,-5.5\n\
    sphere:.5,ball,0,4,-2\n\
    sphere:.5,away,5,4,1\n";

fn contacts(run: &CommandCall) -> Vec<Row> {
    let output = run.run_expecting_code(0);
    parse(&output.stdout)
}

#[test]
fn pairs_that_touch_are_listed_in_order_of_time() {
    let scene = Scene::new("scene");
    let bodies = scene.file("scene.csv", BODIES_TABLE);
    let bodies = bodies.to_str().unwrap();
    let rows = contacts(&CommandCall::with_args(&[
        "scene",
        bodies,
        "--duration",
        "2",
    ]));
    let found: Vec<_> = rows
        .iter()
        .map(|row| (row.text("a"), row.text("b"), row.text("status")))
        .collect();
    let expected = [
        ("fast", "ball", "contact"),
        ("table", "fast", "contact"),
        ("table", "ball", "contact"),
    ];
    assert_eq!(found, expected);
    for (row, (exact, speed)) in rows
        .iter()
        .zip([(3.0 / 3.5, 3.5), (6.5 / 5.5, 5.5), (1.25, 2.0)])
    {
        row.assert_time_within_tolerance(exact, speed);
        assert!(row.number("distance_lower") <= row.number("distance_upper"));
        assert!(row.number("distance_upper") <= 1e-3);
    }
    // From A to B: the ball is below the fast one, and above the table.
    assert!(rows[0].number("normal_z") < -0.999 && rows[2].number("normal_z") > 0.999);
    assert!((rows[2].number("witness_a_z") - 1.0).abs() < 1e-9);
    assert_eq!(rows[2].text("feature_a"), "f5");
    // No pair touches in so short a time.
    assert!(
        contacts(&CommandCall::with_args(&[
            "scene",
            bodies,
            "--duration",
            "0.5"
        ]))
        .is_empty()
    );
}

#[test]
fn contacts_at_the_start_and_bad_motions_have_their_status() {
    let scene = Scene::new("scene-start");
    let table = "body,px,vx\nsphere:1,0,0\nsphere:1,0.5,0\nsphere:1,9,0\nsphere:1,-2,0\n";
    let bodies = scene.file("scene.csv", table);
    let rows = contacts(&CommandCall::with_args(&[
        "scene",
        bodies.to_str().unwrap(),
    ]));
    let found: Vec<_> = rows
        .iter()
        .map(|row| {
            (
                row.text("a"),
                row.text("b"),
                row.text("status"),
                row.text("time"),
            )
        })
        .collect();
    let expected = [
        ("0", "1", "overlapping", "0.0"),
        ("0", "3", "touching", "0.0"),
    ];
    assert_eq!(found, expected);
    let fast = scene.file("fast.csv", "body,px,vx\nsphere:1,0,1e13\nsphere:1,9,0\n");
    let out = scene.directory.join("contacts.csv");
    let run = CommandCall::with_args(&[
        "scene",
        fast.to_str().unwrap(),
        "--out",
        out.to_str().unwrap(),
    ]);
    run.run_expecting_code(2);
    let rows = parse(&std::fs::read(&out).unwrap());
    assert_eq!(rows[0].text("status"), "error");
    assert!(!rows[0].text("reason").is_empty());
}

#[test]
fn a_scene_is_not_overwritten() {
    let scene = Scene::new("scene-over");
    let bodies = scene.file("scene.csv", BODIES_TABLE);
    let bodies = bodies.to_str().unwrap();
    CommandCall::with_args(&["scene", bodies, "--out", bodies]).run_expecting_code(2);
    assert_eq!(std::fs::read_to_string(bodies).unwrap(), BODIES_TABLE);
}

/// Runs `ccd scene` and `ccd view --scene` on a table, and returns their exit codes and messages.
fn run_scene_and_view(bodies: &str, options: &[&str]) -> [(Option<i32>, String); 2] {
    let out = Path::new(bodies).with_extension("html");
    let out = out.to_str().unwrap();
    [
        &["scene", bodies][..],
        &["view", "--scene", bodies, "--out", out],
    ]
    .map(|command| {
        let output = CommandCall::with_args(command).args(options).output();
        (output.status.code(), stderr(&output))
    })
}

#[test]
fn a_scene_is_remarked_upon_as_a_query_is() {
    let scene = Scene::new("scene-remarks");
    let table = "body,px,wz,qw,qx,qy,qz\nsphere:0.001,0,90,1,1,0,0\nsphere:1,9,0,1,0,0,0\n";
    let bodies = scene.file("scene.csv", table);
    let bodies = bodies.to_str().unwrap();
    let remarks = [
        "the tolerance is large against the smaller body",
        "an angular velocity is a round number of degrees",
        "a quaternion is far from unit length",
    ];
    for (code, message) in run_scene_and_view(bodies, &[]) {
        assert_eq!(code, Some(0), "{message}");
        for remark in remarks {
            assert_eq!(message.matches(remark).count(), 1, "{message}");
        }
        assert!(message.contains("without --duration, all motions end at 1\n"));
        assert_contains(&message, "to the end at 1.");
    }
    // A tenth of the time is a turn and a half.
    for (_, message) in run_scene_and_view(bodies, &["--duration", "0.1", "--tolerance", "1e-6"]) {
        assert!(!message.contains("degrees") && !message.contains("the tolerance is"));
        assert!(!message.contains("without --duration") && message.contains("to the end at 0.1."));
    }
    for (_, message) in run_scene_and_view(bodies, &["-q"]) {
        assert_eq!(message, "");
    }
}

/// Tests that all motions end at the duration, also those given by an end pose.
#[test]
fn an_end_pose_is_reached_at_the_end() {
    let scene = Scene::new("scene-end");
    let table = "body,px,end_px,end_py,end_pz\nsphere:1,0,0,0,0\nsphere:1,8,4,0,0\n";
    let bodies = scene.file("scene.csv", table);
    let bodies = bodies.to_str().unwrap();
    assert!(
        contacts(&CommandCall::with_args(&[
            "scene",
            bodies,
            "--duration",
            "2"
        ]))
        .is_empty()
    );
    let nearer = scene.file("nearer.csv", &table.replace("8,4", "8,0"));
    let rows = contacts(&CommandCall::with_args(&[
        "scene",
        nearer.to_str().unwrap(),
        "--duration",
        "2",
    ]));
    rows[0].assert_time_within_tolerance(1.5, 4.0);
    for (code, message) in run_scene_and_view(bodies, &["--duration", "0"]) {
        assert_eq!(code, Some(2), "{message}");
        assert_contains(&message, "row 0 (line 2): --duration: 0 is not");
    }
}

#[test]
fn tables_that_are_no_scene_are_refused_in_its_words() {
    let scene = Scene::new("scene-words");
    for (table, expected) in [
        (
            "body,id\nsphere:1,x\nsphere:2,y\nsphere:3,x\n",
            "row 0 (line 2) and row 2 (line 4) have the same id \"x\"",
        ),
        (
            "body,roll\nsphere:1,0\n",
            "quaternions: columns qw qx qy qz, w first",
        ),
        (
            "body,t\nsphere:1,0\n",
            "give --duration in place of the column `t`",
        ),
        (
            "body,time\nsphere:1,0\n",
            "give --duration in place of the column `time`",
        ),
        (
            "body,mass\nsphere:1,0\n",
            "unknown column `mass`; known columns of a scene are body, id, px py pz",
        ),
        (
            "body,qw\nsphere:1,1\n",
            "no column `qx`, but column `qw` needs it",
        ),
        (
            "body,a_px\nsphere:1,1\n",
            "unknown column `a_px`; did you mean `px`?",
        ),
        (
            "body,px\nsphere:1,a\n",
            "row 0 (line 2): column px: `a` is not a finite number",
        ),
        (
            "body,px\nsphere,1\n",
            "row 0 (line 2): \"sphere\" takes 1 length, not 0; use",
        ),
    ] {
        let bodies = scene.file("scene.csv", table);
        for (code, message) in run_scene_and_view(bodies.to_str().unwrap(), &[]) {
            assert_eq!(code, Some(2), "{message}");
            assert_contains(&message, expected);
        }
    }
}
