//! Tests that the stack returns nodes in the same order as a list does.

use super::*;
use crate::tests::scene::{RngExt, rng};

#[test]
fn nodes_come_back_as_from_a_list() {
    let mut rng = rng(1);
    let (mut waiting, mut list) = (NodeStack::with_root(), vec![0]);
    let mut most = 0;
    for k in 0..20_000u32 {
        let count = rng.random_range(0..9);
        // The stack grows for a while, and shrinks again.
        let pops = rng.random_range(0..9) + if k % 400 < 200 { 0 } else { 3 };
        waiting.extend(k..k + count);
        list.extend(k..k + count);
        most = most.max(list.len());
        for _ in 0..pops {
            assert_eq!(waiting.pop(), list.pop());
        }
    }
    assert!(most > 2 * INLINE_CAPACITY, "{most}");
}
