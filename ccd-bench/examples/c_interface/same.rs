//! Compares each answer of the interface with that of Rust, bit by bit, and the times of both. Where bodies lie in memory
//! changes times by about a hundredth, so Rust is asked twice, with two copies of all bodies.

use crate::folder::{
    Handle, SCENES, cell_solver, cells, check, default_settings, empty_path_answer, motion_of,
    numbers_of, read_numbers, rust_settings, scene,
};
use anyhow::{Context, Result, ensure};
use ccd_tables::motions::Motions;
use rigid_ccd::{Body, Outcome, Solver};
use rigid_ccd_c::*;
use rigid_ccd_robot::{CellSolver, PathOutcome};
use std::path::Path;
use std::ptr::null;
use std::time::{Duration, Instant};

/// The least times of one question: through the interface, in Rust, and in Rust with another copy of the bodies.
struct Times([Duration; 3]);

impl Times {
    /// Asks all, in turn, and in changing order.
    fn measure(repeat: usize, mut ask: impl FnMut(usize) -> Result<()>) -> Result<Self> {
        let mut least = [Duration::MAX; 3];
        for round in 0..repeat.max(1) {
            for turn in 0..3 {
                let which = (turn + round) % 3;
                // What was called before is warm: each way is that of a program which uses no other.
                ask(which)?;
                let start = Instant::now();
                ask(which)?;
                least[which] = least[which].min(start.elapsed());
            }
        }
        Ok(Times(least))
    }
}

/// Prints the times of many questions.
fn print(name: &str, times: &[Times], hits: usize) {
    let total = |which: usize| times.iter().map(|t| t.0[which].as_secs_f64()).sum::<f64>();
    let in_rust = (total(1) + total(2)) / 2.0;
    println!(
        "{name}: {} rows with equal bits, {hits} in contact; time over Rust: {:.4}; Rust over another copy of the bodies: {:.4}",
        times.len(),
        total(0) / in_rust,
        total(1) / total(2),
    );
}

/// Compares all rows of a folder of scenes, at two tolerances.
pub(crate) fn compare_scenes(folder: &Path, repeat: usize) -> Result<()> {
    for tolerance in [1e-3, 1e-6] {
        for (a, b, motions) in SCENES {
            let (c, rust, rows) = scene(folder, [a, b], motions)?;
            let (_, copy, _) = scene(folder, [a, b], motions)?;
            let name = format!("{a} {tolerance:e}");
            compare_rows(&name, &rows, (&c, &[rust, copy]), tolerance, repeat)?;
        }
    }
    Ok(())
}

fn compare_rows(
    name: &str,
    rows: &[Motions],
    (c, rust): (&[Handle<RccdBody>; 2], &[[Body; 2]; 2]),
    tolerance: f64,
    repeat: usize,
) -> Result<()> {
    let settings = RccdSettings {
        tolerance,
        ..default_settings()
    };
    // SAFETY: the settings live here.
    let solver = Handle::new(rccd_solver_free, |out| unsafe {
        rccd_solver_new(&settings, out)
    })?;
    let mut rust_solvers = [(); 2].map(|()| Solver::new().with_settings(rust_settings(tolerance)));
    let (mut times, mut hits) = (Vec::new(), 0);
    for row in rows {
        let motions = [row.a, row.b].map(|motion| numbers_of(&motion));
        // SAFETY: zero is a value of each field.
        let mut answer: RccdAnswer = unsafe { std::mem::zeroed() };
        answer.size = size_of::<RccdAnswer>();
        let mut outcome = None;
        let moving = [0, 1].map(|k| RccdMovingBody {
            body: c[k].0,
            motion: &motions[k],
            trajectory: null(),
        });
        times.push(Times::measure(repeat, |which| {
            if which == 0 {
                let [a, b] = &moving;
                // SAFETY: the pointers are to values that live here.
                check(unsafe { rccd_first_contact(solver.0, a, b, row.duration, &mut answer) })
            } else {
                // Both begin with the numbers of the motions.
                let (a, b) = (motion_of(&motions[0])?, motion_of(&motions[1])?);
                let [body_a, body_b] = &rust[which - 1];
                let solver = &mut rust_solvers[which - 1];
                outcome = Some(solver.first_contact((body_a, a), (body_b, b), row.duration)?);
                Ok(())
            }
        })?);
        let expected = outcome.context("an answer of Rust")?;
        let time = expected.outcome.time().unwrap_or(f64::NAN);
        ensure!(
            answer.time.to_bits() == time.to_bits()
                && answer.lower.to_bits() == expected.outcome.lower().to_bits()
                && answer.upper.to_bits() == expected.outcome.upper().to_bits()
                && answer.work == expected.stats.budgeted_work(),
            "row {} differs: {answer:?}, {expected:?}",
            row.id
        );
        if let Outcome::Contact { contact, .. } = expected.outcome {
            hits += 1;
            let bits = |point: [f64; 3]| point.map(f64::to_bits);
            let separation = contact.separation;
            let same = bits(answer.witness_a) == bits(separation.witness_a.to_array())
                && bits(answer.witness_b) == bits(separation.witness_b.to_array());
            ensure!(same, "row {} has other witnesses", row.id);
        }
    }
    print(name, &times, hits);
    Ok(())
}

