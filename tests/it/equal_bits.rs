//! Tests that the same query gives the same bits again, with a fresh schedule and with one that answered other queries.

use ccd_core::schedule::{
    BestFirst, EngineOptions, Naive, Shortcut, Shortcuts, VectorInstructions,
};
use ccd_core::{DistanceOracle, OrElse, Outcome, Schedule};
use ccd_distance_gjk::{ClosedForm, Direct, Gjk};
use ccd_distance_vmarch::Vmarch;
use ccd_tests::backends::for_each_setup;
use ccd_tests::case::Case;
use ccd_tests::models::PieceKind;
use ccd_tests::strategies::{cases, check_cases, runner};
use proptest::strategy::{Strategy, ValueTree};

#[test]
fn every_setup_repeats_itself() {
    check_cases(100, cases(), |case| {
        let (query, config) = (case.query(), case.config());
        let mut first = Vec::new();
        for_each_setup(&query, &config, |_, _, answer| {
            first.push(format!("{answer:?}"));
        });
        let mut first = first.into_iter();
        let mut law = Ok(());
        for_each_setup(&query, &config, |_, setup, answer| {
            let (once, again) = (first.next(), format!("{answer:?}"));
            if once.as_ref() != Some(&again) {
                law = Err(format!("{setup:?}\n{once:?}\n{again}"));
            }
        });
        law
    });
}

/// Defines one test for each schedule and oracle: reused from query to query, they give the same answers as new ones.
macro_rules! used_as_fresh {
    ($($test:ident: $schedule:ident, $oracle:ty;)*) => {$(
        #[test]
        fn $test() {
            check_reused_as_fresh::<$oracle, $schedule<$oracle>>();
        }
    )*};
}

used_as_fresh! {
    used_best_first_closed_form: BestFirst, ClosedForm;
    used_best_first_gjk: BestFirst, Gjk;
    used_best_first_direct: BestFirst, Direct;
    used_best_first_vmarch: BestFirst, OrElse<Vmarch, Gjk>;
    used_naive_closed_form: Naive, ClosedForm;
    used_naive_direct: Naive, Direct;
}

fn check_reused_as_fresh<O: DistanceOracle + Default, S: Schedule<O> + Default>() {
    let (mut schedule, mut oracle) = (S::default(), O::default());
    for case in sample_cases(100) {
        let query = case.query();
        // Patches have facets, over which marching keeps its position from call to call.
        let shapes = [&query.a.shape, &query.b.shape];
        let solid = shapes
            .iter()
            .all(|shape| shape.can_be_made_of(PieceKind::Patches));
        let as_patches = solid.then(|| query.bodies([PieceKind::Patches; 2]));
        for bodies in as_patches.into_iter().chain([query.bodies_of_triangles()]) {
            if bodies.piece_pair_count() > 1_000 {
                continue;
            }
            let settings = case.config();
            let problem = query.problem(&bodies, &settings);
            let used = schedule.first_contact(&problem, &mut oracle).unwrap();
            let fresh = S::default()
                .first_contact(&problem, &mut O::default())
                .unwrap();
            let (used, fresh) = (format!("{used:?}"), format!("{fresh:?}"));
            assert_eq!(used, fresh, "{}", case.to_toml());
        }
    }
}

/// Tests that other vector instructions change no bit of an answer, and that no shortcut changes whether there is a contact.
#[test]
fn how_the_engine_computes_changes_no_answer() {
    let none = (Shortcut::ALL.iter()).fold(Shortcuts::ALL, |left, &each| left.without(each));
    let (mut schedule, mut oracle) = (BestFirst::default(), Direct::default());
    let (mut contacts, mut free, mut changed) = (0, 0, 0);
    for case in sample_cases(300) {
        let query = case.query();
        let bodies = query.bodies_of_triangles();
        let settings = case.config();
        let mut answer = |options| {
            let problem = query
                .problem(&bodies, &settings)
                .with_engine_options(options);
            schedule.first_contact(&problem, &mut oracle).unwrap()
        };
        let default = answer(EngineOptions::DEFAULT);
        let baseline = answer(EngineOptions {
            vector_instructions: VectorInstructions::Baseline,
            ..EngineOptions::DEFAULT
        });
        let (texts, name) = (
            [default, baseline].map(|answer| format!("{answer:?}")),
            case.to_toml(),
        );
        assert_eq!(texts[0], texts[1], "{name}");
        let searched = answer(EngineOptions {
            shortcuts: none,
            ..EngineOptions::DEFAULT
        });
        changed += u32::from(searched.stats != default.stats);
        match (default.outcome, searched.outcome) {
            (Outcome::Unresolved(_), _) | (_, Outcome::Unresolved(_)) => {}
            (one, other) => {
                let kinds = [one, other].map(|outcome| std::mem::discriminant(&outcome));
                assert_eq!(kinds[0], kinds[1], "{name}");
                match one {
                    Outcome::Free { .. } => free += 1,
                    _ => contacts += 1,
                }
            }
        }
    }
    assert!(
        contacts > 50 && free > 50 && changed > 50,
        "{contacts} {free} {changed}"
    );
}

fn sample_cases(count: u32) -> Vec<Case> {
    let mut runner = runner(count);
    let strategy = cases();
    (0..count)
        .map(|_| strategy.new_tree(&mut runner).expect("a case").current())
        .collect()
}
