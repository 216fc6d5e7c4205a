//! Scenes with simultaneous translation and rotation, or with other difficulties.

use super::{ExpectedOutcome, Scene};
use crate::models::{Mesh, PITCH, Shape, cuboid, nut_thread, screw};
use crate::query::MovingShape;
use ccd_core::glam::{DQuat, DVec3};
use ccd_core::{Motion, Pose};
use std::f64::consts::{PI, TAU};

pub(super) fn scenes() -> Vec<Scene> {
    let mut out = vec![
        screw_in_nut("T18 screw, right pitch", PITCH, 1),
        screw_in_nut("T18 screw, wrong pitch", 0.5 * PITCH, 1),
        degenerate_cube(),
        edge_sharing_cubes(),
        far_cuboids(),
        deep_overlap(),
        nested_cubes(
            "T24 nested solids",
            Shape::from_closed_mesh,
            ExpectedOutcome::Overlap,
        ),
        nested_cubes(
            "T24 nested surfaces",
            Shape::from_open_mesh,
            ExpectedOutcome::Free { gap: 1.5 },
        ),
        cubes_at_rest(),
    ];
    out.extend([0.0, 1e-12, PI].map(slowly_turning_cube));
    out
}

/// The depth of the screw's start below the origin, which is one pitch below the nut's bottom.
const SCREW_START_DEPTH: f64 = 1.05;

/// Returns T18: a screw that makes three turns in its nut and climbs by `pitch` in each turn.
pub fn screw_in_nut(name: &str, pitch: f64, fineness: usize) -> Scene {
    let turning = MovingShape::moving(
        screw(fineness),
        -SCREW_START_DEPTH * DVec3::Z,
        3.0 * pitch * DVec3::Z,
        3.0 * TAU * DVec3::Z,
    );
    // Turned ahead by the angle that corresponds to the screw's low start.
    let turned = DQuat::from_rotation_z(SCREW_START_DEPTH / PITCH * TAU);
    let still = MovingShape::still(
        nut_thread(0.1, fineness).placed(turned, DVec3::ZERO),
        DVec3::ZERO,
    );
    Scene::new(name, [turning, still], ExpectedOutcome::Unknown)
}

/// Returns T21: T1 with a cube that has faces of no area, repeated faces and reversed faces.
fn degenerate_cube() -> Scene {
    let mut mesh: Mesh = cuboid(DVec3::splat(0.5)).mesh.with_reversed_faces();
    let clean = mesh.faces.clone();
    mesh.faces.extend(clean.iter().map(|f| [f[0], f[0], f[1]]));
    mesh.faces.extend(clean.iter().map(|f| [f[2]; 3]));
    mesh.faces.extend(clean);
    let cube = MovingShape::translating_shape(
        Shape::from_open_mesh(mesh),
        3.0 * DVec3::Z,
        -4.0 * DVec3::Z,
    );
    let slab = MovingShape::still(cuboid(DVec3::new(3.0, 3.0, 0.5)), -0.5 * DVec3::Z);
    Scene::new(
        "T21 dirty cube",
        [cube, slab],
        ExpectedOutcome::exact_hit(|g| (2.5 - g) / 4.0),
    )
}

/// Returns T21: two cubes that share an edge and have no bottoms, so that their surface is not a manifold.
fn edge_sharing_cubes() -> Scene {
    let half = DVec3::splat(0.5);
    let mut both = Shape::union([
        cuboid(half).moved(DVec3::new(-0.5, -0.5, 0.0)),
        cuboid(half).moved(DVec3::new(0.5, 0.5, 0.0)),
    ]);
    let level = |f: &[u32; 3], mesh: &Mesh| f.iter().all(|&v| mesh.vertices[v as usize].z < 0.0);
    let mesh = both.mesh.clone();
    both.mesh.faces.retain(|f| !level(f, &mesh));
    both.parts.clear();
    let falling = MovingShape::translating_shape(both, 3.0 * DVec3::Z, -4.0 * DVec3::Z);
    let slab = MovingShape::still(cuboid(DVec3::new(3.0, 3.0, 0.5)), -0.5 * DVec3::Z);
    Scene::new(
        "T21 two shells",
        [falling, slab],
        ExpectedOutcome::exact_hit(|g| (2.5 - g) / 4.0),
    )
}