/// Compares all edges of a folder of a robot.
pub(crate) fn compare_edges(folder: &Path, meshes: &Path, repeat: usize) -> Result<()> {
    for name in ["A", "B"] {
        let (cell, rust) = cells(folder, meshes, name)?;
        let (_, copy) = cells(folder, meshes, name)?;
        let joints = rust.robot().independent_joint_names().len();
        let tolerance = 1e-6;
        let settings = RccdSettings {
            tolerance,
            ..default_settings()
        };
        let solver = cell_solver(&cell, &settings)?;
        let mut rust_solvers =
            [&rust, &copy].map(|cell| cell.solver().with_settings(rust_settings(tolerance)));
        for length in ["0.1", "0.5", "2.0"] {
            let numbers = read_numbers(&folder.join(format!("edges_{name}_{length}.bin")))?;
            let (mut times, mut hits) = (Vec::new(), 0);
            for edge in numbers.chunks_exact(2 * joints) {
                let (time, hit) = compare_edge(&solver, &mut rust_solvers, edge, joints, repeat)?;
                times.push(time);
                hits += usize::from(hit);
            }
            print(&format!("edges {name} {length}"), &times, hits);
        }
    }
    Ok(())
}

/// Returns the times of an edge, and whether it touches.
fn compare_edge(
    solver: &Handle<RccdCellSolver>,
    rust: &mut [CellSolver<'_>; 2],
    edge: &[f64],
    joints: usize,
    repeat: usize,
) -> Result<(Times, bool)> {
    let path = RccdPath {
        configurations: edge.as_ptr(),
        configuration_count: 2,
        curve: null(),
    };
    let ends = [&edge[..joints], &edge[joints..]];
    let (mut answer, mut outcome) = (empty_path_answer(), None);
    let times = Times::measure(repeat, |which| {
        if which == 0 {
            // SAFETY: the pointers are to values that live here.
            check(unsafe { rccd_cell_first_contact(solver.0, &path, &mut answer) })
        } else {
            outcome = Some(rust[which - 1].first_contact(&ends)?);
            Ok(())
        }
    })?;
    let same = match outcome.context("an answer of Rust")?.outcome {
        PathOutcome::Free => answer.outcome == RccdOutcome::Free,
        PathOutcome::Contact(contact) => {
            let bits = |point: [f64; 3]| point.map(f64::to_bits);
            answer.outcome == RccdOutcome::Contact
                && answer.fraction.to_bits() == contact.at.fraction.to_bits()
                && contact.witnesses.is_some_and(|[a, b]| {
                    bits(answer.witness_a) == bits(a.to_array())
                        && bits(answer.witness_b) == bits(b.to_array())
                })
        }
        _ => answer.outcome == RccdOutcome::Unresolved,
    };
    ensure!(same, "an edge differs: {answer:?}");
    Ok((times, answer.outcome == RccdOutcome::Contact))
}
