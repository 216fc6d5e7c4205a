//! Calls all functions of the header in random orders and with random arguments, many of which are wrong.
//!
//! A function is an entry of `table.rs`. Handles are made, shared and freed in any order; none is used after it was
//! freed. Of each call it is checked that it does not panic, that a failure has a message and leaves all places as they
//! were, that an answer is in its ranges, and that the same question has the same answer. `CCD_TEST_CASES` and
//! `CCD_TEST_SEED` are as for the property suite. A failure prints its seed: with it and `CCD_TEST_CASES=0` nothing else
//! runs, and with `CCD_TEST_TRACE=1` each argument is printed before it is used, for a call that does not return.

mod answers;
mod arrays;
mod call;
mod checked;
mod counts;
mod places;
mod table;
mod values;
mod world;

use crate::support::Random;
use checked::call_and_check;
use counts::Counts;
use std::collections::BTreeSet;
use std::time::Instant;
use table::FUNCTIONS;
use world::{Files, World};

/// The number of calls that share their handles.
const CALLS_OF_SEED: usize = 4000;

/// The number of seeds of a short run.
const SEEDS: f64 = 8.0;

#[test]
fn every_function_of_the_header_is_called() {
    let header = include_str!("../../include/rigid_ccd.h");
    let lines = header
        .lines()
        .filter(|line| line.starts_with(char::is_alphanumeric));
    let named = lines.filter_map(|line| {
        let name = line.split('(').next()?.rsplit([' ', '*']).next()?;
        (name.starts_with("rccd_") && line.contains('(')).then_some(name)
    });
    let named: BTreeSet<_> = named.collect();
    let called: BTreeSet<_> = FUNCTIONS.iter().map(|function| function.name).collect();
    let differences: Vec<_> = called.symmetric_difference(&named).collect();
    assert!(
        differences.is_empty() && FUNCTIONS.len() == named.len(),
        "in the header or in tests/it/calls/table.rs, but not once in both: {differences:?}"
    );
}

#[test]
fn random_calls_keep_the_contract() {
    let seeds = ((SEEDS * number_of("CCD_TEST_CASES", 1.0)) as u64).max(1);
    let first = number_of("CCD_TEST_SEED", 0.0) as u64;
    let (files, mut counts) = (Files::new(), Counts::default());
    let mut failures = Vec::new();
    for seed in first..first.saturating_add(seeds) {
        if let Err(failure) = call_functions(seed, &files, &mut counts) {
            failures.push(failure);
            if failures.len() == 20 {
                break;
            }
        }
    }
    counts.print();
    assert!(failures.is_empty(), "{}", failures.join("\n\n"));
    if seeds > 1 {
        counts.check();
    }
}

/// Calls functions at random. The calls of one seed share a set of handles.
fn call_functions(seed: u64, files: &Files, counts: &mut Counts) -> Result<(), String> {
    let mut world = World::new(files);
    let mut random = Random::new(seed);
    for _ in 0..10 {
        random.bits();
    }
    let total: u32 = FUNCTIONS.iter().map(|function| function.weight).sum();
    for number in 0..CALLS_OF_SEED {
        let mut at = random.index(total) as u32;
        let index = FUNCTIONS.iter().position(|function| {
            let is_drawn = at < function.weight;
            at = at.wrapping_sub(function.weight);
            is_drawn
        });
        let index = index.unwrap();
        let own = Random::new(u64::from(random.bits()) << 32 | u64::from(random.bits()));
        let begun = Instant::now();
        let made = call_and_check(&FUNCTIONS[index], &mut world, &own).map_err(|why| {
            format!("CCD_TEST_SEED={seed} CCD_TEST_CASES=0, call {number}: {why}")
        })?;
        counts.add(index, &made, begun.elapsed(), seed);
    }
    Ok(())
}

/// Returns whether each argument is printed.
fn is_traced() -> bool {
    static IS_TRACED: std::sync::OnceLock<bool> = std::sync::OnceLock::new();
    *IS_TRACED.get_or_init(|| std::env::var_os("CCD_TEST_TRACE").is_some())
}

fn number_of(variable: &str, otherwise: f64) -> f64 {
    let text = std::env::var(variable).ok();
    text.map_or(otherwise, |text| text.parse().unwrap())
}
