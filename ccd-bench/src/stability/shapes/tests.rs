use super::*;
use ccd_core::order::greater;
use ccd_decomp::TopologyDefects;

#[test]
fn bodies_are_closed_and_of_the_volume_that_they_should_have() {
    let third = std::f64::consts::PI / 3.0;
    let cases = [
        (cuboid(1.0, 2.0, 3.0), 48.0, 1e-12),
        (ball(1.0, 5000), 4.0 * third, 0.01),
        (cone(300, 1.0), third, 0.001),
        // The bar ends with the last tooth.
        (comb(3), 1.0 - 0.2 + 0.4, 1e-12),
        (holed_plate(0.5), 0.2 * (36.0 - 1.0), 1e-12),
        (comb(64), 1.0 - 0.6 / 64.0 + 0.4, 1e-12),
        (slit_plate(0.5), 0.2 * 6.0 * 5.0, 1e-12),
        (sliver_slab(1e-6), 648.0, 1e-9),
    ];
    for (mesh, volume, slack) in cases {
        let topology = TopologyDefects::of(&mesh.unwrap());
        assert!(topology.is_solid() && topology.is_manifold(), "{topology}");
        assert!(
            (topology.signed_volume - volume).abs() <= slack,
            "{volume}: {topology:?}"
        );
    }
}

#[test]
fn a_sliver_is_as_thin_as_it_should_be() {
    let mesh = sliver_slab(1e-3).unwrap();
    let height = |face: &[u32; 3]| {
        let [a, b, c] = face.map(|v| mesh.vertices()[v as usize]);
        let sides = [b - a, c - b, a - c].map(DVec3::length);
        let longest = sides.into_iter().fold(0.0, greater);
        (b - a).cross(c - a).length() / longest
    };
    let thinnest = mesh.faces().iter().map(height).min_by(f64::total_cmp);
    let expected = 1e-3 * std::f64::consts::SQRT_2;
    assert!((thinnest.unwrap() - expected).abs() < 1e-9, "{thinnest:?}");
}

#[test]
fn cubes_in_a_field_are_turned_inside_out_one_by_one() {
    let field = cube_grid_half_inside_out(5).unwrap();
    assert_eq!(field.faces().len(), 60);
    let topology = TopologyDefects::of(&field);
    assert_eq!(topology.wrong_shells.count(), 2, "{topology:?}");
    assert!(field.vertices().iter().all(|p| p.z <= 0.0));
}

#[test]
fn a_ribbon_rises_by_its_pitch() {
    let ribbon = helicoid([0.9, 1.0], 0.2, 16, 3).unwrap();
    assert_eq!(ribbon.faces().len(), 96);
    let highest = ribbon.vertices().last().unwrap();
    assert!((highest - dvec3(1.0, 0.0, 0.6)).length() < 1e-15);
}

#[test]
fn bad_faces_are_repaired_or_kept_without_moving_the_surface() {
    let cube = cuboid(0.5, 0.5, 0.5).unwrap();
    let bad = with_bad_faces(&cube, 30).unwrap();
    assert_eq!(bad.vertices(), cube.vertices());
    let repairs = bad.repairs();
    assert!(!repairs.collapsed_faces.is_empty() && !repairs.duplicate_faces.is_empty());
}
