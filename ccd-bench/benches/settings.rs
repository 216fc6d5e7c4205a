//! The settings that all benchmarks share.

use criterion::Criterion;
use std::time::Duration;

/// The number of bootstrap resamples per benchmark, enough for the error of a median. The default takes longer than the
/// calls.
const RESAMPLE_COUNT: usize = 2_000;

/// Returns Criterion's settings with the given number of samples, and the given times for warm-up and measurement in
/// milliseconds.
pub(crate) fn criterion_settings(samples: usize, warm_up: u64, measurement: u64) -> Criterion {
    Criterion::default()
        .nresamples(RESAMPLE_COUNT)
        .sample_size(samples)
        .warm_up_time(Duration::from_millis(warm_up))
        .measurement_time(Duration::from_millis(measurement))
}
