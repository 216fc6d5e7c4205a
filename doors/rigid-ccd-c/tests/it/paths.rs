//! Tests of questions about paths. Answers have the bits of Rust, warm solvers do not allocate, and the path before a
//! deadline is free.

use crate::support::{Handle, Random, default_settings, last_error, ok};
use crate::support_cells::*;
use rigid_ccd::Settings;
use rigid_ccd_c::*;
use rigid_ccd_robot::evidence::{Evidence, RecordedAnswer, Verdict};
use rigid_ccd_robot::{JointCurve, PathOutcome};
use std::ffi::CString;
use std::ptr::null;

#[test]
fn paths_have_the_bits_of_rust() {
    let (cell, rust) = cells();
    let solver = cell_solver(&cell, &default_settings());
    let mut rust_solver = rust.solver().with_settings(Settings::DEFAULT);
    let mut random = Random::new(7);
    let (mut free, mut hits) = (0, 0);
    for number in 0..300 {
        let path: Vec<_> = (0..1 + number % 4)
            .map(|_| configuration(&mut random))
            .collect();
        let found = first_contact(&solver, &path);
        match rust_solver.first_contact(&path).unwrap().outcome {
            PathOutcome::Free => {
                free += 1;
                assert_eq!(found.outcome, RccdOutcome::Free, "{number}");
                assert_eq!(
                    (found.segment, found.fraction),
                    (path.len().saturating_sub(2), 1.0)
                );
            }
            PathOutcome::Contact(contact) => {
                hits += 1;
                assert_eq!(found.outcome, RccdOutcome::Contact, "{number}");
                assert_eq!(found.segment, contact.at.segment);
                assert_eq!(found.fraction.to_bits(), contact.at.fraction.to_bits());
                let names = [found.item_a, found.item_b].map(text);
                assert_eq!(names, contact.items.map(|item| item.name().to_owned()));
                assert_eq!([found.lower, found.upper], contact.distance_bounds);
                assert_eq!(found.witness_a, contact.witnesses.unwrap()[0].to_array());
            }
            _ => panic!("{number}"),
        }
        let any = ask(rccd_cell_any_contact, &solver, &through(&path));
        let rust_any = rust_solver.any_contact(&path).unwrap().contact().unwrap();
        assert_eq!(any.outcome == RccdOutcome::Contact, rust_any.is_some());
        if let Some(contact) = rust_any {
            assert_eq!(any.fraction.to_bits(), contact.at.fraction.to_bits());
        }
        let near = ask(rccd_cell_closest_approach, &solver, &through(&path));
        let approach = rust_solver.closest_approach(&path).unwrap().outcome;
        assert_eq!(near.outcome, RccdOutcome::LeastDistance);
        assert_eq!(
            [near.lower, near.upper],
            [approach.lower(), approach.upper()]
        );
        assert_eq!(near.tolerance, Settings::DEFAULT.tolerance);
    }
    assert!(free > 50 && hits > 50, "{free} {hits}");
}

/// Tests that an answer reports a larger tolerance than requested if rounding allows no smaller one.
#[test]
fn a_raised_tolerance_is_told() {
    let (cell, rust) = cells();
    let tolerance = 1e-14;
    let settings = RccdSettings {
        tolerance,
        ..default_settings()
    };
    let solver = cell_solver(&cell, &settings);
    let mut rust_solver = rust.solver().with_settings(Settings {
        tolerance,
        ..Settings::DEFAULT
    });
    let mut random = Random::new(9);
    let path = [(); 2].map(|()| configuration(&mut random));
    let near = ask(rccd_cell_closest_approach, &solver, &through(&path));
    let closest = rust_solver.closest_approach(&path).unwrap();
    assert!(near.tolerance > tolerance && near.tolerance < 1e-10);
    assert_eq!(near.tolerance, closest.tolerance);
}

#[test]
fn warm_paths_do_not_allocate() {
    let (cell, _) = cells();
    let solver = cell_solver(&cell, &default_settings());
    let mut random = Random::new(8);
    let paths: Vec<_> = (0..100)
        .map(|_| [(); 4].map(|()| configuration(&mut random)))
        .collect();
    let round = || {
        for path in &paths {
            first_contact(&solver, path);
        }
    };
    round();
    let counted = allocation_counter::measure(round);
    assert_eq!(counted.count_total, 0, "{counted:?}");
}

