//! Random bodies and motions of every kind and size for tests; the same seed gives the same scene.

use super::nearest::{Triangle, nearest_points};
use super::worst::RandomCase;
use crate::body::pieces::Pieces;
use crate::body::{Body, Solidity};
use crate::error::InputError;
use crate::math::order::{greater, lesser};
use crate::motion::Motion;
use crate::motion::pose::Pose;
use crate::problem::Problem;
use crate::query::MovingBody;
use crate::query::Query;
use crate::settings::Settings;
use glam::{DQuat, DVec3};
use rand::TryRng;
pub(crate) use rand::{RngExt, SeedableRng};
pub(crate) use rand_pcg::Pcg64;
use std::convert::Infallible;

/// The shapes and sizes of the triangles of a soup, a set of unconnected triangles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum SoupKind {
    WellShaped,
    /// Each triangle is 1e-7 times as wide as long.
    Needles,
    /// All triangles are in one plane, up to 1e-7 of their size.
    Coplanar,
    /// All triangles are along one line, up to 1e-7 of their size.
    Collinear,
    /// The sizes of the triangles extend over six orders of magnitude.
    MixedSizes,
}

impl SoupKind {
    pub(crate) const ALL: [SoupKind; 5] = [
        SoupKind::WellShaped,
        SoupKind::Needles,
        SoupKind::Coplanar,
        SoupKind::Collinear,
        SoupKind::MixedSizes,
    ];
}

pub(crate) fn rng(seed: u64) -> Pcg64 {
    Pcg64::seed_from_u64(seed)
}

/// Draws random numbers from a case of a search for the worst rounding error, so that scenes can be drawn in such a
/// search.
impl TryRng for RandomCase {
    type Error = Infallible;

    fn try_next_u32(&mut self) -> Result<u32, Infallible> {
        Ok((self.next_word() >> 32) as u32)
    }

    fn try_next_u64(&mut self) -> Result<u64, Infallible> {
        Ok(self.next_word())
    }

    fn try_fill_bytes(&mut self, bytes: &mut [u8]) -> Result<(), Infallible> {
        for byte in bytes {
            *byte = self.next_word() as u8;
        }
        Ok(())
    }
}

/// Draws a power of ten with a random exponent between `low` and `high`.
pub(crate) fn random_power_of_ten(rng: &mut impl RngExt, low: f64, high: f64) -> f64 {
    10f64.powf(rng.random_range(low..=high))
}

/// Draws a unit vector.
pub(crate) fn random_direction(rng: &mut impl RngExt) -> DVec3 {
    let mut cube = || DVec3::from_array(std::array::from_fn(|_| rng.random_range(-1.0..1.0)));
    let inside = (0..64)
        .map(|_| cube())
        .find(|v| (0.01..1.0).contains(&v.length()));
    inside.unwrap_or(DVec3::X).normalize()
}

/// Draws a point in a ball about the origin.
pub(crate) fn random_point_in_ball(rng: &mut impl RngExt, radius: f64) -> DVec3 {
    random_direction(rng) * radius * rng.random_range(0.0..1.0f64).cbrt()
}

pub(crate) fn random_rotation(rng: &mut impl RngExt) -> DQuat {
    DQuat::from_axis_angle(random_direction(rng), rng.random_range(-3.1..3.1))
}

/// Draws the corners of a box in any orientation, with a half extent of 1 along one axis and of at most 1 along the
/// others.
pub(crate) fn random_box_corners(tape: &mut RandomCase) -> Vec<DVec3> {
    let frame = glam::DMat3::from_quat(random_rotation(tape));
    let half = DVec3::new(1.0, tape.size(-30..=-1), tape.size(-30..=-1));
    let corner = |k: usize| {
        let sign = |bit: usize| if k >> bit & 1 == 1 { 1.0 } else { -1.0 };
        frame * (half * DVec3::new(sign(0), sign(1), sign(2)))
    };
    (0..8).map(corner).collect()
}

