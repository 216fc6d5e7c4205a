//! Makes bumpy, non-convex meshes of any size: stand-ins for scanned models.

use super::sphere::sphere;
use ccd_core::glam::DVec3;
use ccd_core::order::greater;
use ccd_decomp::{MeshError, TriangleMesh};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use std::f64::consts::TAU;

/// A sphere pushed outwards by lobes and covered with ripples, scaled to bounding radius 1.
///
/// Every ray from the origin crosses the surface once, so that it never intersects itself.
#[derive(Clone, Copy, Debug)]
pub struct Blob {
    /// The large bumps, on a core of radius 1.
    lobes: &'static [Lobe],
    /// The height of the ripples, relative to the core's radius.
    ripple_height: f64,
    /// The random seed of the ripples.
    seed: u64,
}

/// A smooth bump on the sphere of a [`Blob`]: its direction, of any length; its height above the core; and its
/// sharpness, which makes it about `1/√sharpness` radians wide.
type Lobe = ([f64; 3], f64, f64);

impl Blob {
    /// A bunny with head, two ears, tail and paws, about as non-convex as the scanned one.
    pub const BUNNY: Blob = Blob {
        lobes: &[
            ([-0.7, 0.5, 0.0], 0.5, 6.0),
            ([-0.25, 1.0, 0.3], 1.1, 40.0),
            ([-0.25, 1.0, -0.3], 1.1, 40.0),
            ([1.0, -0.3, 0.0], 0.3, 25.0),
            ([-0.5, -0.8, 0.5], 0.4, 15.0),
            ([-0.5, -0.8, -0.5], 0.4, 15.0),
            ([0.6, -0.8, 0.0], 0.4, 8.0),
        ],
        ripple_height: 0.012,
        seed: 70,
    };

    /// A Santa with hat, sack, arms and boots, about as non-convex as the scanned one.
    pub const SANTA: Blob = Blob {
        lobes: &[
            ([0.0, 0.1, 1.0], 1.2, 20.0),
            ([1.0, 0.2, 0.2], 0.9, 30.0),
            ([-1.0, 0.2, 0.2], 0.9, 30.0),
            ([0.0, -1.0, 0.5], 0.7, 5.0),
            ([0.4, 0.1, -1.0], 0.8, 20.0),
            ([-0.4, 0.1, -1.0], 0.8, 20.0),
        ],
        ripple_height: 0.015,
        seed: 38,
    };

    /// Returns the closed mesh with this number of vertices, at least 12, and `2 · vertices − 4`
    /// triangles.
    ///
    /// # Errors
    /// If the number of vertices is too small or too large for a mesh.
    pub fn mesh(&self, vertices: usize) -> Result<TriangleMesh, MeshError> {
        let (mut points, faces) = sphere(vertices);
        let ripples = self.ripples();
        for point in &mut points {
            *point *= self.radius(*point, &ripples);
        }
        let bounding_radius = points.iter().map(|p| p.length()).fold(0.0, greater);
        for point in &mut points {
            *point /= bounding_radius;
        }
        TriangleMesh::new(points, &faces)
    }

    /// Returns the distance of the surface from the origin in a direction: a sum of terms that are smooth over the
    /// sphere.
    fn radius(&self, direction: DVec3, ripples: &[Ripple]) -> f64 {
        let lobes: f64 = self
            .lobes
            .iter()
            .map(|&(towards, height, sharpness)| {
                let towards = DVec3::from(towards).normalize();
                height * (sharpness * (direction.dot(towards) - 1.0)).exp()
            })
            .sum();
        let waves: f64 = ripples
            .iter()
            .map(|r| (r.wave_vector.dot(direction) + r.phase).sin())
            .sum();
        1.0 + lobes + self.ripple_height * waves
    }

    fn ripples(&self) -> Vec<Ripple> {
        let mut rng = Pcg64::seed_from_u64(self.seed);
        (0..RIPPLE_COUNT)
            .map(|_| {
                let [x, y, z, phase] = std::array::from_fn(|_| rng.random_range(-1.0..1.0));
                Ripple {
                    wave_vector: MAX_WAVE_NUMBER * DVec3::new(x, y, z),
                    phase: TAU * phase,
                }
            })
            .collect()
    }
}

/// A plane wave in space, evaluated on the sphere.
struct Ripple {
    wave_vector: DVec3,
    phase: f64,
}

/// The number of plane waves that add up to the ripples.
const RIPPLE_COUNT: usize = 24;
/// The highest wave number along each axis, in radians per core radius.
const MAX_WAVE_NUMBER: f64 = 20.0;
