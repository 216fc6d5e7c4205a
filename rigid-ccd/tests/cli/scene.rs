//! `ccd scene`.

use crate::command::{Row, Run, Scene, parse, stderr};

/// Two balls that fall onto a table, the one below it first, and one that never does.
const BODIES: &str = "body,id,px,pz,vz\n\
    \"box:9,9,1\",table,0,0,0\n\
    sphere:.5,fast,0,8,-5.5\n\
    sphere:.5,ball,0,4,-2\n\
    sphere:.5,away,5,4,1\n";

fn contacts(run: &Run) -> Vec<Row> {
    let output = run.output();
    assert!(output.status.success(), "{}", stderr(&output));
    parse(&output.stdout)
}

#[test]
fn pairs_that_touch_are_listed_in_order_of_time() {
    let scene = Scene::new("scene");
    let bodies = scene.file("scene.csv", BODIES);
    let bodies = bodies.to_str().unwrap();
    let rows = contacts(&Run::bare(&["scene", bodies, "--duration", "2"]));
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
        row.assert_in_time(exact, speed);
        assert!(row.number("distance_lower") <= row.number("distance_upper"));
        assert!(row.number("distance_upper") <= 1e-3);
    }
    // From A to B: the ball is below the fast one, and above the table.
    assert!(rows[0].number("normal_z") < -0.999 && rows[2].number("normal_z") > 0.999);
    assert!((rows[2].number("witness_a_z") - 1.0).abs() < 1e-9);
    assert_eq!(rows[2].text("feature_a"), "f5");
    // None of them in so short a time.
    assert!(contacts(&Run::bare(&["scene", bodies, "--duration", "0.5"])).is_empty());
}

#[test]
fn contacts_at_the_start_and_bad_motions_have_their_status() {
    let scene = Scene::new("scene-start");
    let table = "body,px,vx\nsphere:1,0,0\nsphere:1,0.5,0\nsphere:1,9,0\nsphere:1,-2,0\n";
    let bodies = scene.file("scene.csv", table);
    let rows = contacts(&Run::bare(&["scene", bodies.to_str().unwrap()]));
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
    let run = Run::bare(&[
        "scene",
        fast.to_str().unwrap(),
        "--out",
        out.to_str().unwrap(),
    ]);
    let output = run.output();
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    let rows = parse(&std::fs::read(&out).unwrap());
    assert_eq!(rows[0].text("status"), "error");
    assert!(!rows[0].text("reason").is_empty());
}

#[test]
fn a_scene_is_not_overwritten() {
    let scene = Scene::new("scene-over");
    let bodies = scene.file("scene.csv", BODIES);
    let bodies = bodies.to_str().unwrap();
    let output = Run::bare(&["scene", bodies, "--out", bodies]).output();
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    assert_eq!(std::fs::read_to_string(bodies).unwrap(), BODIES);
}
