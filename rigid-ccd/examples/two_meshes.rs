//! Finds the first contact of a wedge that drops onto a bracket and rotates as it falls. Give two mesh files to use
//! them instead.
//!
//! `cargo run -p rigid-ccd --example two_meshes -- part.stl other.obj`

use rigid_ccd::{Motion, Pose, Settings, Solver, load};
use std::error::Error;

const BRACKET_PATH: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/bracket.obj");
const WEDGE_PATH: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/wedge.obj");

#[allow(clippy::print_stdout, reason = "an example shows what comes out")]
fn main() -> Result<(), Box<dyn Error>> {
    let mut files = std::env::args().skip(1);
    let moving = load(files.next().unwrap_or(WEDGE_PATH.into()))?;
    let standing = load(files.next().unwrap_or(BRACKET_PATH.into()))?;

    let start = Pose::at([0.7, 0.2, 2.0])?;
    let drops = Motion::new(start, [0.0, 0.0, -2.0], [0.0, 1.5, 0.0])?;

    // A contact is a distance of at most a millionth.
    let mut solver = Solver::new().with_settings(Settings {
        tolerance: 1e-6,
        ..Settings::DEFAULT
    });
    let answer = solver.first_contact((&moving, drops), (&standing, Motion::STILL), 1.0)?;
    match answer.hit()? {
        Some(hit) => {
            println!("contact at {:.6} in {:.6}", hit.time, hit.witness_b());
            if let Some(contact) = hit.contact() {
                let (a, b) = (contact.feature_a, contact.feature_b);
                println!("{a} of the moving body with {b} of the standing one");
                println!("normal {:.6}", contact.separation.normal);
            }
        }
        None => println!("no contact"),
    }
    Ok(())
}
