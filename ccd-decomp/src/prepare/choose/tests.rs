use super::*;
use crate::solid::manifold::Dihedral;
use crate::solid::solid_surface;
use crate::test_meshes::{block_cells, cubes, merged_meshes, scaled_and_moved, tetrahedron};
use crate::tolerance::AUTO_WORK_BUDGET;
use ccd_core::glam::DVec3;

fn chosen_reason(mesh: &TriangleMesh) -> PieceReason {
    let (parts, why) = choose_pieces(
        mesh,
        &TopologyDefects::of(mesh),
        &WorkBudget::with_steps(AUTO_WORK_BUDGET),
    );
    let fits = match why {
        PieceReason::Convex => matches!(parts, PiecesOfOneKind::Hull(_)),
        PieceReason::PatchesFaster(_) => matches!(parts, PiecesOfOneKind::Patches(_)),
        _ => matches!(parts, PiecesOfOneKind::Triangles),
    };
    assert!(fits, "{why}");
    why
}

#[test]
fn convex_solids_are_hulls() {
    assert_eq!(chosen_reason(&tetrahedron()), PieceReason::Convex);
    assert_eq!(
        chosen_reason(&cubes(&block_cells([3, 3, 3]))),
        PieceReason::Convex
    );
}

/// Tests that patches are chosen for a solid whose planar parts have many triangles, and triangles if the planar parts
/// have few.
#[test]
fn patches_have_to_be_worth_it() {
    let coarse = cubes(&[[0, 0, 0], [1, 0, 0], [0, 0, 1]]);
    assert!(matches!(
        chosen_reason(&coarse),
        PieceReason::TrianglesFaster(_)
    ));
    let in_corner = |c: &[i32; 3]| c[0] >= 8 && c[2] >= 8;
    let cells = block_cells([16, 16, 16])
        .into_iter()
        .filter(|c| !in_corner(c));
    let fine = cubes(&cells.collect::<Vec<_>>());
    assert!(
        matches!(chosen_reason(&fine), PieceReason::PatchesFaster(_)),
        "{}",
        chosen_reason(&fine)
    );
}

#[test]
fn the_largest_plane_is_found_whole() {
    // The bottom of a step: 3 × 2 squares.
    let cells: Vec<_> = block_cells([3, 2, 2])
        .into_iter()
        .filter(|c| *c != [2, 0, 1])
        .collect();
    let mesh = cubes(&cells);
    let manifold = solid_surface(&mesh).unwrap();
    let plane = RegionMerger::merge_all_regions(&manifold).largest_planar_region_size();
    assert_eq!(plane.triangle_count, 12);
    assert_eq!(plane.polygon_count, 1);
}

/// Returns the size of the largest planar part, by a walk over adjacent coplanar polygons.
fn largest_region_size_by_walk(manifold: &Manifold<'_>) -> PlanarRegionSize {
    let flats = RegionMerger::merge_all_regions(manifold).into_polygons();
    let mut seen = vec![false; flats.len()];
    let mut largest = PlanarRegionSize::default();
    for seed in 0..flats.len() as u32 {
        let (mut plane, mut stack) = (PlanarRegionSize::default(), vec![seed]);
        while let Some(flat) = stack.pop() {
            if std::mem::replace(&mut seen[flat as usize], true) {
                continue;
            }
            let flat = flats.get(flat);
            plane.triangle_count += flat.faces.len();
            plane.polygon_count += 1;
            let level = flat
                .rim
                .iter()
                .filter(|&&h| manifold.classify_dihedral(h) == Dihedral::Coplanar);
            stack.extend(level.map(|&h| flats.polygon_of_face(manifold.twin(h) / 3)));
        }
        largest = largest.max(plane);
    }
    largest
}

#[test]
fn the_largest_plane_is_that_of_a_walk() {
    let comb = block_cells([9, 2, 3])
        .into_iter()
        .filter(|c| c[2] == 0 || c[0] % 2 == 0);
    let plate = block_cells([3, 3, 1])
        .into_iter()
        .filter(|c| *c != [1, 1, 0]);
    let solids = [
        cubes(&comb.collect::<Vec<_>>()),
        cubes(&plate.collect::<Vec<_>>()),
        tetrahedron(),
    ];
    for mesh in &solids {
        let manifold = solid_surface(mesh).unwrap();
        let plane = RegionMerger::merge_all_regions(&manifold).largest_planar_region_size();
        assert_eq!(plane, largest_region_size_by_walk(&manifold));
    }
}

#[test]
fn meshes_without_a_solid_stay_triangles() {
    let one = tetrahedron();
    let pierced = merged_meshes(&[&one, &scaled_and_moved(&one, 1.0, DVec3::splat(0.2))]);
    assert!(matches!(
        chosen_reason(&pierced),
        PieceReason::TrianglesFaster(_) | PieceReason::OnlyTrianglesExact(_)
    ));
    let open = crate::test_meshes::mesh(one.vertices().to_vec(), &one.faces()[1..]);
    let PieceReason::OnlyTrianglesExact(error) = chosen_reason(&open) else {
        panic!("an open mesh bounds no solid");
    };
    assert!(error.to_string().contains("edges with one face"));
}

#[test]
fn slow_decompositions_stay_triangles() {
    let in_corner = |c: &[i32; 3]| c[0] >= 8 && c[2] >= 8;
    let cells = block_cells([16, 16, 16])
        .into_iter()
        .filter(|c| !in_corner(c));
    let mesh = cubes(&cells.collect::<Vec<_>>());
    for steps in [1, 1000] {
        let (parts, why) = choose_pieces(
            &mesh,
            &TopologyDefects::of(&mesh),
            &WorkBudget::with_steps(steps),
        );
        assert_eq!(why, PieceReason::WorkBudgetExceeded);
        assert!(matches!(parts, PiecesOfOneKind::Triangles));
    }
}

/// Tests that triangles are chosen for folded meshes, whose edges all have two faces although they bound no solid.
#[test]
fn folded_meshes_stay_triangles() {
    let corners = vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::X + DVec3::Y];
    let faces = [[0, 1, 2], [1, 3, 2], [0, 2, 3], [0, 3, 1]];
    let flat = crate::test_meshes::mesh(corners.clone(), &faces);
    let two = crate::test_meshes::mesh(corners[..3].to_vec(), &[[0, 1, 2], [0, 2, 1]]);
    let solid = scaled_and_moved(&cubes(&block_cells([9, 9, 1])), 1.0, DVec3::splat(5.0));
    for mesh in [
        &flat,
        &two,
        &merged_meshes(&[&solid, &flat]),
        &merged_meshes(&[&solid, &two]),
    ] {
        assert!(matches!(
            chosen_reason(mesh),
            PieceReason::TrianglesFaster(_) | PieceReason::OnlyTrianglesExact(_)
        ));
    }
}
