//! Tests that questions about paths of robots have the bits of Rust, do not allocate once warm, and keep their deadline's
//! promise.

use crate::support::{Handle, Random, last_error, ok};
use rigid_ccd::{Body, Pose, Settings};
use rigid_ccd_c::*;
use rigid_ccd_robot::{Cell, PathOutcome, RobotFile};
use std::ffi::CString;
use std::ptr::null;

const ARM: &str = r#"<robot name="arm">
  <link name="base"><collision><geometry><box size="0.4 0.4 0.2"/></geometry></collision></link>
  <link name="upper"><collision><origin xyz="0 0 0.5"/><geometry><box size="0.1 0.1 0.8"/></geometry></collision></link>
  <link name="lower"><collision><origin xyz="0 0 0.4"/><geometry><sphere radius="0.15"/></geometry></collision></link>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="0 1 0"/>
    <limit lower="-2" upper="2" effort="1" velocity="1"/></joint>
  <joint name="elbow" type="continuous"><parent link="upper"/><child link="lower"/><origin xyz="0 0 1"/><axis xyz="1 0 0"/></joint>
</robot>"#;

fn write_arm() -> tempfile::NamedTempFile {
    let file = tempfile::Builder::new().suffix(".urdf").tempfile().unwrap();
    std::fs::write(file.path(), ARM).unwrap();
    file
}

/// Returns the arm beside a ball, by the interface and in Rust.
fn cells() -> (Handle<RccdCell>, Cell) {
    let arm = write_arm();
    let file = RobotFile::from_path(arm.path());
    let robot = file.read().unwrap();
    let pairs = file.link_pairs(&robot, None).unwrap();
    let mut rust = Cell::new(robot, pairs);
    let at = [0.7, 0.3, 0.9];
    rust.add_obstacle("ball", Body::sphere(0.3).unwrap(), Pose::at(at).unwrap())
        .unwrap();

    let path = CString::new(arm.path().to_str().unwrap()).unwrap();
    // SAFETY: the path ends with a zero.
    let cell = Handle::new(rccd_cell_free, |out| unsafe {
        rccd_cell_load(path.as_ptr(), null(), null(), out)
    });
    let ball = crate::support::sphere(0.3);
    let pose = RccdPose {
        position: at,
        orientation: [0.0, 0.0, 0.0, 1.0],
    };
    // SAFETY: all pointers are to values that live here.
    ok(unsafe { rccd_cell_add_obstacle(cell.pointer(), c"ball".as_ptr(), ball.pointer(), &pose) });
    (cell, rust)
}

fn cell_solver(cell: &Handle<RccdCell>, settings: &RccdSettings) -> Handle<RccdCellSolver> {
    // SAFETY: the handle and the settings live here.
    Handle::new(rccd_cell_solver_free, |out| unsafe {
        rccd_cell_solver_new(cell.pointer(), settings, out)
    })
}

fn empty_answer() -> RccdPathAnswer {
    // SAFETY: zero is a value of each field: numbers, null, and enums that have it.
    let zero: RccdPathAnswer = unsafe { std::mem::zeroed() };
    RccdPathAnswer {
        size: size_of::<RccdPathAnswer>(),
        ..zero
    }
}

fn first_contact(solver: &Handle<RccdCellSolver>, path: &[[f64; 2]]) -> RccdPathAnswer {
    let mut answer = empty_answer();
    // SAFETY: the robot has two free joints.
    ok(unsafe {
        rccd_cell_first_contact(
            solver.pointer(),
            path.as_ptr().cast(),
            path.len(),
            &mut answer,
        )
    });
    answer
}

fn text(text: RccdText) -> String {
    if text.data.is_null() {
        return String::new();
    }
    // SAFETY: the text belongs to a solver that lives here.
    let bytes = unsafe { std::slice::from_raw_parts(text.data.cast::<u8>(), text.length) };
    String::from_utf8(bytes.to_vec()).unwrap()
}

fn configuration(random: &mut Random) -> [f64; 2] {
    [1.9 * random.number(), 3.0 * random.number()]
}

#[test]
fn paths_have_the_bits_of_rust() {
    let (cell, rust) = cells();
    let solver = cell_solver(&cell, &rccd_settings_default());
    let mut rust_solver = rust.solver().with_settings(Settings::DEFAULT);
    let mut random = Random::new(7);
    let (mut free, mut hits) = (0, 0);
    for number in 0..300 {
        let path: Vec<_> = (0..1 + number % 4)
            .map(|_| configuration(&mut random))
            .collect();
        let found = first_contact(&solver, &path);
        match rust_solver.first_contact(&path).unwrap() {
            PathOutcome::Free => {
                free += 1;
                assert_eq!(found.outcome, RccdOutcome::Free, "{number}");
                assert_eq!(
                    (found.segment, found.share),
                    (path.len().saturating_sub(2), 1.0)
                );
            }
            PathOutcome::Contact(contact) => {
                hits += 1;
                assert_eq!(found.outcome, RccdOutcome::Contact, "{number}");
                assert_eq!(found.segment, contact.at.segment);
                assert_eq!(found.share.to_bits(), contact.at.share.to_bits());
                let names = [found.item_a, found.item_b].map(text);
                assert_eq!(names, contact.items.map(|item| item.name().to_owned()));
                assert_eq!([found.lower, found.upper], contact.distance_bounds);
                assert_eq!(found.witness_a, contact.witnesses[0].to_array());
            }
            PathOutcome::Unresolved { .. } => panic!("{number}"),
        }
        let mut near = empty_answer();
        // SAFETY: the robot has two free joints.
        ok(unsafe {
            let (path, count) = (path.as_ptr().cast(), path.len());
            rccd_cell_closest_approach(solver.pointer(), path, count, &mut near)
        });
        let approach = rust_solver.closest_approach(&path).unwrap();
        assert_eq!(near.outcome, RccdOutcome::LeastDistance);
        assert_eq!([near.lower, near.upper], [approach.lower, approach.upper]);
    }
    assert!(free > 50 && hits > 50, "{free} {hits}");
}