/// Draws `count` triangles near the origin, none of which extends much farther than `size` from it.
pub(crate) fn random_triangle_soup(
    rng: &mut impl RngExt,
    look: SoupKind,
    count: usize,
    size: f64,
) -> Vec<Triangle> {
    let frame = random_rotation(rng);
    (0..count)
        .map(|_| {
            let center = random_point_in_ball(rng, size);
            let edge = match look {
                SoupKind::MixedSizes => size * random_power_of_ten(rng, -6.0, 0.0),
                _ => size * rng.random_range(0.05..1.0),
            };
            let mut corners = [0; 3].map(|_| center + random_point_in_ball(rng, edge));
            if look == SoupKind::Needles {
                let tip = 0.5 * (corners[0] + corners[1]) + random_point_in_ball(rng, 1e-7 * edge);
                corners[2] = tip;
            }
            let squeeze = match look {
                SoupKind::Coplanar => DVec3::new(1.0, 1.0, 1e-7),
                SoupKind::Collinear => DVec3::new(1.0, 1e-7, 1e-7),
                _ => DVec3::ONE,
            };
            corners.map(|p| frame * (p * squeeze))
        })
        .collect()
}

/// Draws two triangles, either of any kind of soup, or with random corners in one ball so that they often cross.
pub(crate) fn two_random_triangles(rng: &mut Pcg64) -> [Triangle; 2] {
    if rng.random_bool(0.5) {
        return [(); 2].map(|()| [(); 3].map(|()| random_point_in_ball(rng, 1.0)));
    }
    let look = SoupKind::ALL[rng.random_range(0..5)];
    let pair = random_triangle_soup(rng, look, 2, 0.5);
    [pair[0], pair[1]]
}

pub(crate) fn body(triangles: &[Triangle]) -> Body {
    Body::new(&pieces(triangles), Solidity::Surface).unwrap()
}

pub(crate) fn pieces(triangles: &[Triangle]) -> Pieces {
    let points: Vec<DVec3> = triangles.iter().flatten().copied().collect();
    let faces: Vec<[u32; 3]> = (0..triangles.len() as u32)
        .map(|k| [3 * k, 3 * k + 1, 3 * k + 2])
        .collect();
    let ids: Vec<u32> = (0..triangles.len() as u32).collect();
    Pieces::from_triangles(&points, &faces, &ids).unwrap()
}

/// The motion of a body with constant velocities, given by its pose at the clock `clock`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MotionThroughPose {
    pub(crate) clock: f64,
    pub(crate) rotation: DQuat,
    /// The position of the body's point `middle` at the clock `clock`.
    pub(crate) place: DVec3,
    pub(crate) middle: DVec3,
    /// The velocity of the center of rotation; the duration is 1.
    pub(crate) velocity: DVec3,
    pub(crate) spin: DVec3,
    /// The center of rotation in the body's frame.
    pub(crate) center: DVec3,
}

impl MotionThroughPose {
    pub(crate) fn motion(&self) -> Motion {
        let start = DQuat::from_scaled_axis(-self.clock * self.spin) * self.rotation;
        let translation = self.place - self.rotation * self.middle;
        let center = self.rotation * self.center + translation - self.clock * self.velocity;
        let pose = Pose::new(center - start * self.center, start).unwrap();
        Motion::about(pose, self.velocity, self.spin, self.center).unwrap()
    }

    /// Returns the velocity of the body's point `middle` at the clock `clock`.
    fn velocity_of_middle(&self) -> DVec3 {
        self.velocity + self.spin.cross(self.rotation * (self.middle - self.center))
    }
}

/// Two bodies that come near each other within a duration of 1.
#[derive(Debug)]
pub(crate) struct Scene {
    pub(crate) bodies: [Body; 2],
    pub(crate) motions: [Motion; 2],
    pub(crate) accelerations: [DVec3; 2],
    pub(crate) settings: Settings,
    /// The clock at which the bodies are near each other.
    pub(crate) clock: f64,
    /// The approximate time for which the bodies are near each other.
    pub(crate) passage_duration: f64,
}

