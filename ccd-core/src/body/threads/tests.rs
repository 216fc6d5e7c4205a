//! Tests that every element and both functions are processed once, on any number of threads.

use super::{join, parallel_for_each_on};

#[test]
fn every_element_is_met_once_on_any_number_of_threads() {
    for count in [0, 1, 63, 64, 65, 5_000] {
        for threads in [1, 2, 3, 16] {
            let mut list = vec![0; count];
            parallel_for_each_on(threads, &mut list, &(), |(), k, element| *element += k + 1);
            assert!(list.into_iter().eq(1..=count));
        }
    }
}

#[test]
fn a_workspace_is_one_threads_own() {
    let mut list = vec![(0, 0); 5_000];
    parallel_for_each_on(
        4,
        &mut list,
        &Vec::new(),
        |seen: &mut Vec<usize>, k, element| {
            seen.push(k);
            *element = (seen.len(), seen[seen.len() - 1]);
        },
    );
    assert!(
        list.iter()
            .zip(0..)
            .all(|(&(nth, last), k)| last == k && nth <= k + 1)
    );
}

#[test]
fn both_results_come_back() {
    for size in [1, 100_000] {
        assert_eq!(join(size, || "aside", || 2), ("aside", 2));
    }
}
