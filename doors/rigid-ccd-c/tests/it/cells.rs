//! Tests of cells: their contents, changes that invalidate solvers, and arguments that are refused.

use crate::support::{Handle, default_settings, last_error, ok};
use crate::support_cells::*;
use rigid_ccd_c::*;
use std::ptr::{null, null_mut};

#[test]
fn a_solver_of_a_cell_that_was_changed_does_not_answer() {
    let (cell, _) = cells();
    let reach = [[0.0, 0.0], [1.2, 0.0]];
    let path = through(&reach);
    let ball = crate::support::sphere(0.1);
    let pose = RccdPose {
        position: [9.0, 0.0, 0.0],
        rotation: [0.0, 0.0, 0.0, 1.0],
    };
    let pointer = cell.pointer();
    let (cup, lower) = (c"cup".as_ptr(), c"lower".as_ptr());
    // SAFETY: pointers are null or to values that live here.
    let changes: [(&str, &dyn Fn() -> RccdStatus); 7] = unsafe {
        [
            ("add", &|| {
                rccd_cell_add_obstacle(pointer, c"far".as_ptr(), ball.pointer(), &pose)
            }),
            ("move", &|| {
                rccd_cell_move_obstacle(pointer, c"far".as_ptr(), &pose)
            }),
            ("attach", &|| {
                rccd_cell_attach(pointer, cup, ball.pointer(), lower, &pose, null(), 0)
            }),
            ("detach", &|| rccd_cell_detach(pointer, cup)),
            ("padding", &|| rccd_cell_set_padding(pointer, lower, 0.01)),
            ("clearance", &|| {
                rccd_cell_set_clearance(pointer, lower, c"ball".as_ptr(), 0.01)
            }),
            ("remove", &|| {
                rccd_cell_remove_obstacle(pointer, c"ball".as_ptr())
            }),
        ]
    };
    for (what, change) in changes {
        let solver = cell_solver(&cell, &default_settings());
        let before = first_contact(&solver, &reach);
        assert_eq!(before.outcome, RccdOutcome::Contact, "{what}");
        // A change that fails changes nothing.
        // SAFETY: pointers are to values that live here.
        let failed = unsafe { rccd_cell_detach(pointer, c"nobody".as_ptr()) };
        assert_eq!(failed, RccdStatus::InvalidInput);
        assert_eq!(
            first_contact(&solver, &reach).outcome,
            RccdOutcome::Contact,
            "{what}"
        );
        ok(change());
        for question in [
            rccd_cell_first_contact as Question,
            rccd_cell_any_contact,
            rccd_cell_closest_approach,
        ] {
            let mut answer = before;
            // SAFETY: the path and the answer live here.
            let status = unsafe { question(solver.pointer(), &path, &mut answer) };
            assert_eq!(status, RccdStatus::InvalidInput, "{what}");
            assert!(
                last_error().contains("make a new solver"),
                "{what}: {}",
                last_error()
            );
            // Compares texts, because NaN is not equal to NaN.
            assert_eq!(format!("{answer:?}"), format!("{before:?}"), "{what}");
        }
    }
    let of_now = cell_solver(&cell, &default_settings());
    assert_eq!(first_contact(&of_now, &reach).outcome, RccdOutcome::Free);
    // Freeing the cell does not affect the solver.
    drop(cell);
    assert_eq!(first_contact(&of_now, &reach).outcome, RccdOutcome::Free);
}

#[test]
fn a_cell_of_a_text_is_that_of_its_file() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(
        folder.path().join("post.obj"),
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
    )
    .unwrap();
    let robot = ARM.replace(
        r#"<sphere radius="0.15"/>"#,
        r#"<mesh filename="post.obj"/>"#,
    );
    let texts = [robot.as_str(), folder.path().to_str().unwrap(), "<robot"];
    let [text, folder, broken] = texts.map(|text| std::ffi::CString::new(text).unwrap());
    let [text, folder, broken] = [&text, &folder, &broken].map(|text| text.as_ptr());
    // SAFETY: texts end with a zero.
    unsafe {
        let cell = Handle::new(rccd_cell_free, |out| {
            rccd_cell_from_text(text, folder, null(), null(), out)
        });
        let mut count = 0;
        ok(rccd_cell_joint_count(cell.pointer(), &mut count));
        assert_eq!(count, 2);
        let mut out = null_mut();
        for (robot, folder, named) in [
            (text, null(), "post.obj"),
            (broken, null(), "robot"),
            (null(), null(), "robot is null"),
        ] {
            let status = rccd_cell_from_text(robot, folder, null(), null(), &mut out);
            assert_ne!(status, RccdStatus::Ok);
            assert!(last_error().contains(named), "{}", last_error());
            assert!(out.is_null());
        }
    }
}

