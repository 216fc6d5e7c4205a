//! Generates random trajectories of every kind, over the times from 0 to 1.

use ccd_core::glam::{DQuat, DVec3};
use ccd_core::{
    AccelerationBounds, DeviationBound, InputError, Motion, Pose, SmoothTrajectory, Stretch,
    Trajectory,
};
use rand::RngExt;
use rand_pcg::Pcg64;
use rigid_ccd::trajectory::{
    Ballistic, Chain, Curve, Joint, OrientationCurve, PosePath, Spline, screw,
};

/// The names of the kinds of trajectories.
pub const TRAJECTORY_KINDS: [&str; 11] = [
    "motion",
    "still",
    "screw",
    "joint",
    "poses",
    "thrown",
    "Bézier curve, slerp",
    "B-spline, slerp",
    "link",
    "smooth",
    "zigzag",
];

/// Returns a random trajectory of a kind, given by its index in [`TRAJECTORY_KINDS`]. Its lengths are about `reach`, and it stays
/// within about `reach` of the origin.
pub fn draw(rng: &mut Pcg64, kind: usize, reach: f64) -> Box<dyn Trajectory> {
    random_trajectory(rng, TRAJECTORY_KINDS[kind], reach).expect("finite numbers")
}

/// Returns true if the trajectories of a kind are single motions.
pub fn is_motion_kind(kind: usize) -> bool {
    ["motion", "still", "screw", "joint"].contains(&TRAJECTORY_KINDS[kind])
}

fn random_trajectory(
    rng: &mut Pcg64,
    kind: &str,
    reach: f64,
) -> Result<Box<dyn Trajectory>, InputError> {
    Ok(match kind {
        "motion" => Box::new(random_motion(rng, reach)?),
        "still" => Box::new(Motion::still(pose(rng, reach)?)),
        "screw" => {
            let axis = random_vector(rng, 1.0);
            let [turns, advance] = [rng.random_range(-3.0..3.0), rng.random_range(-reach..reach)];
            Box::new(screw(
                pose(rng, reach)?,
                random_vector(rng, reach),
                axis,
                turns,
                advance,
            )?)
        }
        "joint" => {
            let joint = joint(rng, reach)?;
            let [from, to] = [(); 2].map(|()| rng.random_range(-2.0..2.0));
            Box::new(joint.motion(from, to, 1.0)?)
        }
        "poses" => poses(rng, reach)?,
        "thrown" => Box::new(Ballistic::new(
            random_motion(rng, reach)?,
            random_vector(rng, 4.0 * reach),
        )?),
        "Bézier curve, slerp" => bezier_trajectory(rng, reach)?,
        "B-spline, slerp" => {
            let count = rng.random_range(4..9);
            let curve = Curve::b_spline(&points(rng, count, reach), rng.random_range(0.5..1.5))?;
            Box::new(Spline::new(
                curve,
                OrientationCurve::piecewise_slerp(&random_orientations(rng))?,
            ))
        }
        "link" => last_link_trajectory(rng, reach)?,
        "smooth" => Box::new(Oscillation {
            place: random_vector(rng, reach),
            amplitude: random_vector(rng, reach),
            rate: rng.random_range(0.5..20.0),
            axis: random_vector(rng, 1.0).normalize(),
            angle_amplitude: rng.random_range(0.0..3.0),
        }),
        _ => Box::new(Zigzag {
            corners: points(rng, 5, reach)
                .into_iter()
                .map(DVec3::from_array)
                .collect(),
            reveals_corners: rng.random_bool(0.5),
        }),
    })
}

/// Returns a path through one to eight random poses.
fn poses(rng: &mut Pcg64, reach: f64) -> Result<Box<dyn Trajectory>, InputError> {
    let mut time = rng.random_range(-0.3..0.3);
    let mut stops = Vec::new();
    for _ in 0..rng.random_range(1..9) {
        stops.push((time, pose(rng, reach)?));
        // Some poses are next to each other.
        time += [0.01, 0.15, 0.4][rng.random_range(0..3)] * rng.random_range(0.5..1.5);
    }
    Ok(Box::new(
        PosePath::new(stops)?.about(random_vector(rng, 0.3 * reach))?,
    ))
}

/// Returns a body whose center follows a Bézier curve, and whose orientation follows a slerp.
fn bezier_trajectory(rng: &mut Pcg64, reach: f64) -> Result<Box<dyn Trajectory>, InputError> {
    let count = rng.random_range(1..6);
    let curve = Curve::bezier(&points(rng, count, reach), rng.random_range(0.5..1.5))?;
    Ok(Box::new(
        Spline::new(
            curve,
            OrientationCurve::piecewise_slerp(&random_orientations(rng))?,
        )
        .about(random_vector(rng, 0.3 * reach))?,
    ))
}

/// Returns the trajectory of the last link of a random chain, all of whose joints move.
fn last_link_trajectory(rng: &mut Pcg64, reach: f64) -> Result<Box<dyn Trajectory>, InputError> {
    let count = rng.random_range(1..6);
    let joints: Result<_, InputError> = (0..count).map(|_| joint(rng, reach)).collect();
    let positions = [(); 2].map(|()| (0..count).map(|_| rng.random_range(-1.0..1.0)).collect());
    Ok(Box::new(LastLinkTrajectory {
        chain: Chain::new(Pose::IDENTITY, joints?),
        positions,
    }))
}

fn random_vector(rng: &mut Pcg64, size: f64) -> DVec3 {
    DVec3::from_array([(); 3].map(|()| rng.random_range(-size..size)))
}

