//! Random queries of many kinds: bodies from balls to knots, motions from none to many turns. Each query is determined
//! by a number.

use crate::models::{
    PieceKind, blob, boulder, comb, cuboid, icosphere, l_prism, needles, rod, torus, torus_knot,
};
use ccd_core::glam::{DQuat, DVec3};
use ccd_core::{Body, Motion, MovingBody, Pose, Settings, StartPolicy};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// The bodies to which all queries refer.
pub struct MixedBodies {
    bodies: Vec<Body>,
}

/// A query that refers to the bodies of a [`MixedBodies`] by index.
#[derive(Clone, Debug)]
pub struct MixedQuery {
    /// The indices of bodies A and B.
    pub bodies: [usize; 2],
    /// The motions of bodies A and B.
    pub motions: [Motion; 2],
    /// The settings of the query.
    pub config: Settings,
}

impl MixedBodies {
    /// Creates the bodies to which all queries refer.
    pub fn new() -> Self {
        let cube = || cuboid(DVec3::splat(0.5));
        let shapes = vec![
            (cube(), PieceKind::Triangles),
            (cube(), PieceKind::Hull),
            (rod(1.5, 0.1), PieceKind::Hull),
            (l_prism(), PieceKind::Patches),
            (comb(6), PieceKind::Triangles),
            (needles(20, 1e-3), PieceKind::Triangles),
            (icosphere(0.6, 1), PieceKind::Hull),
            (icosphere(0.6, 3), PieceKind::Triangles),
            (torus(0.7, 0.2, 24, 12), PieceKind::Triangles),
            (torus_knot(60, 6), PieceKind::Triangles),
            (blob(2), PieceKind::Triangles),
            (boulder(2, 0.3, 7), PieceKind::Triangles),
        ];
        let bodies = shapes.iter().map(|(shape, kind)| shape.body(*kind));
        MixedBodies {
            bodies: bodies.collect(),
        }
    }

    /// Returns the query that `number` determines, as a random seed.
    pub fn query(&self, number: u64) -> MixedQuery {
        let mut rng = Pcg64::seed_from_u64(number);
        let mut body = || rng.random_range(0..self.bodies.len());
        let bodies = [body(), body()];
        let motions = [0.0, 3.0].map(|apart| random_motion(&mut rng, apart));
        let config = Settings {
            tolerance: 10f64.powi(-rng.random_range(2..=7)),
            margin: if rng.random_bool(0.2) { 0.05 } else { 0.0 },
            start_policy: if rng.random_bool(0.1) {
                StartPolicy::Leave
            } else {
                StartPolicy::Report
            },
            ..Settings::DEFAULT
        };
        MixedQuery {
            bodies,
            motions,
            config,
        }
    }

    /// Returns body A (`which` is 0) or B (1) of a query, with its motion.
    pub fn moving_body(&self, query: &MixedQuery, which: usize) -> MovingBody<'_> {
        (&self.bodies[query.bodies[which]], query.motions[which]).into()
    }
}

impl Default for MixedBodies {
    fn default() -> Self {
        MixedBodies::new()
    }
}

/// Returns a random motion that starts near `apart` on the x axis, and in most cases flies towards the origin.
fn random_motion(rng: &mut Pcg64, apart: f64) -> Motion {
    let mut vector = |size: f64| DVec3::from_array([0; 3].map(|_| rng.random_range(-size..=size)));
    let (place, axis) = (apart * DVec3::X + vector(0.8), vector(1.0));
    let towards = -place + vector(2.0);
    let (turned, spin) = (vector(3.0), axis.normalize_or_zero());
    let turns = match rng.random_range(0..10) {
        0..3 => 0.0,
        3..9 => rng.random_range(0.0..4.0),
        _ => rng.random_range(0.0..60.0),
    };
    let speed = if rng.random_bool(0.1) { 0.0 } else { 1.0 };
    let pose = Pose::new(place, DQuat::from_scaled_axis(turned)).expect("finite");
    Motion::new(pose, speed * towards, turns * spin).expect("finite")
}
