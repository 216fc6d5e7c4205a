//! A random search for the largest ratio of a trajectory's deviation to its bound.

use ccd_core::glam::DVec3;
use ccd_core::order::{greater, lesser};
use ccd_core::{InputError, Trajectory};

/// The sample with the largest deviation relative to its bound.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WorstDeviation {
    /// The deviation divided by its bound: at most 1 for a correct trajectory.
    pub ratio: f64,
    /// The time at which the segment starts.
    pub from: f64,
    /// The time at which the segment ends.
    pub to: f64,
    /// The time at which the deviation was measured.
    pub time: f64,
    /// The vector from the motion's center to the measured point, in the body's frame.
    pub arm: DVec3,
}

/// Searches for the segment, the time and the point with the largest deviation relative to its bound.
///
/// It draws stretches within the duration, of all lengths, and points up to `reach` from the center; then it
/// changes the worst draw a little, again and again. The same seed makes the same draws. Poses are those of
/// [`Trajectory::pose`], which have to be exact to a few units in the last place.
///
/// Give the reach of your largest body: bounds of turns count by it, and a false one shows where it is large.
///
/// A ratio above 1 is a fault of the trajectory, at the place that is returned. A ratio far below 1 over all
/// draws says that the bounds could be tighter.
///
/// # Errors
/// Those of the trajectory.
///
/// ```
/// use rigid_ccd::trajectory::{Ballistic, worst_deviation};
/// use rigid_ccd::{Motion, Pose};
/// let thrown = Motion::new(Pose::IDENTITY, [3.0, 0.0, 4.0], [0.0, 9.0, 0.0])?;
/// let ball = Ballistic::new(thrown, [0.0, 0.0, -9.81])?;
/// let worst = worst_deviation(&ball, 1.0, 0.5, 10_000, 1)?;
/// assert!(worst.ratio <= 1.0, "{worst:?}");
/// # Ok::<(), rigid_ccd::InputError>(())
/// ```
pub fn worst_deviation(
    trajectory: &dyn Trajectory,
    duration: f64,
    reach: f64,
    draws: u64,
    seed: u64,
) -> Result<WorstDeviation, InputError> {
    let mut search = Search {
        trajectory,
        duration,
        reach,
        state: seed,
    };
    let mut worst: Option<(UnitCubePoint, WorstDeviation)> = None;
    for number in 0..draws {
        let draw = match &worst {
            // Hill climbing starts at every fresh sample.
            Some((draw, _)) if number % 4 != 0 => search.nearby_sample(draw),
            _ => search.random_sample(),
        };
        let found = search.measure(&draw)?;
        if worst.is_none_or(|(_, worst)| found.ratio > worst.ratio) {
            worst = Some((draw, found));
        }
    }
    Ok(worst.map(|(_, worst)| worst).unwrap_or_default())
}

/// Numbers from 0 to 1 that determine a segment, a time and a point.
type UnitCubePoint = [f64; 6];

struct Search<'t> {
    trajectory: &'t dyn Trajectory,
    duration: f64,
    reach: f64,
    state: u64,
}

impl Search<'_> {
    /// Returns a pseudo-random number from 0 to 1, by SplitMix64.
    fn random_number(&mut self) -> f64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    fn random_sample(&mut self) -> UnitCubePoint {
        [(); 6].map(|()| self.random_number())
    }

    fn nearby_sample(&mut self, draw: &UnitCubePoint) -> UnitCubePoint {
        let step = 10f64.powf(-6.0 * self.random_number());
        draw.map(|x| (x + step * (self.random_number() - 0.5)).clamp(0.0, 1.0))
    }

    fn measure(
        &self,
        &[length, from, time, arm, azimuth, height]: &UnitCubePoint,
    ) -> Result<WorstDeviation, InputError> {
        // The lengths are of all orders of magnitude, down to a millionth.
        let length = self.duration * 10f64.powf(-6.0 * length);
        let from = from * (self.duration - length);
        let to = lesser(from + length, self.duration);
        let time = lesser(from + time * length, to);
        let stretch = self.trajectory.stretch_between(from, to)?;
        let z = 2.0 * height - 1.0;
        let (sin, cos) = (std::f64::consts::TAU * azimuth).sin_cos();
        let across = greater(0.0, 1.0 - z * z).sqrt();
        let reach = self.reach * arm;
        let arm = reach * DVec3::new(across * cos, across * sin, z);
        let point = stretch.motion.center() + arm;
        let [pose, near] = [self.trajectory.pose(time)?, stretch.pose(time - from)];
        let deviation = pose
            .transform_point(point)
            .distance(near.transform_point(point));
        // The compared poses have rounding errors of one or two units in the last place.
        let places = pose.translation().length() + point.length();
        let rounding = 8.0 * f64::EPSILON * places;
        Ok(WorstDeviation {
            ratio: (deviation - rounding) / stretch.deviation_bound.at_reach(reach),
            from,
            to,
            time,
            arm,
        })
    }
}
