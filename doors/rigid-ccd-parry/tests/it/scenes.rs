//! Makes random scenes of all shapes, with single-precision numbers, so that both precisions have exactly the same
//! scene.

use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// The numbers from which a shape is made, in either precision.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum ShapeSpec {
    Ball(f32),
    Cuboid([f32; 3]),
    RoundCuboid([f32; 3], f32),
    Capsule([f32; 3], [f32; 3], f32),
    Segment([[f32; 3]; 2]),
    Triangle([[f32; 3]; 3]),
    RoundTriangle([[f32; 3]; 3], f32),
    /// The hull of points, grown by a radius.
    Hull(Vec<[f32; 3]>, f32),
    Mesh(Vec<[f32; 3]>, Vec<[u32; 3]>),
    /// The heights by rows, the number of rows, and the scale.
    Heights(Vec<f32>, usize, [f32; 3]),
    /// The half height, the radius, and the radius by which the cylinder is grown.
    Cylinder(f32, f32, f32),
    Cone(f32, f32, f32),
    Voxels([f32; 3], Vec<[i32; 3]>),
    Polyline(Vec<[f32; 3]>),
    /// The parts, each with its position and quaternion.
    Compound(Vec<([f32; 3], [f32; 4], ShapeSpec)>),
}

/// The numbers from which a motion is made, in either precision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct MotionSpec {
    pub(crate) place: [f32; 3],
    /// The orientation, a unit quaternion up to rounding.
    pub(crate) turned: [f32; 4],
    pub(crate) center: [f32; 3],
    pub(crate) velocity: [f32; 3],
    pub(crate) spin: [f32; 3],
}

impl ShapeSpec {
    /// Returns the shape with all lengths multiplied by `by`, a power of two.
    pub(crate) fn scaled(self, by: f32) -> Self {
        let v = |v: [f32; 3]| v.map(|x| x * by);
        match self {
            ShapeSpec::Ball(r) => ShapeSpec::Ball(r * by),
            ShapeSpec::Cuboid(half) => ShapeSpec::Cuboid(v(half)),
            ShapeSpec::RoundCuboid(half, r) => ShapeSpec::RoundCuboid(v(half), r * by),
            ShapeSpec::Capsule(a, b, r) => ShapeSpec::Capsule(v(a), v(b), r * by),
            ShapeSpec::Segment(ends) => ShapeSpec::Segment(ends.map(v)),
            ShapeSpec::Triangle(corners) => ShapeSpec::Triangle(corners.map(v)),
            ShapeSpec::RoundTriangle(corners, r) => {
                ShapeSpec::RoundTriangle(corners.map(v), r * by)
            }
            ShapeSpec::Hull(points, r) => {
                ShapeSpec::Hull(points.into_iter().map(v).collect(), r * by)
            }
            ShapeSpec::Mesh(points, faces) => {
                ShapeSpec::Mesh(points.into_iter().map(v).collect(), faces)
            }
            ShapeSpec::Heights(heights, rows, scale) => ShapeSpec::Heights(heights, rows, v(scale)),
            ShapeSpec::Cylinder(half, r, border) => {
                ShapeSpec::Cylinder(half * by, r * by, border * by)
            }
            ShapeSpec::Cone(half, r, border) => ShapeSpec::Cone(half * by, r * by, border * by),
            ShapeSpec::Voxels(size, cells) => ShapeSpec::Voxels(v(size), cells),
            ShapeSpec::Polyline(points) => ShapeSpec::Polyline(points.into_iter().map(v).collect()),
            ShapeSpec::Compound(parts) => {
                let part = |(place, turned, inner): ([f32; 3], [f32; 4], ShapeSpec)| {
                    (v(place), turned, inner.scaled(by))
                };
                ShapeSpec::Compound(parts.into_iter().map(part).collect())
            }
        }
    }

    /// Returns the name of the shape's kind.
    pub(crate) fn name(&self) -> String {
        let text = format!("{self:?}");
        text.split('(').next().unwrap_or_default().to_owned()
    }
}

impl MotionSpec {
    /// Returns the motion with all lengths multiplied by `by`, a power of two.
    pub(crate) fn scaled(self, by: f32) -> Self {
        let v = |v: [f32; 3]| v.map(|x| x * by);
        MotionSpec {
            place: v(self.place),
            center: v(self.center),
            velocity: v(self.velocity),
            ..self
        }
    }
}

pub(crate) fn seeded_rng(seed: u64) -> Pcg64Mcg {
    Pcg64Mcg::seed_from_u64(seed)
}

pub(crate) fn number(rng: &mut impl Rng, low: f32, high: f32) -> f32 {
    low + (high - low) * rng.random::<f32>()
}

pub(crate) fn random_vector(rng: &mut impl Rng, size: f32) -> [f32; 3] {
    std::array::from_fn(|_| number(rng, -size, size))
}

