//! Tests that bodies that slide on flat ground touch no inner edges of its triangles, only other bodies on the ground.

use ccd_core::Unresolved;
use ccd_core::glam::{DQuat, DVec3, dvec3};
use ccd_core::{Body, Limit, Motion, Outcome, Pose, Settings, StartPolicy};
use ccd_tests::backends::for_each_setup;
use ccd_tests::models::{Mesh, PieceKind, Shape, cuboid, dented_cube, divided_l_prism, icosphere};
use ccd_tests::query::{MovingShape, Query};
use ccd_tests::strategies::seeds;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rigid_ccd::Solver;
use std::f64::consts::PI;

/// Half of the ground's length and width, in units of length.
const GROUND_HALF_LENGTH: f64 = 8.0;

/// The time by which a contact may be early, because a search after a start in contact uses the least tolerance instead
/// of the given one.
const ALLOWED_EARLINESS: f64 = 1e-9;

fn settings_with_leave() -> Settings {
    Settings {
        start_policy: StartPolicy::Leave,
        ..Settings::DEFAULT
    }
}

/// Returns flat ground at height 0, cut along `cuts` random lines in x and in y, with a diagonal in each cell.
fn ground_cut_along_lines(rng: &mut Pcg64, cuts: usize) -> Mesh {
    let mut lines = || {
        let mut lines: Vec<f64> = (0..cuts)
            .map(|_| rng.random_range(-GROUND_HALF_LENGTH..GROUND_HALF_LENGTH))
            .collect();
        lines.extend([-GROUND_HALF_LENGTH, GROUND_HALF_LENGTH]);
        lines.sort_unstable_by(f64::total_cmp);
        lines
    };
    let (xs, ys) = (lines(), lines());
    let vertices = ys
        .iter()
        .flat_map(|&y| xs.iter().map(move |&x| dvec3(x, y, 0.0)))
        .collect();
    let n = xs.len() as u32;
    let mut faces = Vec::new();
    for j in 0..ys.len() as u32 - 1 {
        for i in 0..n - 1 {
            let [p, q, r, s] = [
                j * n + i,
                j * n + i + 1,
                (j + 1) * n + i + 1,
                (j + 1) * n + i,
            ];
            faces.extend(if rng.random() {
                [[p, q, r], [p, r, s]]
            } else {
                [[p, q, s], [q, r, s]]
            });
        }
    }
    Mesh { vertices, faces }
}

/// Returns the closed solid between a sheet and its copy one unit below.
fn slab(top: Mesh) -> Mesh {
    let count = top.vertices.len() as u32;
    let Mesh {
        mut vertices,
        mut faces,
    } = top;
    vertices.extend(vertices.clone().iter().map(|v| *v - DVec3::Z));
    let below = faces.clone();
    faces.extend(
        below
            .iter()
            .map(|&[p, q, r]| [p + count, r + count, q + count]),
    );
    let edges = below.iter().flat_map(|&[p, q, r]| [[p, q], [q, r], [r, p]]);
    let edges: std::collections::BTreeSet<[u32; 2]> = edges.collect();
    for &[p, q] in edges.iter().filter(|[p, q]| !edges.contains(&[*q, *p])) {
        faces.extend([[p, p + count, q + count], [p, q + count, q]]);
    }
    Mesh { vertices, faces }
}

fn random_ground(rng: &mut Pcg64) -> Shape {
    let cuts = rng.random_range(0..4);
    let sheet = ground_cut_along_lines(rng, cuts);
    if rng.random() {
        Shape::from_open_mesh(sheet)
    } else {
        Shape::from_closed_mesh(slab(sheet))
    }
}

/// Returns a random solid around the origin whose lowest point is at height 0.
fn random_solid(rng: &mut Pcg64) -> Shape {
    let half = || dvec3(0.3, 0.4, 0.5);
    let shape = match rng.random_range(0..5) {
        0 => cuboid(half()),
        1 => Shape::from_closed_mesh(cuboid(half()).mesh),
        2 => divided_l_prism(2),
        3 => dented_cube(0.5, 0.3),
        _ => Shape::from_closed_mesh(icosphere(0.5, 1).mesh),
    };
    let tilt = match rng.random_range(0..3) {
        0 => DQuat::from_rotation_x(rng.random_range(-1.0..1.0)),
        _ => DQuat::from_rotation_z(rng.random_range(-1.0..1.0)),
    };
    let shape = shape.placed(tilt, DVec3::ZERO);
    let heights = shape.mesh.vertices.iter().map(|v| v.z);
    let least = heights.fold(f64::INFINITY, ccd_core::order::lesser);
    shape.placed(DQuat::IDENTITY, -least * DVec3::Z)
}

