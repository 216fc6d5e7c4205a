//! Smooth trajectories for tests.

use crate::error::InputError;
use crate::motion::Motion;
use crate::motion::pose::Pose;
use crate::motion::trajectory::{Acceleration, AccelerationBounds, SmoothTrajectory};
use crate::tests::scene::{Pcg64, RngExt, random_direction, random_point_in_ball, random_rotation};
use glam::{DQuat, DVec3};

/// A trajectory that swings: `center + drift t + Σ along sin(rate t + phase)`, turned by `turn sin(rate t + phase)`
/// about a fixed axis.
#[derive(Clone, Debug)]
pub(crate) struct SwingingTrajectory {
    pub(crate) place: DVec3,
    pub(crate) drift: DVec3,
    swing_amplitudes: [DVec3; 2],
    angular_frequencies: [f64; 3],
    phases: [f64; 3],
    axis: DVec3,
    turn_amplitude: f64,
    start: DQuat,
    center: DVec3,
    /// Whether the trajectory provides the acceleration of its center, not only bounds of it.
    provides_acceleration: bool,
}

impl SwingingTrajectory {
    /// Draws a random trajectory whose position and swings are of up to the given size.
    pub(crate) fn draw(rng: &mut Pcg64, size: f64) -> Self {
        SwingingTrajectory {
            place: random_point_in_ball(rng, size),
            drift: random_point_in_ball(rng, size),
            swing_amplitudes: [(); 2].map(|()| random_point_in_ball(rng, size)),
            angular_frequencies: [(); 3].map(|()| rng.random_range(0.5..6.0)),
            phases: [(); 3].map(|()| rng.random_range(0.0..6.0)),
            axis: random_direction(rng),
            turn_amplitude: rng.random_range(0.0..3.0),
            start: random_rotation(rng),
            center: random_point_in_ball(rng, 1.0),
            provides_acceleration: rng.random_bool(0.5),
        }
    }
}

impl SmoothTrajectory for SwingingTrajectory {
    fn tangent_motion(&self, t: f64) -> Result<Motion, InputError> {
        let (mut at, mut velocity) = (self.place + self.drift * t, self.drift);
        for k in 0..2 {
            let angle = self.angular_frequencies[k] * t + self.phases[k];
            at += self.swing_amplitudes[k] * angle.sin();
            velocity += self.swing_amplitudes[k] * (self.angular_frequencies[k] * angle.cos());
        }
        let angle = self.angular_frequencies[2] * t + self.phases[2];
        let turned =
            DQuat::from_scaled_axis(self.axis * (self.turn_amplitude * angle.sin())) * self.start;
        let spin = self.axis * (self.turn_amplitude * self.angular_frequencies[2] * angle.cos());
        // The center is at the place, not the origin.
        let start = Pose::new(at - turned * self.center, turned)?;
        Motion::about(start, velocity, spin, self.center)
    }

    fn acceleration_bounds(&self, _: f64, _: f64) -> AccelerationBounds {
        let linear = |k: usize| {
            self.swing_amplitudes[k].length()
                * self.angular_frequencies[k]
                * self.angular_frequencies[k]
        };
        AccelerationBounds {
            linear_acceleration: linear(0) + linear(1),
            angular_acceleration: self.turn_amplitude
                * self.angular_frequencies[2]
                * self.angular_frequencies[2],
        }
    }

    fn osculating_motion(
        &self,
        t: f64,
        _: f64,
        _: f64,
    ) -> Result<(Motion, Option<Acceleration>), InputError> {
        let (mut vector, mut jerk) = (DVec3::ZERO, 0.0);
        for k in 0..2 {
            let (rate, along) = (self.angular_frequencies[k], self.swing_amplitudes[k]);
            vector -= along * (rate * rate * (rate * t + self.phases[k]).sin());
            jerk += along.length() * rate * rate * rate;
        }
        let acceleration = Acceleration {
            acceleration_vector: vector,
            jerk_bound: jerk,
        };
        Ok((
            self.tangent_motion(t)?,
            self.provides_acceleration.then_some(acceleration),
        ))
    }
}