pub(crate) fn turn(rng: &mut impl Rng) -> [f32; 4] {
    loop {
        let q: [f32; 4] = std::array::from_fn(|_| number(rng, -1.0, 1.0));
        let length = q.iter().map(|x| x * x).sum::<f32>().sqrt();
        if length > 0.1 && length < 1.0 {
            return q.map(|x| x / length);
        }
    }
}

/// The number of kinds of shapes.
pub(crate) const SHAPE_KIND_COUNT: u32 = 16;

/// Returns a random shape of a kind, of size about 1.
pub(crate) fn random_shape(rng: &mut impl Rng, kind: u32) -> ShapeSpec {
    let size = |rng: &mut _| number(rng, 0.1, 0.5);
    let points = |rng: &mut _| random_vector(rng, 0.5);
    match kind % SHAPE_KIND_COUNT {
        0 => ShapeSpec::Ball(size(rng)),
        1 => ShapeSpec::Cuboid([size(rng), size(rng), size(rng)]),
        2 => ShapeSpec::RoundCuboid([size(rng), size(rng), size(rng)], 0.3 * size(rng)),
        3 => ShapeSpec::Capsule(points(rng), points(rng), size(rng)),
        4 => ShapeSpec::Segment([points(rng), points(rng)]),
        5 => ShapeSpec::Triangle([points(rng), points(rng), points(rng)]),
        6 => ShapeSpec::RoundTriangle([points(rng), points(rng), points(rng)], 0.3 * size(rng)),
        7 => ShapeSpec::Hull((0..12).map(|_| points(rng)).collect(), 0.0),
        8 => ShapeSpec::Hull((0..12).map(|_| points(rng)).collect(), 0.3 * size(rng)),
        9 => random_torus(rng),
        10 => {
            let heights = (0..20).map(|_| number(rng, -0.2, 0.2)).collect();
            ShapeSpec::Heights(heights, 5, [1.5, 1.0, 1.0])
        }
        11 => ShapeSpec::Cylinder(size(rng), size(rng), [0.0, 0.1][rng.random_range(0..2)]),
        12 => ShapeSpec::Cone(size(rng), size(rng), [0.0, 0.1][rng.random_range(0..2)]),
        13 => {
            let cells = (0..9).map(|_| std::array::from_fn(|_| rng.random_range(-2..2)));
            ShapeSpec::Voxels([0.2, 0.3, 0.25], cells.collect())
        }
        14 => {
            let points = (0..5).map(|_| points(rng));
            ShapeSpec::Polyline(points.collect())
        }
        _ => {
            let part = |rng: &mut _| {
                // Composite shapes are refused by parry.
                let kind =
                    [0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 12, 13][number(rng, 0.0, 11.99) as usize];
                (random_vector(rng, 0.5), turn(rng), random_shape(rng, kind))
            };
            ShapeSpec::Compound((0..3).map(|_| part(rng)).collect())
        }
    }
}

/// Returns a torus of a few triangles; one in four is not closed.
fn random_torus(rng: &mut impl Rng) -> ShapeSpec {
    let (rings, sides) = (7, 5);
    let thick = number(rng, 0.1, 0.25);
    let vertex = |k: u32| {
        let angle = |k: u32, of: u32| std::f32::consts::TAU * k as f32 / of as f32;
        let (a, b) = (angle(k / sides, rings), angle(k % sides, sides));
        let out = 0.4 + thick * b.cos();
        [out * a.cos(), out * a.sin(), thick * b.sin()]
    };
    let at = |i: u32, j: u32| (i % rings) * sides + j % sides;
    let mut faces = Vec::new();
    for (i, j) in (0..rings).flat_map(|i| (0..sides).map(move |j| (i, j))) {
        faces.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
        faces.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
    }
    if rng.random_range(0..4) == 0 {
        faces.truncate(50);
    }
    ShapeSpec::Mesh((0..rings * sides).map(vertex).collect(), faces)
}

/// Returns two motions of bodies that start apart; in most cases the first one is aimed at the second one.
pub(crate) fn random_motions(rng: &mut impl Rng) -> [MotionSpec; 2] {
    let moves = |rng: &mut _, place, velocity| {
        let fast = [0.0, 3.0, 12.0][number(rng, 0.0, 2.99) as usize];
        MotionSpec {
            place,
            turned: turn(rng),
            center: random_vector(rng, 0.3),
            velocity,
            spin: random_vector(rng, fast),
        }
    };
    let start = turn(rng);
    let place = [start[0], start[1], start[2]].map(|x| 4.0 * x);
    let aside = random_vector(rng, 1.0);
    let velocity = std::array::from_fn(|k| aside[k] - place[k] * number(rng, 0.5, 1.5));
    let drift = random_vector(rng, 0.3);
    [moves(rng, place, velocity), moves(rng, [0.0; 3], drift)]
}
