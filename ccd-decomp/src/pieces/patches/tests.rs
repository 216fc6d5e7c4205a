use super::*;
use crate::solid::solid_surface;
use crate::solid::topology::TopologyDefects;
use crate::test_meshes::{
    block_cells, cubes, merged_meshes, mesh_with_reversed_faces, prism, prism_under_prism,
    scaled_and_moved, star_bipyramid, tetrahedron, toothed_quadrant_outline,
};
use ccd_core::FacetOrigin;
use ccd_core::glam::DVec3;
use rstest::rstest;

const ORDERS: [PatchOrder; 3] = [
    PatchOrder::Cresting,
    PatchOrder::BreadthFirst,
    PatchOrder::DepthFirst,
];

/// Checks that every triangle is in exactly one patch, and that the facets of a patch name as many faces as the patch
/// has.
fn check(mesh: &TriangleMesh, decomposition: &Decomposition) {
    let mut seen = vec![0; mesh.faces().len()];
    for patch in &decomposition.patches {
        patch.faces.iter().for_each(|&f| seen[f as usize] += 1);
        let polytope = &patch.polytope;
        let whole = polytope
            .facets
            .iter()
            .filter(|f| matches!(f.origin, FacetOrigin::Face(_)));
        assert_eq!(whole.count() + polytope.faces.len(), patch.faces.len());
        assert!(polytope.facets.len() >= 2);
        let virtual_facets = polytope
            .facets
            .iter()
            .filter(|f| f.origin == FacetOrigin::Virtual);
        assert_eq!(virtual_facets.count(), patch.virtual_facet_count());
    }
    assert!(seen.iter().all(|&count| count == 1), "{seen:?}");
}

fn patch_counts(mesh: &TriangleMesh) -> Vec<usize> {
    let count = |&order: &PatchOrder| {
        let decomposition = decompose(mesh, order).unwrap();
        check(mesh, &decomposition);
        decomposition.patches.len()
    };
    ORDERS.iter().map(count).collect()
}

#[rstest]
#[case::tetrahedron(tetrahedron())]
#[case::cube(cubes(&block_cells([1, 1, 1])))]
#[case::fine_block(cubes(&block_cells([4, 3, 5])))]
fn convex_solids_are_one_patch(#[case] mesh: TriangleMesh) {
    assert_eq!(patch_counts(&mesh), [1, 1, 1]);
    assert_eq!(
        decompose(&mesh, PatchOrder::Cresting).unwrap().patches[0].virtual_facet_count(),
        0
    );
}

#[test]
fn a_step_is_a_few_patches() {
    let step = cubes(&[[0, 0, 0], [1, 0, 0], [0, 0, 1]]);
    assert!(
        patch_counts(&step).iter().all(|&n| (2..=6).contains(&n)),
        "{:?}",
        patch_counts(&step)
    );
}

#[test]
fn the_walls_of_a_cavity_are_flat_patches() {
    let outer = scaled_and_moved(&cubes(&block_cells([1, 1, 1])), 4.0, DVec3::ZERO);
    let inner = scaled_and_moved(&cubes(&block_cells([1, 1, 1])), 2.0, DVec3::ONE);
    let hollow = merged_meshes(&[&outer, &mesh_with_reversed_faces(&inner)]);
    for order in ORDERS {
        let decomposition = decompose(&hollow, order).unwrap();
        check(&hollow, &decomposition);
        let walls = decomposition.patches.iter().filter(|p| p.faces[0] >= 12);
        for wall in walls {
            assert_eq!(wall.polytope.facets.len(), 2);
            assert_eq!(wall.virtual_facet_count(), 1);
            assert_eq!(wall.polytope.points.len(), 4);
        }
    }
}

#[test]
fn the_same_mesh_gives_the_same_patches() {
    let mesh = cubes(&[[0, 0, 0], [1, 0, 0], [1, 1, 0], [1, 1, 1], [2, 1, 1]]);
    for order in ORDERS {
        let once = decompose(&mesh, order).unwrap();
        let twice = decompose(&mesh, order).unwrap();
        let faces = |d: &Decomposition| {
            d.patches
                .iter()
                .map(|p| p.faces.clone())
                .collect::<Vec<_>>()
        };
        assert_eq!(faces(&once), faces(&twice));
    }
}

/// Returns the winding number of a surface about a point, by the solid angles of its triangles.
fn winding_number(mesh: &TriangleMesh, point: DVec3) -> f64 {
    let angle = |face: &[u32; 3]| {
        let [a, b, c] = face.map(|v| mesh.vertices()[v as usize] - point);
        let [x, y, z] = [a, b, c].map(DVec3::length);
        let below = x * y * z + a.dot(b) * z + b.dot(c) * x + c.dot(a) * y;
        2.0 * a.dot(b.cross(c)).atan2(below)
    };
    mesh.faces().iter().map(angle).sum::<f64>() / (4.0 * std::f64::consts::PI)
}

/// Returns 200 points spread inside the convex hull of the given corners.
fn inner_points(corners: &[DVec3]) -> impl Iterator<Item = DVec3> {
    (1..=200).map(|k| {
        let weight = |corner: usize| {
            (f64::from(k) * (corner as f64 + 2.0).sqrt())
                .fract()
                .powi(3)
        };
        let weights: Vec<f64> = (0..corners.len()).map(weight).collect();
        let sum: DVec3 = corners.iter().zip(&weights).map(|(&p, &w)| p * w).sum();
        sum / weights.iter().sum::<f64>()
    })
}