impl Scene {
    pub(crate) fn problem(&self) -> Problem<'_> {
        let moving = |k: usize| (&self.bodies[k], self.motions[k]);
        let bodies = [moving(0), moving(1)];
        Problem::with_accelerations(
            bodies,
            self.accelerations,
            1.0,
            &self.settings.to_query_settings(),
        )
        .unwrap()
    }

    /// Adds accelerations of both bodies with a probability of a third.
    pub(crate) fn with_occasional_accelerations(self, rng: &mut Pcg64) -> Self {
        match rng.random_range(0..3) {
            0 => self.with_accelerations(rng),
            _ => self,
        }
    }

    /// Adds random accelerations of both bodies, without a change of their poses and velocities at the clock `clock`.
    /// The accelerations are of the order of the scene's size or of the bodies' displacements.
    pub(crate) fn with_accelerations(mut self, rng: &mut Pcg64) -> Self {
        let clock = self.clock;
        let size = self.bodies[0].tree().max_distance_from_origin
            + self.bodies[1].tree().max_distance_from_origin;
        for (motion, acceleration) in self.motions.iter_mut().zip(&mut self.accelerations) {
            let speed = if rng.random_bool(0.5) {
                size
            } else {
                motion.velocity().length()
            };
            *acceleration = random_direction(rng) * speed * random_power_of_ten(rng, -3.0, 1.5);
            let (pose, change) = (motion.start(), clock * *acceleration);
            let start = Pose::new(pose.translation() + 0.5 * clock * change, pose.rotation());
            let velocity = motion.velocity() - change;
            *motion = Motion::about(
                start.unwrap(),
                velocity,
                motion.angular_velocity(),
                motion.center(),
            )
            .unwrap();
        }
        self
    }
}

/// Returns the distance of the two bodies at a clock, as the least distance of any two triangles.
pub(crate) fn distance(problem: &Problem<'_>, s: f64) -> f64 {
    let [a, b] = [&problem.a, &problem.b].map(|side| {
        let frame = side.path.frame(s);
        let pieces = side.body.pieces();
        let placed = |k: usize| pieces.triangle(k).map(|p| frame.transform_point(p));
        (0..pieces.len()).map(placed).collect::<Vec<Triangle>>()
    });
    let pairs = a
        .iter()
        .flat_map(|x| b.iter().map(move |y| nearest_points(x, y).distance));
    pairs.fold(f64::INFINITY, lesser)
}

/// Returns the triangles of a grid surface with corners at `point(i, j)`, two for each square of the grid.
pub(crate) fn sheet(
    rows: usize,
    columns: usize,
    point: impl Fn(f64, f64) -> [f64; 3],
) -> Vec<Triangle> {
    let point = |i: usize, j: usize| {
        DVec3::from_array(point(i as f64 / rows as f64, j as f64 / columns as f64))
    };
    let squares = (0..rows).flat_map(|i| (0..columns).map(move |j| (i, j)));
    squares
        .flat_map(|(i, j)| {
            let [a, b] = [point(i, j), point(i + 1, j)];
            let [c, d] = [point(i + 1, j + 1), point(i, j + 1)];
            [[a, b, c], [a, c, d]]
        })
        .collect()
}

/// The kind of motion of two bodies while they are near each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum SceneKind {
    /// Each body rests, translates or turns at random, about any center.
    RandomMotion,
    /// The bodies overlap, and move apart without turning.
    Receding,
    /// One body slides past the other, without turning, by a thousand times its size in the duration.
    Sliding,
    /// A large body turns, and a small body is near it, at rest or in motion.
    NearRim,
}

impl SceneKind {
    /// Returns one of the three kinds in which the bodies pass each other, in turn.
    pub(crate) fn passing(number: usize) -> Self {
        [
            SceneKind::RandomMotion,
            SceneKind::NearRim,
            SceneKind::Sliding,
        ][number % 3]
    }
}

