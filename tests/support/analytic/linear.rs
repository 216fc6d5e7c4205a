//! Scenes of translation, in which the distance falls at a constant rate.

use super::{ExpectedOutcome, Scene};
use crate::models::{
    comb, cuboid, icosphere, inradius, needles, slit_plate, square_plate, torus, u_hook,
};
use crate::query::MovingShape;
use ccd_core::glam::{DQuat, DVec3};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

pub(super) fn scenes() -> Vec<Scene> {
    let mut out = vec![
        falling_cube(),
        bullet_and_sheet(),
        hooks_closing(),
        hooks_parting(),
        linked_tori(),
    ];
    out.extend(tilted_cubes());
    out.extend([(0.3, 0.15), (0.12, 0.1)].map(|(c, phi)| plate_through_slit(c, phi)));
    out.extend([4, 32].map(combs_closing));
    out.extend([1e-3, 1e-6, 1e-9].map(needles_on_slab));
    out.push(parallel_plates());
    out.push(spinning_icosphere());
    out.extend([1e-6, 1e-9].map(|gap| sliding_cube(gap, -DVec3::X)));
    out
}

fn slab() -> MovingShape {
    MovingShape::still(cuboid(DVec3::new(3.0, 3.0, 0.5)), -0.5 * DVec3::Z)
}

/// Returns T1: a cube that falls flat onto a slab, with coplanar triangles on both faces.
fn falling_cube() -> Scene {
    let cube = cuboid(DVec3::splat(0.5));
    let cube = MovingShape::translating_shape(cube, 3.0 * DVec3::Z, -4.0 * DVec3::Z);
    Scene::new(
        "T1 falling cube",
        [cube, slab()],
        ExpectedOutcome::exact_hit(|g| (2.5 - g) / 4.0),
    )
}

/// Returns T8: tilted cubes that meet edge on edge, and corner on face.
fn tilted_cubes() -> [Scene; 2] {
    let cube = || cuboid(DVec3::splat(0.5));
    let upper = cube().placed(DQuat::from_rotation_x(FRAC_PI_4), DVec3::ZERO);
    let lower = cube().placed(DQuat::from_rotation_y(FRAC_PI_4), DVec3::ZERO);
    let falls = |shape| MovingShape::translating_shape(shape, 3.0 * DVec3::Z, -4.0 * DVec3::Z);
    // Rotates the diagonal to −z.
    let down = DQuat::from_rotation_arc(DVec3::ONE.normalize(), -DVec3::Z);
    let corner_down = cube().placed(down, DVec3::ZERO);
    [
        Scene::new(
            "T8 edge on edge",
            [falls(upper), MovingShape::still(lower, DVec3::ZERO)],
            ExpectedOutcome::exact_hit(|g| (3.0 - 2.0_f64.sqrt() - g) / 4.0),
        ),
        Scene::new(
            "T8 corner on slab",
            [falls(corner_down), slab()],
            ExpectedOutcome::exact_hit(|g| (3.0 - 3.0_f64.sqrt() / 2.0 - g) / 4.0),
        ),
    ]
}

/// Returns T10: a cube that moves from a small gap above a slab, in most cases parallel to the slab.
pub fn sliding_cube(gap: f64, velocity: DVec3) -> Scene {
    let cube = cuboid(DVec3::splat(0.5));
    let cube = MovingShape::translating_shape(cube, (0.5 + gap) * DVec3::Z, velocity);
    // Accounts for the rounding of the cube's position: 0.5 + gap is a multiple of 2⁻⁵³.
    let gap = (0.5 + gap) - 0.5;
    Scene::new(
        format!("T10 sliding at {gap:.0e}"),
        [cube, slab()],
        ExpectedOutcome::Free { gap },
    )
}

/// Returns T13: a small fast cube that hits a thin sheet.
fn bullet_and_sheet() -> Scene {
    let bullet = cuboid(DVec3::splat(0.005));
    let bullet = MovingShape::translating_shape(bullet, DVec3::ZERO, 1000.0 * DVec3::X);
    let paper = MovingShape::still(cuboid(DVec3::new(5e-7, 1.0, 1.0)), 400.0 * DVec3::X);
    Scene::new(
        "T13 bullet",
        [bullet, paper],
        ExpectedOutcome::exact_hit(|g| (400.0 - 5e-7 - 0.005 - g) / 1000.0),
    )
}

/// Returns T15: crossed hooks that move into each other until their bases meet. The lateral gaps are wider than any
/// tolerance.
fn hooks_closing() -> Scene {
    Scene::new(
        "T15 hooks closing",
        hooks(-DVec3::Z),
        ExpectedOutcome::exact_hit(|g| 0.3 - g),
    )
}

/// Returns T15 in reverse: crossed hooks that move away from each other. The neighbouring legs stay nearest.
fn hooks_parting() -> Scene {
    // A leg's inner face is at 0.3; the other hook's base reaches to 0.1.
    Scene::new(
        "T15 hooks parting",
        hooks(DVec3::Z),
        ExpectedOutcome::Free { gap: 0.2 },
    )
}