/// Tests that several solids have the expected number of patches, and that the patches' hulls lie inside the solid.
/// More patches are a regression.
#[rstest]
#[case::prism_under_prism(prism_under_prism(12), 2)]
#[case::star(star_bipyramid(9, 0.4), 4)]
#[case::teeth(prism(&toothed_quadrant_outline(7)), 7)]
#[case::stairs(cubes(&[[0, 0, 0], [1, 0, 0], [1, 1, 0], [1, 1, 1], [2, 1, 1]]), 4)]
#[case::ring(cubes(&[[0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 1, 0], [2, 1, 0], [0, 2, 0], [1, 2, 0], [2, 2, 0]]), 4)]
#[case::wide_and_narrow(cubes(&[[0, 0, 0], [1, 0, 0], [2, 0, 0], [3, 0, 0], [1, 0, 1], [2, 0, 1], [2, 0, 2], [2, 1, 2]]), 3)]
fn patches_are_few_and_within_the_solid(#[case] mesh: TriangleMesh, #[case] count: usize) {
    assert_eq!(patch_counts(&mesh), [count; 3]);
    let mut thick = 0;
    for order in ORDERS {
        let decomposition = decompose(&mesh, order).unwrap();
        check(&mesh, &decomposition);
        for patch in &decomposition.patches {
            if patch.polytope.facets.len() <= 2 {
                continue;
            }
            for point in inner_points(&patch.polytope.points) {
                let winding = winding_number(&mesh, point);
                assert!(winding > 0.9, "{order:?}: {point} of {patch:?}, {winding}");
            }
            thick += 1;
        }
    }
    assert!(thick > 3, "{thick}");
}

/// Tests that patches on the flank of a cone of many polygons have at most `MAX_PATCH_POLYGONS` polygons of the flank.
#[test]
fn patches_are_capped() {
    let count = 4 * MAX_PATCH_POLYGONS as u32;
    let angle = |k: u32| std::f64::consts::TAU * f64::from(k) / f64::from(count);
    let rim = |radius: f64, z: f64| {
        (0..count).map(move |k| DVec3::new(radius * angle(k).cos(), radius * angle(k).sin(), z))
    };
    let rims = rim(1.0, 0.0).chain(rim(2.0, 0.0)).chain(rim(2.0, -1.0));
    let vertices: Vec<DVec3> = rims.chain([DVec3::Z, -DVec3::Z]).collect();
    let (apex, foot) = (3 * count, 3 * count + 1);
    let faces: Vec<[u32; 3]> = (0..count)
        .flat_map(|k| {
            let next = (k + 1) % count;
            let wall = |lower: u32, upper: u32| {
                [
                    [lower + k, lower + next, upper + next],
                    [lower + k, upper + next, upper + k],
                ]
            };
            let ([a, b], [c, d]) = (wall(count, 0), wall(2 * count, count));
            [
                [k, next, apex],
                a,
                b,
                c,
                d,
                [2 * count + next, 2 * count + k, foot],
            ]
        })
        .collect();
    let cone = crate::test_meshes::mesh(vertices, &faces);
    let decomposition = decompose(&cone, PatchOrder::Cresting).unwrap();
    check(&cone, &decomposition);
    let largest = decomposition.patches.iter().map(|p| p.faces.len()).max();
    assert!(largest >= Some(MAX_PATCH_POLYGONS), "{largest:?}");
    let flank = |f: u32| f.is_multiple_of(6);
    let of_flank = decomposition.patches.iter().filter(|p| flank(p.faces[0]));
    let most = of_flank
        .map(|p| p.faces.iter().filter(|&&f| flank(f)).count())
        .max();
    assert!(most <= Some(MAX_PATCH_POLYGONS), "{most:?}");
}

/// Tests that a star-shaped bipyramid is decomposed in work linear in the number of patches, which all share two
/// apices.
#[test]
fn patches_of_slivers_take_linear_work() {
    for corners in [100, 1_000, 10_000] {
        let mesh = star_bipyramid(corners, 0.5);
        let manifold = solid_surface(&mesh).unwrap();
        let flats = ConvexPolygons::new(&manifold);
        let work = WorkBudget::with_steps(1_000 * u64::from(corners));
        let decomposition =
            patches_from_polygons(&manifold, &flats, PatchOrder::default(), &work).unwrap();
        check(&mesh, &decomposition);
        assert_eq!(decomposition.patches.len(), corners as usize / 2);
    }
}

/// Tests that decomposition takes fewer than 8,000 steps per face, for solids with up to 5,000 teeth or slivers.
#[test]
fn steps_per_face_stay_bounded() {
    for count in [50, 500, 5_000] {
        for mesh in [
            prism(&toothed_quadrant_outline(count)),
            prism_under_prism(count),
        ] {
            let manifold =
                Manifold::without_intersection_check(&mesh, &TopologyDefects::of(&mesh)).unwrap();
            let work = WorkBudget::unbounded();
            let flats = ConvexPolygons::new(&manifold);
            let found =
                patches_from_polygons(&manifold, &flats, PatchOrder::default(), &work).unwrap();
            check(&mesh, &found);
            let steps = work.steps_spent() / mesh.faces().len() as u64;
            assert!(steps < 8_000, "{count}: {steps}");
        }
    }
}
