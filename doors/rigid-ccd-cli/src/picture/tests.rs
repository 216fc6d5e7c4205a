use super::*;
use ccd_core::glam::DQuat;
use ccd_core::{Motion, Outcome, Settings};
use ccd_tables::motions::Motions;
use ccd_tables::paths::PathPair;
use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use rigid_ccd::trajectory::PosePath;

fn random_vector(random: &mut impl Rng, size: f64) -> DVec3 {
    DVec3::from_array([(); 3].map(|()| random.random_range(-size..size)))
}

fn pose(random: &mut impl Rng, size: f64) -> Pose {
    let turn = DQuat::from_scaled_axis(random_vector(random, 3.0));
    Pose::new(random_vector(random, size), turn).unwrap()
}

fn bodies() -> Vec<Body> {
    let bracket = rigid_ccd::load("../../rigid-ccd/examples/bracket.obj").unwrap();
    vec![
        Body::sphere(0.4).unwrap(),
        Body::cuboid([0.1, 0.7, 0.4]).unwrap(),
        Body::capsule(0.2, 0.5).unwrap(),
        bracket,
    ]
}

fn random_movements(random: &mut impl Rng, spin: f64) -> Movements {
    let mut motion = |from: DVec3| {
        let start = pose(random, 1.0).translation() + from;
        let start = Pose::new(start, pose(random, 1.0).rotation()).unwrap();
        let velocity = random_vector(random, 1.0) - 2.0 * from;
        Motion::about(
            start,
            velocity,
            random_vector(random, spin),
            random_vector(random, 0.5),
        )
        .unwrap()
    };
    Movements::Motions(Motions {
        id: "throw".to_owned(),
        a: motion(2.0 * DVec3::X),
        b: motion(-2.0 * DVec3::X),
        duration: 1.5,
    })
}

fn path(random: &mut impl Rng) -> Movements {
    let mut poses = || {
        let timed = [0.0, 0.2, 0.9, 1.5].map(|time| (time, pose(random, 3.0)));
        PosePath::new(timed.to_vec()).unwrap()
    };
    Movements::Path(PathPair {
        id: "visit".to_owned(),
        a: poses(),
        b: poses(),
        start_time: 4.0,
        end: 5.5,
        duration: 1.5,
    })
}

fn interpolate_line(line: &[[f64; 2]], time: f64) -> f64 {
    let next = line
        .partition_point(|[t, _]| *t < time)
        .clamp(1, line.len() - 1);
    let ([t0, g0], [t1, g1]) = (line[next - 1], line[next]);
    if t1 > t0 {
        g0 + (g1 - g0) * (time - t0) / (t1 - t0)
    } else {
        g0
    }
}

#[test]
fn the_proven_line_is_under_the_gap_at_every_time() {
    let (bodies, mut solver) = (bodies(), Solver::new());
    let mut random = Pcg64Mcg::seed_from_u64(3);
    let (mut tight, mut touching, mut looked) = (0, 0, 0);
    for k in 0..120 {
        let [a, b] = [k % 4, (k / 4) % 4].map(|k| &bodies[k]);
        let course = match k % 3 {
            0 => path(&mut random),
            1 => random_movements(&mut random, 2.0),
            _ => random_movements(&mut random, 40.0),
        };
        let found = measure_gap_over_time(&mut solver, BodyPair { a, b }, &course, 0.0).unwrap();
        let line = &found.gap.proven;
        assert!(
            line.windows(2).all(|two| two[0][0] <= two[1][0] + 1e-12),
            "{k}: in order"
        );
        let end = course.duration();
        assert_eq!((line[0][0], line[line.len() - 1][0]), (0.0, end));
        solver.set_settings(Settings::DEFAULT);
        for _ in 0..60 {
            let time = random.random_range(0.0..end);
            let [pose_a, pose_b] = course.poses_at(time).unwrap();
            let answer = solver.distance((a, pose_a), (b, pose_b)).unwrap().outcome;
            let upper = match answer {
                Outcome::Overlapping { upper, .. } => upper,
                ref nearest => nearest.upper(),
            };
            let proven = interpolate_line(line, time);
            assert!(proven <= upper + 1e-9, "{k}: {proven} > {upper} at {time}");
            looked += 1;
            tight += u32::from(upper > 0.0 && proven > 0.8 * upper);
            touching += u32::from(upper == 0.0);
        }
    }
    assert!(
        tight * 3 > looked && touching > 100,
        "{tight} tight, {touching} touching of {looked}"
    );
}

#[test]
fn nothing_touches_before_the_last_step() {
    let (bodies, mut solver) = (bodies(), Solver::new());
    let mut random = Pcg64Mcg::seed_from_u64(5);
    let mut contacts = 0;
    for k in 0..60 {
        let Movements::Motions(query) = random_movements(&mut random, 5.0) else {
            continue;
        };
        let [a, b] = [k % 4, (k / 4) % 4].map(|k| &bodies[k]);
        let course = Movements::Motions(query.clone());
        let found = measure_gap_over_time(&mut solver, BodyPair { a, b }, &course, 0.0).unwrap();
        solver.set_settings(Settings::DEFAULT);
        let hit = solver
            .first_contact((a, query.a), (b, query.b), query.duration)
            .unwrap();
        let last = found.step_times[found.step_times.len() - 1];
        if let Some(hit) = hit.hit().unwrap() {
            contacts += 1;
            // The contact may be early by up to the tolerance.
            assert!(last <= hit.time + 1e-2, "{k}: {last} {}", hit.time);
        }
        assert!(found.ghost_times(query.duration).len() <= 13);
    }
    assert!(contacts > 15, "{contacts}");
}

