//! `ccd peer`: a peer library behind standard input and output, to be stopped from outside.

use super::{CannotWrite, Verdict};
use crate::peer::{PeerKind, wire};
use anyhow::{Context, Result};
use ccd_decomp::TriangleMesh;
use clap::Args;
use std::io;
use std::path::{Path, PathBuf};

/// Answer queries with a peer library, line by line: motions and durations in, times out
#[derive(Debug, Args)]
pub(super) struct PeerArgs {
    /// Which one
    #[arg(long, value_enum)]
    kind: PeerKind,
    /// The mesh of body A
    #[arg(long, value_name = "MESH")]
    a: PathBuf,
    /// The mesh of body B
    #[arg(long, value_name = "MESH")]
    b: PathBuf,
    /// Where the peer takes one, in the scene's unit of length
    #[arg(long, value_name = "LENGTH")]
    tolerance: f64,
}

pub(super) fn run(args: &PeerArgs) -> Result<Verdict> {
    let read = |path: &Path| TriangleMesh::read(path).with_context(|| path.display().to_string());
    let (a, b) = (read(&args.a)?, read(&args.b)?);
    let mut contender = args.kind.contender(&a, &b, args.tolerance)?;
    let (input, output) = (io::stdin().lock(), io::stdout().lock());
    match wire::serve(contender.as_mut(), input, output) {
        Ok(()) => Ok(Verdict::AllAnswered),
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
