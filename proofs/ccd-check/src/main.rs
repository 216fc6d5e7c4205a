//! The command `ccd-check`: reads meshes and certificates, and prints a verdict on each proof.

#![allow(clippy::print_stdout, clippy::print_stderr, reason = "the command prints verdicts")]

use ccd_check::{Body, check};
use std::fs;
use std::process::ExitCode;

const HELP: &str = "\
Checks machine-checkable proofs that moving triangle meshes stay apart

Usage: ccd-check [--mesh MESH BODY]... PROOF...

  --mesh MESH BODY   a mesh, and the certificate of its tree
  PROOF              a certificate of a query; it identifies its meshes by their SHA-256 digests

Prints a verdict on each proof: `holds`, `broken` with the reason and the position in the file, or `unverifiable` with the reason.
Exit code: 0 if all proofs hold, 1 if one does not hold, 2 if a file cannot be read.

Example:
  ccd-check --mesh a.mesh a.body --mesh b.mesh b.body 0.proof
";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match run(&arguments) {
        Ok(all_hold) => ExitCode::from(u8::from(!all_hold)),
        Err(error) => {
            eprintln!("ccd-check: {error}");
            ExitCode::from(2)
        }
    }
}

fn run(mut arguments: &[String]) -> Result<bool, String> {
    let read = |name: &String| fs::read(name).map_err(|error| format!("{name}: {error}"));
    let mut meshes = Vec::new();
    if arguments.first().is_some_and(|option| option == "--help" || option == "-h") {
        print!("{HELP}");
        return Ok(true);
    }
    while let [option, mesh, body, rest @ ..] = arguments
        && option == "--mesh"
    {
        meshes.push((read(mesh)?, read(body)?, body));
        arguments = rest;
    }
    if arguments.first().is_none_or(|argument| argument.starts_with("--")) {
        return Err("expected any number of --mesh MESH BODY, then at least one PROOF; see --help".into());
    }
    let mut all_hold = true;
    for name in arguments {
        let proof = read(name)?;
        // A proof may use only some of the meshes. Other meshes may have numbers that are out of range in its unit of length.
        let (mut bodies, mut skipped) = (Vec::new(), None);
        for (mesh, body, name) in &meshes {
            match Body::new(mesh, body, &proof) {
                Ok(body) => bodies.push(body),
                Err(stop) => skipped = Some(format!("; {name}: {stop}")),
            }
        }
        let verdict = check(&bodies, &proof).map_err(|stop| format!("{stop}{}", skipped.unwrap_or_default()));
        all_hold &= verdict.is_ok();
        println!("{name}: {}", verdict.map_or_else(|why| why, |()| "holds".into()));
    }
    Ok(all_hold)
}
