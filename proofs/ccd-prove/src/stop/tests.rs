use super::*;

#[test]
fn sorting_long_lists_is_stable() {
    for count in [
        0,
        1,
        SORTED_AT_ONCE,
        SORTED_AT_ONCE + 1,
        5 * SORTED_AT_ONCE - 3,
    ] {
        let value = |k: usize| (k.wrapping_mul(2_654_435_761) >> 7) % 1000;
        let mut sorted: Vec<(usize, usize)> = (0..count).map(|k| (value(k), k)).collect();
        let mut expected = sorted.clone();
        expected.sort_unstable();
        let Ok(()) = sort(&mut sorted, |a, b| a.0.cmp(&b.0), Never);
        assert_eq!(sorted, expected);
    }
}

#[test]
fn a_flag_stops_sorting() {
    let flag = AtomicBool::new(true);
    assert!(sort(&mut [2, 1], Ord::cmp, &flag).is_err());
}
