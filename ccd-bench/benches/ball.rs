//! Builds convex hulls of random points on a sphere.

use ccd_core::glam::DVec3;
use ccd_core::{HullTree, Pieces, Polytope};
use ccd_decomp::build_hull_tree;
use rand::RngExt;
use rand_pcg::Pcg64;

/// Returns the convex hull of `corners` random points on the unit sphere, as a hull tree.
pub(crate) fn random_sphere_point_hull(rng: &mut Pcg64, corners: usize) -> HullTree {
    let points: Vec<DVec3> = (0..corners).map(|_| random_direction(rng)).collect();
    let half = |points: &[DVec3]| Polytope {
        points: points.to_vec(),
        ..Polytope::default()
    };
    let (one, other) = points.split_at(corners / 2);
    let pieces = Pieces::from_polytopes(&[half(one), half(other)]).expect("points of a sphere");
    build_hull_tree(&pieces).expect("points of a sphere have a hull")
}

/// Returns a uniformly distributed unit vector.
pub(crate) fn random_direction(rng: &mut Pcg64) -> DVec3 {
    loop {
        let cube = DVec3::from_array([(); 3].map(|()| rng.random_range(-1.0..1.0)));
        if (0.01..1.0).contains(&cube.length_squared()) {
            return cube.normalize();
        }
    }
}
