//! Answers a thousand queries on all cores; the answers come in the order of the queries.

use rigid_ccd::{Body, Error, Motion, Pose, first_contacts};

/// Returns the motion of a capsule towards a box, which it hits or misses, from a direction that depends on `k`.
fn motion(k: u32) -> Result<Motion, Error> {
    let angle = f64::from(k) * 0.01;
    let from = Pose::at([4.0 * angle.cos(), 4.0 * angle.sin(), 0.3])?;
    let velocity = [-5.0 * (angle + 0.2).cos(), -5.0 * (angle + 0.2).sin(), 0.0];
    Ok(Motion::new(from, velocity, [angle, 1.0, 0.0])?)
}

#[allow(clippy::print_stdout, reason = "an example shows what comes out")]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let capsule = Body::capsule(0.1, 0.6)?;
    let wall = Body::cuboid([0.5, 1.0, 0.5])?;

    let mut queries = Vec::new();
    for k in 0..1000 {
        queries.push(((&capsule, motion(k)?), (&wall, Motion::STILL), 1.0));
    }
    let mut times = Vec::new();
    for answer in first_contacts(&queries) {
        // The error of a query has its index.
        times.extend(answer?.hit()?.map(|hit| hit.time));
    }
    let mean = times.iter().sum::<f64>() / times.len() as f64;
    println!(
        "{} of {} touch, at {mean:.4} on average",
        times.len(),
        queries.len()
    );
    Ok(())
}