#[test]
fn cells_refuse_what_is_wrong() {
    let (cell, _) = cells();
    // SAFETY: pointers are null or to values that live here.
    unsafe {
        let pointer = cell.pointer();
        ok(rccd_cell_remove_obstacle(pointer, c"ball".as_ptr()));
        let solver = cell_solver(&cell, &default_settings());
        let gone = rccd_cell_remove_obstacle(pointer, c"ball".as_ptr());
        assert_eq!(gone, RccdStatus::InvalidInput);
        assert!(last_error().contains("ball"), "{}", last_error());
        let mut answer = empty_answer();
        let beyond = [[5.0, 0.0]];
        let s = solver.pointer();
        let mut path = RccdPath {
            configurations: beyond.as_ptr().cast(),
            configuration_count: 1,
            curve: null(),
        };
        let refused = rccd_cell_first_contact(s, &path, &mut answer);
        assert_eq!(refused, RccdStatus::InvalidInput);
        assert!(last_error().contains("shoulder"), "{}", last_error());
        path.configurations = null();
        assert_eq!(
            rccd_cell_first_contact(s, &path, &mut answer),
            RccdStatus::InvalidArgument
        );
        path.configuration_count = 0;
        assert_eq!(
            rccd_cell_first_contact(s, &path, &mut answer),
            RccdStatus::InvalidInput
        );
        assert_eq!(
            rccd_cell_first_contact(s, null(), &mut answer),
            RccdStatus::InvalidArgument
        );

        let (mut count, mut name) = (0, empty_answer().item_a);
        let (mut lower, mut upper) = (0.0, 0.0);
        ok(rccd_cell_joint_count(pointer, &mut count));
        ok(rccd_cell_joint(
            pointer, 0, &mut name, &mut lower, &mut upper,
        ));
        assert_eq!(
            (count, text(name).as_str(), lower, upper),
            (2, "shoulder", -2.0, 2.0)
        );
        ok(rccd_cell_joint(
            pointer, 1, &mut name, &mut lower, &mut upper,
        ));
        assert_eq!(
            (text(name).as_str(), lower, upper),
            ("elbow", f64::NEG_INFINITY, f64::INFINITY)
        );
        let missing = rccd_cell_joint(pointer, 2, &mut name, &mut lower, &mut upper);
        assert_eq!(missing, RccdStatus::InvalidArgument);
    }
}

#[test]
fn paddings_and_clearances_keep_obstacles_away() {
    let (cell, _) = cells();
    let at = [[0.0, 0.0]];
    let rests = || first_contact(&cell_solver(&cell, &default_settings()), &at);
    assert_eq!(rests().outcome, RccdOutcome::Free);
    // SAFETY: pointers are to values that live here.
    unsafe {
        let pointer = cell.pointer();
        ok(rccd_cell_set_padding(pointer, c"upper".as_ptr(), 1.0));
        assert_eq!(rests().outcome, RccdOutcome::Contact);
        let (upper, ball) = (c"upper".as_ptr(), c"ball".as_ptr());
        ok(rccd_cell_set_clearance(pointer, upper, ball, 0.0));
        assert_eq!(rests().outcome, RccdOutcome::Free);
        let nobody = rccd_cell_set_clearance(pointer, upper, c"cup".as_ptr(), 0.0);
        assert_eq!(nobody, RccdStatus::InvalidInput);
        assert!(last_error().contains("cup"), "{}", last_error());
    }
}

