//! Tests that the exact answers of the families agree with the answers of the referee.

use super::families;
use crate::stability::{ExactCase, Family, FamilyScene};
use crate::truth::{Surface, Truth, TruthSolver};
use rayon::prelude::*;
use std::collections::HashSet;

/// The number of triangles above which the referee takes too long for a test.
const MAX_REFEREE_TRIANGLES: usize = 3000;

/// The fraction of a family's parameter values that are checked, the easiest first; the referee is slow on harder values.
const CHECKED_SHARE: f64 = 0.4;

#[test]
fn families_have_names_and_steps_of_their_own() {
    let families = families();
    let names: HashSet<&str> = families.iter().map(|family| family.name).collect();
    assert_eq!(names.len(), families.len());
    for Family {
        name,
        parameter_values: values,
        ..
    } in &families
    {
        let distinct: HashSet<u64> = values.iter().map(|value| value.to_bits()).collect();
        assert!(
            distinct.len() == values.len() && values.len() >= 4,
            "{name}: {values:?}"
        );
    }
}

#[test]
fn every_scene_can_be_made() {
    families().par_iter().for_each(|family| {
        for &value in &family.parameter_values {
            let scene = (family.make_scene)(value);
            let scene = scene.unwrap_or_else(|error| panic!("{} {value:e}: {error}", family.name));
            assert!(!scene.cases.is_empty() && scene.tolerance > 0.0);
            for ExactCase {
                expected_truth: expected,
                ..
            } in &scene.cases
            {
                if let Truth::Hit { lo, hi } = *expected {
                    assert!(
                        0.0 < hi && lo <= hi && lo < scene.duration,
                        "{} {value:e}",
                        family.name
                    );
                }
            }
        }
    });
}

#[test]
fn the_referee_finds_the_answers_that_are_claimed() {
    let checked: usize = families()
        .par_iter()
        .map(|family| {
            let count = (CHECKED_SHARE * family.parameter_values.len() as f64) as usize;
            let steps = family.parameter_values[..count].iter();
            steps
                .map(|&value| assert_referee_agrees(family, value))
                .sum::<usize>()
        })
        .sum();
    assert!(checked >= 200, "{checked}");
}

/// Asserts that the referee agrees with the exact answers of a family's queries at a parameter value, and returns the
/// number of queries that it decided.
fn assert_referee_agrees(family: &Family, value: f64) -> usize {
    let scene = (family.make_scene)(value).unwrap();
    let FamilyScene { meshes, cases, .. } = &scene;
    let many = meshes
        .iter()
        .any(|mesh| mesh.faces().len() > MAX_REFEREE_TRIANGLES);
    // The referee has no margin.
    if many || scene.margin > 0.0 {
        return 0;
    }
    let [a, b] = meshes.each_ref().map(Surface::new);
    let mut decided = 0;
    for ExactCase {
        query,
        expected_truth: expected,
    } in cases
    {
        let truth = TruthSolver::new(&a, &b).first_contact(query);
        // The referee places points in the world, whose origin may be far away.
        let early = 1e-12 + 1e-15 * query.a.start().translation().length();
        let at = format!(
            "{} {value:e}, case {}: {expected:?} {truth:?}",
            family.name, query.id
        );
        match (truth, *expected) {
            (Truth::Undecided { .. }, _) => continue,
            (Truth::Hit { lo, hi }, Truth::Hit { lo: from, hi: to }) => {
                assert!(lo <= to && from <= hi, "{at}");
            }
            // Faces that meet flat touch without a proof of intersection.
            (Truth::Graze { lo }, Truth::Hit { lo: from, hi: to }) => {
                assert!((from - early..=to).contains(&lo), "{at}");
            }
            (Truth::Free, Truth::Free) => {}
            // The referee uses surfaces, not solids.
            (Truth::Free, Truth::ContactAtStart) => {}
            _ => panic!("{at}"),
        }
        decided += 1;
    }
    decided
}
