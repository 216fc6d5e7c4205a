use super::*;
use crate::method::Method;
use crate::method::guarded::MethodPrograms;
use crate::method::solver::ContactClaim;
use crate::scene::model::cuboid;
use crate::scene::{ModelBodyCache, PieceKind, scene_descriptions};
use crate::truth::Truth;
use ccd_core::glam::DVec3;
use ccd_core::{Motion, Pose};
use ccd_decomp::TriangleMesh;
use rigid_ccd_cli::SolverKind;
use rstest::rstest;

/// Returns a cube of side 1 about the origin.
fn cube() -> TriangleMesh {
    cuboid(0.5, 0.5, 0.5).unwrap()
}

/// Returns a query in which a cube flies at speed 8 towards another cube, whose center is 4 away, so that they touch at
/// 3/8.
fn flight_query() -> Motions {
    let start = Pose::at(-4.0 * DVec3::X).unwrap();
    Motions {
        id: "flight".to_owned(),
        a: Motion::new(start, 8.0 * DVec3::X, DVec3::ZERO).unwrap(),
        b: Motion::still(Pose::IDENTITY),
        duration: 1.0,
    }
}

const EXACT_HIT: Truth = Truth::Hit {
    lo: 0.375,
    hi: 0.375,
};

#[rstest]
#[case::exact(EXACT_HIT, ContactClaim::Contact { time: 0.375 }, Verdict::Right, Some(0.0))]
#[case::within(EXACT_HIT, ContactClaim::Contact { time: 0.37 }, Verdict::Right, Some(0.005))]
#[case::early(EXACT_HIT, ContactClaim::Contact { time: 0.25 }, Verdict::Early, Some(0.125))]
#[case::late(EXACT_HIT, ContactClaim::Contact { time: 0.376 }, Verdict::Late, Some(0.001))]
#[case::no_time(EXACT_HIT, ContactClaim::Contact { time: f64::NAN }, Verdict::Late, None)]
#[case::missed(EXACT_HIT, ContactClaim::NoContact, Verdict::Missed, None)]
#[case::given_up(EXACT_HIT, ContactClaim::Unresolved { safe_until: 0.3 }, Verdict::Unresolved, None)]
#[case::given_up_late(EXACT_HIT, ContactClaim::Unresolved { safe_until: 0.4 }, Verdict::Late, None)]
#[case::free(Truth::Free, ContactClaim::NoContact, Verdict::Right, None)]
#[case::near(Truth::Free, ContactClaim::Contact { time: 0.37 }, Verdict::Right, None)]
#[case::false_contact(Truth::Free, ContactClaim::Contact { time: 0.2 }, Verdict::FalseContact, None)]
#[case::start(Truth::ContactAtStart, ContactClaim::Contact { time: 0.0 }, Verdict::Undecided, None)]
#[case::wide(Truth::Hit { lo: 0.3, hi: 0.4 }, ContactClaim::Contact { time: 0.35 }, Verdict::Undecided, None)]
#[case::just_late(EXACT_HIT, ContactClaim::Contact { time: 0.375 + 1e-11 }, Verdict::Late, Some(1e-11))]
#[case::unknown(Truth::Graze { lo: 0.3 }, ContactClaim::NoContact, Verdict::Undecided, None)]
fn claims_get_expected_verdicts(
    #[case] truth: Truth,
    #[case] claim: ContactClaim,
    #[case] verdict: Verdict,
    #[case] error: Option<f64>,
) {
    let surface = Surface::new(&cube());
    let referee = TruthSolver::new(&surface, &surface);
    // The distance at time t is 3 − 8 t.
    let judged = judge(&referee, &flight_query(), truth, claim, 0.05);
    assert_eq!(judged.verdict, verdict);
    match error {
        Some(error) => assert!((judged.time_error.unwrap() - error).abs() < 1e-12),
        None => assert!(judged.time_error.is_none_or(f64::is_nan)),
    }
}

fn small_scene() -> Scene {
    let listing = scene_descriptions()
        .unwrap()
        .into_iter()
        .find(|listing| listing.name == "knot216")
        .unwrap();
    listing.make_scene(&mut ModelBodyCache::default()).unwrap()
}