/// Tests that a path is free until the point in the answer if a deadline or a budget ended the search.
#[test]
fn a_limit_leaves_a_certified_prefix() {
    let (cell, rust) = cells();
    // Far below the gap that a free prefix is proven to keep.
    let fine = Settings {
        tolerance: 1e-9,
        ..Settings::DEFAULT
    };
    let mut rust_solver = rust.solver().with_settings(fine);
    let mut random = Random::new(9);
    let (mut unresolved, mut prefixes) = (0, 0);
    for number in 0..300 {
        let path = [(); 6].map(|()| configuration(&mut random));
        let settings = RccdSettings {
            tolerance: 1e-6,
            deadline: [0.0, 1e-6, 1e-5, 1e-4][number % 4],
            ..default_settings()
        };
        let found = first_contact(&cell_solver(&cell, &settings), &path);
        if found.outcome != RccdOutcome::Unresolved {
            continue;
        }
        assert_eq!(found.limit, RccdLimit::Deadline, "{number}");
        unresolved += 1;
        let mut prefix = path[..=found.segment].to_vec();
        let [from, to] = [path[found.segment], path[found.segment + 1]];
        prefix.push([0, 1].map(|k| from[k] + (to[k] - from[k]) * found.fraction * (1.0 - 1e-9)));
        prefixes += usize::from(found.segment > 0 || found.fraction > 0.0);
        let outcome = rust_solver.first_contact(&prefix).unwrap().outcome;
        let begins_in_contact = found.segment == 0 && found.fraction == 0.0;
        assert!(
            outcome == PathOutcome::Free || begins_in_contact,
            "{number}: {found:?}"
        );
    }
    assert!(unresolved > 30, "{unresolved} {prefixes}");
}

/// Tests that curves equal those of Rust: with accelerations, without, and made from polynomials.
#[test]
fn curves_have_the_bits_of_rust() {
    let (cell, rust) = cells();
    let solver = cell_solver(&cell, &default_settings());
    let mut rust_solver = rust.solver().with_settings(Settings::DEFAULT);
    let mut random = Random::new(17);
    let (mut free, mut hits) = (0, 0);
    for number in 0..100 {
        // Velocities that keep the joints within their limits.
        let mut rows = |size: f64| [(); 3].map(|()| configuration(&mut random).map(|q| size * q));
        let times = [0.0, 0.5, 1.25];
        let (positions, velocities, accelerations) = (rows(0.8), rows(0.1), rows(0.1));
        let is_quintic = number % 2 == 1;
        let curve = if is_quintic {
            JointCurve::quintic_hermite(&times, &positions, &velocities, &accelerations)
        } else {
            JointCurve::cubic_hermite(&times, &positions, &velocities)
        };
        let given = if is_quintic {
            accelerations.as_ptr().cast()
        } else {
            null()
        };
        // SAFETY: the arrays have three rows of two numbers.
        let handle = Handle::new(rccd_joint_curve_free, |out| unsafe {
            let (positions, velocities) = (positions.as_ptr().cast(), velocities.as_ptr().cast());
            rccd_joint_curve_through(times.as_ptr(), positions, velocities, given, 3, 2, out)
        });
        let path = RccdPath {
            configurations: null(),
            configuration_count: 0,
            curve: handle.pointer(),
        };
        let found = ask(rccd_cell_first_contact, &solver, &path);
        match rust_solver.first_contact(&curve.unwrap()).unwrap().outcome {
            PathOutcome::Free => {
                free += 1;
                assert_eq!(found.outcome, RccdOutcome::Free, "{number}");
            }
            PathOutcome::Contact(contact) => {
                hits += 1;
                assert_eq!(found.segment, contact.at.segment, "{number}");
                assert_eq!(found.fraction.to_bits(), contact.at.fraction.to_bits());
            }
            _ => panic!("{number}"),
        }
    }
    assert!(free > 20 && hits > 20, "{free} {hits}");
}

/// Tests that a curve of polynomials of degree 1 is an edge.
#[test]
fn polynomials_of_degree_one_are_an_edge() {
    let (cell, _) = cells();
    let solver = cell_solver(&cell, &default_settings());
    let (times, coefficients) = ([2.0, 4.0], [[0.0, 0.6], [0.0, 0.0]]);
    // SAFETY: one segment of two joints with two coefficients each.
    let curve = Handle::new(rccd_joint_curve_free, |out| unsafe {
        let coefficients = coefficients.as_ptr().cast();
        rccd_joint_curve_from_polynomials(times.as_ptr(), coefficients, 1, 2, 1, out)
    });
    let path = RccdPath {
        configurations: null(),
        configuration_count: 0,
        curve: curve.pointer(),
    };
    let found = ask(rccd_cell_first_contact, &solver, &path);
    let edge = first_contact(&solver, &[[0.0, 0.0], [1.2, 0.0]]);
    assert_eq!(found.outcome, RccdOutcome::Contact);
    assert!(
        (found.fraction - edge.fraction).abs() < 1e-3,
        "{found:?} {edge:?}"
    );
    let both = RccdPath {
        configurations: [0.0; 2].as_ptr(),
        ..path
    };
    let mut answer = empty_answer();
    // SAFETY: pointers are to values that live here.
    let refused = unsafe { rccd_cell_first_contact(solver.pointer(), &both, &mut answer) };
    assert_eq!(refused, RccdStatus::InvalidArgument);
    assert!(last_error().contains("both"), "{}", last_error());
}

