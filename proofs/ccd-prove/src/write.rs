//! Writes a certificate: its statement, and the steps that prove it.

use crate::error::NotProven;
use crate::interval::link_states;
use crate::link_motion::{LinkMotion, exponent_above, link_motions};
use crate::nearest::MeshPoint;
use crate::scene::{Scene, SceneBody, Witness};
use crate::statement::Statement;
use crate::subdivision::{MAX_CACHED_STATES, Subdivision, SubdivisionLimits};
use crate::tolerances::ROUNDING;
use crate::tree::Tree;
use ccd_core::glam::DVec3;
use ccd_core::order::greater;
use std::sync::atomic::AtomicBool;

/// A certificate, and figures about it.
#[derive(Clone, Debug)]
pub struct Proof {
    /// The certificate.
    pub bytes: Vec<u8>,
    /// The number of leaves.
    pub leaves: usize,
    /// The exponent of the unit of length, which is a power of two.
    pub unit: i32,
}

/// The checker's limit for the parameter of a link's motion. For a revolute joint the parameter is an angle in radians.
const MAX_PARAMETER: f64 = 256.0;

/// The inverse of the unit of barycentric weights, which is 2⁻⁵⁵.
const WEIGHT_SCALE: f64 = (1u64 << 55) as f64;

/// The number of bits of the largest length, in the unit of length.
const LENGTH_BITS: i32 = 52;

/// The checker's error bound of a rotation for each radian of its angle.
const ROTATION_ERROR: f64 = 1.0 / (1u64 << 50) as f64;

/// The checker's limit for the sum of all link offsets, as a multiple of the largest length. The sum is at most 2⁵⁹ units of
/// length, and a length is at most 2⁵³ units.
const MAX_LINK_OFFSET_SUM: f64 = 64.0;

/// A constant that the checker adds to the sum of all link offsets, in units of length.
const ADDED_TO_LINK_OFFSET_SUM: f64 = (1u64 << 47) as f64;

/// Writes a certificate. Its statement is that each pair of a scene stays farther apart than its margin from time 0 to `until`,
/// and that the distance of the witness points is at most the margin plus the tolerance.
///
/// To prove a first contact, set `until` to its time, and give a witness at that time. To prove a least clearance, set `until` to the
/// end of the motion and the margins to the clearance, and give a witness at the time of the closest approach.
///
/// # Errors
/// [`NotProven`].
pub fn prove(scene: &Scene<'_>, until: f64, witness: Option<Witness>) -> Result<Proof, NotProven> {
    prove_unless_stopped(scene, until, witness, None)
}

/// Writes a certificate as [`prove`] does. Returns [`NotProven::Stopped`] soon after another thread sets the flag `stop`.
pub(crate) fn prove_unless_stopped(
    scene: &Scene<'_>,
    until: f64,
    witness: Option<Witness>,
    stop: Option<&AtomicBool>,
) -> Result<Proof, NotProven> {
    let time_unit = exponent_above(until);
    let links = link_motions(&scene.links, time_unit)?;
    let exceeds_max_parameter = |link: &LinkMotion| {
        let magnitudes = link.encoded.parameter_magnitudes(time_unit);
        !magnitudes
            .iter()
            .all(|&magnitude| magnitude <= MAX_PARAMETER)
    };
    if let Some(link) = links.iter().position(exceeds_max_parameter) {
        return Err(NotProven::RotationTooLarge { link });
    }
    let statement = write_statement(scene, &links, until, witness)?;
    let limits = SubdivisionLimits {
        until,
        stop,
        max_cached_states: MAX_CACHED_STATES,
    };
    let subdivision = subdivide_pairs((scene, &links), &statement, limits)?;
    Ok(Proof {
        bytes: [statement.bytes, subdivision.steps].concat(),
        leaves: subdivision.leaf_count,
        unit: statement.length_exponent,
    })
}

