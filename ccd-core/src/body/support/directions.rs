//! A fixed set of directions, at steps of 22.5 degrees in latitude and longitude `[SWIFT01]`.

use glam::DVec3;
use std::f64::consts::FRAC_PI_8;

/// The number of directions: both poles, and 16 on each of seven circles of latitude.
pub const TABLE_DIRECTION_COUNT: usize = 2 + 7 * 16;

/// The squared cosines of the angles from the pole that are halfway between circles: 11.25, 33.75, 56.25 and 78.75
/// degrees.
const LATITUDE_BORDER_SQUARED_COSINES: [f64; 4] = [
    0.961939766255643,
    0.691341716182545,
    0.308658283817455,
    0.038060233744357,
];

/// The tangents of the longitudes that are halfway between meridians: 11.25, 33.75, 56.25 and 78.75 degrees.
const MERIDIAN_BORDER_TANGENTS: [f64; 4] = [
    0.198912367379658,
    0.668178637919299,
    1.496605762665489,
    5.027339492125846,
];

/// Returns all directions in the order of their numbers: the north pole, the circles from north to south, the south
/// pole.
pub(super) fn table_directions() -> impl Iterator<Item = DVec3> {
    let circle = |latitude: u32| {
        let (sin, cos) = (f64::from(latitude) * FRAC_PI_8).sin_cos();
        (0..16).map(move |longitude| {
            let (y, x) = (f64::from(longitude) * FRAC_PI_8).sin_cos();
            DVec3::new(sin * x, sin * y, cos)
        })
    };
    let poles = [DVec3::Z, DVec3::NEG_Z].map(std::iter::once);
    let [north, south] = poles;
    north.chain((1..8).flat_map(circle)).chain(south)
}

/// Returns the number of the fixed direction that is nearest to a vector of any length in latitude and in longitude.
/// The number is arbitrary if the vector is not finite.
#[inline]
pub(super) fn nearest_direction_index(v: DVec3) -> usize {
    let square = v.length_squared();
    let from_pole = count_true(LATITUDE_BORDER_SQUARED_COSINES.map(|c| v.z * v.z < c * square));
    let from_axis = count_true(MERIDIAN_BORDER_TANGENTS.map(|t| v.y.abs() > t * v.x.abs()));
    let latitude = if v.z < 0.0 { 8 - from_pole } else { from_pole };
    let longitude = match (v.x < 0.0, v.y < 0.0) {
        (false, false) => from_axis,
        (true, false) => 8 - from_axis,
        (true, true) => 8 + from_axis,
        (false, true) => (16 - from_axis) % 16,
    };
    match latitude {
        0 => 0,
        8 => TABLE_DIRECTION_COUNT - 1,
        _ => 1 + 16 * (latitude - 1) + longitude,
    }
}

#[inline]
fn count_true(passed: [bool; 4]) -> usize {
    passed.into_iter().map(usize::from).sum()
}
