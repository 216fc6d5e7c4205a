//! Tests that threads can share bodies, trajectories, curves, cells and flags, each thread with its own solver. Their
//! answers are those of one thread. `scripts/sanitise.sh` runs the tests with a sanitiser that detects data races.

use crate::support::{Handle, Random, default_settings, empty_answer, ok};
use crate::support_cells::{self, Question, cells};
use rigid_ccd_c::*;
use std::ptr::null;

/// A handle that threads share as `const`.
#[derive(Clone, Copy)]
struct Shared<T>(*const T);

// SAFETY: what the header says: such handles may be shared by threads.
unsafe impl<T> Send for Shared<T> {}
// SAFETY: as above.
unsafe impl<T> Sync for Shared<T> {}

/// The objects that all threads share.
struct Scene {
    bodies: [Shared<RccdBody>; 2],
    trajectory: Shared<RccdTrajectory>,
    cell: Shared<RccdCell>,
    curve: Shared<RccdJointCurve>,
    stop: Shared<RccdStop>,
}

#[test]
fn threads_share_what_is_const() {
    let mut random = Random::new(23);
    let (mesh, _) = crate::support::random_mesh(&mut random, 30);
    let ball = crate::support::cylinder(0.3, 0.4);
    let flies = crate::support::thrown(&random.motion(), [0.0, 0.0, -3.0]);
    let (cell, _) = cells();
    let (times, rows) = ([0.0, 1.0], [[0.1, 0.2], [0.9, -0.4]]);
    // SAFETY: the arrays have two rows of two numbers.
    let curve = Handle::new(rccd_joint_curve_free, |out| unsafe {
        let rows = rows.as_ptr().cast();
        rccd_joint_curve_through(times.as_ptr(), rows, rows, null(), 2, 2, out)
    });
    // SAFETY: the place is a local variable.
    let stop = Handle::new(rccd_stop_free, |out| unsafe { rccd_stop_new(out) });
    let scene = Scene {
        bodies: [&mesh, &ball].map(|body| Shared(body.pointer().cast_const())),
        trajectory: Shared(flies.pointer()),
        cell: Shared(cell.pointer()),
        curve: Shared(curve.pointer()),
        stop: Shared(stop.pointer()),
    };
    let alone = answers(&scene, null());
    let stopped = std::thread::scope(|scope| {
        let threads = [(); 3].map(|()| scope.spawn(|| answers(&scene, scene.stop.0)));
        // Sets the flag as long as threads ask questions, because a sanitiser forgets old writes.
        while threads.iter().any(|thread| !thread.is_finished()) {
            // SAFETY: the handle lives here.
            ok(unsafe { rccd_stop_set(stop.pointer()) });
            // SAFETY: the handle lives here.
            ok(unsafe { rccd_stop_clear(stop.pointer()) });
            // The flag is clear most of the time; otherwise no question would be answered.
            std::thread::sleep(std::time::Duration::from_millis(1));
        }
        threads.map(|thread| check_same(&alone, &thread.join().unwrap()))
    });
    assert!(
        stopped.iter().all(|&count| count < alone.len()),
        "{stopped:?}"
    );
}

/// Checks that answers are equal, except for questions that were stopped. Returns the number of stopped questions.
fn check_same(alone: &[(RccdLimit, u64)], shared: &[(RccdLimit, u64)]) -> usize {
    let is_stopped = |&&(limit, _): &&(RccdLimit, u64)| limit == RccdLimit::Stopped;
    for (number, (one, other)) in alone.iter().zip(shared).enumerate() {
        assert!(
            one == other || is_stopped(&other),
            "question {} of a round: {one:?} {other:?}",
            number % 6
        );
    }
    shared.iter().filter(is_stopped).count()
}

/// Asks questions with the solvers of this thread.
fn answers(scene: &Scene, stop: *const RccdStop) -> Vec<(RccdLimit, u64)> {
    let settings = RccdSettings {
        stop,
        ..default_settings()
    };
    let solver = crate::support::solver(Some(&settings));
    // SAFETY: the handle and the settings live here.
    let cell_solver = Handle::new(rccd_cell_solver_free, |out| unsafe {
        rccd_cell_solver_new(scene.cell.0, &settings, out)
    });
    let mut random = Random::new(24);
    let mut answers = Vec::new();
    for _ in 0..40 {
        let motion = random.motion();
        let [a, b] = [0, 1].map(|k| RccdMovingBody {
            body: scene.bodies[k].0,
            motion: if k == 0 { &motion } else { null() },
            trajectory: if k == 0 { null() } else { scene.trajectory.0 },
        });
        let mut answer = empty_answer();
        // SAFETY: all pointers are to values that live here, and the solver is of this thread.
        ok(unsafe { rccd_first_contact(solver.pointer(), &a, &b, 1.0, &mut answer) });
        answers.push((answer.limit, answer.time.to_bits()));
        // SAFETY: as above.
        ok(unsafe { rccd_closest_approach(solver.pointer(), &a, &b, 1.0, &mut answer) });
        // If bodies come within the tolerance, a second query examines the start. If that query is stopped, the answer
        // has the later time.
        answers.push((answer.limit, answer.lower.to_bits()));
        let configurations = [(); 2].map(|()| support_cells::configuration(&mut random));
        let curve = RccdPath {
            configurations: null(),
            configuration_count: 0,
            curve: scene.curve.0,
        };
        let questions = [rccd_cell_first_contact as Question, rccd_cell_any_contact];
        for (question, is_first) in questions.into_iter().zip([true, false]) {
            for path in [support_cells::through(&configurations), curve] {
                let found = support_cells::ask(question, &cell_solver, &path);
                // A stopped question about any contact may have found a different contact before.
                let answer = if is_first {
                    found.fraction.to_bits()
                } else {
                    found.outcome as u64
                };
                answers.push((found.limit, answer));
            }
        }
    }
    answers
}
