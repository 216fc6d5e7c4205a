//! Asks about two bodies under a deadline: allocations, times, and proven times against the truth.

use crate::folder::{
    Handle, SCENES, check, default_settings, motion_of, numbers_of, rust_settings, scene,
};
use crate::tally::{Answered, Tally, report};
use anyhow::Result;
use ccd_tables::motions::Motions;
use rigid_ccd::{Body, Solver};
use rigid_ccd_c::*;
use std::path::PathBuf;
use std::ptr::null;

#[derive(clap::Args)]
pub(crate) struct Args {
    /// A folder of meshes and motions (`knots.csv`, …)
    folder: PathBuf,
    /// The deadline in microseconds; none if it is left out
    #[arg(long)]
    deadline: Option<f64>,
    /// How often each row is asked
    #[arg(long, default_value_t = 50)]
    rounds: usize,
}

/// A row of a table, with the time until which nothing touches and at which something has come within the tolerance.
struct Row {
    motions: [RccdMotion; 2],
    duration: f64,
    touches_at: f64,
}

pub(crate) fn run(args: &Args) -> Result<()> {
    for (a, b, motions) in SCENES {
        let (c, rust, rows) = scene(&args.folder, [a, b], motions)?;
        let rows = with_truth(&rust, &rows)?;
        let settings = RccdSettings {
            contact_normals: RccdContactNormals::OfPieces as u32,
            ..default_settings()
        };
        // SAFETY: the settings live here.
        let solver = Handle::new(rccd_solver_free, |out| unsafe {
            rccd_solver_new(&settings, out)
        })?;
        ask_each(&solver, &c, &rows, &mut Tally::new(None, rows.len()))?;
        let deadline = args.deadline.map(|micros| micros * 1e-6);
        let settings = RccdSettings {
            deadline: deadline.unwrap_or(f64::INFINITY),
            ..settings
        };
        // SAFETY: the handle and the settings live here.
        check(unsafe { rccd_solver_set_settings(solver.0, &settings) })?;
        let mut all = Tally::new(deadline, args.rounds * rows.len());
        let mut failure = None;
        let counted = allocation_counter::measure(|| {
            for _ in 0..args.rounds {
                if let Err(error) = ask_each(&solver, &c, &rows, &mut all) {
                    failure = Some(error);
                }
            }
        });
        if let Some(error) = failure {
            return Err(error);
        }
        all.allocations = counted.count_total;
        report(a, &[all]);
    }
    Ok(())
}

/// Finds out when each row first touches.
fn with_truth(bodies: &[Body; 2], rows: &[Motions]) -> Result<Vec<Row>> {
    let mut solver = Solver::new().with_settings(rust_settings(1e-9));
    let rows = rows.iter().map(|row| {
        let motions = [row.a, row.b].map(|motion| numbers_of(&motion));
        let (a, b) = (motion_of(&motions[0])?, motion_of(&motions[1])?);
        let answer = solver.first_contact((&bodies[0], a), (&bodies[1], b), row.duration)?;
        Ok(Row {
            motions,
            duration: row.duration,
            touches_at: answer.hit()?.map_or(f64::INFINITY, |hit| hit.time),
        })
    });
    rows.collect()
}

fn ask_each(
    solver: &Handle<RccdSolver>,
    bodies: &[Handle<RccdBody>; 2],
    rows: &[Row],
    tally: &mut Tally,
) -> Result<()> {
    for row in rows {
        let [a, b] = [0, 1].map(|k| RccdMovingBody {
            body: bodies[k].0,
            motion: &row.motions[k],
            trajectory: null(),
        });
        // SAFETY: zero is a value of each field.
        let mut answer: RccdAnswer = unsafe { std::mem::zeroed() };
        answer.size = size_of::<RccdAnswer>();
        // SAFETY: the pointers are to values that live here.
        let question =
            || check(unsafe { rccd_first_contact(solver.0, &a, &b, row.duration, &mut answer) });
        tally.ask(question)?;
        let answer = Answered {
            outcome: answer.outcome,
            free_until: answer.safe_until,
            end: row.duration,
        };
        tally.judge(answer, row.touches_at);
    }
    Ok(())
}