#[test]
fn warm_paths_do_not_allocate() {
    let (cell, _) = cells();
    let solver = cell_solver(&cell, &rccd_settings_default());
    let mut random = Random::new(8);
    let paths: Vec<_> = (0..100)
        .map(|_| [(); 4].map(|()| configuration(&mut random)))
        .collect();
    let round = || {
        for path in &paths {
            first_contact(&solver, path);
        }
    };
    round();
    let counted = allocation_counter::measure(round);
    assert_eq!(counted.count_total, 0, "{counted:?}");
}

/// Tests that a path whose deadline or budget ends the search is free until the point that the answer names.
#[test]
fn a_limit_leaves_a_certified_prefix() {
    let (cell, rust) = cells();
    // Far below the gap that a prefix is proven to keep.
    let fine = Settings {
        tolerance: 1e-9,
        ..Settings::DEFAULT
    };
    let mut rust_solver = rust.solver().with_settings(fine);
    let mut random = Random::new(9);
    let (mut unresolved, mut prefixes) = (0, 0);
    for number in 0..300 {
        let path = [(); 6].map(|()| configuration(&mut random));
        let settings = RccdSettings {
            tolerance: 1e-6,
            deadline: [0.0, 1e-6, 1e-5, 1e-4][number % 4],
            ..rccd_settings_default()
        };
        let found = first_contact(&cell_solver(&cell, &settings), &path);
        if found.outcome != RccdOutcome::Unresolved {
            continue;
        }
        assert_eq!(found.limit, RccdLimit::Deadline, "{number}");
        unresolved += 1;
        let mut prefix = path[..=found.segment].to_vec();
        let [from, to] = [path[found.segment], path[found.segment + 1]];
        prefix.push([0, 1].map(|k| from[k] + (to[k] - from[k]) * found.share * (1.0 - 1e-9)));
        prefixes += usize::from(found.segment > 0 || found.share > 0.0);
        let outcome = rust_solver.first_contact(&prefix).unwrap();
        let begins_in_contact = found.segment == 0 && found.share == 0.0;
        assert!(
            outcome == PathOutcome::Free || begins_in_contact,
            "{number}: {found:?}"
        );
    }
    assert!(unresolved > 30, "{unresolved} {prefixes}");
}

#[test]
fn cells_keep_what_solvers_saw_and_refuse_what_is_wrong() {
    let (cell, _) = cells();
    let solver = cell_solver(&cell, &rccd_settings_default());
    let reach = [[0.0, 0.0], [1.2, 0.0]];
    assert_eq!(first_contact(&solver, &reach).outcome, RccdOutcome::Contact);
    // SAFETY: pointers are null or to values that live here.
    unsafe {
        let pointer = cell.pointer();
        ok(rccd_cell_remove_obstacle(pointer, c"ball".as_ptr()));
        assert_eq!(first_contact(&solver, &reach).outcome, RccdOutcome::Contact);
        let of_now = cell_solver(&cell, &rccd_settings_default());
        assert_eq!(first_contact(&of_now, &reach).outcome, RccdOutcome::Free);

        let gone = rccd_cell_remove_obstacle(pointer, c"ball".as_ptr());
        assert_eq!(gone, RccdStatus::InvalidInput);
        assert!(last_error().contains("ball"), "{}", last_error());
        let mut answer = empty_answer();
        let beyond = [[5.0, 0.0]];
        let s = solver.pointer();
        let refused = rccd_cell_first_contact(s, beyond.as_ptr().cast(), 1, &mut answer);
        assert_eq!(refused, RccdStatus::InvalidInput);
        assert!(last_error().contains("shoulder"), "{}", last_error());
        assert_eq!(
            rccd_cell_first_contact(s, null(), 0, &mut answer),
            RccdStatus::InvalidInput
        );
        assert_eq!(
            rccd_cell_first_contact(s, null(), 1, &mut answer),
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
fn held_bodies_move_with_their_link() {
    let (cell, _) = cells();
    let tool = crate::support::sphere(0.4);
    let pose = RccdPose {
        position: [0.0, 0.0, 0.6],
        orientation: [0.0, 0.0, 0.0, 1.0],
    };
    let edge = [[-0.1, 0.0], [-0.4, 0.0]];
    let touches = || first_contact(&cell_solver(&cell, &rccd_settings_default()), &edge);
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
