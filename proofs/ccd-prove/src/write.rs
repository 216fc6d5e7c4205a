//! Writes a certificate: the statement, and the cover that proves it.

use crate::cover::Cover;
use crate::error::NotProven;
use crate::nearest::MeshPoint;
use crate::placed::{Moving, moving, placed};
use crate::scene::{Scene, Witness};
use crate::screw::exponent_above;
use crate::statement::Statement;
use crate::tolerances::ROUNDING;
use crate::tree::Tree;
use ccd_core::glam::DVec3;
use ccd_core::order::greater;
use std::sync::atomic::AtomicBool;

/// A certificate, and what it took.
#[derive(Clone, Debug)]
pub struct Proof {
    /// The certificate.
    pub bytes: Vec<u8>,
    /// The number of its leaves.
    pub leaves: usize,
    /// The unit of its lengths is 2 to the power of this.
    pub unit: i32,
}

/// The checker has numbers of 8 bits before the point for what a link has moved by.
const MOST_RADIANS: f64 = 256.0;

/// Weights of corners are multiples of 2⁻⁵⁵.
const WEIGHT_UNIT: f64 = (1u64 << 55) as f64;

/// The number of bits of the largest length in the unit of a certificate.
const LENGTH_BITS: i32 = 52;

/// What a rotation is off by in the checker: the share of a turn of about a radian.
const TURNS: f64 = 1.0 / (1u64 << 50) as f64;

/// The checker has 59 bits for the sum of lengths.
const LENGTHS_IN_SUM: f64 = 64.0;

/// What the checker adds to the sum of lengths, in units: it is turned as much as lengths are.
const ADDED_TO_SUM: f64 = (1u64 << 47) as f64;

/// Writes a certificate: each pair of a scene is farther apart than its margin from time 0 to `until`, and the
/// witness, if there is one, comes as near as it says.
///
/// A first contact is proven until its time, with a witness at it. A least clearance is proven for the whole duration, with the
/// clearance as the margin and a witness at some time.
///
/// # Errors
/// [`NotProven`].
pub fn prove(scene: &Scene<'_>, until: f64, witness: Option<Witness>) -> Result<Proof, NotProven> {
    prove_unless_stopped(scene, until, witness, None)
}

/// As [`prove`], but ends soon after another thread sets a flag.
pub(crate) fn prove_unless_stopped(
    scene: &Scene<'_>,
    until: f64,
    witness: Option<Witness>,
    stop: Option<&AtomicBool>,
) -> Result<Proof, NotProven> {
    let time_unit = exponent_above(until);
    let links = moving(&scene.links, time_unit)?;
    let turns_too_far =
        |link: &Moving| !(link.screw.moved(time_unit).iter()).all(|&by| by <= MOST_RADIANS);
    if let Some(link) = links.iter().position(turns_too_far) {
        return Err(NotProven::TurnsTooFar { link });
    }
    let (mut bytes, unit, lost) = state(scene, &links, until, witness)?;
    let mut cover = Cover::new((scene, &links), (until, stop), 2f64.powi(unit));
    for (number, pair) in scene.pairs.iter().enumerate() {
        cover.write(number, 0.5 * pair.margin + lost)?;
    }
    bytes.extend(&cover.steps);
    Ok(Proof {
        bytes,
        leaves: cover.leaves,
        unit,
    })
}

/// Returns a statement as bytes, the unit of its lengths as a power of two, and how much farther than is asked for parts have to be
/// from a plane so that the checker sees it.
///
/// # Errors
/// [`NotProven::NoContact`].
fn state(
    scene: &Scene<'_>,
    links: &[Moving],
    until: f64,
    witness: Option<Witness>,
) -> Result<(Vec<u8>, i32, f64), NotProven> {
    let time_unit = exponent_above(until);
    let size = largest_length(scene, links, time_unit);
    let sum = sum_of_lengths(links, time_unit);
    let unit = exponent_above(greater(size, sum / LENGTHS_IN_SUM)) - LENGTH_BITS;
    let lost = lost(links, time_unit, [2f64.powi(unit), 2.0 * size + sum])
        + ROUNDING * size * (scene.links.len() + 2) as f64;
    let mut bytes = b"CCDPROF1".to_vec();
    bytes.extend(unit.to_le_bytes());
    bytes.extend(time_unit.to_le_bytes());
    for count in [scene.links.len(), scene.bodies.len(), scene.pairs.len()] {
        bytes.extend((count as u32).to_le_bytes());
    }
    for link in &links[1..] {
        bytes.extend((link.parent as u32).to_le_bytes());
        let (before, axes, after) = link.screw.numbers();
        write_numbers(&mut bytes, before);
        bytes.extend(axes.to_le_bytes());
        write_numbers(&mut bytes, after);
    }
    for carried in &scene.bodies {
        bytes.extend(carried.body.digest);
        bytes.extend((carried.link as u32).to_le_bytes());
    }
    for pair in &scene.pairs {
        bytes.extend(pair.bodies.map(|body| (body as u32).to_le_bytes()).concat());
        write_numbers(&mut bytes, [pair.margin]);
    }
    write_numbers(&mut bytes, [until]);
    bytes.extend(u32::from(witness.is_some()).to_le_bytes());
    if let Some(witness) = witness {
        write_witness(&mut bytes, scene, links, (witness, lost))?;
    }
    Ok((bytes, unit, lost))
}

