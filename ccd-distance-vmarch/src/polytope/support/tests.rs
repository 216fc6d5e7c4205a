//! Tests that hill climbing finds corners as high as a scan does.

use super::{
    CUBE_MAP_SQUARE_COUNT, StartVertexTable, square_center_direction, square_index_towards,
};
use crate::tests::setting::{cube, prepared_polytope};
use crate::tests::shape::{self, Pcg64, SeedableRng, random_direction};
use ccd_core::glam::DVec3;
use ccd_core::order::greater;

#[test]
fn directions_are_in_the_square_whose_center_is_near() {
    for square in 0..CUBE_MAP_SQUARE_COUNT {
        for scale in [1e-150, 1.0, 1e150] {
            assert_eq!(
                square_index_towards(square_center_direction(square) * scale),
                square
            );
        }
    }
    let mut rng = Pcg64::seed_from_u64(1);
    for _ in 0..10_000 {
        let look = random_direction(&mut rng);
        let angle = look.angle_between(square_center_direction(square_index_towards(look)));
        // The angle of half the diagonal of a square in the middle of a side.
        assert!(angle <= 0.36, "{angle}");
    }
    for nonsense in [DVec3::NAN, DVec3::ZERO, DVec3::INFINITY] {
        assert!(square_index_towards(nonsense) < CUBE_MAP_SQUARE_COUNT);
    }
}

#[test]
fn hill_climbing_finds_an_extremal_corner() {
    let mut rng = Pcg64::seed_from_u64(2);
    for shape in [
        shape::uv_sphere(9, 16),
        shape::prism(40),
        shape::random_hull(&mut rng, 40),
    ] {
        let polytope = prepared_polytope(&shape);
        assert!(polytope.start_vertex_table.is_some());
        for _ in 0..2_000 {
            let look = random_direction(&mut rng);
            let height = |v: &super::super::Vertex| look.dot(v.point);
            let highest = polytope.vertices.iter().map(height).fold(f64::MIN, greater);
            let found = polytope.vertex(polytope.extremal_vertex(look));
            assert!(height(found) >= highest - 1e-15);
        }
    }
    assert!(StartVertexTable::new(&cube()).0.iter().all(|&v| v < 8));
}