/// Returns a pose in which to see the whole scene: the identity or a random pose.
fn random_frame(rng: &mut Pcg64) -> Pose {
    let mut unit = || rng.random_range(-1.0..1.0);
    let any = DQuat::from_xyzw(unit(), unit(), unit(), unit()).normalize();
    let at = 3.0 * dvec3(unit(), unit(), unit());
    if unit() > 0.0 {
        Pose::new(at, any).expect("a unit quaternion")
    } else {
        Pose::IDENTITY
    }
}

fn for_random_cases(cases: u32, law: impl Fn(&mut Pcg64, u64)) {
    for seed in seeds(cases) {
        law(&mut Pcg64::seed_from_u64(seed), seed);
    }
}

/// Tests that a body that slides and rotates on ground of several triangles is free.
#[test]
fn bodies_that_slide_on_cut_ground_are_free() {
    for_random_cases(24, |rng, seed| {
        let ground = random_ground(rng);
        let angle = rng.random_range(-PI..PI);
        let velocity = rng.random_range(0.5..5.0) * DVec3::new(angle.cos(), angle.sin(), 0.0);
        let turning = if rng.random() {
            DVec3::ZERO
        } else {
            rng.random_range(-4.0..4.0) * DVec3::Z
        };
        let at = dvec3(
            rng.random_range(-1.0..1.0),
            rng.random_range(-1.0..1.0),
            0.0,
        );
        let query = Query::new(
            MovingShape::moving(random_solid(rng), at, velocity, turning),
            MovingShape::still(ground, DVec3::ZERO),
        );
        let query = query.seen_from(&random_frame(rng));
        for query in [query.swapped(), query] {
            for_each_setup(&query, &settings_with_leave(), |_, setup, answer| {
                let free = matches!(answer.outcome, Outcome::Free { .. });
                assert!(free, "seed {seed}\n{setup:?}\n{answer:?}\n{query:?}");
            });
        }
    });
}

/// Tests that a body that slides on the ground hits a block on it at the right time, however low the block is.
#[test]
fn a_block_on_cut_ground_is_hit_at_the_right_time() {
    for_random_cases(16, |rng, seed| {
        let height = [1.0, 1e-3, 1e-6][rng.random_range(0..3)];
        let at = dvec3(rng.random_range(-6.0..-4.0), 0.0, 0.0);
        let block = cuboid(dvec3(0.5, 7.0, 0.5 * height));
        let block = block.placed(DQuat::IDENTITY, dvec3(3.0, 0.0, 0.5 * height));
        let cuts = rng.random_range(0..4);
        let ground = Shape::union([
            Shape::from_open_mesh(ground_cut_along_lines(rng, cuts)),
            block,
        ]);
        let half = dvec3(0.3, 0.4, 0.5);
        let mover = if rng.random() {
            cuboid(half)
        } else {
            Shape::from_closed_mesh(cuboid(half).mesh)
        };
        let speed = rng.random_range(5.0..9.0);
        let query = Query {
            a: MovingShape::translating_shape(mover, at + 0.5 * DVec3::Z, speed * DVec3::X),
            b: MovingShape::still(ground, DVec3::ZERO),
            duration: 2.0,
        };
        let truth = (2.5 - 0.3 - at.x) / speed;
        let query = query.seen_from(&random_frame(rng));
        for query in [query.swapped(), query] {
            for_each_setup(&query, &settings_with_leave(), |_, setup, answer| {
                let time = match answer.outcome {
                    Outcome::Contact { time, .. } => time,
                    // Pieces so near to each other that an oracle's axis does not separate them.
                    Outcome::Unresolved(Unresolved {
                        safe_until,
                        limit: Limit::Stalled,
                        ..
                    }) => safe_until,
                    other => panic!("seed {seed}\n{setup:?}\n{other:?}"),
                };
                let on_time = truth - ALLOWED_EARLINESS <= time && time <= truth + 1e-14;
                assert!(on_time, "seed {seed}\n{setup:?}\n{answer:?}\nnot {truth}");
            });
        }
    });
}

