//! Tests that earlier questions and limits do not change later answers.

use super::*;
use std::time::Duration;

#[test]
fn what_was_asked_before_changes_no_first_contact() {
    let mut random = Pcg64::seed_from_u64(91);
    let [mut contacts, mut stopped, mut answered] = [0; 3];
    for _ in 0..300 {
        let cell = random_cell(&mut random);
        let mut used = cell.solver();
        for _ in 0..20 {
            let path = [(); 2].map(|()| random_configuration(&mut random, cell.robot()));
            let alone = cell.solver().first_contact(&path[..]).unwrap().outcome;
            let any_alone = cell
                .solver()
                .any_contact(&path[..])
                .unwrap()
                .contact()
                .unwrap();
            contacts += usize::from(matches!(alone, PathOutcome::Contact(_)));

            let (is_timed, budget) = (random.random_range(0..2) == 0, random.random_range(0..300));
            used.set_settings(Settings {
                // Some deadlines have passed at the start, even on a fast machine.
                deadline: is_timed.then(|| {
                    let nanos: u64 = random.random_range(0..60_000);
                    Duration::from_nanos(if nanos < 20_000 { 0 } else { nanos })
                }),
                budget,
                ..Settings::DEFAULT
            });
            // A limit may lead to another contact, equally early within the tolerance.
            let mut limited = cell.solver().with_settings(Settings {
                budget,
                ..Settings::DEFAULT
            });
            match used.first_contact(&path[..]).unwrap().outcome {
                PathOutcome::Unresolved(_) => stopped += 1,
                answered => {
                    let again = limited.first_contact(&path[..]).unwrap().outcome;
                    assert_same(&answered, &again);
                }
            }
            // With a limit, another contact may be found.
            if let Ok(any) = used.any_contact(&path[..]).unwrap().contact() {
                assert_eq!(any.is_some(), any_alone.is_some());
                answered += 1;
            }
            used.set_settings(Settings::DEFAULT);
            assert_same(&used.first_contact(&path[..]).unwrap().outcome, &alone);
            assert_eq!(
                used.any_contact(&path[..])
                    .unwrap()
                    .contact()
                    .unwrap()
                    .map(|any| any.at),
                any_alone.map(|any| any.at)
            );
        }
    }
    assert!(
        contacts > 1500 && stopped > 1000 && answered > 1000,
        "{contacts} {stopped} {answered}"
    );
}

/// Asserts that two first contacts are the same. Witnesses may be missing if a deadline passes.
fn assert_same(one: &PathOutcome<'_>, other: &PathOutcome<'_>) {
    match (one, other) {
        (PathOutcome::Contact(one), PathOutcome::Contact(other)) => {
            assert_eq!((one.at, one.items), (other.at, other.items));
        }
        _ => assert_eq!(one, other),
    }
}
