//! The tolerances of the test suite, and their derivations.

/// Returns a bound on the difference between a distance computed by the engine and the same distance by this suite.
/// `scale` is the largest coordinate of the scene.
///
/// Each side evaluates a pose (sine, cosine, nine products, sums: fewer than 40 roundings relative
/// to the coordinate, and to the angle of rotation, which is a factor of `scale`) and a distance
/// (fewer than 40). 2⁻⁵³ · 2 · 80 · 1.6.
pub fn rounding(scale: f64) -> f64 {
    256.0 * 0.5 * f64::EPSILON * scale
}

/// The allowed lateness of a reported time relative to a closed form, as a fraction of the duration. It is the rounding
/// of the closed form itself, a few units in the last place after its subtractions.
pub const MAX_LATENESS_FRACTION: f64 = 1e-13;

/// The distance, as a fraction of a scene's size, below which the referee looks for an intersection nearby. It is 2²³
/// times the rounding of the referee's distances, and less than any tolerance tested.
pub const NEAR_CONTACT_DISTANCE_FRACTION: f64 = 1e-10;

/// The fraction of each proven step that the referee takes, less than 1 to allow for rounding.
pub const STEP_FRACTION: f64 = 1.0 - 1e-9;
