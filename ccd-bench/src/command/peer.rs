//! The command `ccd-bench peer`: runs a peer library on standard input and output, so that it can
//! be stopped from outside.

use crate::method::peer::{PeerKind, wire};
use anyhow::{Context, Result};
use ccd_decomp::TriangleMesh;
use clap::Args;
use rigid_ccd::command::{CannotWrite, Exit};
use std::io;
#[cfg(unix)]
use std::os::unix::process::parent_id;
use std::path::{Path, PathBuf};
#[cfg(unix)]
use std::{thread, time::Duration};

/// Answer queries with a peer library, line by line: motions and durations in, times out
#[derive(Debug, Args)]
pub(super) struct PeerArgs {
    /// The peer library
    #[arg(long, value_enum)]
    kind: PeerKind,
    /// The mesh of body A
    #[arg(long, value_name = "MESH")]
    a: PathBuf,
    /// The mesh of body B
    #[arg(long, value_name = "MESH")]
    b: PathBuf,
    /// The tolerance, for peers that take one, in the scene's unit of length
    #[arg(long, value_name = "LENGTH")]
    tolerance: f64,
}

pub(super) fn run(args: &PeerArgs) -> Result<Exit> {
    end_with_parent();
    let read = |path: &Path| TriangleMesh::read(path).with_context(|| path.display().to_string());
    let (a, b) = (read(&args.a)?, read(&args.b)?);
    let mut solver = args.kind.solver(&a, &b, args.tolerance)?;
    let (input, output) = (io::stdin().lock(), io::stdout().lock());
    match wire::serve(solver.as_mut(), input, output) {
        Ok(()) => Ok(Exit::AllAnswered),
        Err(error) if error.kind() == io::ErrorKind::InvalidData => {
            Err(error).context("standard input: no query")
        }
        Err(source) => Err(CannotWrite {
            place: "the replies".to_owned(),
            source,
        }
        .into()),
    }
}

/// The time that this process may outlive its parent.
#[cfg(unix)]
const WITHOUT_PARENT: Duration = Duration::from_secs(1);

/// Ends this process, in whatever call it is, once its parent has ended.
#[cfg(unix)]
fn end_with_parent() {
    let parent = parent_id();
    thread::spawn(move || {
        while parent_id() == parent {
            thread::sleep(WITHOUT_PARENT);
        }
        std::process::exit(1);
    });
}

#[cfg(not(unix))]
fn end_with_parent() {}
