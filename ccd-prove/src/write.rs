//! Writes a certificate: the statement, and the cover that proves it.

use crate::body::Body;
use crate::cover::Cover;
use crate::error::NotProven;
use crate::stretch::Moving;
use ccd_core::Motion;
use ccd_core::glam::DVec3;
use ccd_core::order::greater;

/// What a certificate claims.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Claim {
    /// The bodies stay farther apart than the margin over the whole duration.
    Free,
    /// They do until a time, at which points of both are within margin + tolerance.
    Contact {
        /// The time.
        time: f64,
        /// What the points may be farther apart than the margin.
        tolerance: f64,
        /// A point of each body, in the world.
        witnesses: [DVec3; 2],
    },
}

/// A certificate, and what it took.
#[derive(Clone, Debug)]
pub struct Proof {
    /// The certificate.
    pub bytes: Vec<u8>,
    /// The number of leaves.
    pub leaves: usize,
    /// The unit of its lengths is 2 to the power of this.
    pub unit: i32,
}

/// The share of the largest coordinate that is allowed for rounding.
const ROUNDING: f64 = 1e-13;

/// The number of bits of the largest coordinate in the unit of a certificate.
const LENGTH_BITS: i32 = 49;

/// Writes a certificate of a claim about two moving bodies.
///
/// # Errors
/// [`NotProven`].
pub fn prove(
    a: (&Body, Motion),
    b: (&Body, Motion),
    (duration, margin): (f64, f64),
    claim: Claim,
) -> Result<Proof, NotProven> {
    let bodies = [a, b].map(|(body, motion)| Moving { body, motion });
    let time_unit = exponent_above(duration);
    let size = bodies
        .iter()
        .map(|moving| largest_length(moving, duration))
        .fold(margin, greater);
    let unit = exponent_above(size) - LENGTH_BITS;
    let mut bytes = b"CCDPROOF".to_vec();
    bytes.extend(unit.to_le_bytes());
    bytes.extend(time_unit.to_le_bytes());
    for moving in &bodies {
        bytes.extend(moving.body.digest);
    }
    for moving in &bodies {
        let (start, motion) = (moving.motion.start(), moving.motion);
        let numbers = start.translation().to_array().into_iter();
        let numbers = numbers.chain(start.rotation().to_array());
        let rest = [motion.velocity(), motion.spin(), motion.centre()];
        write_numbers(
            &mut bytes,
            numbers.chain(rest.into_iter().flat_map(|v| v.to_array())),
        );
    }
    let until = match claim {
        Claim::Free => duration,
        Claim::Contact { time, .. } => time,
    };
    write_numbers(&mut bytes, [until, margin]);
    if let Claim::Contact {
        time,
        tolerance,
        witnesses,
    } = claim
    {
        bytes.push(1);
        write_numbers(&mut bytes, [tolerance]);
        write_witnesses(&mut bytes, &bodies, time, witnesses);
    } else {
        bytes.push(0);
    }
    let mut cover = Cover::new(&bodies, margin + ROUNDING * size, until);
    cover.write()?;
    bytes.extend(&cover.steps);
    Ok(Proof {
        bytes,
        leaves: cover.leaves,
        unit,
    })
}

/// Returns the least exponent of a power of two above a number.
fn exponent_above(number: f64) -> i32 {
    if number == 0.0 {
        0
    } else {
        number.log2().floor() as i32 + 1
    }
}

/// Returns the largest length that the checker computes with.
fn largest_length(moving: &Moving<'_>, duration: f64) -> f64 {
    let (motion, root) = (&moving.motion, &moving.body.nodes[0]);
    let lengths = [
        motion.start().translation(),
        motion.velocity() * duration * 2.0,
        motion.centre(),
    ];
    let reach = root.centre.abs().max_element() + root.radius;
    lengths
        .iter()
        .fold(reach, |most, v| greater(most, v.abs().max_element()))
}

fn write_numbers(bytes: &mut Vec<u8>, numbers: impl IntoIterator<Item = f64>) {
    bytes.extend(numbers.into_iter().flat_map(|x| x.to_le_bytes()));
}

/// Writes the triangle of each witness, and the weights of its corners.
fn write_witnesses(
    bytes: &mut Vec<u8>,
    bodies: &[Moving<'_>; 2],
    time: f64,
    witnesses: [DVec3; 2],
) {
    for (moving, witness) in bodies.iter().zip(witnesses) {
        let pose = moving.motion.pose(time);
        let local = pose.rotation().conjugate() * (witness - pose.translation());
        let nearest = moving
            .body
            .triangles
            .iter()
            .enumerate()
            .map(|(place, triangle)| {
                let weights = nearest_weights(*triangle, local);
                let point = (0..3).map(|k| triangle[k] * weights[k]).sum::<DVec3>();
                (point.distance_squared(local), place, weights)
            });
        let nearest = nearest.min_by(|a, b| a.0.total_cmp(&b.0));
        let (_, place, own) = nearest.unwrap_or((0.0, 0, [1.0, 0.0, 0.0]));
        bytes.extend((place as u32).to_le_bytes());
        // Rounded down, the first two leave no less than 0 for the third one.
        let [a, b, _] = own.map(|weight| (weight * 2_147_483_648.0) as u32);
        bytes.extend([a, b].map(u32::to_le_bytes).concat());
    }
}

/// Returns the weights of the corners of the point of a triangle that is nearest to a point `[ERICSON05 §5.1.5]`.
fn nearest_weights([a, b, c]: [DVec3; 3], p: DVec3) -> [f64; 3] {
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let (d1, d2) = (ab.dot(ap), ac.dot(ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return [1.0, 0.0, 0.0];
    }
    let bp = p - b;
    let (d3, d4) = (ab.dot(bp), ac.dot(bp));
    if d3 >= 0.0 && d4 <= d3 {
        return [0.0, 1.0, 0.0];
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        let v = d1 / (d1 - d3);
        return [1.0 - v, v, 0.0];
    }
    let cp = p - c;
    let (d5, d6) = (ab.dot(cp), ac.dot(cp));
    if d6 >= 0.0 && d5 <= d6 {
        return [0.0, 0.0, 1.0];
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        let w = d2 / (d2 - d6);
        return [1.0 - w, 0.0, w];
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        let w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return [0.0, 1.0 - w, w];
    }
    let total = va + vb + vc;
    let (v, w) = (vb / total, vc / total);
    [1.0 - v - w, v, w]
}