fn pose(rng: &mut Pcg64, size: f64) -> Result<Pose, InputError> {
    let turn = DQuat::from_scaled_axis(random_vector(rng, 3.0));
    Pose::new(random_vector(rng, size), turn)
}

fn random_motion(rng: &mut Pcg64, reach: f64) -> Result<Motion, InputError> {
    // Some rotate so often that they repeat their poses.
    let turns = [0.0, 1.0, 6.0, 90.0][rng.random_range(0..4)];
    let spin = random_vector(rng, 1.0) * turns;
    let center = random_vector(rng, 0.3 * reach);
    Motion::about(
        pose(rng, reach)?,
        random_vector(rng, 2.0 * reach),
        spin,
        center,
    )
}

fn points(rng: &mut Pcg64, count: usize, reach: f64) -> Vec<[f64; 3]> {
    (0..count)
        .map(|_| random_vector(rng, reach).to_array())
        .collect()
}

/// Returns random orientations at even times from 0 to 1, with rotations of less than 1 radian from one to the next.
fn random_orientations(rng: &mut Pcg64) -> Vec<(f64, [f64; 4])> {
    let count = rng.random_range(2..6);
    let mut at = DQuat::from_scaled_axis(random_vector(rng, 3.0));
    let key = |k| {
        at = DQuat::from_scaled_axis(random_vector(rng, 0.5)) * at;
        (f64::from(k) / f64::from(count - 1), at.to_array())
    };
    (0..count).map(key).collect()
}

fn joint(rng: &mut Pcg64, reach: f64) -> Result<Joint, InputError> {
    let origin = Pose::at(random_vector(rng, 0.7 * reach))?;
    let axis = random_vector(rng, 1.0);
    if rng.random_bool(0.8) {
        Joint::revolute(origin, axis)
    } else {
        Joint::prismatic(origin, axis)
    }
}

/// The trajectory of the last link of a kinematic chain, which owns the chain.
struct LastLinkTrajectory {
    chain: Chain,
    positions: [Vec<f64>; 2],
}

impl Trajectory for LastLinkTrajectory {
    fn stretch_between(&self, from: f64, to: f64) -> Result<Stretch, InputError> {
        let [first, last] = &self.positions;
        (self.chain.link(first.len(), first, last, 1.0)?).stretch_between(from, to)
    }
}

/// A user-defined trajectory that oscillates as a sine of the time, with known bounds on its accelerations.
struct Oscillation {
    place: DVec3,
    amplitude: DVec3,
    rate: f64,
    axis: DVec3,
    angle_amplitude: f64,
}

impl SmoothTrajectory for Oscillation {
    fn tangent_motion(&self, time: f64) -> Result<Motion, InputError> {
        let (sin, cos) = (self.rate * time).sin_cos();
        let turned = DQuat::from_axis_angle(self.axis, self.angle_amplitude * sin);
        let start = Pose::new(self.place + self.amplitude * sin, turned)?;
        let cos = self.rate * cos;
        Motion::new(
            start,
            self.amplitude * cos,
            self.axis * (self.angle_amplitude * cos),
        )
    }

    fn acceleration_bounds(&self, _: f64, _: f64) -> AccelerationBounds {
        let square = self.rate * self.rate * (1.0 + 1e-9);
        AccelerationBounds {
            linear_acceleration: self.amplitude.length() * square,
            angular_acceleration: self.angle_amplitude * square,
        }
    }
}

/// A trajectory that moves straight from corner to corner, and that may not report its corners as knots.
struct Zigzag {
    corners: Vec<DVec3>,
    reveals_corners: bool,
}

impl Zigzag {
    fn position_at(&self, time: f64) -> DVec3 {
        let last = self.corners.len() - 1;
        let place = time.clamp(0.0, 1.0) * last as f64;
        let k = (place as usize).min(last - 1);
        self.corners[k].lerp(self.corners[k + 1], place - k as f64)
    }

    fn inner_corner_times(&self, from: f64, to: f64) -> impl Iterator<Item = f64> {
        let count = self.corners.len() - 1;
        let times = (0..=count).map(move |k| k as f64 / count as f64);
        times.filter(move |&time| time > from && time < to)
    }
}

impl Trajectory for Zigzag {
    fn stretch_between(&self, from: f64, to: f64) -> Result<Stretch, InputError> {
        let ends = [from, to].map(|time| self.position_at(time));
        let velocity = if to > from {
            (ends[1] - ends[0]) / (to - from)
        } else {
            DVec3::ZERO
        };
        // It is farthest from the chord at a corner.
        let off = |time: f64| {
            self.position_at(time)
                .distance(ends[0] + velocity * (time - from))
        };
        let shift =
            (self.inner_corner_times(from, to).map(off)).fold(0.0, ccd_core::order::greater);
        let motion = Motion::new(Pose::at(ends[0])?, velocity, DVec3::ZERO)?;
        let reach = self.corners.iter().map(|corner| corner.length());
        let rounding = 1e-15 * reach.fold(0.0, ccd_core::order::greater);
        Ok(Stretch {
            deviation_bound: DeviationBound {
                center_deviation: shift + 8.0 * rounding,
                max_deviation_angle: 0.0,
            },
            ..Stretch::exact(motion)
        })
    }

    fn velocity_jump_time(&self, from: f64, to: f64) -> Option<f64> {
        self.inner_corner_times(from, to)
            .find(|_| self.reveals_corners)
    }
}
