use super::*;
use ccd_core::Outcome;
use ccd_core::{Body, InputError, Motion, Pose, Settings};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::AtomicBool;

fn solver(threads: usize) -> ParallelSolver {
    ParallelSolver::with_threads(NonZeroUsize::new(threads).unwrap(), Solver::new)
}

fn capsule() -> Body {
    Body::capsule(0.1, 0.6).unwrap()
}

/// Returns a rotating motion along a straight path, which is moved by `0.01 * k` towards the other body.
fn approaching_motion(k: u32) -> Motion {
    let from = Pose::at([-3.0, 1.5 - 0.01 * f64::from(k), 0.1]).unwrap();
    Motion::new(from, [5.0, 0.0, 0.0], [0.3, 2.0, f64::from(k)]).unwrap()
}

/// Returns answers as text with all their digits, so that equal texts mean equal bits.
fn exact_text(found: &[Result<Answer, QueryError>]) -> Vec<String> {
    found.iter().map(|found| format!("{found:?}")).collect()
}

#[test]
fn answers_are_the_same_bits_in_order_on_any_number_of_threads() {
    let (capsule, cuboid, ball) = (
        capsule(),
        Body::cuboid([0.5, 0.4, 0.3]).unwrap(),
        Body::sphere(0.7).unwrap(),
    );
    let targets = [&cuboid, &ball, &capsule];
    let queries: Vec<_> = (0..200)
        .map(|k| {
            let target = targets[k as usize % targets.len()];
            (
                (&capsule, approaching_motion(k)),
                (target, Motion::STILL),
                1.0,
            )
        })
        .collect();
    let mut one = Solver::new();
    let alone: Vec<_> = queries
        .iter()
        .map(|&(a, b, duration)| Ok(one.first_contact(a, b, duration).unwrap()))
        .collect();
    let hits = alone.iter().flatten();
    let hits = hits
        .filter(|answer| answer.hit().unwrap().is_some())
        .count();
    assert!((50..150).contains(&hits), "{hits} of 200 hit");
    assert_eq!(exact_text(&first_contacts(&queries)), exact_text(&alone));
    for threads in [1, 2, 5] {
        let mut many = solver(threads);
        assert_eq!(many.threads(), threads);
        for _ in 0..2 {
            assert_eq!(
                exact_text(&many.first_contacts(&queries)),
                exact_text(&alone)
            );
        }
    }
}

#[test]
fn results_are_in_order_when_queries_take_unlike_times() {
    // The first queries take a thousand times as long as the others.
    let queries: Vec<u64> = (0..5000).collect();
    let work = |count: &mut u64, &query: &u64| {
        let steps = if query < 10 { 100_000 } else { 100 };
        *count += 1;
        (0..steps).fold(query, |sum, step| std::hint::black_box(sum ^ step))
    };
    let expected: Vec<u64> = queries.iter().map(|query| work(&mut 0, query)).collect();
    for threads in [1, 2, 5] {
        let mut counts = ParallelSolver::with_threads(NonZeroUsize::new(threads).unwrap(), || 0);
        assert_eq!(counts.map(&queries, work), expected);
        let by_value = |count: &mut u64, query: u64| work(count, &query);
        assert_eq!(counts.map_iter(0..5000, by_value), expected);
        let unsized_end = (0..).take_while(|&query| query < 5000);
        assert_eq!(counts.map_iter(unsized_end, by_value), expected);
        let done: u64 = counts.solvers.iter().map(|own| own.0).sum();
        assert_eq!(done, 3 * 5000, "each query is answered once");
    }
}

#[test]
fn no_queries_and_more_threads_than_queries() {
    let capsule = capsule();
    let query = |k| {
        (
            (&capsule, approaching_motion(k)),
            (&capsule, Motion::STILL),
            1.0,
        )
    };
    for threads in [1, 2, 5] {
        let queries = [query(130), query(0)];
        assert!(solver(threads).first_contacts(&queries[..0]).is_empty());
        let few = solver(threads).first_contacts(&queries);
        assert_eq!(few.len(), 2);
        let hits = few
            .iter()
            .flatten()
            .map(|answer| answer.hit().unwrap().is_some());
        assert_eq!(hits.collect::<Vec<_>>(), [true, false], "{few:?}");
    }
}

