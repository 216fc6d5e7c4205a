//! A distance backend of one's own: the nearest points of balls and capsules, GJK for all else.
//!
//! The engine checks whatever a backend says. A wrong one makes it slow, or answer that it does not
//! know; it is never late.

use rigid_ccd::{Body, Motion, Pose, Solver};
use rigid_ccd::{Claim, Combination, DistanceOracle, GiveUp, Gjk, PiecePair};
use std::error::Error;

/// For pieces of one or two points.
struct Segments;

impl DistanceOracle for Segments {
    /// Nothing is kept from one call on a pair to the next.
    type Cache = ();

    fn separation(&mut self, pair: &PiecePair<'_>, _: &mut ()) -> Result<Claim, GiveUp> {
        let (([p], [q, ..]) | ([p, _], [q, ..])) = (pair.a.points, pair.b.points) else {
            return Err(GiveUp::TooManyPoints);
        };
        let (p, q) = (*p, pair.b_to_a.point(*q));
        let ends = [pair.a.points.len() - 1, pair.b.points.len() - 1];
        if ends[1] > 1 {
            return Err(GiveUp::TooManyPoints);
        }
        let u = pair.a.points[ends[0]] - p;
        let v = pair.b_to_a.point(pair.b.points[ends[1]]) - q;
        // The nearest point of one segment to a point of the other, in turn.
        let (mut s, mut t) = (0.5, 0.5);
        for _ in 0..100 {
            s = clamped((q + t * v - p).dot(u) / u.length_squared());
            t = clamped((p + s * u - q).dot(v) / v.length_squared());
        }
        Ok(Claim {
            axis: (q + t * v) - (p + s * u),
            a: Combination::segment([0, ends[0] as u32], s),
            b: Combination::segment([0, ends[1] as u32], t),
        })
    }
}

/// From 0 to 1; 0 for what is no number, as of a segment without length.
fn clamped(share: f64) -> f64 {
    if share > 0.0 { share.min(1.0) } else { 0.0 }
}

#[allow(clippy::print_stdout, reason = "an example shows what comes out")]
fn main() -> Result<(), Box<dyn Error>> {
    let capsule = Body::capsule(0.2, 0.5)?;
    let flies = Motion::new(
        Pose::at([-3.0, 0.0, 0.1])?,
        [4.0, 0.0, 0.0],
        [1.0, 2.0, 3.0],
    )?;
    for (name, other) in [("ball", Body::ball(0.5)?), ("box", Body::cuboid([0.5; 3])?)] {
        let (a, b) = ((&capsule, flies), (&other, Motion::STILL));
        let theirs = Solver::new().first_contact(a, b, 1.0)?.map(|hit| hit.time);
        let mut solver = Solver::with_oracle(Segments.or_else(Gjk));
        let own = solver.first_contact(a, b, 1.0)?.map(|hit| hit.time);
        println!("{name}: {own:.4?}, by the default {theirs:.4?}");
    }
    Ok(())
}
