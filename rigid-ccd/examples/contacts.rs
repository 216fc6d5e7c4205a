//! Lists all features in contact when a cube falls flat onto a slab.

use rigid_ccd::{Body, Motion, Pose, Query, Settings, first_contact};
use std::error::Error;

#[allow(clippy::print_stdout, reason = "an example shows what comes out")]
fn main() -> Result<(), Box<dyn Error>> {
    let cube = Body::cuboid([0.5, 0.5, 0.5])?;
    let slab = Body::cuboid([2.0, 2.0, 0.1])?;
    let falls = Motion::new(Pose::at([0.3, 0.2, 2.0])?, [0.0, 0.0, -3.0], [0.0; 3])?;

    let (a, b) = ((&cube, falls), (&slab, Motion::STILL));
    let hit = first_contact(a, b, 1.0)?.hit()?.ok_or("no contact")?;
    println!("lands at {:.4}", hit.time);

    let query = Query::new(a, b, 1.0, &Settings::DEFAULT)?;
    for pair in query.contacts_at(hit.time)? {
        let (a, b) = (pair.feature_a, pair.feature_b);
        println!(
            "{a} of the cube, {b} of the slab, in {:.3}",
            pair.separation.witness_b
        );
    }
    Ok(())
}
