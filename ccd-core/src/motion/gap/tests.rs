use super::Gap;
use crate::tests::double::Double;
use crate::tests::worst::{Worst, share};
use crate::tolerance::RATE_F64;

/// A free time without its allowance against the root of the square equation.
#[test]
fn worst_free_time() {
    let found = Worst::of("RATE_F64, a free time", 40_000).search(|tape| {
        let gap = Gap {
            gap: tape.size(-200..=30),
            rate: tape.any(-60..=60),
            bend: tape.size(-60..=60),
        };
        let [apart, rate, bend] = [gap.gap, gap.rate, gap.bend].map(Double::from);
        let two = Double::from(2.0);
        let root = (rate * rate + two * bend * apart).sqrt();
        let exact = match gap.rate > 0.0 {
            true => two * apart / (rate + root),
            false => (root - rate) / bend,
        };
        let free = Double::from(gap.free_time()) / Double::from(1.0 - RATE_F64);
        Some(share((free / exact - Double::from(1.0)).get(), RATE_F64))
    });
    found.is_within(8.0);
}
