//! The checker as a command: reads meshes, certificates of bodies, and certificates of queries, and prints a verdict on each.

#![allow(clippy::print_stdout, clippy::print_stderr, reason = "verdicts are its output")]

use ccd_check::{Body, check};
use std::fs;
use std::process::ExitCode;

const HELP: &str = "\
Checks machine-checkable proofs that moving triangle meshes stay apart

Usage: ccd-check [--mesh MESH BODY]... PROOF...

  --mesh MESH BODY   a mesh, and the certificate of its tree
  PROOF              a certificate of a query; it names its meshes by their digests

Prints `holds`, `broken` and where, or `unverifiable` for each. Exit code: 0 if all hold, 1 if one does not, 2 if a file cannot
be read.

Example:
  ccd-check --mesh a.mesh a.body --mesh b.mesh b.body 0.proof
";

fn main() -> ExitCode {
    match run(std::env::args().skip(1)) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("ccd-check: {error}");
            ExitCode::from(2)
        }
    }
}

fn run(mut arguments: impl Iterator<Item = String>) -> Result<bool, String> {
    let read = |name: &str| fs::read(name).map_err(|error| format!("{name}: {error}"));
    let (mut meshes, mut proofs) = (Vec::new(), Vec::new());
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--help" | "-h" => {
                print!("{HELP}");
                return Ok(true);
            }
            "--mesh" => {
                let files = arguments.next().zip(arguments.next());
                let (mesh, body) = files.ok_or("--mesh needs two files; see --help")?;
                meshes.push((read(&mesh)?, read(&body)?, body));
            }
            _ => proofs.push(argument),
        }
    }
    if proofs.is_empty() {
        return Err("no proof is given; see --help".into());
    }
    let mut all_hold = true;
    for name in proofs {
        let verdict = verdict(&read(&name)?, &meshes).map_or_else(|stop| stop, |()| "holds".into());
        all_hold &= verdict == "holds";
        println!("{name}: {verdict}");
    }
    Ok(all_hold)
}

/// Checks a proof. Its unit of length is in its header, and the meshes are read in it.
fn verdict(proof: &[u8], meshes: &[(Vec<u8>, Vec<u8>, String)]) -> Result<(), String> {
    let unit = proof.get(8..12).and_then(|bytes| bytes.try_into().ok());
    let unit = i32::from_le_bytes(unit.unwrap_or_default());
    let read =
        |(mesh, body, name): &(Vec<u8>, Vec<u8>, String)| Body::new(mesh, body, unit).map_err(|stop| format!("{name}: {stop}"));
    let bodies: Vec<Body> = meshes.iter().map(read).collect::<Result<_, _>>()?;
    check(&bodies, proof).map_err(|stop| stop.to_string())
}
