//! Compares the queue with a sorted list.

use super::Queue;
use crate::engine::queue::{Rank, Worklist};
use crate::tests::scene::{RngExt, rng};
use proptest::prelude::*;

/// Removes all items from a queue, and returns them in the order of removal.
fn drain(queue: &mut Queue<u32>) -> Vec<u32> {
    let mut out = Vec::new();
    while let Some((_, item)) = queue.peek_next() {
        out.push(*item);
        queue.remove_next();
    }
    out
}

#[test]
fn least_clock_first_then_piece_pairs_then_the_newest() {
    let mut queue = Queue::default();
    let pushed = [
        (0.5, Rank::Siblings, 6),
        (0.25, Rank::Siblings, 3),
        (0.25, Rank::PiecePair, 1),
        (0.25, Rank::Siblings, 2),
        (0.25, Rank::PiecePair, 0),
        (0.5, Rank::PiecePair, 5),
        (0.5 - f64::EPSILON, Rank::Siblings, 4),
    ];
    for (clock, rank, item) in pushed {
        queue.push(clock, rank, item).unwrap();
    }
    assert_eq!(drain(&mut queue), [0, 1, 2, 3, 4, 5, 6]);
    assert_eq!(queue.peak_length(), 7);
    assert!(queue.peek_next().is_none());
    queue.remove_next();
}

#[test]
fn clocks_keep_all_their_bits() {
    let mut queue = Queue::default();
    let clocks = [
        -0.0,
        0.0,
        5e-324,
        1e-300,
        0.1,
        0.1f64.next_up(),
        1.0f64.next_down(),
    ];
    for (item, &clock) in clocks.iter().enumerate().rev() {
        queue.push(clock, Rank::Siblings, item as u32).unwrap();
    }
    for &clock in &clocks {
        assert_eq!(queue.peek_next().unwrap().0, clock);
        queue.remove_next();
    }
}

#[test]
fn places_are_used_again() {
    let mut queue = Queue::default();
    for round in 0..100 {
        for item in 0..10 {
            queue.push(0.1, Rank::Siblings, item).unwrap();
        }
        let out = drain(&mut queue);
        assert_eq!(out, (0..10).rev().collect::<Vec<_>>(), "round {round}");
    }
    assert_eq!(queue.items.len(), 10);
    assert_eq!(queue.peak_length(), 10);
    queue.clear();
    assert_eq!(queue.peak_length(), 0);
    assert!(queue.peek_next().is_none());
    queue.remove_next();
}

#[test]
fn postponed_items_wait_in_order() {
    let mut queue = Queue::default();
    for (clock, item) in [(0.1, 0), (0.2, 1), (0.3, 2)] {
        queue.push(clock, Rank::Siblings, item).unwrap();
    }
    *queue.peek_next().unwrap().1 = 7;
    queue.postpone(0.25);
    assert_eq!(*queue.peek_next().unwrap().1, 1);
    assert_eq!(drain(&mut queue), [1, 7, 2]);
}

proptest! {
    #[test]
    fn any_sequence_comes_out_as_a_sorted_list_would(seed in any::<u64>()) {
        let mut rng = rng(seed);
        let mut queue = Queue::default();
        // The items of the list are clock, rank, and age, newest first.
        let mut list: Vec<(f64, u8, i32, u32)> = Vec::new();
        let mut peak = 0;
        for step in 0..300 {
            // There are few different clocks, so that many are equal.
            let clock = f64::from(rng.random_range(0..8)) / 8.0;
            list.sort_by(|x, y| x.partial_cmp(y).unwrap());
            let rank = [Rank::PiecePair, Rank::Siblings][rng.random_range(0..2)];
            let new = (clock, rank as u8, -step, step as u32);
            let least = queue.peek_next().map(|(clock, item)| (clock, *item));
            prop_assert_eq!(least, list.first().map(|first| (first.0, first.3)));
            match (rng.random_range(0..5), list.first_mut()) {
                (0, Some(first)) => {
                    // Clocks may also become earlier than all others.
                    *first = (clock, first.1, -step, first.3);
                    queue.postpone(clock);
                }
                (1, Some(first)) => {
                    *first = new;
                    queue.replace_next(clock, rank, step as u32);
                }
                (2, first) => {
                    if first.is_some() {
                        list.remove(0);
                    }
                    queue.remove_next();
                }
                _ => {
                    queue.push(clock, rank, step as u32).unwrap();
                    list.push(new);
                    peak = peak.max(list.len());
                }
            }
        }
        list.sort_by(|x, y| x.partial_cmp(y).unwrap());
        let rest: Vec<u32> = list.iter().map(|item| item.3).collect();
        prop_assert_eq!(drain(&mut queue), rest);
        prop_assert_eq!(queue.peak_length(), peak as u64);
    }
}