#[test]
fn a_flag_stops_pairs_and_paths_until_it_is_cleared() {
    let (cell, _) = cells();
    // SAFETY: the place is a local variable.
    let stop = Handle::new(rccd_stop_free, |out| unsafe { rccd_stop_new(out) });
    let settings = RccdSettings {
        stop: stop.pointer(),
        ..default_settings()
    };
    let solver = cell_solver(&cell, &settings);
    let edge = [[0.0, 0.0], [1.2, 0.0]];
    assert_eq!(first_contact(&solver, &edge).outcome, RccdOutcome::Contact);
    // SAFETY: the handle lives here.
    ok(unsafe { rccd_stop_set(stop.pointer()) });
    for question in [
        rccd_cell_first_contact as Question,
        rccd_cell_any_contact,
        rccd_cell_closest_approach,
    ] {
        let found = ask(question, &solver, &through(&edge));
        assert_eq!(found.outcome, RccdOutcome::Unresolved);
        assert_eq!(found.limit, RccdLimit::Stopped);
    }
    // SAFETY: the handle lives here.
    ok(unsafe { rccd_stop_clear(stop.pointer()) });
    // The solver shares the flag.
    drop(stop);
    assert_eq!(first_contact(&solver, &edge).outcome, RccdOutcome::Contact);
}

#[test]
fn records_of_answers_are_replayed_in_rust() {
    let (cell, rust) = cells();
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("stop.json");
    let name = CString::new(file.to_str().unwrap()).unwrap();
    let settings = RccdSettings {
        tolerance: 1e-4,
        deadline: 1.0,
        ..default_settings()
    };
    let solver = cell_solver(&cell, &settings);
    let write = |path: &RccdPath, answer: &RccdPathAnswer| {
        // SAFETY: all pointers are to values that live here.
        unsafe { rccd_evidence_write(cell.pointer(), &settings, path, answer, name.as_ptr()) }
    };
    let edge = [[0.0, 0.0], [1.2, 0.0]];
    let mut answer = first_contact(&solver, &edge);
    assert_eq!(answer.outcome, RccdOutcome::Contact);
    ok(write(&through(&edge), &answer));
    let read = || Evidence::from_json(&std::fs::read_to_string(&file).unwrap()).unwrap();
    let record = read();
    assert_eq!(record.settings.deadline, Some(1.0));
    assert_eq!(record.replay(&rust).unwrap().verdict, Verdict::SameAnswer);

    // Imitates a deadline that passed at half of the free prefix.
    answer.outcome = RccdOutcome::Unresolved;
    answer.limit = RccdLimit::Deadline;
    answer.fraction *= 0.5;
    // An answer with bounds would be one about a distance.
    assert_eq!(write(&through(&edge), &answer), RccdStatus::InvalidArgument);
    [answer.lower, answer.upper] = [f64::NAN; 2];
    ok(write(&through(&edge), &answer));
    let expected = RecordedAnswer::Unresolved {
        limit: "deadline".to_owned(),
        segment: 0,
        fraction: answer.fraction,
    };
    assert_eq!(read().answer, expected);
    assert_eq!(read().replay(&rust).unwrap().verdict, Verdict::Holds);

    answer.outcome = RccdOutcome::Interval;
    assert_eq!(write(&through(&edge), &answer), RccdStatus::InvalidArgument);
    assert!(last_error().contains("outcome 5"), "{}", last_error());
    assert_eq!(write(&through(&[]), &answer), RccdStatus::InvalidArgument);
    // SAFETY: null is refused.
    let refused = unsafe {
        rccd_evidence_write(
            cell.pointer(),
            &settings,
            &through(&edge),
            null(),
            name.as_ptr(),
        )
    };
    assert_eq!(refused, RccdStatus::InvalidArgument);
    answer.outcome = RccdOutcome::Free;
    let beyond = [[5.0, 0.0]];
    assert_eq!(write(&through(&beyond), &answer), RccdStatus::InvalidInput);
}