/// Returns what a certificate of a scene states without a witness; `None` if none can state it.
pub(crate) fn statement_of(scene: &Scene<'_>, until: f64) -> Option<Statement> {
    let links = moving(&scene.links, exponent_above(until)).ok()?;
    let (bytes, ..) = state(scene, &links, until, None).ok()?;
    Statement::read(&bytes)
}

/// Returns the sum of the coordinates of all arms and of their changes in the unit of time, of which the checker has 59 bits.
fn sum_of_lengths(links: &[Moving], time_unit: i32) -> f64 {
    let lengths = links.iter().map(|link| {
        let travel = link.travel * 2f64.powi(time_unit);
        (link.arm.abs() + travel.abs()).element_sum()
    });
    lengths.sum()
}

/// Returns 8 L of the checker's README, for lengths in a unit that add up to so much.
fn lost(links: &[Moving], time_unit: i32, [unit, lengths]: [f64; 2]) -> f64 {
    let of_moves = |link: &Moving| 3.0 + link.screw.moved(time_unit).iter().sum::<f64>();
    let off = links.iter().map(of_moves).sum::<f64>() * TURNS;
    8.0 * (13.0 * unit * (links.len() + 1) as f64 + off * (lengths + ADDED_TO_SUM * unit))
}

/// Returns the largest length that the checker computes with.
fn largest_length(scene: &Scene<'_>, links: &[Moving], time_unit: i32) -> f64 {
    let margins = scene.pairs.iter().map(|pair| pair.margin);
    let mut most = margins.fold(0.0, greater);
    let mut reaches: Vec<f64> = Vec::new();
    for link in links {
        let travel = link.travel.length() * 2f64.powi(time_unit);
        // What is read before it is added up is no longer than half of the sum, but for centres.
        let reach = reaches.get(link.parent).unwrap_or(&0.0) + 2.0 * (link.arm.length() + travel);
        reaches.push(reach);
        most = greater(most, reach + link.screw.centre.length());
    }
    for carried in &scene.bodies {
        let tree = &carried.body.tree;
        let reach = tree.reach(Tree::WHOLE, DVec3::ZERO);
        most = greater(most, tree.largest_radius() + reach);
    }
    most
}

fn write_numbers(bytes: &mut Vec<u8>, numbers: impl IntoIterator<Item = f64>) {
    bytes.extend(numbers.into_iter().flat_map(|x| x.to_le_bytes()));
}

/// Writes the triangle of each witness, and the weights of its corners. If only rounding makes the tolerance too small for the
/// checker, it is as large as it has to be.
fn write_witness(
    bytes: &mut Vec<u8>,
    scene: &Scene<'_>,
    links: &[Moving],
    (witness, rounding): (Witness, f64),
) -> Result<(), NotProven> {
    let points = mesh_points(scene, links, witness);
    let [a, b] = &points;
    let distance = a.ball.truncate().distance(b.ball.truncate()) - a.ball.w - b.ball.w;
    let needed = distance + rounding - scene.pairs[witness.pair].margin;
    if !(needed <= witness.tolerance + 2.0 * rounding) {
        return Err(NotProven::NoContact { distance });
    }
    bytes.extend((witness.pair as u32).to_le_bytes());
    write_numbers(bytes, [witness.time, greater(witness.tolerance, needed)]);
    for point in points {
        bytes.extend((point.place as u32).to_le_bytes());
        // Together they are the whole, also if they are rounded up.
        let (whole, weights) = (WEIGHT_UNIT as u64, point.weights);
        let [a, b, _] = weights.map(|weight| (weight * WEIGHT_UNIT) as u64);
        let a = a.min(whole);
        let b = b.min(whole - a);
        for weight in [a, b, whole - a - b] {
            bytes.extend(&weight.to_le_bytes()[..7]);
        }
    }
    Ok(())
}

/// Returns the points of both meshes that are nearest to those of a witness, in the world.
pub(crate) fn mesh_points(scene: &Scene<'_>, links: &[Moving], witness: Witness) -> [MeshPoint; 2] {
    let all = placed(links, witness.time, 0.0);
    [0, 1].map(|k| {
        let carried = &scene.bodies[scene.pairs[witness.pair].bodies[k]];
        let link = &all[carried.link];
        let local = link.rotation.transpose() * (witness.points[k] - link.centre);
        let centre = links[carried.link].screw.centre;
        let nearest = MeshPoint::nearest(&carried.body.tree, local + centre);
        let place = link.centre + link.rotation * (nearest.ball.truncate() - centre);
        MeshPoint {
            ball: place.extend(nearest.ball.w),
            ..nearest
        }
    })
}
