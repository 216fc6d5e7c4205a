//! Shared helpers of tests of cells: an arm beside a ball, in the interface and in Rust.

use crate::support::{Handle, Random, ok};
use rigid_ccd::{Body, Pose};
use rigid_ccd_c::*;
use rigid_ccd_robot::{Cell, RobotFile};
use std::ffi::CString;
use std::ptr::null;

pub(crate) const ARM: &str = r#"<robot name="arm">
  <link name="base"><collision><geometry><box size="0.4 0.4 0.2"/></geometry></collision></link>
  <link name="upper"><collision><origin xyz="0 0 0.5"/><geometry><box size="0.1 0.1 0.8"/></geometry></collision></link>
  <link name="lower"><collision><origin xyz="0 0 0.4"/><geometry><sphere radius="0.15"/></geometry></collision></link>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="0 1 0"/>
    <limit lower="-2" upper="2" effort="1" velocity="1"/></joint>
  <joint name="elbow" type="continuous"><parent link="upper"/><child link="lower"/><origin xyz="0 0 1"/><axis xyz="1 0 0"/></joint>
</robot>"#;

pub(crate) fn write_arm() -> tempfile::NamedTempFile {
    let file = tempfile::Builder::new().suffix(".urdf").tempfile().unwrap();
    std::fs::write(file.path(), ARM).unwrap();
    file
}

/// Returns the arm beside a ball, as a cell of the interface and as a cell of Rust.
pub(crate) fn cells() -> (Handle<RccdCell>, Cell) {
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
        rotation: [0.0, 0.0, 0.0, 1.0],
    };
    // SAFETY: all pointers are to values that live here.
    ok(unsafe { rccd_cell_add_obstacle(cell.pointer(), c"ball".as_ptr(), ball.pointer(), &pose) });
    (cell, rust)
}

pub(crate) fn cell_solver(
    cell: &Handle<RccdCell>,
    settings: &RccdSettings,
) -> Handle<RccdCellSolver> {
    // SAFETY: the handle and the settings live here.
    Handle::new(rccd_cell_solver_free, |out| unsafe {
        rccd_cell_solver_new(cell.pointer(), settings, out)
    })
}

pub(crate) fn empty_answer() -> RccdPathAnswer {
    // SAFETY: zero is a value of each field: numbers, null, and enums that have it.
    let zero: RccdPathAnswer = unsafe { std::mem::zeroed() };
    RccdPathAnswer {
        size: size_of::<RccdPathAnswer>(),
        ..zero
    }
}

pub(crate) fn first_contact(solver: &Handle<RccdCellSolver>, path: &[[f64; 2]]) -> RccdPathAnswer {
    ask(rccd_cell_first_contact, solver, &through(path))
}

/// A question about a path.
pub(crate) type Question =
    unsafe extern "C" fn(*mut RccdCellSolver, *const RccdPath, *mut RccdPathAnswer) -> RccdStatus;

pub(crate) fn ask(
    question: Question,
    solver: &Handle<RccdCellSolver>,
    path: &RccdPath,
) -> RccdPathAnswer {
    let mut answer = empty_answer();
    // SAFETY: the path is of the robot, which has two independent joints, and lives here.
    ok(unsafe { question(solver.pointer(), path, &mut answer) });
    answer
}

/// Returns a path through configurations. The caller keeps the configurations alive.
pub(crate) fn through(configurations: &[[f64; 2]]) -> RccdPath {
    RccdPath {
        configurations: configurations.as_ptr().cast(),
        configuration_count: configurations.len(),
        curve: null(),
    }
}

pub(crate) fn text(text: RccdText) -> String {
    if text.data.is_null() {
        return String::new();
    }
    // SAFETY: the text belongs to a solver that lives here.
    let bytes = unsafe { std::slice::from_raw_parts(text.data.cast::<u8>(), text.length) };
    String::from_utf8(bytes.to_vec()).unwrap()
}

pub(crate) fn configuration(random: &mut Random) -> [f64; 2] {
    [1.9 * random.number(), 3.0 * random.number()]
}
