//! Finds when and where a box that rotates at 20 radians per unit of time hits a ball.

use rigid_ccd::{Body, Motion, Pose, first_contact};
use std::error::Error;

#[allow(clippy::print_stdout, reason = "an example shows what comes out")]
fn main() -> Result<(), Box<dyn Error>> {
    // Half extents.
    let body = Body::cuboid([0.5, 0.5, 0.5])?;
    let ball = Body::sphere(0.3)?;

    let start = Pose::at([-3.0, 0.0, 0.0])?;
    let fast = Motion::new(start, [4.0, 0.0, 0.0], [0.0, 0.0, 20.0])?;
    let slow = Motion::new(start, [1.0, 0.0, 0.0], [0.0, 0.0, 20.0])?;

    for (name, flies) in [("fast", fast), ("slow", slow)] {
        match first_contact((&body, flies), (&ball, Motion::STILL), 1.0)?.hit()? {
            Some(hit) => {
                let (time, place) = (hit.time, hit.witness_a());
                println!("{name}: contact at {time:.4} in {place:.4}");
            }
            None => println!("{name}: no contact"),
        }
    }
    Ok(())
}
