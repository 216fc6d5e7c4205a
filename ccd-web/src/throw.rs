//! Throws a part at another part, and finds the certified first contact or tests for contact at equal time steps.

use crate::{Part, WebError};
use rigid_ccd::{Motion, Outcome, Pose, Settings, Solver};

/// A throw of one second: a part's position at the start, its velocity and its angular velocity. The other part rests
/// at the world's origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Throw {
    /// The position of the part's origin at the start, in metres.
    pub place: [f64; 3],
    /// The velocity of the part, in metres per second.
    pub velocity: [f64; 3],
    /// The angular velocity of the part, in radians per second.
    pub spin: [f64; 3],
}

/// The certified result of a throw, as the page shows it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThrowResult {
    /// The kind of the result: contact, free, touching, overlapping or unresolved.
    pub verdict: &'static str,
    /// The time in seconds before which the parts are proven not to touch.
    pub time: f64,
}

impl Throw {
    /// The duration of every throw, in seconds.
    pub const DURATION: f64 = 1.0;
    /// The distance, in metres, at which parts count as touching.
    pub const TOLERANCE: f64 = 1e-6;
}

impl Throw {
    /// Finds the first contact of the thrown part with the target.
    ///
    /// # Guarantee
    /// Nothing touches before the returned time.
    ///
    /// # Errors
    /// [`WebError`] for numbers out of range.
    pub fn first_contact(&self, part: &Part, target: &Part) -> Result<ThrowResult, WebError> {
        let outcome = ask(part, self.motion()?, target, Throw::DURATION)?;
        let (verdict, time) = match outcome {
            Outcome::Contact { time, .. } => ("contact", time),
            Outcome::Touching { .. } => ("touching", 0.0),
            Outcome::Overlapping { .. } => ("overlapping", 0.0),
            Outcome::Unresolved(known) => ("unresolved", known.safe_until),
            // A first contact has no other outcomes.
            Outcome::Free { .. } | Outcome::Interval { .. } | Outcome::LeastDistance { .. } => {
                ("free", Throw::DURATION)
            }
        };
        Ok(ThrowResult { verdict, time })
    }

    /// Returns for evenly spaced times, from the start to the end, whether the parts touch: 1 if they do, 0 if not.
    ///
    /// # Errors
    /// [`WebError`] for numbers out of range.
    pub fn steps(&self, part: &Part, target: &Part, count: u32) -> Result<Vec<u8>, WebError> {
        let motion = self.motion()?;
        let touches = (0..=count).map(|step| {
            let time = Throw::DURATION * f64::from(step) / f64::from(count.max(1));
            let found = ask(part, Motion::still(motion.pose(time)), target, 0.0)?;
            Ok(u8::from(!matches!(found, Outcome::Free { .. })))
        });
        touches.collect()
    }
}

impl Throw {
    fn motion(&self) -> Result<Motion, WebError> {
        Ok(Motion::new(
            Pose::at(self.place)?,
            self.velocity,
            self.spin,
        )?)
    }
}

fn ask(part: &Part, motion: Motion, target: &Part, duration: f64) -> Result<Outcome, WebError> {
    let mut solver = Solver::new().with_settings(Settings {
        tolerance: Throw::TOLERANCE,
        ..Settings::DEFAULT
    });
    let target = (&target.body, Motion::STILL);
    let answer = solver.first_contact((&part.body, motion), target, duration)?;
    Ok(answer.outcome)
}

#[cfg(test)]
mod tests;