#[test]
fn bodies_are_drawn_by_their_surface() {
    let [ball, cuboid, capsule, bracket] = [0, 1, 2, 3].map(|k| drawn_mesh(&bodies()[k]));
    assert!(
        ball.vertices
            .iter()
            .all(|v| (v.length() - 0.4).abs() < 1e-9)
    );
    assert_eq!((cuboid.vertices.len(), cuboid.faces.len()), (8, 12));
    let reach = capsule.vertices.iter().map(|v| v.z.abs());
    assert!(
        reach
            .reduce(ccd_core::order::greater)
            .is_some_and(|z| z > 0.69 && z < 0.7 + 1e-9)
    );
    let mesh = ccd_decomp::TriangleMesh::read("../../rigid-ccd/examples/bracket.obj").unwrap();
    assert_eq!(bracket.faces.len(), mesh.faces().len());
    for mesh in [ball, cuboid, capsule, bracket] {
        let most = mesh.vertices.len() as u32;
        assert!(!mesh.faces.is_empty() && mesh.faces.iter().flatten().all(|k| *k < most));
    }
}

#[test]
fn features_are_lit_where_they_are() {
    let cuboid = Body::cuboid([1.0, 2.0, 3.0]).unwrap();
    let pose = Pose::new(DVec3::new(5.0, 0.0, 0.0), DQuat::from_rotation_z(0.5)).unwrap();
    let [corner, edge, face] = [
        DVec3::new(1.0, 2.0, 3.0),
        DVec3::new(1.0, 2.0, 0.7),
        DVec3::new(1.0, 0.3, -0.4),
    ]
    .map(|point| pose.transform_point(point));
    assert_eq!(feature_corners(&cuboid, &pose, "v7", corner).len(), 1);
    let ends = feature_corners(&cuboid, &pose, "e3-7", edge);
    assert!(
        ends.iter()
            .all(|end| (end.distance(edge) - 2.3).abs() < 1e-9
                || (end.distance(edge) - 3.7).abs() < 1e-9)
    );
    let number = (0..6).find(|k| {
        let corners = feature_corners(&cuboid, &pose, &format!("f{k}"), face);
        let local = corners.iter().map(|c| pose.inverse().transform_point(*c));
        corners.len() == 6 && local.into_iter().all(|c| (c.x - 1.0).abs() < 1e-9)
    });
    assert!(number.is_some());
    assert!(
        feature_corners(&cuboid, &pose, "p0", face).is_empty()
            && feature_corners(&cuboid, &pose, "", face).is_empty()
    );
}

#[test]
fn numbers_in_words_are_short_and_never_say_more_than_is_proven() {
    for (value, text) in [
        (0.0, "0"),
        (1.0, "1"),
        (0.359_502_9, "0.359502"),
        (0.999_999_99, "0.999999"),
        (1e-9, "1.000e-9"),
        (9.9996e-5, "9.999e-5"),
        (2.5e7, "25000000"),
        (2.5e13, "2.500e13"),
    ] {
        assert_eq!(verdict::format_rounded_down(value), text);
    }
    let mut random = Pcg64Mcg::seed_from_u64(9);
    for _ in 0..10_000 {
        let size = 10f64.powf(random.random_range(-12.0..12.0));
        let value = size * random.random_range(-1.0..1.0);
        let read: f64 = verdict::format_rounded_down(value).parse().unwrap();
        assert!(
            read <= value && value - read <= 2e-3 * value.abs(),
            "{value} {read}"
        );
    }
}

#[test]
fn keys_lead_where_the_engine_goes() {
    let mut random = Pcg64Mcg::seed_from_u64(11);
    for k in 0..60 {
        let mut way = path(&mut random);
        if let (Movements::Path(way), true) = (&mut way, k % 2 == 0) {
            // The direction of a half turn depends on the sign of the quaternion.
            let sign = if k % 4 == 0 { 1.0 } else { -1.0 };
            let half = DQuat::from_xyzw(0.0, 0.0, sign, 0.0);
            let turned = Pose::new(DVec3::X, half).unwrap();
            way.a = PosePath::new(vec![(0.0, Pose::IDENTITY), (1.5, turned)]).unwrap();
        }
        let shown = serde_json::to_value(&shown_motions(&way).unwrap()[0]).unwrap();
        let keys = shown["keys"].as_array().unwrap();
        let vector = |value: &serde_json::Value| {
            DVec3::from_array([0, 1, 2].map(|n| value[n].as_f64().unwrap()))
        };
        for two in keys.windows(2) {
            let [from, to] = [0, 1].map(|n| two[n]["time"].as_f64().unwrap());
            let start = way.poses_at(from).unwrap()[0].rotation();
            for fraction in [0.2, 0.5, 0.9] {
                let pose = way.poses_at(from + fraction * (to - from)).unwrap()[0];
                let turned = DQuat::from_scaled_axis(fraction * vector(&two[0]["turn"])) * start;
                let arm = DVec3::new(1.0, -2.0, 0.5);
                let off = (turned * arm).distance(pose.rotation() * arm);
                assert!(off < 1e-7, "{k}: {off}");
            }
        }
    }
}