fn hooks(velocity: DVec3) -> [MovingShape; 2] {
    let (bar, gap, length) = (0.2, 0.6, 0.55);
    let crossed = DQuat::from_rotation_z(FRAC_PI_2) * DQuat::from_rotation_x(PI);
    let upper = u_hook(bar, gap, length);
    let lower = u_hook(bar, gap, length).placed(crossed, DVec3::ZERO);
    [
        MovingShape::translating_shape(upper, 0.5 * DVec3::Z, velocity),
        MovingShape::still(lower, DVec3::ZERO),
    ]
}

/// Returns T16: a tilted plate that moves through a slit. It is free if its projection is lower than the slit.
fn plate_through_slit(half_height: f64, phi: f64) -> Scene {
    let tilted = DQuat::from_rotation_y(-phi);
    let plate = cuboid(DVec3::new(1.0, 1.0, 0.1)).placed(tilted, DVec3::ZERO);
    let corner = |x: f64, z: f64| tilted * DVec3::new(x, 0.0, z);
    let (top, bottom) = (corner(1.0, 0.1), corner(1.0, -0.1));
    let speed = 5.0;
    let plate = MovingShape::translating_shape(plate, -2.0 * DVec3::X, speed * DVec3::X);
    let expect = if top.z < half_height {
        ExpectedOutcome::Free {
            gap: half_height - top.z,
        }
    } else {
        // The slit's upper edge meets the front face, at the edge's height.
        let part = (half_height - bottom.z) / (top.z - bottom.z);
        let front = bottom.x + part * (top.x - bottom.x);
        ExpectedOutcome::exact_hit(move |g| (2.0 - front - g / phi.cos()) / speed)
    };
    let slit = MovingShape::still(slit_plate(half_height), DVec3::ZERO);
    Scene::new(format!("T16 slit {half_height}"), [plate, slit], expect)
}

/// Returns T17: two linked rings that meet vertex on vertex, each at the inner side of the other ring.
fn linked_tori() -> Scene {
    let (major, minor, rings, sides) = (1.0, 0.25, 24, 8);
    let flat = torus(major, minor, rings, sides);
    // In the xz-plane, its first section on −x.
    let upright = DQuat::from_rotation_x(FRAC_PI_2) * DQuat::from_rotation_z(PI);
    let upright = torus(major, minor, rings, sides).placed(upright, DVec3::ZERO);
    let upright = MovingShape::translating_shape(upright, major * DVec3::X, DVec3::X);
    // Around each vertex the other ring is a concave edge: it is nearer by the cosine of the angle between
    // sections, once for either ring.
    let nearer = (PI / rings as f64).cos().powi(2);
    let expect = ExpectedOutcome::Hit {
        first_time_within_distance: Box::new(move |g| major - 2.0 * minor - g / nearer),
        latest_time: major - 2.0 * minor,
    };
    Scene::new(
        "T17 linked tori",
        [MovingShape::still(flat, DVec3::ZERO), upright],
        expect,
    )
}

/// Returns T19: two combs that move into each other, until the tips reach the other comb's base.
pub fn combs_closing(teeth: usize) -> Scene {
    let (apart, speed) = (0.5, 1.0);
    let flipped = comb(teeth).placed(
        DQuat::from_rotation_x(PI),
        DVec3::new(0.5, 0.0, 1.0 + apart),
    );
    let upper = MovingShape::translating_shape(flipped, DVec3::ZERO, -speed * DVec3::Z);
    let lower = MovingShape::still(comb(teeth), DVec3::ZERO);
    Scene::new(
        format!("T19 combs of {teeth}"),
        [upper, lower],
        ExpectedOutcome::exact_hit(move |g| (apart - g) / speed),
    )
}

/// Returns T21: thin triangles that fall onto a slab, tip first.
fn needles_on_slab(width: f64) -> Scene {
    let fall = MovingShape::translating_shape(needles(9, width), 0.75 * DVec3::Z, -DVec3::Z);
    Scene::new(
        format!("T21 needles of {width:.0e}"),
        [fall, slab()],
        ExpectedOutcome::exact_hit(|g| 0.75 - g),
    )
}

/// Returns two equal plates that meet face on face, so that all pairs of opposite triangles touch at the same time.
fn parallel_plates() -> Scene {
    let falling = MovingShape::translating_shape(square_plate(16), 0.5 * DVec3::Z, -DVec3::Z);
    let lying = MovingShape::still(square_plate(16), DVec3::ZERO);
    Scene::new(
        "plates",
        [falling, lying],
        ExpectedOutcome::exact_hit(|g| 0.5 - g),
    )
}

/// Returns T22: a rotating icosphere that falls onto a slab. Its inscribed and circumscribed balls bound the time of
/// contact.
fn spinning_icosphere() -> Scene {
    let (radius, height, speed) = (0.5, 2.0, 2.0);
    let ball = icosphere(radius, 2);
    let inner = inradius(&ball.mesh);
    let spin = DVec3::new(1.0, 2.0, 3.0);
    let ball = MovingShape::moving(ball, height * DVec3::Z, -speed * DVec3::Z, spin);
    let expect = ExpectedOutcome::Hit {
        first_time_within_distance: Box::new(move |g| (height - radius - g) / speed),
        latest_time: (height - inner) / speed,
    };
    Scene::new("T22 spinning icosphere", [ball, slab()], expect)
}