/// Writes the steps that prove a statement.
fn subdivide_pairs<'a>(
    (scene, links): (&'a Scene<'a>, &'a [LinkMotion]),
    statement: &WrittenStatement,
    limits: SubdivisionLimits<'a>,
) -> Result<Subdivision<'a>, NotProven> {
    let length_unit = 2f64.powi(statement.length_exponent);
    let mut subdivision = Subdivision::new((scene, links), limits, length_unit);
    for (index, pair) in scene.pairs.iter().enumerate() {
        subdivision.write_pair(index, 0.5 * pair.margin + statement.rounding)?;
    }
    Ok(subdivision)
}

/// The bytes of a statement, and its unit and error bound.
struct WrittenStatement {
    bytes: Vec<u8>,
    /// The exponent of the unit of length.
    length_exponent: i32,
    /// The error bound of the distance of a node from a plane. It covers the rounding of the prover and of the checker.
    rounding: f64,
}

/// Writes a statement.
///
/// # Errors
/// [`NotProven::NoContact`].
fn write_statement(
    scene: &Scene<'_>,
    links: &[LinkMotion],
    until: f64,
    witness: Option<Witness>,
) -> Result<WrittenStatement, NotProven> {
    let time_unit = exponent_above(until);
    let largest = largest_length(scene, links, time_unit);
    let link_offset_sum = sum_of_link_offsets(links, time_unit);
    let length_exponent =
        exponent_above(greater(largest, link_offset_sum / MAX_LINK_OFFSET_SUM)) - LENGTH_BITS;
    let length_unit = 2f64.powi(length_exponent);
    let rounding = checker_error(
        links,
        time_unit,
        length_unit,
        2.0 * largest + link_offset_sum,
    ) + ROUNDING * largest * (scene.links.len() + 2) as f64;
    let mut bytes = b"CCDPROF1".to_vec();
    bytes.extend(length_exponent.to_le_bytes());
    bytes.extend(time_unit.to_le_bytes());
    for count in [scene.links.len(), scene.bodies.len(), scene.pairs.len()] {
        bytes.extend((count as u32).to_le_bytes());
    }
    for link in &links[1..] {
        bytes.extend((link.parent as u32).to_le_bytes());
        let (before, axes, after) = link.encoded.numbers();
        write_numbers(&mut bytes, before);
        bytes.extend(axes.to_le_bytes());
        write_numbers(&mut bytes, after);
    }
    for SceneBody { body, link } in &scene.bodies {
        bytes.extend(body.digest);
        bytes.extend((*link as u32).to_le_bytes());
    }
    for pair in &scene.pairs {
        bytes.extend(pair.bodies.map(|body| (body as u32).to_le_bytes()).concat());
        write_numbers(&mut bytes, [pair.margin]);
    }
    write_numbers(&mut bytes, [until]);
    bytes.extend(u32::from(witness.is_some()).to_le_bytes());
    if let Some(witness) = witness {
        write_witness(&mut bytes, scene, links, (witness, rounding))?;
    }
    Ok(WrittenStatement {
        bytes,
        length_exponent,
        rounding,
    })
}

/// Returns the statement about a scene, without a witness. Returns `None` if a number is too small for a certificate.
pub(crate) fn statement_of(scene: &Scene<'_>, until: f64) -> Option<Statement> {
    let links = link_motions(&scene.links, exponent_above(until)).ok()?;
    let written = write_statement(scene, &links, until, None).ok()?;
    Statement::read(&written.bytes)
}

/// Returns the sum of the absolute coordinates of all link offsets and of their changes in the unit of time.
fn sum_of_link_offsets(links: &[LinkMotion], time_unit: i32) -> f64 {
    let lengths = links.iter().map(|link| {
        let link_offset_change = link.velocity * 2f64.powi(time_unit);
        (link.link_offset.abs() + link_offset_change.abs()).element_sum()
    });
    lengths.sum()
}

/// Returns 8 L(r) of the checker's README. It bounds the checker's error of a signed distance. `lengths` is r plus the sum of the
/// link offsets.
fn checker_error(links: &[LinkMotion], time_unit: i32, length_unit: f64, lengths: f64) -> f64 {
    let parameter_sum = |link: &LinkMotion| {
        3.0 + link
            .encoded
            .parameter_magnitudes(time_unit)
            .iter()
            .sum::<f64>()
    };
    let rotation_error = links.iter().map(parameter_sum).sum::<f64>() * ROTATION_ERROR;
    8.0 * (13.0 * length_unit * (links.len() + 1) as f64
        + rotation_error * (lengths + ADDED_TO_LINK_OFFSET_SUM * length_unit))
}