/// Tests that a body that slides on ground of a thousand triangles is free.
#[test]
fn ground_of_a_thousand_triangles_is_as_one() {
    for_random_cases(4, |rng, seed| {
        let ground =
            Shape::from_open_mesh(ground_cut_along_lines(rng, 22)).body(PieceKind::Triangles);
        for mover in [random_solid(rng), random_solid(rng), random_solid(rng)] {
            let mover = mover.body(PieceKind::Triangles);
            let velocity = dvec3(
                rng.random_range(-6.0..6.0),
                rng.random_range(-6.0..6.0),
                0.0,
            );
            let motion = Motion::new(
                Pose::IDENTITY,
                velocity,
                rng.random_range(-1.0..1.0) * DVec3::Z,
            );
            let motion = motion.expect("a motion");
            let mut solver = Solver::new().with_settings(settings_with_leave());
            let answer = solver
                .first_contact((&mover, motion), (&ground, Motion::STILL), 1.0)
                .expect("a query");
            let free = matches!(answer.outcome, Outcome::Free { .. });
            assert!(free, "seed {seed}\n{answer:?}");
        }
    });
}

/// Tests that a ball that rolls over the cuts of the ground is free, and hits a wall at the right time.
#[test]
fn a_ball_rolls_on_cut_ground_up_to_a_wall() {
    for_random_cases(16, |rng, seed| {
        let wall = cuboid(dvec3(0.5, 7.0, 1.0)).placed(DQuat::IDENTITY, dvec3(3.0, 0.0, 1.0));
        let sheet = Shape::from_open_mesh(ground_cut_along_lines(rng, 6));
        let [open, walled] = [&sheet, &Shape::union([sheet.clone(), wall])]
            .map(|shape| shape.body(PieceKind::Triangles));
        let ball = Body::sphere(0.5).expect("a ball");
        let at = dvec3(
            rng.random_range(-6.0..-2.0),
            rng.random_range(-1.0..1.0),
            0.5,
        );
        let speed = rng.random_range(4.5..7.0);
        let rolling = Motion::new(
            Pose::at(at).expect("a pose"),
            speed * DVec3::X,
            2.0 * speed * DVec3::Y,
        );
        let rolling = rolling.expect("a motion");
        let mut solver = Solver::new().with_settings(settings_with_leave());
        let mut outcome = |ground, duration| {
            let answer = solver.first_contact((&ball, rolling), (ground, Motion::STILL), duration);
            answer.expect("a query").outcome
        };
        let free = outcome(&open, 1.0);
        assert!(
            matches!(free, Outcome::Free { .. }),
            "seed {seed}\n{free:?}"
        );
        let truth = (2.0 - at.x) / speed;
        match outcome(&walled, 2.0) {
            Outcome::Contact { time, .. }
                if (truth - ALLOWED_EARLINESS..=truth + 1e-14).contains(&time) => {}
            other => panic!("seed {seed}\n{other:?}\nnot {truth}"),
        }
    });
}

/// Tests that open sheets that meet edge to edge in one plane are in contact at the right time. Open surfaces have no
/// inner side.
#[test]
fn sheets_within_one_plane_meet() {
    let sheet = |from: f64, to: f64| {
        let corner = |x, y| dvec3(x, y, 0.0);
        Shape::from_open_mesh(Mesh {
            vertices: vec![
                corner(from, -1.0),
                corner(to, -1.0),
                corner(to, 1.0),
                corner(from, 1.0),
            ],
            faces: vec![[0, 1, 2], [0, 2, 3]],
        })
    };
    let query = Query {
        a: MovingShape::translating_shape(sheet(0.0, 1.0), DVec3::ZERO, DVec3::X),
        b: MovingShape::still(
            Shape::union([sheet(-1.0, 0.0), sheet(3.0, 4.0)]),
            DVec3::ZERO,
        ),
        duration: 3.0,
    };
    for query in [query.swapped(), query] {
        for_each_setup(
            &query,
            &settings_with_leave(),
            |_, setup, answer| match answer.outcome {
                Outcome::Contact { time, .. } if time <= 2.0 => {}
                other => panic!("{setup:?}\n{other:?}"),
            },
        );
    }
}
