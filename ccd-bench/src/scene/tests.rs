pub(crate) mod shots;

use super::*;
use ccd_core::Pose;
use ccd_core::glam::DVec3;
use ccd_tables::motions::write;
use shots::{ShotGenerator, drops_onto_or_past_board};

fn shot_generator() -> ShotGenerator {
    ShotGenerator {
        count: 200,
        translation_count: 80,
        start_distances: 3.0..3.5,
        max_offset: 1.0,
        seed: 9,
    }
}

#[test]
fn shots_pass_the_origin_within_their_distance_aside() {
    for query in shot_generator().queries().unwrap() {
        let start = query.a.start().translation();
        let end = query.a.pose(query.duration).translation();
        assert!((3.0..3.5).contains(&start.length()));
        let nearest = start.cross(end - start).length() / (end - start).length();
        assert!(nearest <= 1.0 + 1e-12);
        assert!(start.dot(end) < 0.0, "the end lies on the far side");
        assert_eq!(query.b, ccd_core::Motion::still(Pose::IDENTITY));
    }
}

#[test]
fn the_first_shots_do_not_turn_and_the_others_do() {
    let queries = shot_generator().queries().unwrap();
    let (still, turning) = queries.split_at(80);
    assert!(still.iter().all(|q| q.a.angular_velocity() == DVec3::ZERO));
    let real_turns = turning
        .iter()
        .filter(|q| q.a.angular_velocity().length() > 1e-3);
    assert!(real_turns.count() > 110);
}

#[test]
fn scenes_are_the_same_every_time_and_differ_by_seed() {
    assert_eq!(
        shot_generator().queries().unwrap(),
        shot_generator().queries().unwrap()
    );
    let other = ShotGenerator {
        seed: 10,
        ..shot_generator()
    };
    assert_ne!(
        shot_generator().queries().unwrap(),
        other.queries().unwrap()
    );
    assert_eq!(
        drops_onto_or_past_board(9, 1).unwrap(),
        drops_onto_or_past_board(9, 1).unwrap()
    );
}

#[test]
fn boards_lie_across_the_path_or_just_next_to_it() {
    let queries = drops_onto_or_past_board(40, 1).unwrap();
    let positions = queries.iter().map(|query| query.b.start().translation());
    let (next_to, across): (Vec<DVec3>, Vec<DVec3>) = positions.partition(|p| p.x != 0.0);
    assert_eq!((next_to.len(), across.len()), (10, 30));
    // The board reaches 1.5 towards a body of radius 1.
    assert!(next_to.iter().all(|p| (2.4..2.6).contains(&p.x)));
    assert!(across.windows(2).all(|pair| pair[0].z > pair[1].z));
}

#[test]
fn models_are_made_once() {
    let mut models = ModelBodyCache::default();
    let first = models.model_body(Model::Knot216).unwrap();
    let second = models.model_body(Model::Knot216).unwrap();
    assert!(Arc::ptr_eq(&first.body, &second.body));
    assert_eq!(first.mesh().faces().len(), 216);
}

/// Tests that the stored tables of motions are byte for byte those that the random seeds give.
#[test]
fn the_stored_motions_are_those_of_their_seeds() {
    let bunnies = ShotGenerator {
        count: 250,
        translation_count: 100,
        start_distances: 2.6..3.2,
        max_offset: 1.6,
        seed: 2,
    };
    let knots = ShotGenerator {
        start_distances: 3.0..3.8,
        max_offset: 2.3,
        seed: 3,
        ..bunnies.clone()
    };
    let knots = knots.queries().unwrap();
    // Every tenth row keeps the proportion of both kinds of motion.
    let few: Vec<Motions> = knots.iter().step_by(10).cloned().collect();
    let drawn = [
        ("santa.csv", drops_onto_or_past_board(100, 1).unwrap()),
        ("bunnies.csv", bunnies.queries().unwrap()),
        ("knots.csv", knots),
        ("small-knots.csv", few),
    ];
    for (name, queries) in drawn {
        let mut table = Vec::new();
        write(&mut table, &queries).unwrap();
        let stored = listing::EMBEDDED_MOTION_CSVS
            .into_iter()
            .find(|(stored, _)| *stored == name);
        assert!(stored.unwrap().1.as_bytes() == table, "{name}");
    }
}