/// Draws a scene of two bodies with up to `most` triangles each, which come near each other.
pub(crate) fn scene(rng: &mut Pcg64, kind: SceneKind, most: usize) -> Scene {
    let size = random_power_of_ten(rng, -6.0, 6.0);
    let ratio = match kind {
        SceneKind::NearRim => random_power_of_ten(rng, 1.0, 5.0),
        SceneKind::Receding => random_power_of_ten(rng, 0.0, 0.5),
        _ if rng.random_bool(0.5) => 1.0,
        _ => random_power_of_ten(rng, 0.0, 4.0),
    };
    let mut sizes = [size, greater(1e-6, size / ratio)];
    if rng.random_bool(0.5) {
        sizes.swap(0, 1);
    }
    let clock = rng.random_range(0.0..1.0);
    let world = random_direction(rng) * random_distance_from_origin(rng, size);
    let way = random_direction(rng);
    // The distance of the middles at that clock is from overlapping to well apart.
    let near = match kind {
        SceneKind::Receding => rng.random_range(0.0..0.3),
        _ => rng.random_range(0.0..1.4),
    } * (sizes[0] + sizes[1]);
    let mut bodies = Vec::new();
    let mut motions = Vec::new();
    let mut velocities = [DVec3::ZERO; 2];
    for (k, sign) in [(0, 0.0), (1, near)] {
        let look = SoupKind::ALL[rng.random_range(0..5)];
        let count = random_power_of_ten(rng, 0.0, (most as f64).log10()) as usize;
        let middle = random_direction(rng) * random_distance_from_origin(rng, sizes[k]);
        let triangles = random_triangle_soup(rng, look, count.max(1), sizes[k]);
        let moved: Vec<Triangle> = triangles.iter().map(|t| t.map(|p| p + middle)).collect();
        bodies.push(body(&moved));
        let mut passage = MotionThroughPose {
            clock,
            rotation: random_rotation(rng),
            place: world + sign * way,
            middle,
            velocity: DVec3::ZERO,
            spin: DVec3::ZERO,
            center: DVec3::ZERO,
        };
        draw_velocities(rng, kind, &mut passage, k, way, &sizes);
        velocities[k] = passage.velocity_of_middle();
        motions.push(passage.motion());
    }
    Scene {
        bodies: bodies.try_into().unwrap(),
        motions: motions.try_into().unwrap(),
        accelerations: [DVec3::ZERO; 2],
        settings: Settings {
            tolerance: lesser(sizes[0], sizes[1]) * random_power_of_ten(rng, -6.0, -2.0),
            ..Settings::DEFAULT
        },
        clock,
        passage_duration: (sizes[0] + sizes[1]) / (velocities[0].distance(velocities[1]) + size),
    }
}

/// Draws a distance from the origin: 0, up to a thousand times `size`, or up to the greater of 1e6 and `size`.
fn random_distance_from_origin(rng: &mut Pcg64, size: f64) -> f64 {
    match rng.random_range(0..4) {
        0 | 1 => 0.0,
        2 => size * random_power_of_ten(rng, 0.0, 3.0),
        _ => greater(random_power_of_ten(rng, 0.0, 6.0), size),
    }
}

fn draw_velocities(
    rng: &mut Pcg64,
    kind: SceneKind,
    passage: &mut MotionThroughPose,
    side: usize,
    way: DVec3,
    sizes: &[f64; 2],
) {
    let size = greater(sizes[0], sizes[1]);
    let large = sizes[side] == size;
    match kind {
        SceneKind::Receding => {
            let sign = if side == 0 { -1.0 } else { 1.0 };
            passage.velocity = (sign * way + random_point_in_ball(rng, 0.3))
                * size
                * random_power_of_ten(rng, -2.0, 2.0);
        }
        SceneKind::Sliding => {
            if side == 1 {
                let across = way.cross(random_direction(rng)).normalize();
                passage.velocity = across * size * 1e3;
            }
        }
        SceneKind::NearRim => {
            if large {
                passage.spin = random_direction(rng) * rng.random_range(0.1..20.0);
                passage.center = passage.middle + random_point_in_ball(rng, size);
            } else if rng.random_bool(0.5) {
                passage.velocity = random_point_in_ball(rng, size);
                passage.spin = random_point_in_ball(rng, 20.0);
                passage.center = passage.middle;
            }
        }
        SceneKind::RandomMotion => {
            if rng.random_bool(0.7) {
                passage.velocity =
                    random_direction(rng) * size * random_power_of_ten(rng, -3.0, 1.5);
            }
            if rng.random_bool(0.7) {
                let turns = random_power_of_ten(rng, -4.0, 6f64.log10());
                passage.spin = random_direction(rng) * std::f64::consts::TAU * turns;
                passage.center = match rng.random_range(0..4) {
                    0 => DVec3::ZERO,
                    1 | 2 => passage.middle + random_point_in_ball(rng, sizes[side]),
                    _ => {
                        let far = size * random_power_of_ten(rng, 0.0, 4.0);
                        passage.middle + random_point_in_ball(rng, far)
                    }
                };
            }
        }
    }
}

impl<'a> Problem<'a> {
    /// Creates the problem that a query about two bodies with constant velocities solves.
    pub(crate) fn of_moving_bodies(
        a: impl Into<MovingBody<'a>>,
        b: impl Into<MovingBody<'a>>,
        duration: f64,
        settings: &'a Settings,
    ) -> Result<Self, InputError> {
        let query = Query::new(a, b, duration, settings)?;
        Ok(query
            .constant_velocity_problem
            .expect("both bodies are on motions"))
    }
}