#[test]
fn an_error_has_the_index_of_its_query() {
    let capsule = capsule();
    let query = |k, duration| {
        (
            (&capsule, approaching_motion(k)),
            (&capsule, Motion::STILL),
            duration,
        )
    };
    let mut queries = [query(130, 1.0); 40];
    queries[7].2 = -1.0;
    queries[31].2 = f64::NAN;
    for threads in [1, 2, 5] {
        let found = solver(threads).first_contacts(&queries);
        for (index, found) in found.iter().enumerate() {
            match found {
                Ok(answer) => assert!(answer.hit().unwrap().is_some() && index != 7 && index != 31),
                Err(error) => {
                    assert_eq!(error.query_index, index);
                    assert!([7, 31].contains(&index));
                    let input = matches!(error.error, InputError::OutOfRange { .. });
                    assert!(input || index == 31, "{error}");
                    assert!(error.to_string().starts_with(&format!("query {index}: ")));
                }
            }
        }
        let all: Result<Vec<_>, _> = found.into_iter().collect();
        assert_eq!(all.unwrap_err().query_index, 7);
    }
}

#[test]
fn limits_are_those_of_each_solver() {
    let (capsule, cuboid) = (capsule(), Body::cuboid([0.5, 0.4, 0.3]).unwrap());
    let config = Settings {
        budget: 1,
        ..Settings::DEFAULT
    };
    let mut solver = ParallelSolver::new(|| Solver::new().with_settings(config.clone()));
    let query = (
        (&capsule, approaching_motion(130)),
        (&cuboid, Motion::STILL),
        1.0,
    );
    for found in solver.first_contacts(&[query; 3]) {
        let outcome = found.unwrap().outcome;
        assert!(matches!(outcome, Outcome::Unresolved(_)), "{outcome:?}");
    }
}

/// A value that sets a flag when it is dropped: in a panic, after the panic has printed its message.
struct SetFlagOnDrop<'f>(&'f AtomicBool);

impl Drop for SetFlagOnDrop<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::SeqCst);
    }
}

#[test]
fn an_iterator_is_not_polled_after_its_end() {
    for threads in [1, 2, 5] {
        let mut left = 3;
        let mut ended = false;
        let once = std::iter::from_fn(|| {
            assert!(!ended, "asked after the end");
            ended = left == 0;
            left -= 1;
            (!ended).then_some(left)
        });
        let mut solver = solver(threads);
        assert_eq!(solver.map_iter(once, |_, left| left), [2, 1, 0]);
        assert!(solver.map_iter(0..0, |_, query| query).is_empty());
    }
}

#[test]
fn a_panic_of_the_iterator_reaches_the_caller() {
    for threads in [1, 2, 5] {
        let queries = (0..1000).inspect(|&query| assert!(query < 20, "query 20 is broken"));
        let mut solver = solver(threads);
        let call = AssertUnwindSafe(|| solver.map_iter(queries, |_, query| query));
        let panic = catch_unwind(call).unwrap_err();
        let text = panic.downcast_ref::<&str>();
        assert_eq!(text, Some(&"query 20 is broken"));
        assert_eq!(solver.map_iter(0..9, |_, query| query).len(), 9);
    }
}

#[test]
fn a_panic_reaches_the_caller_and_stops_the_other_threads() {
    let queries: Vec<usize> = (0..1_000_000).collect();
    for threads in [1, 2, 5] {
        let panicked = AtomicBool::new(false);
        let mut counts = ParallelSolver::with_threads(NonZeroUsize::new(threads).unwrap(), || 0);
        let answer = |count: &mut usize, query: usize| {
            if query == 3 {
                let _unwinds = SetFlagOnDrop(&panicked);
                panic!("query 3 is broken");
            }
            // The other threads wait until the panic unwinds.
            while query > 3 && !panicked.load(Ordering::SeqCst) {
                thread::yield_now();
            }
            *count += 1;
            thread::yield_now();
        };
        let slice = AssertUnwindSafe(|| counts.map(&queries, |count, &query| answer(count, query)));
        let of_slice = catch_unwind(slice).unwrap_err();
        panicked.store(false, Ordering::SeqCst);
        let iter = AssertUnwindSafe(|| counts.map_iter(0..queries.len(), answer));
        let of_iter = catch_unwind(iter).unwrap_err();
        for panic in [of_slice, of_iter] {
            assert_eq!(panic.downcast_ref(), Some(&"query 3 is broken"));
        }
        let done: usize = counts.solvers.iter().map(|own| own.0).sum();
        assert!(done < queries.len() - 1, "{done} queries were answered");
        // The solvers are available for the next call.
        assert_eq!(
            counts.map(&queries[..100], |_, &query| query),
            queries[..100]
        );
    }
}
