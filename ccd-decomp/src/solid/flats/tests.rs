use super::*;
use crate::mesh::TriangleMesh;
use crate::solid::topology::TopologyDefects;
use crate::solid::{check_solid, solid_surface};
use crate::test_meshes::{block_cells, cubes, merged_meshes, mesh, scaled_and_moved, tetrahedron};
use crate::work::WorkBudget;
use ccd_core::glam::DVec3;
use rstest::rstest;

fn convex_polygons(mesh: &TriangleMesh) -> ConvexPolygons {
    ConvexPolygons::new(&solid_surface(mesh).unwrap())
}

#[rstest]
#[case::one([1, 1, 1])]
#[case::slab([5, 4, 1])]
#[case::cube([4, 4, 4])]
fn sides_of_a_block_are_one_polygon_each(#[case] size: [i32; 3]) {
    let mesh = cubes(&block_cells(size));
    let flats = convex_polygons(&mesh);
    assert_eq!(flats.len(), 6);
    let faces: usize = (0..6).map(|k| flats.get(k).faces.len()).sum();
    assert_eq!(faces, mesh.faces().len());
    assert!((0..6).all(|k| flats.get(k).corners.len() == 4));
}

#[test]
fn triangles_in_no_common_plane_stay_alone() {
    assert_eq!(convex_polygons(&tetrahedron()).len(), 4);
}

#[test]
fn polygons_are_convex_and_leave_nothing_out() {
    // A plate with a hole: 8 cells about a missing one.
    let cells: Vec<[i32; 3]> = block_cells([3, 3, 1])
        .into_iter()
        .filter(|c| *c != [1, 1, 0])
        .collect();
    let mesh = cubes(&cells);
    let manifold = solid_surface(&mesh).unwrap();
    let flats = ConvexPolygons::new(&manifold);
    let mut area = 0.0;
    for k in 0..flats.len() as u32 {
        let flat = flats.get(k);
        let at = |i: usize| manifold.point(flat.corners[i % flat.corners.len()]);
        let plane = Projection::new(manifold.triangle(flat.faces[0])).unwrap();
        for i in 0..flat.corners.len() {
            assert_eq!(plane.turn(at(i), at(i + 1), at(i + 2)), Ordering::Greater);
        }
        area += (1..flat.corners.len() - 1)
            .map(|i| 0.5 * (at(i) - at(0)).cross(at(i + 1) - at(0)).length())
            .sum::<f64>();
        assert!(flat.faces.iter().all(|&f| flats.polygon_of_face(f) == k));
    }
    assert_eq!(area, 2.0 * 8.0 + 12.0 + 4.0);
    // Four outer and four inner sides, and at least four polygons about the hole above and below.
    assert!((16..=24).contains(&flats.len()), "{}", flats.len());
}

/// Tests that a plate with a hole merges to 16 rectangles, whatever the order of its faces.
#[test]
fn a_grid_with_a_hole_is_a_few_rectangles() {
    let cells = block_cells([9, 9, 1])
        .into_iter()
        .filter(|c| *c != [4, 5, 0]);
    let mesh = cubes(&cells.collect::<Vec<_>>());
    for stride in [1, 7, 101] {
        let count = mesh.faces().len();
        let faces: Vec<[u32; 3]> = (0..count)
            .map(|k| mesh.faces()[k * stride % count])
            .collect();
        assert!(
            !count.is_multiple_of(7) && !count.is_multiple_of(101),
            "all are taken"
        );
        let shuffled = crate::test_meshes::mesh(mesh.vertices().to_vec(), &faces);
        let flats = convex_polygons(&shuffled);
        // Four about the hole above and below, four sides outside and four within.
        assert_eq!(flats.len(), 4 + 4 + 4 + 4, "{stride}");
    }
}

/// Tests that no polygons are merged over a fold: triangles back to back, or a flat tetrahedron, each next to a
/// solid.
#[test]
fn folds_are_no_polygons() {
    let back_to_back = mesh(
        vec![DVec3::ZERO, DVec3::X, DVec3::Y],
        &[[0, 1, 2], [0, 2, 1]],
    );
    let corners = vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::X + DVec3::Y];
    let flat = mesh(corners, &[[0, 1, 2], [1, 3, 2], [0, 2, 3], [0, 3, 1]]);
    let beside = |part: &TriangleMesh| {
        merged_meshes(&[&scaled_and_moved(&tetrahedron(), 1.0, 5.0 * DVec3::X), part])
    };
    let cases = [
        (back_to_back.clone(), 2),
        (flat.clone(), 2),
        (beside(&back_to_back), 6),
        (beside(&flat), 6),
    ];
    for (mesh, polygons) in cases {
        let manifold =
            Manifold::without_intersection_check(&mesh, &TopologyDefects::of(&mesh)).unwrap();
        assert_eq!(ConvexPolygons::new(&manifold).len(), polygons);
        assert!(check_solid(&manifold, &WorkBudget::unbounded()).is_err());
    }
}
