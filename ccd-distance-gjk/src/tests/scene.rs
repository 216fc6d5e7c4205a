//! Random pairs of pieces that are hard for distance algorithms.

use ccd_core::glam::{DQuat, DVec3};
use ccd_core::order::{greater, lesser};
use ccd_core::{Frame, Piece, PiecePair, Pose};
use rand::RngExt;
pub(crate) use rand::SeedableRng;
pub(crate) use rand_pcg::Pcg64;

/// A pair of pieces that owns its points.
#[derive(Clone, Debug)]
pub(crate) struct Scene {
    pub(crate) a: Vec<DVec3>,
    pub(crate) b: Vec<DVec3>,
    pub(crate) b_to_a: Frame,
    /// The largest distance from A's first point to any point of the pieces, to which errors are relative.
    pub(crate) size: f64,
}

impl Scene {
    /// Creates a pair from the points of both pieces in A's frame.
    fn new(a: Vec<DVec3>, b: Vec<DVec3>) -> Self {
        let reach = |x: DVec3| a.iter().chain(&b).map(|y| y.distance(x)).fold(0.0, greater);
        let size = greater(f64::MIN_POSITIVE, reach(a[0]));
        Scene {
            a,
            b,
            b_to_a: Frame::IDENTITY,
            size,
        }
    }

    pub(crate) fn pair(&self) -> PiecePair<'_> {
        PiecePair {
            a: Piece::from_points(&self.a),
            b: Piece::from_points(&self.b),
            b_to_a: self.b_to_a,
        }
    }

    /// Returns both pieces' points in A's frame, relative to A's first point, without the rounding of far coordinates.
    pub(crate) fn local_points(&self) -> (Vec<DVec3>, Vec<DVec3>) {
        let between = self.b_to_a.transform_point(self.b[0]) - self.a[0];
        let local = |y: &DVec3| self.b_to_a.rotation * (*y - self.b[0]) + between;
        let a = self.a.iter().map(|x| *x - self.a[0]).collect();
        (a, self.b.iter().map(local).collect())
    }

    /// Returns the pair with A and B exchanged.
    pub(crate) fn swapped(&self) -> Scene {
        Scene {
            a: self.b.clone(),
            b: self.a.clone(),
            b_to_a: self.b_to_a.transform_from(&Frame::IDENTITY),
            size: self.size,
        }
    }

    /// Scales the coordinates of both bodies.
    pub(crate) fn scaled(mut self, scale: f64) -> Scene {
        for point in self.a.iter_mut().chain(&mut self.b) {
            *point *= scale;
        }
        self.b_to_a.translation *= scale;
        self.size *= scale;
        self
    }

    /// Expresses both pieces in random frames, whose origins are up to about `far` away. The relative position changes
    /// only by rounding.
    pub(crate) fn in_random_frames(self, rng: &mut Pcg64, far: f64) -> Scene {
        let [to_a, to_b]: [Frame; 2] = std::array::from_fn(|_| pose(rng, far).into());
        Scene {
            a: self.a.iter().map(|&x| to_a.transform_point(x)).collect(),
            b: self
                .b
                .iter()
                .map(|&y| to_b.transform_point(self.b_to_a.transform_point(y)))
                .collect(),
            b_to_a: relative_frame(&to_a, &to_b),
            size: self.size,
        }
    }
}

/// Returns the transform that applies the inverse of `to_b`, then `to_a`.
fn relative_frame(to_a: &Frame, to_b: &Frame) -> Frame {
    let rotation = to_a.rotation * to_b.rotation.transpose();
    Frame {
        rotation,
        translation: to_a.translation - rotation * to_b.translation,
    }
}

pub(crate) fn pose(rng: &mut Pcg64, far: f64) -> Pose {
    let turn = DQuat::from_scaled_axis(3.0 * random_vector(rng));
    Pose::new(far * random_vector(rng), turn).expect("finite and of length one")
}

/// Draws a vector in the cube of side two about the origin.
pub(crate) fn random_vector(rng: &mut Pcg64) -> DVec3 {
    DVec3::from_array(std::array::from_fn(|_| rng.random_range(-1.0..1.0)))
}

pub(crate) fn points(rng: &mut Pcg64, count: usize) -> Vec<DVec3> {
    (0..count).map(|_| random_vector(rng)).collect()
}

/// Draws points whose coordinates are 0, 1, tiny or huge.
pub(crate) fn extreme_coordinate_points(rng: &mut Pcg64, count: usize) -> Vec<DVec3> {
    const EXTREME_VALUES: [f64; 7] = [0.0, -0.0, 1.0, 1e-300, 1e15, -1e15, f64::MIN_POSITIVE];
    let mut odd = || EXTREME_VALUES[rng.random_range(0..EXTREME_VALUES.len())];
    (0..count)
        .map(|_| DVec3::new(odd(), odd(), odd()))
        .collect()
}

