//! Shows a custom distance backend: nearest points of balls and capsules, with GJK for other pieces.
//!
//! The engine checks each result: with a wrong backend, a query is slow or unresolved, never late.

use rigid_ccd::body::ConvexCombination;
use rigid_ccd::oracle::{Claim, DistanceOracle, GiveUpReason, Gjk, PiecePair};
use rigid_ccd::{Body, Motion, Pose, Solver};
use std::error::Error;

/// A distance backend for pieces of one or two points.
struct SegmentOracle;

impl DistanceOracle for SegmentOracle {
    type Cache = ();

    fn separation(&mut self, pair: &PiecePair<'_>, _: &mut ()) -> Result<Claim, GiveUpReason> {
        let (a, b) = (pair.a.points, pair.b.points);
        if a.len() > 2 || b.len() > 2 {
            return Err(GiveUpReason::TooManyPoints);
        }
        let last = [a.len() - 1, b.len() - 1];
        let (p, q) = (a[0], pair.b_to_a.transform_point(b[0]));
        let (u, v) = (a[last[0]] - p, pair.b_to_a.transform_point(b[last[1]]) - q);
        // Alternating projection: the nearest point of one segment to a point of the other.
        let (mut s, mut t) = (0.5, 0.5);
        for _ in 0..100 {
            s = clamp_to_unit((q + t * v - p).dot(u) / u.length_squared());
            t = clamp_to_unit((p + s * u - q).dot(v) / v.length_squared());
        }
        Ok(Claim {
            axis: (q + t * v) - (p + s * u),
            a: ConvexCombination::of_two_points([0, last[0] as u32], s),
            b: ConvexCombination::of_two_points([0, last[1] as u32], t),
        })
    }
}

/// Clamps a number to the range from 0 to 1. NaN becomes 0: the segment of a ball has length 0.
fn clamp_to_unit(share: f64) -> f64 {
    if share.is_nan() {
        return 0.0;
    }
    share.clamp(0.0, 1.0)
}

#[allow(clippy::print_stdout, reason = "an example shows what comes out")]
fn main() -> Result<(), Box<dyn Error>> {
    let capsule = Body::capsule(0.2, 0.5)?;
    let start = Pose::at([-3.0, 0.0, 0.1])?;
    let flies = Motion::new(start, [4.0, 0.0, 0.0], [1.0, 2.0, 3.0])?;
    for (name, other) in [
        ("ball", Body::sphere(0.5)?),
        ("box", Body::cuboid([0.5; 3])?),
    ] {
        let (a, b) = ((&capsule, flies), (&other, Motion::STILL));
        let by_default = Solver::new()
            .first_contact(a, b, 1.0)?
            .hit()?
            .map(|hit| hit.time);
        let mut solver = Solver::with_oracle(SegmentOracle.or_else(Gjk));
        let own = solver.first_contact(a, b, 1.0)?.hit()?.map(|hit| hit.time);
        println!("{name}: {own:.4?}, by the default {by_default:.4?}");
    }
    Ok(())
}
