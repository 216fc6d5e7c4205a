use super::*;

fn progress_line(progress: &Progress) -> String {
    line(&progress.bar, progress.total_work, &progress.steps)
}

/// Tests that progress counts the rows that are answered, not those that a batch has only read.
#[test]
fn answered_rows_count_and_read_rows_do_not() {
    let progress = Progress::new(TotalWork::Bytes(110));
    progress.begin_batch(0, 10);
    progress.begin_batch(4, 110);
    assert_eq!(progress_line(&progress), "0 rows answered, 9 %");
    progress.step();
    assert_eq!(progress_line(&progress), "1 row answered, 31 %");
    for _ in 0..3 {
        progress.step();
    }
    assert!(progress_line(&progress).ends_with(", 100 %"));
}

/// Tests that skipped rows count as answered when a run continues an earlier one, or begins at a later row.
#[test]
fn rows_that_were_skipped_count_as_answered() {
    let progress = Progress::new(TotalWork::Bytes(100));
    progress.begin_batch(0, 60);
    progress.begin_batch(2, 100);
    assert_eq!(progress_line(&progress), "0 rows answered, 60 %");
}

#[test]
fn slow_rows_have_a_time_and_fast_ones_a_rate() {
    let after =
        |steps, seconds| count_and_rate_text(&AtomicU64::new(steps), Duration::from_secs(seconds));
    assert_eq!(after(0, 5), "0 rows answered");
    assert_eq!(after(1, 5), "1 row answered");
    assert_eq!(after(2, 10), "2 rows answered, 5 s/row");
    assert_eq!(after(5000, 2), "5,000 rows answered, 2,500 rows/s");
}
