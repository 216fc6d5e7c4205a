//! The bodies of a query.

use super::args::QueryArgs;
use crate::batch::Bodies;
use crate::command::files::same_file;
use crate::command::progress::Progress;
use crate::command::size::Size;
use anyhow::{Context, Result};
use ccd_core::Body;
use ccd_decomp::{BodySource, Prepared, build_hull_tree};
use std::fs::File;
use std::io::{self, Write};
use std::path::Path;

/// Both bodies; `b` is none when both come from the same file or primitive.
pub(super) struct Pair {
    a: Body,
    b: Option<Body>,
    /// Checksums of their files, by option.
    pub(super) checksums: [(&'static str, String); 2],
}

impl Pair {
    pub(super) fn load(args: &QueryArgs) -> Result<Self> {
        let source = |text: &str| text.parse::<BodySource>();
        let source_a = source(&args.a).context("--a")?;
        let source_b = source(&args.b).context("--b")?;
        let a = load(args, ("--a", &args.a), &source_a)?;
        let b = match same(&source_a, &source_b) {
            true => None,
            false => Some(load(args, ("--b", &args.b), &source_b)?),
        };
        if let (Some(b), false) = (&b, args.quiet) {
            Size::compare(Size::of(&a), Size::of(b));
        }
        let checksums = [("--a", &source_a), ("--b", &source_b)]
            .map(|(option, source)| (option, format!("{:08x}", checksum(source))));
        Ok(Pair { a, b, checksums })
    }

    pub(super) fn bodies(&self) -> Bodies<'_> {
        Bodies {
            a: &self.a,
            b: self.b.as_ref().unwrap_or(&self.a),
        }
    }
}

fn load(args: &QueryArgs, (option, text): (&str, &str), source: &BodySource) -> Result<Body> {
    let detail = args.pieces.detail()?;
    let progress = match args.quiet {
        true => Progress::hidden(),
        false => Progress::of(&format!("preparing {text}")),
    };
    let Prepared { mut body, report } = source.load(detail).with_context(|| option.to_owned())?;
    if args.schedule.uses_hull_trees() && body.hull_tree().is_none() {
        body = with_hull_tree(body).with_context(|| format!("{option} {text}"))?;
    }
    super::method(args).prepare(&body);
    drop(progress);
    if !args.quiet {
        let size = Size::of(&body);
        let _ = writeln!(io::stderr(), "{option} {text}: {report}, size {size}");
    }
    Ok(body)
}

fn with_hull_tree(body: Body) -> Result<Body> {
    let tree = build_hull_tree(body.pieces())?;
    Ok(body.with_hull_tree(tree)?)
}

fn same(a: &BodySource, b: &BodySource) -> bool {
    match (file(a), file(b)) {
        (Some(a), Some(b)) => same_file(a, b),
        _ => a == b,
    }
}

/// Returns the file that a body comes from; none for a primitive.
pub(super) fn file(source: &BodySource) -> Option<&Path> {
    match source {
        BodySource::Mesh(path) | BodySource::Stored(path) => Some(path),
        BodySource::Box { .. } | BodySource::Sphere { .. } | BodySource::Capsule { .. } => None,
    }
}

/// Returns the checksum of the file of a body; 0 for a primitive or a file that cannot be read.
fn checksum(source: &BodySource) -> u32 {
    let mut sum = Crc(crc32fast::Hasher::new());
    let file = file(source).and_then(|path| File::open(path).ok());
    match file.map(|mut file| io::copy(&mut file, &mut sum)) {
        Some(Ok(_)) => sum.0.finalize(),
        _ => 0,
    }
}

struct Crc(crc32fast::Hasher);

impl Write for Crc {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.update(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
