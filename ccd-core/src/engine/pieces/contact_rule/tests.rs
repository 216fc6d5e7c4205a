//! Tests for two triangles in one plane on which side of it each is kept, and for how long.

use super::*;
use crate::body::{Body, Solidity};
use crate::distance::separation::sharp::improve_axis;
use crate::motion::Motion;
use crate::motion::pose::Pose;
use crate::problem::Problem;
use crate::settings::Settings;
use crate::tests::meshes::{cube, translated_triangles};
use crate::tests::nearest::Triangle;
use crate::tests::oracle::ExhaustiveOracle;
use crate::tests::scene::{RngExt, pieces, random_rotation, rng};
use glam::DQuat;

/// A body with a triangle, or an edge, in the plane z = 0.
struct RestingBody {
    body: Body,
    piece: u32,
}

impl RestingBody {
    fn new(triangles: &[Triangle], volume: Solidity) -> Self {
        let body = Body::new(&pieces(triangles), volume).unwrap();
        let in_plane = |k: &usize| {
            let points = body.pieces().get(*k).points;
            points.iter().filter(|p| p.z == 0.0).count()
        };
        // Of several pieces, the first is taken.
        let piece = (0..body.pieces().len()).rev().max_by_key(in_plane);
        RestingBody {
            piece: piece.unwrap() as u32,
            body,
        }
    }

    /// Creates a cube on top of the plane if `side` is positive, and below the plane otherwise.
    fn solid(side: f64) -> Self {
        RestingBody::new(
            &translated_triangles(&cube(0.5, 1), 0.5 * side * DVec3::Z),
            Solidity::Solid,
        )
    }

    /// Creates a cube that stands on an edge along an axis, on this side of the plane.
    fn cube_on_edge(side: f64, along: DVec3) -> Self {
        let tilt = DQuat::from_axis_angle(along, std::f64::consts::FRAC_PI_4);
        let level = |p: DVec3| {
            let p = tilt * p + side * 0.5f64.sqrt() * DVec3::Z;
            let z = if p.z.abs() < 1e-9 { 0.0 } else { p.z };
            DVec3::new(p.x, p.y, z)
        };
        let cube: Vec<Triangle> = cube(0.5, 1).iter().map(|t| t.map(level)).collect();
        RestingBody::new(&cube, Solidity::Solid)
    }

    fn sheet() -> Self {
        let triangle = [DVec3::ZERO, 0.4 * DVec3::X, 0.4 * DVec3::Y];
        RestingBody::new(&[triangle], Solidity::Surface)
    }

    /// Creates a shell with a figure of eight as cross section: the solid is above one half of a face, and below the
    /// other half.
    fn figure_eight_shell() -> Self {
        let eight = [(-1.0, 0.0), (1.0, 0.0), (1.0, 1.0), (-1.0, -1.0)];
        let at = |k: usize, y: f64| DVec3::new(eight[k % 4].0, y, eight[k % 4].1);
        let mut shell = Vec::new();
        for k in 0..4 {
            let [a, b, c, d] = [at(k, 0.0), at(k + 1, 0.0), at(k + 1, 1.0), at(k, 1.0)];
            shell.extend([[a, b, c], [a, c, d]]);
        }
        let caps = [[0, 2, 1], [0, 3, 2]].map(|t| t.map(|k| at(k, 0.0)));
        shell.extend(caps);
        shell.extend(caps.map(|[a, b, c]| [a, c, b].map(|p| p + DVec3::Y)));
        RestingBody::new(&shell, Solidity::Solid)
    }
}

/// Returns the free time of B's triangle on A's for a required gap of minus `k` roundings, in units in which B moves by
/// one rounding; `None` up to the end. B moves away along z by `speed` in the whole duration. Both are rotated together by
/// `whole`.
fn free_time([a, b]: [&RestingBody; 2], whole: DQuat, speed: f64, k: f64) -> Option<f64> {
    let pose = Pose::new(DVec3::ZERO, whole).unwrap();
    // B's own frame differs from A's.
    let tilted = Pose::new(DVec3::ZERO, whole * DQuat::from_rotation_z(0.3)).unwrap();
    let velocity = whole * DVec3::new(0.01, 0.02, speed);
    let sides = (
        (&a.body, Motion::still(pose)),
        (&b.body, Motion::new(tilted, velocity, DVec3::ZERO).unwrap()),
    );
    let problem = Problem::of_moving_bodies(sides.0, sides.1, 1.0, &Settings::DEFAULT).unwrap();
    let placed = PlacedPair::new(&problem, [a.piece, b.piece], 0.0);
    let mut meter = Meter::new(&problem);
    let checked = placed
        .query_oracle(&mut ExhaustiveOracle, &mut (), &mut meter)
        .unwrap();
    let checked = improve_axis(&placed.pieces, &checked, problem.rounding);
    let free = placed.free_time_when_touching(&checked, -k * problem.rounding, [a.piece, b.piece]);
    // The unit is the time in which B moves by a rounding.
    free.bounded()
        .map(|free| free * speed.abs() / problem.rounding)
}

