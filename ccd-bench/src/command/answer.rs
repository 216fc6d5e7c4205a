//! The command `ccd-bench answer`: answers queries on standard input with one method, in a process that can be killed
//! from outside.

use crate::method::solver::Solver;
use crate::method::wire::{REFUSAL_PREFIX, serve_queries};
use crate::method::{Method, ProjectSolver};
use crate::run::contest::MAX_PAIRS_FOR_NAIVE_SCHEDULE;
use anyhow::{Context, Result, anyhow};
use ccd_decomp::TriangleMesh;
use clap::Args;
use rigid_ccd::batch::{Bodies, ScheduleKind};
use rigid_ccd::command::{OutputError, RunOutcome};
use std::io::{self, Write};
#[cfg(unix)]
use std::os::unix::process::parent_id;
use std::path::{Path, PathBuf};
#[cfg(unix)]
use std::{thread, time::Duration};

/// Answer queries with one method: one line of JSON with motions and a duration in, one line with the reply out
#[derive(Debug, Args)]
pub(super) struct AnswerArgs {
    /// The name of the method, as in the tables
    #[arg(long)]
    method: String,
    /// The mesh of body A
    #[arg(long, value_name = "MESH")]
    a: PathBuf,
    /// The mesh of body B
    #[arg(long, value_name = "MESH")]
    b: PathBuf,
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
    let read = |path: &Path| TriangleMesh::read(path).with_context(|| path.display().to_string());
    let meshes = [read(&args.a)?, read(&args.b)?];
    if let Err(refusal) = answer_queries(method, &meshes, args)? {
        writeln!(io::stdout(), "{REFUSAL_PREFIX}{refusal}").map_err(reply_write_error)?;
    }
    Ok(RunOutcome::AllAnswered)
}

/// Answers all queries on standard input; the inner `Err` says why the method refuses the bodies or the setting.
fn answer_queries(
    method: Method,
    [a, b]: &[TriangleMesh; 2],
    args: &AnswerArgs,
) -> Result<Result<(), String>> {
    let tolerance = args.tolerance;
    if args.margin != 0.0 && !matches!(method, Method::ThisProject(..)) {
        return Ok(Err("the method keeps no margin".to_owned()));
    }
    match method {
        Method::ThisProject(kind, pieces) => {
            let bodies = [a, b].map(|mesh| pieces.make_body(mesh));
            let [a, b] = match bodies {
                [Ok(a), Ok(b)] => [a, b],
                [Err(error), _] | [_, Err(error)] => return Ok(Err(error.to_string())),
            };
            let pairs = a.pieces().len() as u64 * b.pieces().len() as u64;
            if kind.schedule == ScheduleKind::Naive && pairs > MAX_PAIRS_FOR_NAIVE_SCHEDULE {
                return Ok(Err(format!("{pairs} pairs are too many")));
            }
            let bodies = Bodies { a: &a, b: &b };
            serve_standard_streams(
                &mut ProjectSolver::new(kind, bodies, args.margin),
                tolerance,
            )?;
        }
        Method::Rival(kind) => serve_standard_streams(kind.solver(a, b).as_mut(), tolerance)?,
        Method::Peer(kind) => match kind.solver(a, b) {
            Ok(mut solver) => serve_standard_streams(solver.as_mut(), tolerance)?,
            Err(error) => return Ok(Err(format!("{error:#}"))),
        },
        Method::Script(_) => return Ok(Err("the method is run by a script".to_owned())),
    }
    Ok(Ok(()))
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