/// Returns T26: two cuboids at coordinates of some thousands, one of which flies and rotates about a center far from
/// it. The numbers are from a bug report to parry (its issue 317).
fn far_cuboids() -> Scene {
    let flying = Motion::about(
        Pose::new(
            DVec3::new(6458.7905, -209.1331, 1014.52124),
            DQuat::from_xyzw(5.335_995_4e-20, 9.459_897e-20, -0.840_350_15, -0.542_044),
        )
        .expect("a pose"),
        DVec3::new(588.2583, -553.06335, 471.54688),
        DVec3::new(0.0, 0.0, -1.770_823),
        DVec3::new(99.97085, -2.288_818_4e-5, -35.0),
    );
    let still = Pose::new(
        DVec3::new(6079.4917, -849.3108, 853.8756),
        DQuat::from_xyzw(
            0.002_524_775,
            -0.000_262_104_35,
            -0.001_206_448_5,
            0.999_996_07,
        ),
    );
    let flying = MovingShape {
        shape: cuboid(DVec3::new(235.0, 105.0, 110.0)),
        motion: flying.expect("finite"),
    };
    let still = MovingShape {
        shape: cuboid(DVec3::new(650.0, 330.0, 275.0)),
        motion: Motion::still(still.expect("a pose")),
    };
    Scene::new(
        "T26 cuboids in the distance",
        [flying, still],
        ExpectedOutcome::Unknown,
    )
}

/// Returns T24: two cubes with a corner of each inside the other.
fn deep_overlap() -> Scene {
    let cube = || cuboid(DVec3::splat(0.5));
    let corner = DVec3::new(0.7, 0.1, 0.2);
    let leaving = MovingShape::moving(cube(), corner, DVec3::X, DVec3::Z);
    Scene::new(
        "T24 overlap",
        [leaving, MovingShape::still(cube(), DVec3::ZERO)],
        ExpectedOutcome::Overlap,
    )
}

/// Returns T24: a small cube inside a big one, with separate surfaces.
fn nested_cubes(name: &str, shape: fn(Mesh) -> Shape, expect: ExpectedOutcome) -> Scene {
    let small = MovingShape::rotating_shape(
        shape(cuboid(DVec3::splat(0.5)).mesh),
        DVec3::ZERO,
        1e-3 * DVec3::Z,
    );
    // Turned by 1e-3, the small cube's edges come 2.5e-7 nearer than 1.5.
    let gap = match expect {
        ExpectedOutcome::Free { gap } => ExpectedOutcome::Free {
            gap: gap + 0.5 - 0.5 * 2.0_f64.sqrt() * (PI / 4.0 - 1e-3).cos(),
        },
        other => other,
    };
    let big = MovingShape::still(shape(cuboid(DVec3::splat(2.0)).mesh), DVec3::ZERO);
    Scene::new(name, [small, big], gap)
}

/// Returns T25: two cubes at rest, one unit apart.
fn cubes_at_rest() -> Scene {
    let cube = || cuboid(DVec3::splat(0.5));
    let bodies = [
        MovingShape::still(cube(), DVec3::ZERO),
        MovingShape::still(cube(), 2.0 * DVec3::X),
    ];
    Scene::new("T25 at rest", bodies, ExpectedOutcome::Free { gap: 1.0 })
}

/// Returns T25: a cube that falls onto a slab while it rotates about the vertical by zero, by a tiny angle or by π.
fn slowly_turning_cube(angle: f64) -> Scene {
    let cube = cuboid(DVec3::splat(0.5));
    let cube = MovingShape::moving(cube, 3.0 * DVec3::Z, -4.0 * DVec3::Z, angle * DVec3::Z);
    let slab = MovingShape::still(cuboid(DVec3::new(3.0, 3.0, 0.5)), -0.5 * DVec3::Z);
    Scene::new(
        format!("T25 falling, turning by {angle:.2e}"),
        [cube, slab],
        ExpectedOutcome::exact_hit(|g| (2.5 - g) / 4.0),
    )
}