/// Checks that a free time, given as a displacement in roundings, is about `k − 1`.
fn check(free: f64, k: f64) {
    assert!(
        (free / (k - 1.0) - 1.0).abs() < 0.1,
        "{free} of {}",
        k - 1.0
    );
}

#[test]
fn solids_keep_to_their_sides_of_the_plane() {
    let mut rng = rng(8);
    let (below, above, sheet) = (
        RestingBody::solid(-1.0),
        RestingBody::solid(1.0),
        RestingBody::sheet(),
    );
    for _ in 0..200 {
        let (whole, k) = (random_rotation(&mut rng), rng.random_range(1.5..3.0));
        let ask = |a, b, speed: f64| free_time([a, b], whole, speed, k);
        for (a, b) in [(&below, &above), (&below, &sheet), (&sheet, &above)] {
            assert_eq!(ask(a, b, 0.5), None, "they part");
            let free = ask(a, b, -0.5).unwrap();
            check(free, k);
        }
        for (a, b) in [(&above, &below), (&sheet, &below), (&above, &sheet)] {
            assert_eq!(ask(a, b, -0.5), None, "they part");
            let free = ask(a, b, 0.5).unwrap();
            check(free, k);
        }
        // Faces of solids on one side slide, whichever of them moves down.
        for (side, speed) in [(&below, 0.5), (&below, -0.5), (&above, 0.5), (&above, -0.5)] {
            assert_eq!(ask(side, side, speed), None);
        }
    }
}

#[test]
fn crossed_edges_rest_on_the_plane_between_them() {
    let below = RestingBody::cube_on_edge(-1.0, DVec3::X);
    let above = RestingBody::cube_on_edge(1.0, DVec3::Y);
    let mut rng = rng(14);
    for _ in 0..100 {
        let (whole, k) = (random_rotation(&mut rng), rng.random_range(1.5..3.0));
        assert_eq!(
            free_time([&below, &above], whole, 0.5, k),
            None,
            "they part"
        );
        let free = free_time([&below, &above], whole, -0.5, k).unwrap();
        check(free, k);
    }
}

#[test]
fn what_is_left_of_the_rounding_is_no_time() {
    let mut rng = rng(9);
    let (below, above, sheet) = (
        RestingBody::solid(-1.0),
        RestingBody::solid(1.0),
        RestingBody::sheet(),
    );
    for _ in 0..100 {
        let whole = random_rotation(&mut rng);
        for (pair, speeds) in [
            ([&below, &above], &[-0.5][..]),
            ([&sheet, &sheet], &[-0.5, 0.5]),
        ] {
            let ask = |left: f64| {
                speeds
                    .iter()
                    .map(move |&v| free_time(pair, whole, v, 1.0 + left))
            };
            assert!(ask(0.5 * RESTING_SLACK_PER_ROUNDING).all(|free| free == Some(0.0)));
            let more: Vec<_> = ask(2.0 * RESTING_SLACK_PER_ROUNDING).collect();
            // The plane of two sheets lets them part in one of both directions.
            assert!(
                more.iter()
                    .any(|free| *free > Some(RESTING_SLACK_PER_ROUNDING)),
                "{more:?}"
            );
        }
    }
}

#[test]
fn surfaces_in_one_plane_are_kept_apart_by_it_on_either_side() {
    let sheet = RestingBody::sheet();
    let (mut rng, mut parted) = (rng(10), 0);
    for _ in 0..100 {
        let (whole, k) = (random_rotation(&mut rng), rng.random_range(1.5..3.0));
        for speed in [-0.5, 0.5] {
            // The claim's axis is on one side. A plane through both sheets lets one of them part.
            match free_time([&sheet, &sheet], whole, speed, k) {
                None => parted += 1,
                Some(free) => check(free, k),
            }
        }
    }
    assert_eq!(parted, 100);
}

#[test]
fn a_piece_of_unknown_side_is_not_let_go() {
    let (unclear, sheet) = (RestingBody::figure_eight_shell(), RestingBody::sheet());
    assert_eq!(unclear.body.facing(unclear.piece), Facing::Unclear);
    for pair in [[&unclear, &sheet], [&sheet, &unclear]] {
        for speed in [-0.5, 0.5] {
            assert_eq!(free_time(pair, DQuat::IDENTITY, speed, 2.0), Some(0.0));
        }
    }
}
