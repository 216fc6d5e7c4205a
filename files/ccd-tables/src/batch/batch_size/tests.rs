use super::*;

#[test]
fn batches_grow_only_for_quick_work() {
    let mut size = BatchSize::new(2);
    size.adapt(TARGET_DURATION / 4);
    assert_eq!(size.row_count(), 4);
    size.adapt(TARGET_DURATION / 32);
    assert_eq!(size.row_count(), 32);
    for _ in 0..20 {
        size.adapt(Duration::ZERO);
    }
    assert_eq!(size.row_count(), MAX_ROWS);
    size.adapt(TARGET_DURATION);
    assert_eq!(size.row_count(), MAX_ROWS);
    for _ in 0..20 {
        size.adapt(3 * TARGET_DURATION);
    }
    assert_eq!(size.row_count(), 2);
}