/// Draws a number between 10 to the power of `low` and of `high`, with every order of magnitude equally likely.
pub(crate) fn random_magnitude(rng: &mut Pcg64, low: f64, high: f64) -> f64 {
    10f64.powf(rng.random_range(low..high))
}

/// Draws hulls of `a` and `b` random points at a random distance: apart or intersecting.
pub(crate) fn random_hulls(rng: &mut Pcg64, a: usize, b: usize) -> Scene {
    let offset = rng.random_range(0.0..2.5) * random_vector(rng).normalize();
    let b = points(rng, b).iter().map(|y| *y + offset).collect();
    Scene::new(points(rng, a), b).in_random_frames(rng, 1.0)
}

/// Draws random hulls, moved so that a point inside A coincides with a point inside B.
pub(crate) fn intersecting_hulls(rng: &mut Pcg64, a: usize, b: usize) -> Scene {
    let (a, b) = points_of_intersecting_hulls(rng, a, b);
    Scene::new(a, b).in_random_frames(rng, 1.0)
}

/// Draws intersecting hulls, flattened along two axes by random factors down to 1e-12.
pub(crate) fn flattened_hulls(rng: &mut Pcg64, a: usize, b: usize) -> Scene {
    let (mut a, mut b) = points_of_intersecting_hulls(rng, a, b);
    let thin = DVec3::new(
        1.0,
        random_magnitude(rng, -12.0, 0.0),
        random_magnitude(rng, -12.0, 0.0),
    );
    a.iter_mut().chain(&mut b).for_each(|x| *x *= thin);
    Scene::new(a, b).in_random_frames(rng, 1.0)
}

fn points_of_intersecting_hulls(rng: &mut Pcg64, a: usize, b: usize) -> (Vec<DVec3>, Vec<DVec3>) {
    let (a, b) = (points(rng, a), points(rng, b));
    let inner = |rng: &mut Pcg64, points: &[DVec3]| {
        let weights: Vec<f64> = points.iter().map(|_| rng.random_range(0.1..1.0)).collect();
        let sum: DVec3 = points.iter().zip(&weights).map(|(x, w)| *w * *x).sum();
        sum / weights.iter().sum::<f64>()
    };
    let shift = inner(rng, &a) - inner(rng, &b);
    let b = b.iter().map(|y| *y + shift).collect();
    (a, b)
}

/// The pair of features that is nearest in the triangles of [`near_contact`].
#[derive(Clone, Copy, Debug)]
pub(crate) enum NearestFeatures {
    CornerFace,
    CrossedEdges,
    ParallelFaces,
    CornerEdge,
    CornerCorner,
}

/// Makes two random triangles that are `gap` apart along z, with nearest features of the kind `meeting`. The other
/// corners are farther by any magnitude from 1e-12 on.
pub(crate) fn near_contact(rng: &mut Pcg64, meeting: NearestFeatures, gap: f64) -> Scene {
    let slope = |rng: &mut Pcg64| random_magnitude(rng, -12.0, 0.0);
    let flat = |rng: &mut Pcg64| {
        let v = random_vector(rng);
        DVec3::new(v.x, v.y, 0.0)
    };
    let rising = |rng: &mut Pcg64| flat(rng) + (gap + slope(rng)) * DVec3::Z;
    let falling = |rng: &mut Pcg64| flat(rng) - slope(rng) * DVec3::Z;
    let up = gap * DVec3::Z;
    // A triangle in the plane z = 0 about the origin, and a segment through it.
    let about = |rng: &mut Pcg64| {
        let turn = DQuat::from_rotation_z(rng.random_range(0.0..7.0));
        [0.0, 2.1, 4.2].map(|angle: f64| {
            rng.random_range(0.2..1.0) * (turn * DVec3::new(angle.cos(), angle.sin(), 0.0))
        })
    };
    let through = |direction: DVec3| [-0.7 * direction, 0.6 * direction];
    let (a, b) = match meeting {
        NearestFeatures::CornerFace => (about(rng).to_vec(), vec![up, rising(rng), rising(rng)]),
        NearestFeatures::CrossedEdges => {
            let angle = random_magnitude(rng, -12.0, 0.0);
            let [p, q] = through(DVec3::X);
            let [r, s] = through(DVec3::new(angle.cos(), angle.sin(), 0.0)).map(|x| x + up);
            (vec![p, q, falling(rng)], vec![r, s, rising(rng)])
        }
        NearestFeatures::ParallelFaces => {
            let tilt =
                DQuat::from_scaled_axis(random_magnitude(rng, -16.0, -9.0) * random_vector(rng));
            let b = about(rng).map(|y| tilt * y);
            // Lifted until its lowest corner is up at the gap.
            let low = b.iter().map(|y| y.z).fold(f64::INFINITY, lesser);
            (
                about(rng).to_vec(),
                b.map(|y| y + up - low * DVec3::Z).to_vec(),
            )
        }
        NearestFeatures::CornerEdge => {
            let [p, q] = through(flat(rng).normalize());
            (vec![p, q, falling(rng)], vec![up, rising(rng), rising(rng)])
        }
        NearestFeatures::CornerCorner => (
            vec![DVec3::ZERO, falling(rng), falling(rng)],
            vec![up, rising(rng), rising(rng)],
        ),
    };
    Scene::new(a, b).in_random_frames(rng, 1.0)
}

