//! Makes motions of bodies that fly at resting bodies.

use ccd_core::glam::{DQuat, DVec3};
use ccd_core::{InputError, Motion, Pose};
use ccd_tables::motions::Motions;
use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::ops::Range;

/// Random straight flights from one side of a resting body to the other.
#[derive(Clone, Debug)]
pub(crate) struct ShotGenerator {
    /// The number of flights to make.
    pub(crate) count: usize,
    /// The number of flights without rotation, which come first.
    pub(crate) translation_count: usize,
    /// The range of distances from the resting body's origin at which flights start.
    pub(crate) start_distances: Range<f64>,
    /// The largest distance of a flight's path from the resting body's origin.
    pub(crate) max_offset: f64,
    /// The seed of the random numbers.
    pub(crate) seed: u64,
}

impl ShotGenerator {
    /// Returns one query of duration 1 for each flight; B rests at the origin.
    ///
    /// # Errors
    /// If a distance is not finite.
    pub(crate) fn queries(&self) -> Result<Vec<Motions>, InputError> {
        let mut rng = Pcg64::seed_from_u64(self.seed);
        (0..self.count)
            .map(|row| {
                let from =
                    rng.random_range(self.start_distances.clone()) * random_unit_vector(&mut rng);
                let target = self.max_offset * random_unit_ball_point(&mut rng);
                let start = Pose::new(from, random_orientation(&mut rng))?;
                let velocity = 2.0 * (target - from);
                let spin = if row < self.translation_count {
                    DVec3::ZERO
                } else {
                    rng.random_range(0.0..FRAC_PI_2) * random_unit_vector(&mut rng)
                };
                query_against_resting_body(row, Motion::new(start, velocity, spin)?, DVec3::ZERO)
            })
            .collect()
    }
}

/// Returns queries in which a body of radius 1 falls from height 5 to −5, with 3/8 of a turn, past a resting board. A
/// board that reaches 1.5 to either side lies across its way, each time a little lower, or in one of four drops so far
/// aside that the body hardly passes it.
///
/// # Errors
/// None: all motions are finite.
pub(crate) fn drops_onto_or_past_board(
    count: usize,
    seed: u64,
) -> Result<Vec<Motions>, InputError> {
    let mut rng = Pcg64::seed_from_u64(seed);
    (0..count)
        .map(|row| {
            let start = Pose::new(5.0 * DVec3::Z, random_orientation(&mut rng))?;
            let spin = 0.75 * PI * random_unit_vector(&mut rng);
            let motion = Motion::new(start, -10.0 * DVec3::Z, spin)?;
            let height = 3.5 - 7.0 * row as f64 / count as f64;
            let aside = match row % 4 {
                0 => rng.random_range(2.45..2.6),
                _ => 0.0,
            };
            let board = DVec3::new(aside, 0.0, height);
            query_against_resting_body(row, motion, board)
        })
        .collect()
}

fn query_against_resting_body(row: usize, a: Motion, b: DVec3) -> Result<Motions, InputError> {
    Ok(Motions {
        id: row.to_string(),
        a,
        b: Motion::still(Pose::at(b)?),
        duration: 1.0,
    })
}

/// Returns a uniformly distributed unit vector.
fn random_unit_vector(rng: &mut impl Rng) -> DVec3 {
    let z: f64 = rng.random_range(-1.0..1.0);
    let (sin, cos) = rng.random_range(0.0..TAU).sin_cos();
    let radius = (1.0 - z * z).sqrt();
    DVec3::new(radius * cos, radius * sin, z)
}

/// Returns a uniformly distributed point of the unit ball.
fn random_unit_ball_point(rng: &mut impl Rng) -> DVec3 {
    let radius = rng.random_range(0.0f64..1.0).cbrt();
    radius * random_unit_vector(rng)
}

/// Returns a uniformly distributed rotation, as a point of the unit sphere in four dimensions.
fn random_orientation(rng: &mut impl Rng) -> DQuat {
    let fraction: f64 = rng.random_range(0.0..1.0);
    let (sin_a, cos_a) = rng.random_range(0.0..TAU).sin_cos();
    let (sin_b, cos_b) = rng.random_range(0.0..TAU).sin_cos();
    let (a, b) = ((1.0 - fraction).sqrt(), fraction.sqrt());
    DQuat::from_xyzw(a * sin_a, a * cos_a, b * sin_b, b * cos_b)
}
