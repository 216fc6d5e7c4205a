//! Tests that `ccd-bench cost` counts the same visits with any vector instructions, and more without a shortcut.

use crate::TETRAHEDRON_OBJ;
use crate::command::{CommandCall, Scene, parse, stderr};

#[test]
fn visits_depend_on_shortcuts_alone() {
    let scene = Scene::new("cost");
    let mesh = scene.file("tetrahedron.obj", TETRAHEDRON_OBJ);
    let mesh = mesh.to_str().unwrap();
    // One flies far from the other, one hits it.
    let motions = "a_px,a_py,a_pz,a_vx,a_wx\n3,9,9,-1,1\n3,-.2,-.3,-4,1\n";
    let run = |options: &[&str]| {
        let fixed = ["--a", mesh, "--b", mesh, "--motions", "-", "--rounds", "1"];
        CommandCall::with_args(&["cost"])
            .args(&fixed)
            .args(options)
            .stdin(motions)
            .output()
    };
    let visits = |options: &[&str]| {
        let output = run(options);
        assert!(output.status.success(), "{}", stderr(&output));
        let rows = parse(&output.stdout);
        assert!(rows.iter().all(|row| row.number("cold_mean_us") > 0.0));
        let visits = rows.iter().map(|row| row.number("visits_mean"));
        visits.collect::<Vec<f64>>()
    };
    let with = visits(&[]);
    assert_eq!(with.len(), 2);
    assert_eq!(with[0], with[1]);
    let without = visits(&["--without", "balls,boxes", "--instructions", "best"]);
    assert!(without.len() == 1 && without[0] > with[0], "{without:?}");

    let unknown = run(&["--without", "luck"]);
    assert_eq!(unknown.status.code(), Some(2));
    assert!(stderr(&unknown).contains("turning_pieces"));
}
