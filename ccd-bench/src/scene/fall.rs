//! Bodies that fall onto resting ones, as a physics engine would ask about them: step by step.

use super::shots::{orientation, unit_vector};
use crate::engine::Method;
use crate::motions::Query;
use crate::query::{Bodies, solve};
use ccd_core::glam::DVec3;
use ccd_core::{Config, InputError, Motion, Outcome, Pose};
use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// Free falls from rest, each cut into steps of constant velocity that end with the first contact.
///
/// Unlike shots, these queries are short, close, and most of them free. Steps during which the bodies
/// are farther apart than their bounding balls are left out, as a broad phase would.
#[derive(Clone, Debug)]
pub struct Fall {
    /// How many falls.
    pub drops: usize,
    /// How far above the resting body they start.
    pub height: f64,
    /// The sum of both bodies' bounding radii.
    pub reach: f64,
    /// How far off the vertical through it, at most.
    pub aside: f64,
    /// The fastest they tumble, in radians per second.
    pub spin: f64,
    /// Draws them.
    pub seed: u64,
}

/// The step of a physics engine, in seconds.
const STEP: f64 = 1.0 / 60.0;
/// In units of length per second squared.
const GRAVITY: f64 = 9.81;
/// A fall that has touched nothing by then has passed.
const MAX_STEPS: usize = 60;

impl Fall {
    /// The motions, in seconds; B rests at the origin. Which of them is a fall's last is told by the
    /// default method.
    ///
    /// # Errors
    /// When a quantity is not finite.
    pub fn queries(&self, bodies: Bodies<'_>) -> Result<Vec<Query>, InputError> {
        let mut rng = Pcg64::seed_from_u64(self.seed);
        let mut solver = Method::default().solver();
        let mut queries = Vec::new();
        for drop in 0..self.drops {
            for (step, a) in self.steps(&mut rng)?.into_iter().enumerate() {
                if !self.is_near(&a) {
                    continue;
                }
                let query = Query {
                    id: format!("{drop}.{step}"),
                    a,
                    b: Motion::still(Pose::IDENTITY),
                    duration: STEP,
                };
                let answer = solve(bodies, &query, &Config::default(), solver.as_mut())?;
                queries.push(query);
                if !matches!(answer.outcome, Outcome::Free { .. }) {
                    break;
                }
            }
        }
        Ok(queries)
    }

    /// Whether the bounding balls touch at either end of a step.
    fn is_near(&self, a: &Motion) -> bool {
        let ends = [a.start(), a.pose(STEP)];
        ends.iter()
            .any(|end| end.translation().length() <= self.reach)
    }

    /// One fall, past the resting body.
    fn steps(&self, rng: &mut impl Rng) -> Result<Vec<Motion>, InputError> {
        let mut aside = || rng.random_range(-self.aside..=self.aside);
        let from = DVec3::new(aside(), aside(), self.height);
        let spin = rng.random_range(0.0..=self.spin) * unit_vector(rng);
        let mut pose = Pose::new(from, orientation(rng))?;
        let mut steps = Vec::with_capacity(MAX_STEPS);
        for step in 0..MAX_STEPS {
            // The mean velocity of the step, so that its ends lie on the parabola.
            let velocity = -GRAVITY * STEP * (step as f64 + 0.5) * DVec3::Z;
            let motion = Motion::new(pose, velocity, spin)?;
            pose = motion.pose(STEP);
            steps.push(motion);
        }
        Ok(steps)
    }
}
