//! Makes scenes of bodies in free flight over a level, step by step.

use anyhow::Result;
use ccd_bench::scene::model::TorusKnot;
use ccd_core::glam::{DQuat, DVec3};
use ccd_decomp::{Detail, TriangleMesh, body_from_mesh};
use parry3d_f64::shape::SharedShape;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rigid_ccd::{Body, Motion, Pose};

/// A body, and the same shape for the peer library.
pub(crate) struct Shape {
    pub(crate) body: Body,
    pub(crate) peer: SharedShape,
}

/// The way in which the bodies start.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Kind {
    /// The bodies fall onto the level from above.
    Hail,
    /// The bodies fly low along the level.
    Skimming,
    /// The bodies fly from all sides to the middle.
    Implosion,
    /// The bodies start close to each other, and fly in all directions.
    Crowd,
    /// The bodies fall from above, ten times as fast as the others.
    Bullets,
}

pub(crate) const KINDS: [Kind; 5] = [
    Kind::Hail,
    Kind::Skimming,
    Kind::Implosion,
    Kind::Crowd,
    Kind::Bullets,
];

/// The duration of a step, in seconds.
pub(crate) const STEP: f64 = 1.0 / 60.0;

/// The number of squares along each side of the level, with two triangles each.
const CELLS: u32 = 119;

/// Half the length of a side of the level.
const HALF: f64 = 30.0;

/// Returns the level, hills of 28,322 triangles, followed by one shape of each kind of body.
pub(crate) fn shapes() -> Result<Vec<Shape>> {
    let row = CELLS + 1;
    let vertices = (0..row * row)
        .map(|k| {
            let [x, y] =
                [k % row, k / row].map(|n| HALF * (2.0 * f64::from(n) / f64::from(CELLS) - 1.0));
            DVec3::new(x, y, height(x, y))
        })
        .collect();
    let faces: Vec<[u32; 3]> = (0..CELLS * CELLS)
        .flat_map(|k| {
            let a = k / CELLS * row + k % CELLS;
            [[a, a + 1, a + row], [a + 1, a + row + 1, a + row]]
        })
        .collect();
    let knot = TorusKnot {
        segments: 36,
        sides: 8,
        tube: 0.35,
    }
    .mesh()?;
    let smaller = knot.vertices().iter().map(|&v| 0.25 * v).collect();
    let shape = |body, peer| Shape { body, peer };
    Ok(vec![
        of_mesh(&TriangleMesh::new(vertices, &faces)?)?,
        shape(Body::sphere(0.3)?, SharedShape::ball(0.3)),
        shape(
            Body::cuboid([0.3, 0.2, 0.4])?,
            SharedShape::cuboid(0.3, 0.2, 0.4),
        ),
        shape(Body::capsule(0.15, 0.4)?, SharedShape::capsule_z(0.4, 0.15)),
        of_mesh(&TriangleMesh::new(smaller, knot.faces())?)?,
    ])
}

fn of_mesh(mesh: &TriangleMesh) -> Result<Shape> {
    let peer = ccd_bench::method::peer::parry::double::shapes::tri_mesh(mesh)?;
    Ok(Shape {
        body: body_from_mesh(mesh, Detail::Auto)?.body,
        peer: SharedShape::new(peer),
    })
}

fn height(x: f64, y: f64) -> f64 {
    1.5 * (0.31 * x).sin() * (0.27 * y).cos() + 0.3 * (1.7 * x + 0.9 * y).sin()
}

/// Bodies at constant velocities: the index of the shape, position, orientation, velocity and angular velocity of each.
pub(crate) struct Flight(Vec<(usize, DVec3, DQuat, DVec3, DVec3)>);

impl Flight {
    pub(crate) fn new(kind: Kind, count: usize, shapes: usize, seed: u64) -> Self {
        let mut rng = Pcg64::seed_from_u64(seed);
        let mut any =
            |size: f64| DVec3::from_array(std::array::from_fn(|_| rng.random_range(-size..size)));
        let body = |k: usize| {
            let (place, way) = (any(1.0), any(1.0));
            let wide = place * DVec3::new(20.0, 20.0, 0.0);
            let ground = height(wide.x, wide.y) * DVec3::Z;
            let (place, velocity) = match kind {
                Kind::Hail => (
                    wide + DVec3::Z * (4.0 + 2.0 * place.z),
                    way * 5.0 - 20.0 * DVec3::Z,
                ),
                Kind::Skimming => (
                    wide + ground + DVec3::Z * (1.2 + 0.5 * place.z),
                    way * DVec3::new(20.0, 20.0, 1.0),
                ),
                Kind::Implosion => (
                    place.normalize() * 10.0 + 14.0 * DVec3::Z,
                    -20.0 * place.normalize() + way,
                ),
                Kind::Crowd => (place * 4.0 + 9.0 * DVec3::Z, way * 10.0),
                Kind::Bullets => (
                    wide + DVec3::Z * (24.0 + 20.0 * place.z),
                    way * 30.0 - 200.0 * DVec3::Z,
                ),
            };
            let spin = any(10.0);
            (
                1 + k % (shapes - 1),
                place,
                DQuat::from_scaled_axis(any(3.0)),
                velocity,
                spin,
            )
        };
        Flight((0..count).map(body).collect())
    }

    /// Returns the index of each body's shape, and the body's motion in a step.
    pub(crate) fn step(&self, step: u32) -> Result<Vec<(usize, Motion)>> {
        let time = STEP * f64::from(step);
        let motion =
            |&(shape, place, rotation, velocity, spin): &(usize, DVec3, DQuat, DVec3, DVec3)| {
                let turned = DQuat::from_scaled_axis(time * spin) * rotation;
                let start = Pose::new(place + time * velocity, turned)?;
                Ok((shape, Motion::new(start, velocity, spin)?))
            };
        self.0.iter().map(motion).collect()
    }
}
