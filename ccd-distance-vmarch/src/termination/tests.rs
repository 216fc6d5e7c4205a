//! Tests that a repeated pair of features is detected within a bounded number of steps.

use super::BrentCycleDetector;
use crate::feature::{Feature, Pair};

#[test]
fn states_that_come_again_are_noticed() {
    let state = |k: u32| Pair {
        a: Feature::Vertex(k),
        b: Feature::Edge(k),
    };
    for tail in 0..40 {
        for length in 1..40 {
            let mut brent = BrentCycleDetector::new(state(0));
            // 0, 1, …, tail, …, tail + length − 1, tail, …
            let at = |k: u32| {
                if k < tail {
                    k
                } else {
                    tail + (k - tail) % length
                }
            };
            let noticed = (1..1000).find(|&k| brent.record_and_detect(state(at(k))));
            let noticed = noticed.expect("it goes in a circle");
            assert!(
                noticed >= length && noticed <= 3 * (tail + length) + 2,
                "{tail} {length}"
            );
        }
    }
    let mut brent = BrentCycleDetector::new(state(0));
    assert!((1..1000).all(|k| !brent.record_and_detect(state(k))));
}