#[test]
fn held_bodies_move_with_their_link() {
    let (cell, _) = cells();
    let tool = crate::support::sphere(0.4);
    let pose = RccdPose {
        position: [0.0, 0.0, 0.6],
        rotation: [0.0, 0.0, 0.0, 1.0],
    };
    let edge = [[-0.1, 0.0], [-0.4, 0.0]];
    let touches = || first_contact(&cell_solver(&cell, &default_settings()), &edge);
    assert_eq!(touches().outcome, RccdOutcome::Free);
    // SAFETY: pointers are to values that live here.
    unsafe {
        let pointer = cell.pointer();
        let (name, link) = (c"tool".as_ptr(), c"lower".as_ptr());
        let may_touch = [c"upper".as_ptr()];
        ok(rccd_cell_attach(
            pointer,
            name,
            tool.pointer(),
            link,
            &pose,
            may_touch.as_ptr(),
            1,
        ));
        let far = RccdPose {
            position: [-1.2, 0.0, 1.5],
            ..pose
        };
        ok(rccd_cell_move_obstacle(pointer, c"ball".as_ptr(), &far));
        let found = touches();
        assert_eq!(found.outcome, RccdOutcome::Contact);
        ok(rccd_cell_detach(pointer, name));
    }
    assert_eq!(touches().outcome, RccdOutcome::Free);
}

/// Tests that the name of a joint is valid as long as its cell. The cell shares its content with a solver until it is
/// changed.
#[test]
fn names_of_joints_stay_when_the_cell_changes() {
    let (cell, _) = cells();
    let mut name = empty_answer().item_a;
    let (mut lower, mut upper) = (0.0, 0.0);
    let solver = cell_solver(&cell, &default_settings());
    // SAFETY: pointers are to values that live here.
    unsafe {
        let pointer = cell.pointer();
        ok(rccd_cell_joint(
            pointer, 0, &mut name, &mut lower, &mut upper,
        ));
        ok(rccd_cell_remove_obstacle(pointer, c"ball".as_ptr()));
        drop(solver);
        let mut again = empty_answer().item_a;
        ok(rccd_cell_joint(
            pointer, 0, &mut again, &mut lower, &mut upper,
        ));
        assert_eq!((name.data, name.length), (again.data, again.length));
    }
    assert_eq!(text(name), "shoulder");
}

#[test]
fn a_joint_is_stored_in_all_places_or_in_none() {
    let (cell, _) = cells();
    let mut name = empty_answer().item_a;
    let mut lower = 7.0;
    // SAFETY: pointers are null or to values that live here.
    let status = unsafe { rccd_cell_joint(cell.pointer(), 0, &mut name, &mut lower, null_mut()) };
    assert_eq!(status, RccdStatus::InvalidArgument);
    assert!(last_error().contains("upper is null"), "{}", last_error());
    assert!(name.data.is_null() && lower == 7.0, "{name:?} {lower}");
}

/// Tests that the number of configurations without joints, which take no memory, is bounded.
#[test]
fn too_many_configurations_without_joints_are_refused() {
    let file = tempfile::Builder::new().suffix(".urdf").tempfile().unwrap();
    std::fs::write(
        file.path(),
        r#"<robot name="post"><link name="base"/></robot>"#,
    )
    .unwrap();
    let path = std::ffi::CString::new(file.path().to_str().unwrap()).unwrap();
    // SAFETY: the path ends with a zero.
    let post = Handle::new(rccd_cell_free, |out| unsafe {
        rccd_cell_load(path.as_ptr(), null(), null(), out)
    });
    let mut path = RccdPath {
        configurations: null(),
        configuration_count: 2,
        curve: null(),
    };
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("record.json");
    let file = std::ffi::CString::new(file.to_str().unwrap()).unwrap();
    let mut answer = empty_answer();
    answer.outcome = RccdOutcome::Free;
    let record = |path: &RccdPath| {
        // SAFETY: pointers are null or to values that live here.
        unsafe { rccd_evidence_write(post.pointer(), null(), path, &answer, file.as_ptr()) }
    };
    ok(record(&path));
    for count in [usize::MAX, 1 << 60, 1 << 32] {
        path.configuration_count = count;
        assert_eq!(record(&path), RccdStatus::InvalidArgument, "{count}");
        assert!(
            last_error().contains("configurations is too long"),
            "{}",
            last_error()
        );
    }
}

