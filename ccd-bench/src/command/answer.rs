//! The command `ccd-bench answer`: answers queries on standard input with one method, in a process that can be killed
//! from outside.

use super::inputs::MeshPairArgs;
use crate::method::solver::Solver;
use crate::method::wire::{REFUSAL_PREFIX, serve_queries};
use crate::method::{Method, ProjectSolver};
use crate::run::contest::MAX_PAIRS_FOR_NAIVE_SCHEDULE;
use anyhow::{Context, Result, anyhow, bail};
use ccd_core::Body;
use ccd_decomp::TriangleMesh;
use ccd_tables::batch::BodyPair;
use clap::Args;
use rigid_ccd_cli::ScheduleKind;
use rigid_ccd_cli::{OutputError, RunOutcome};
use std::cell::OnceCell;
use std::io::{self, Write};
#[cfg(unix)]
use std::os::unix::process::parent_id;
#[cfg(unix)]
use std::{thread, time::Duration};

/// Answer queries with one method: one line of JSON with motions and a duration in, one line with the reply out
#[derive(Debug, Args)]
pub(super) struct AnswerArgs {
    /// The name of the method, as in the tables
    #[arg(long)]
    method: String,
    #[command(flatten)]
    meshes: MeshPairArgs,
    /// The tolerance, for methods that take one, in the scene's unit of length
    #[arg(long, value_name = "LENGTH")]
    tolerance: f64,
    /// The distance to keep between the bodies, in the scene's unit of length
    #[arg(long, value_name = "LENGTH", default_value_t = 0.0)]
    margin: f64,
}

pub(super) fn run(args: &AnswerArgs) -> Result<RunOutcome> {
    exit_when_parent_ends();
    let name = &args.method;
    let method = Method::from_name(name).ok_or_else(|| anyhow!("there is no method `{name}`"))?;
    let (meshes, bodies) = (args.meshes.read_meshes()?, OnceCell::new());
    match solver(method, &meshes, args.margin, &bodies) {
        Ok(mut solver) => serve_standard_streams(solver.as_mut(), args.tolerance)?,
        Err(refusal) => {
            writeln!(io::stdout(), "{REFUSAL_PREFIX}{refusal:#}").map_err(reply_write_error)?;
        }
    }
    Ok(RunOutcome::AllAnswered)
}

/// Makes the solver of a method, with the bodies that it needs in `bodies`.
///
/// # Errors
/// Why the method refuses the meshes or the margin.
fn solver<'b>(
    method: Method,
    [a, b]: &[TriangleMesh; 2],
    margin: f64,
    bodies: &'b OnceCell<[Body; 2]>,
) -> Result<Box<dyn Solver + 'b>> {
    if margin != 0.0 && !matches!(method, Method::ThisProject(..)) {
        bail!("the method keeps no margin");
    }
    Ok(match method {
        Method::ThisProject(kind, pieces) => {
            let made = [pieces.make_body(a)?, pieces.make_body(b)?];
            let [a, b] = bodies.get_or_init(|| made);
            let pairs = a.pieces().len() as u64 * b.pieces().len() as u64;
            if kind.schedule == ScheduleKind::Naive && pairs > MAX_PAIRS_FOR_NAIVE_SCHEDULE {
                bail!("{pairs} pairs are too many");
            }
            Box::new(ProjectSolver::new(kind, BodyPair { a, b }, margin))
        }
        Method::Rival(kind) => kind.solver(a, b),
        Method::Peer(kind) => kind.solver(a, b)?,
        Method::Script(_) => bail!("the method is run by a script"),
    })
}

fn serve_standard_streams(solver: &mut dyn Solver, tolerance: f64) -> Result<()> {
    let (input, output) = (io::stdin().lock(), io::stdout().lock());
    match serve_queries(solver, tolerance, input, output) {
        Ok(()) => Ok(()),
        Err(error) if error.kind() == io::ErrorKind::InvalidData => {
            Err(error).context("standard input: no query")
        }
        Err(source) => Err(reply_write_error(source).into()),
    }
}

fn reply_write_error(source: io::Error) -> OutputError {
    OutputError {
        file_or_stream: "the replies".to_owned(),
        source,
    }
}

/// The longest time that this process may outlive its parent.
#[cfg(unix)]
const MAX_TIME_WITHOUT_PARENT: Duration = Duration::from_secs(1);

/// Watches for the end of the parent process, and then ends this process, whatever it is doing.
#[cfg(unix)]
fn exit_when_parent_ends() {
    let parent = parent_id();
    thread::spawn(move || {
        while parent_id() == parent {
            thread::sleep(MAX_TIME_WITHOUT_PARENT);
        }
        std::process::exit(1);
    });
}

#[cfg(not(unix))]
fn exit_when_parent_ends() {}