/// Returns an upper bound of all lengths in the checker's computations.
fn largest_length(scene: &Scene<'_>, links: &[LinkMotion], time_unit: i32) -> f64 {
    let margins = scene.pairs.iter().map(|pair| pair.margin);
    let mut largest = margins.fold(0.0, greater);
    // The largest distance of each link's center from the origin.
    let mut distances: Vec<f64> = Vec::new();
    for link in links {
        let link_offset_change = link.velocity.length() * 2f64.powi(time_unit);
        // Twice the lengths also bound the vectors that the checker adds up to a link offset, except the centers.
        let distance = distances.get(link.parent).unwrap_or(&0.0)
            + 2.0 * (link.link_offset.length() + link_offset_change);
        distances.push(distance);
        largest = greater(largest, distance + link.encoded.center.length());
    }
    for SceneBody { body, .. } in &scene.bodies {
        let tree = &body.tree;
        let distance = tree.max_distance(Tree::ROOT, DVec3::ZERO);
        largest = greater(largest, tree.largest_radius() + distance);
    }
    largest
}

fn write_numbers(bytes: &mut Vec<u8>, numbers: impl IntoIterator<Item = f64>) {
    bytes.extend(numbers.into_iter().flat_map(|x| x.to_le_bytes()));
}

/// Writes a witness: for each point the triangle and its barycentric weights. If the tolerance is too small, but only because of
/// rounding, writes the smallest tolerance that the checker accepts.
fn write_witness(
    bytes: &mut Vec<u8>,
    scene: &Scene<'_>,
    links: &[LinkMotion],
    (witness, rounding): (Witness, f64),
) -> Result<(), NotProven> {
    let points = nearest_mesh_points(scene, links, witness);
    let [a, b] = &points;
    let distance = a.ball.truncate().distance(b.ball.truncate()) - a.ball.w - b.ball.w;
    let min_tolerance = distance + rounding - scene.pairs[witness.pair].margin;
    if !(min_tolerance <= witness.tolerance + 2.0 * rounding) {
        return Err(NotProven::NoContact { distance });
    }
    bytes.extend((witness.pair as u32).to_le_bytes());
    write_numbers(
        bytes,
        [witness.time, greater(witness.tolerance, min_tolerance)],
    );
    for point in points {
        bytes.extend((point.triangle as u32).to_le_bytes());
        // The third weight is the difference to 1. The limits of the others keep it non-negative after rounding.
        let (one, weights) = (WEIGHT_SCALE as u64, point.weights);
        let [a, b, _] = weights.map(|weight| (weight * WEIGHT_SCALE) as u64);
        let a = a.min(one);
        let b = b.min(one - a);
        for weight in [a, b, one - a - b] {
            bytes.extend(&weight.to_le_bytes()[..7]);
        }
    }
    Ok(())
}

/// Returns, for each point of a witness, the nearest point of its body's mesh, in the world.
pub(crate) fn nearest_mesh_points(
    scene: &Scene<'_>,
    links: &[LinkMotion],
    witness: Witness,
) -> [MeshPoint; 2] {
    let states = link_states(links, witness.time, 0.0);
    [0, 1].map(|k| {
        let SceneBody { body, link } = scene.bodies[scene.pairs[witness.pair].bodies[k]];
        let (state, center) = (&states[link], links[link].encoded.center);
        let from_link_center = state.rotation.transpose() * (witness.points[k] - state.center);
        let nearest = MeshPoint::nearest(&body.tree, from_link_center + center);
        let in_world = state.center + state.rotation * (nearest.ball.truncate() - center);
        MeshPoint {
            ball: in_world.extend(nearest.ball.w),
            ..nearest
        }
    })
}

#[cfg(test)]
mod tests;