const NO_LIMITS: MeasurementLimits = MeasurementLimits {
    cell_time: Duration::MAX,
    patience: Duration::MAX,
    max_rows: usize::MAX,
    min_rows: 1,
    preparation_limit: Duration::MAX,
};

#[test]
fn every_prefix_of_the_order_is_spread_over_all_rows() {
    let scene = small_scene();
    let contest = PreparedScene::new(&scene).unwrap();
    let count = scene.queries.len();
    let mut all = contest.spread_row_indices(usize::MAX);
    assert_eq!(contest.spread_row_indices(5), all[..5]);
    let most = *all[..5].iter().max().unwrap();
    let least = *all[..5].iter().min().unwrap();
    assert!(most - least > count / 2, "{:?}", &all[..5]);
    all.sort_unstable();
    assert_eq!(all, (0..count).collect::<Vec<_>>());
}

#[test]
fn this_project_is_right_on_the_small_scene_and_its_cell_says_so() {
    let scene = small_scene();
    let contest = PreparedScene::new(&scene).unwrap();
    let method = Method::ThisProject(SolverKind::default(), PieceKind::FewestPieces);
    let session = Session::open(method, &scene, &MethodPrograms::default());
    let mut session = session.unwrap().unwrap();
    let measured = contest.run(&mut session, 1e-6, &NO_LIMITS);
    let measured = measured.unwrap();
    let (cell, trials) = measured.unwrap();
    assert_eq!(cell.rows, scene.queries.len());
    assert_eq!(trials.len(), cell.rows);
    assert!(trials.iter().all(|t| t.verdict == "right"), "{trials:?}");
    let mut errors: Vec<f64> = trials.iter().filter_map(|t| t.error).collect();
    errors.sort_by(f64::total_cmp);
    let hits = errors.len();
    assert!((8..25).contains(&hits), "{hits} of 25 hit");
    // The error is the tolerance over the closing speed; few of these flights graze.
    assert!(errors[hits / 2] < 1e-6, "{errors:?}");
    assert_eq!(cell.max_error, Some(errors[hits - 1]));
    assert!(cell.mean_error <= cell.max_error);
    assert!(cell.median_us > 0.0 && cell.mean_steps >= 1.0);
    assert_eq!(summarise_trials(&trials), cell);
}

#[test]
fn an_interrupted_journal_resumes_where_it_stopped() {
    let folder = std::env::temp_dir().join(format!("ccd-journal-{}", std::process::id()));
    let trial = |method: &str, id: &str| Trial {
        scene: "santa".to_owned(),
        method: method.to_owned(),
        tolerance: 1e-3,
        row: 0,
        id: id.to_owned(),
        micros: 2.5,
        steps: 3,
        verdict: "right".to_owned(),
        error: None,
        time: Some(0.5),
        note: "a, \"b\"".to_owned(),
    };
    let add = |journal: &mut Journal, method: &str| {
        let trials = vec![trial(method, "0"), trial(method, "1")];
        journal.add(summarise_trials(&trials), trials).unwrap();
    };
    let mut journal = Journal::open(&folder, "one").unwrap();
    add(&mut journal, "C2A");
    add(&mut journal, "CONTACT");
    // The last trial is lost, as after a power failure.
    let trials = std::fs::read_to_string(folder.join("trials.csv")).unwrap();
    let cut = trials.trim_end().rfind('\n').unwrap();
    std::fs::write(folder.join("trials.csv"), &trials[..=cut]).unwrap();
    // Two processes would mix their rows.
    let second = Journal::open(&folder, "one").unwrap_err();
    assert!(format!("{second:#}").contains("another run"), "{second:#}");
    drop(journal);
    let mut journal = Journal::open(&folder, "one").unwrap();
    assert!(journal.has_cell("santa", "C2A", 1e-3));
    assert!(!journal.has_cell("santa", "CONTACT", 1e-3));
    assert_eq!((journal.cells().len(), journal.trials().len()), (1, 2));
    add(&mut journal, "CONTACT");
    drop(journal);
    let again = Journal::open(&folder, "one").unwrap();
    assert_eq!((again.cells().len(), again.trials().len()), (2, 4));
    drop(again);
    let other = Journal::open(&folder, "other").unwrap();
    assert!(other.cells().is_empty());
    assert!(folder.join("chart.csv.old").exists());
    std::fs::remove_dir_all(folder).unwrap();
}
