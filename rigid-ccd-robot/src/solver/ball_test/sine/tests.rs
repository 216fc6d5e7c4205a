//! Tests sines and cosines against those of f64.

use super::*;
use ccd_core::order::greater;
use ccd_core::schedule::VectorInstructions;
use ccd_core::simd::load;
use ccd_core::vectorize;

#[test]
fn the_error_is_at_most_eight_units() {
    let mut largest = 0.0;
    for instructions in [VectorInstructions::Best, VectorInstructions::Baseline] {
        for k in -200_000..200_000 {
            let base = f64::from(k) * (MAX_ANGLE / 200_000.0);
            let angles: [f32; 8] = std::array::from_fn(|lane| (base + 1e-5 * lane as f64) as f32);
            let level = instructions.simd_level();
            let found = vectorize!(level, level => {
                let [sine, cosine] = sin_cos(level, load(level, &angles));
                let mut rows = [[0.0; 8]; 2];
                sine.store_slice(&mut rows[0]);
                cosine.store_slice(&mut rows[1]);
                rows
            });
            for lane in 0..8 {
                let angle = f64::from(angles[lane]);
                let errors = [
                    f64::from(found[0][lane]) - angle.sin(),
                    f64::from(found[1][lane]) - angle.cos(),
                ];
                largest = greater(largest, greater(errors[0].abs(), errors[1].abs()));
            }
        }
    }
    let units = largest / f64::from(0.5 * f32::EPSILON);
    assert!(units <= 8.0 && units > 0.5, "{units}");
}