#[test]
fn a_cell_of_which_no_pair_is_checked_has_no_solver() {
    let (cell, _) = cells();
    // SAFETY: pointers are to values that live here.
    unsafe {
        let pointer = cell.pointer();
        ok(rccd_cell_remove_obstacle(pointer, c"ball".as_ptr()));
        let mut solver = std::ptr::null_mut();
        // The base and the lower link are checked.
        ok(rccd_cell_solver_new(pointer, null(), &mut solver));
        rccd_cell_solver_free(solver);
    }
    let slide = r#"<robot name="slide"><link name="rail"><collision><geometry><box size="1 1 1"/></geometry></collision></link>
      <link name="carriage"><collision><geometry><box size="1 1 1"/></geometry></collision></link>
      <joint name="slider" type="prismatic"><parent link="rail"/><child link="carriage"/><axis xyz="1 0 0"/>
        <limit lower="-2" upper="2" effort="1" velocity="1"/></joint></robot>"#;
    let file = tempfile::Builder::new().suffix(".urdf").tempfile().unwrap();
    std::fs::write(file.path(), slide).unwrap();
    let path = std::ffi::CString::new(file.path().to_str().unwrap()).unwrap();
    // SAFETY: pointers are null or to values that live here.
    unsafe {
        let cell = Handle::new(rccd_cell_free, |out| {
            rccd_cell_load(path.as_ptr(), null(), null(), out)
        });
        let mut solver = std::ptr::null_mut();
        let refused = rccd_cell_solver_new(cell.pointer(), null(), &mut solver);
        assert_eq!(refused, RccdStatus::InvalidInput);
        let error = last_error();
        assert!(
            error.contains("nothing is compared in this cell: 2 links; 2 bodies"),
            "{error}"
        );
        let (rail, carriage) = (c"rail".as_ptr(), c"carriage".as_ptr());
        ok(rccd_cell_set_clearance(cell.pointer(), rail, carriage, 0.0));
        ok(rccd_cell_solver_new(cell.pointer(), null(), &mut solver));
        rccd_cell_solver_free(solver);
    }
}

/// Tests that an attached body can be lifted from its support, by the start policy and by an allowed contact.
#[test]
fn held_bodies_are_lifted_from_what_they_stand_on() {
    let lift = r#"<robot name="lift"><link name="rail"/><link name="fork"/>
      <joint name="lift" type="prismatic"><parent link="rail"/><child link="fork"/><axis xyz="0 0 1"/>
        <limit lower="-2" upper="2" effort="1" velocity="1"/></joint></robot>"#;
    let file = tempfile::Builder::new().suffix(".urdf").tempfile().unwrap();
    std::fs::write(file.path(), lift).unwrap();
    let path = std::ffi::CString::new(file.path().to_str().unwrap()).unwrap();
    // SAFETY: pointers are null or to values that live here.
    unsafe {
        let cell = Handle::new(rccd_cell_free, |out| {
            rccd_cell_load(path.as_ptr(), null(), null(), out)
        });
        let (pointer, can, table) = (cell.pointer(), c"can".as_ptr(), c"table".as_ptr());
        let at = |z: f64| RccdPose {
            position: [0.0, 0.0, z],
            rotation: [0.0, 0.0, 0.0, 1.0],
        };
        let ball = crate::support::sphere(0.1);
        let (above, below) = (at(0.3), at(0.1));
        ok(rccd_cell_add_obstacle(
            pointer,
            table,
            ball.pointer(),
            &below,
        ));
        let fork = c"fork".as_ptr();
        ok(rccd_cell_attach(
            pointer,
            can,
            ball.pointer(),
            fork,
            &above,
            null(),
            0,
        ));
        let configurations = [0.0, 1.0];
        let path = RccdPath {
            configurations: configurations.as_ptr(),
            configuration_count: 2,
            curve: null(),
        };
        let lifted = |settings: &RccdSettings| {
            ask(
                rccd_cell_first_contact,
                &cell_solver(&cell, settings),
                &path,
            )
            .outcome
        };
        let report = default_settings();
        let leave = RccdSettings {
            start_policy: RccdStartPolicy::Leave as u32,
            ..report
        };
        assert_eq!(lifted(&report), RccdOutcome::Contact);
        assert_eq!(lifted(&leave), RccdOutcome::Free);
        let solver = cell_solver(&cell, &leave);
        let refused = rccd_cell_closest_approach(solver.pointer(), &path, &mut empty_answer());
        assert_eq!(refused, RccdStatus::InvalidInput);
        assert!(last_error().contains("start policy"), "{}", last_error());

        ok(rccd_cell_allow_contact(pointer, can, table));
        let mut summary = empty_answer().item_a;
        ok(rccd_cell_check_summary(pointer, &mut summary));
        let lines = text(summary);
        assert!(
            lines.contains("1 obstacle, 1 attached, 1 contact allowed"),
            "{lines}"
        );
        assert!(
            lines.ends_with("\n1 contact allowed: can and table"),
            "{lines}"
        );
        // The cell has no other pair to check.
        let mut solver = std::ptr::null_mut();
        let refused = rccd_cell_solver_new(pointer, null(), &mut solver);
        assert_eq!(refused, RccdStatus::InvalidInput);
        let far = at(3.0);
        ok(rccd_cell_add_obstacle(
            pointer,
            c"far".as_ptr(),
            ball.pointer(),
            &far,
        ));
        assert_eq!(lifted(&report), RccdOutcome::Free);
        ok(rccd_cell_forbid_contact(pointer, table, can));
        assert_eq!(lifted(&report), RccdOutcome::Contact);
    }
}