/// Draws triangles that touch at a corner, along an edge, or within a common plane, but do not pierce each other.
pub(crate) fn touching_triangles(rng: &mut Pcg64) -> Scene {
    let flat = |x: f64, y: f64| DVec3::new(x, y, 0.0);
    let up = rng.random_range(0.1..1.0) * DVec3::Z;
    let base = vec![flat(0.0, 0.0), flat(1.0, 0.0), flat(0.0, 1.0)];
    let beside = flat(rng.random_range(-0.5..1.5), rng.random_range(-1.0..-0.1));
    let b = match rng.random_range(0..6) {
        // A corner on the inside, on an edge, on a corner.
        0 => vec![flat(0.3, 0.3), beside + up, flat(0.1, 0.2) + up],
        1 => vec![flat(0.5, 0.0), beside + up, beside + 2.0 * up + DVec3::X],
        2 => vec![flat(1.0, 0.0), beside + up, flat(2.0, 0.5) + up],
        // A whole edge, across and within the plane.
        3 => vec![flat(0.0, 0.0), flat(1.0, 0.0), beside + up],
        4 => vec![flat(0.0, 0.0), flat(1.0, 0.0), beside],
        // Overlapping within the plane.
        _ => vec![flat(0.2, 0.2), flat(0.9, 0.7), beside],
    };
    Scene::new(base, b)
}

/// Draws degenerate points, segments and triangles: coinciding corners, corners on one line, needles.
pub(crate) fn degenerate_pieces(rng: &mut Pcg64) -> Scene {
    let offset = rng.random_range(0.5..3.0) * random_vector(rng).normalize();
    let piece = |rng: &mut Pcg64| -> Vec<DVec3> {
        let (p, q) = (random_vector(rng), random_vector(rng));
        let between = p.lerp(q, rng.random_range(0.0..1.0));
        match rng.random_range(0..8) {
            0 => vec![p],
            1 => vec![p, q],
            2 => vec![p, p],
            3 => vec![p, p, p],
            4 => vec![p, q, q],
            5 => vec![p, q, between],
            6 => vec![p, q, between + 1e-9 * random_vector(rng)],
            _ => vec![p, q, q + 1e-9 * random_vector(rng)],
        }
    };
    let b = piece(rng).iter().map(|y| *y + offset).collect();
    Scene::new(piece(rng), b).in_random_frames(rng, 1.0)
}

/// Draws boxes at the distance `gap` whose faces are parallel up to a tilt below rounding.
pub(crate) fn stacked_boxes(rng: &mut Pcg64, gap: f64) -> Scene {
    let cuboid = |half: DVec3| -> Vec<DVec3> {
        let sign = |k: usize, bit: usize| if k >> bit & 1 == 1 { 1.0 } else { -1.0 };
        (0..8)
            .map(|k| half * DVec3::new(sign(k, 0), sign(k, 1), sign(k, 2)))
            .collect()
    };
    let turn = DQuat::from_rotation_z(rng.random_range(0.0..7.0));
    let tilt = DQuat::from_rotation_x(random_magnitude(rng, -16.0, -10.0));
    let b: Vec<DVec3> = cuboid(DVec3::new(0.4, 0.7, 0.5))
        .iter()
        .map(|y| tilt * turn * *y)
        .collect();
    let low = b.iter().map(|y| y.z).fold(f64::INFINITY, lesser);
    let lift = DVec3::new(rng.random_range(-0.9..0.9), 0.3, 1.0 + gap - low);
    let b = b.iter().map(|y| *y + lift).collect();
    Scene::new(cuboid(DVec3::ONE), b).in_random_frames(rng, 1.0)
}

/// Draws hulls of points on spheres, at a distance of about `gap`.
pub(crate) fn balls(rng: &mut Pcg64, count: usize, gap: f64) -> Scene {
    let ball = |rng: &mut Pcg64| -> Vec<DVec3> {
        (0..count)
            .map(|_| random_vector(rng).normalize_or(DVec3::X))
            .collect()
    };
    let (a, offset) = (ball(rng), (2.0 + gap) * random_vector(rng).normalize());
    let b = ball(rng).iter().map(|y| *y + offset).collect();
    Scene::new(a, b).in_random_frames(rng, 1.0)
}
