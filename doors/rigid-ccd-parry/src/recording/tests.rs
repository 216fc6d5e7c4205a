#![cfg(feature = "f64")]

use crate::RecordError;
use crate::f64::Caster;
use ccd_core::{Settings, StartPolicy};
use ccd_tables::motions::MotionTable;
use parry3d_f64::math::{Pose, Vector};
use parry3d_f64::query::{NonlinearRigidMotion, ShapeCastHit};
use parry3d_f64::shape::SharedShape;
use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use rigid_ccd::{Solver, load};
use std::fs::File;
use std::path::{Path, PathBuf};

struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        Folder(std::env::temp_dir().join(format!("ccd-{name}-{}", std::process::id())))
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// Answers the recording in a folder as the command does, and returns the time of the contact, if any.
fn replay_contact_time(folder: &Path, command: &str) -> Option<f64> {
    let words: Vec<&str> = command.split(' ').collect();
    let option = |name: &str| {
        words
            .iter()
            .position(|word| *word == name)
            .map(|k| words[k + 1])
    };
    let number = |name| option(name).and_then(|text| text.parse().ok()).expect(name);
    let config = Settings {
        tolerance: number("--tolerance"),
        margin: number("--margin"),
        start_policy: match option("--start") {
            Some("leave") => StartPolicy::Leave,
            _ => StartPolicy::Report,
        },
        ..Settings::DEFAULT
    };
    let [a, b] = ["a.ccd", "b.ccd"].map(|name| load(folder.join(name)).expect("a body"));
    let table = MotionTable::read(File::open(folder.join("motions.csv")).expect("a table"));
    let (_, query) = &table.expect("motions").rows[0];
    let mut solver = Solver::new().with_settings(config);
    let bodies = [(&a, query.a), (&b, query.b)];
    let hit = solver.first_contact(bodies[0], bodies[1], query.duration);
    let hit = hit.expect("answered").hit().expect("within the budget");
    hit.map(|hit| hit.time)
}

fn shapes() -> Vec<SharedShape> {
    let points = [Vector::ZERO, Vector::X, Vector::Y, Vector::Z, Vector::ONE];
    let tent = vec![[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 2, 3]];
    let moved = |at: f64| Pose::translation(at, 0.1, 0.0);
    vec![
        SharedShape::ball(0.5),
        SharedShape::cuboid(0.1, 0.5, 0.9),
        SharedShape::round_cuboid(0.1, 0.5, 0.9, 0.05),
        SharedShape::capsule(Vector::X, Vector::Y, 0.2),
        SharedShape::cylinder(0.6, 0.3),
        SharedShape::trimesh(points.to_vec(), tent).expect("a mesh"),
        SharedShape::convex_hull(&points).expect("a hull"),
        SharedShape::compound(vec![
            (moved(0.7), SharedShape::ball(0.2)),
            (moved(-0.4), SharedShape::cuboid(0.2, 0.2, 0.2)),
        ]),
        SharedShape::halfspace(Vector::new(0.6, 0.0, 0.8)),
    ]
}

fn throw(random: &mut impl Rng, from: f64) -> NonlinearRigidMotion {
    let mut vector = |size: f64| Vector::from([(); 3].map(|()| random.random_range(-size..size)));
    let start = Pose::new(Vector::new(from, 0.0, 0.0) + vector(0.5), vector(3.0));
    NonlinearRigidMotion::new(
        start,
        vector(0.3),
        Vector::new(-2.0 * from, 0.0, 0.0) + vector(0.3),
        vector(4.0),
    )
}

#[test]
fn a_saved_recording_has_the_answer_of_the_cast() {
    let (folder, mut caster, shapes) = (Folder::new("casts"), Caster::default(), shapes());
    let mut random = Pcg64Mcg::seed_from_u64(7);
    let (mut hits, mut misses) = (0, 0);
    for k in 0..200 {
        let [g1, g2] = [k % 8, (k / 8) % 9].map(|k| &shapes[k]);
        let (one, two) = (throw(&mut random, -2.0), throw(&mut random, 2.0));
        let (start, end) = (
            random.random_range(-0.2..0.2),
            random.random_range(0.3..1.5),
        );
        let cast: Option<ShapeCastHit> = caster
            .cast_shapes_nonlinear(&one, g1, &two, g2, start, end, true)
            .expect("served");
        let recording = caster
            .record(&one, g1, &two, g2, start, end, true)
            .expect("served");
        let command = recording.save(&folder.0).expect("saved");
        match (replay_contact_time(&folder.0, &command), cast) {
            (None, None) => misses += 1,
            (Some(time), Some(hit)) => {
                hits += 1;
                let there = start + time;
                assert!(
                    (there - hit.time_of_impact).abs() < 1e-9,
                    "{k}: {there}, {hit:?}"
                );
            }
            (saved, cast) => panic!("{k}: {saved:?}, {cast:?}"),
        }
    }
    assert!(hits > 60 && misses > 20, "{hits} hits, {misses} misses");
}

#[test]
fn a_place_that_cannot_be_written_is_named() {
    let folder = Folder::new("taken");
    std::fs::write(&folder.0, "a file").expect("written");
    let (ball, rests) = (SharedShape::ball(1.0), NonlinearRigidMotion::identity());
    let recording = Caster::default()
        .record(&rests, &ball, &rests, &ball, 0.0, 1.0, false)
        .expect("served");
    let error = recording.save(&folder.0).expect_err("it is a file");
    assert!(matches!(error, RecordError::Write { .. }), "{error}");
    assert!(error.to_string().contains("ccd-taken-"), "{error}");
    std::fs::remove_file(&folder.0).expect("removed");
}

#[test]
fn an_interval_without_time_is_refused() {
    let (ball, rests) = (SharedShape::ball(1.0), NonlinearRigidMotion::identity());
    let recorded = Caster::default().record(&rests, &ball, &rests, &ball, 1.0, 0.0, true);
    assert_eq!(recorded.err(), Some(crate::CastError::EmptyInterval));
}