#[test]
fn all_remarks_are_in_the_summary() {
    let folder = tempfile::tempdir().unwrap();
    let srdf = folder.path().join("arm.srdf");
    std::fs::write(&srdf, r#"<robot name="leg"/>"#).unwrap();
    let weld = r#"<mujoco model="arm"><worldbody><body name="a"><joint type="slide"/><geom size="0.1"/></body></worldbody>
        <equality><weld name="w" body1="a"/></equality></mujoco>"#;
    let turned = r#"<robot name="arm"><link name="base"/><link name="a"><collision><origin rpy="0 0 90"/>
        <geometry><sphere radius="0.1"/></geometry></collision></link><joint name="j" type="continuous"><parent link="base"/>
        <child link="a"/></joint></robot>"#;
    let texts = [weld, turned, srdf.to_str().unwrap()];
    let [weld, turned, srdf] = texts.map(|text| std::ffi::CString::new(text).unwrap());
    let place = RccdPose {
        position: [9000.0, 0.0, 0.0],
        rotation: [0.0, 0.0, 0.0, 1.0],
    };
    // SAFETY: texts end with a zero, and pointers are to values that live here.
    let summary = |robot: &std::ffi::CString, radius: f64| unsafe {
        let cell = Handle::new(rccd_cell_free, |out| {
            rccd_cell_from_text(robot.as_ptr(), null(), srdf.as_ptr(), null(), out)
        });
        let (pointer, body) = (cell.pointer(), crate::support::sphere(radius));
        ok(rccd_cell_add_obstacle(
            pointer,
            c"boulder".as_ptr(),
            body.pointer(),
            &place,
        ));
        let mut lines = empty_answer().item_a;
        ok(rccd_cell_check_summary(pointer, &mut lines));
        text(lines)
    };
    for (robot, radius, expected) in [
        (&weld, 0.2, &["weld w in equality", "It is of `leg`"][..]),
        (
            &turned,
            0.2,
            &["link a: roll, pitch or yaw", "It is of `leg`"],
        ),
        (
            &turned,
            200.0,
            &["link a: roll", "It is of `leg`", "boulder is 400 long"],
        ),
    ] {
        let lines = summary(robot, radius);
        let warnings: Vec<&str> = lines
            .lines()
            .filter(|line| line.starts_with("warning: "))
            .collect();
        assert_eq!(warnings.len(), expected.len(), "{lines}");
        for part in expected {
            assert!(
                warnings.iter().any(|line| line.contains(part)),
                "{part}: {lines}"
            );
        }
    }
}
