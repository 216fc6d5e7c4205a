//! The settings of all benches.

use criterion::Criterion;
use std::time::Duration;

/// The number of resamples, enough for a median. The default takes longer than the calls.
const RESAMPLES: usize = 2_000;

/// Returns settings with this number of samples and these times in milliseconds.
pub(crate) fn settings(samples: usize, warm_up: u64, measurement: u64) -> Criterion {
    Criterion::default()
        .nresamples(RESAMPLES)
        .sample_size(samples)
        .warm_up_time(Duration::from_millis(warm_up))
        .measurement_time(Duration::from_millis(measurement))
}
