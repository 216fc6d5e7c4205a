//! Builds a planner's roadmap for a bracket that has to pass a slot in a wall: edges are certified, and compared with
//! checks at equal steps.
//!
//! ```sh
//! cargo run --release -p rigid-ccd --example planner
//! ```
//! It draws places on both sides of the wall and in the slot, joins near ones by motions, and seeks a path.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rigid_ccd::glam::{DQuat, DVec3};
use rigid_ccd::{Body, Error, Motion, Pose, Settings, Solver, load};
use std::collections::VecDeque;
use std::io::Write;
use std::path::Path;

/// Two walls with a slot between them.
struct Room {
    walls: Vec<(Body, Motion)>,
}

const HALF_SLOT: f64 = 1.0;
const PLACES: usize = 220;
const NEIGHBOURS: usize = 10;

impl Room {
    fn new() -> Result<Self, Error> {
        let mut walls = Vec::new();
        for side in [-1.0, 1.0] {
            let wall = Body::cuboid([0.3, 3.0, 3.0])?;
            let place = Pose::at([0.0, side * (3.0 + HALF_SLOT), 0.0])?;
            walls.push((wall, Motion::still(place)));
        }
        // A lintel and a sill: the bracket has to turn to pass.
        for side in [-1.0, 1.0] {
            let beam = Body::cuboid([0.3, HALF_SLOT, 1.5])?;
            let place = Pose::at([0.0, 0.0, side * (1.5 + HALF_SLOT)])?;
            walls.push((beam, Motion::still(place)));
        }
        Ok(Room { walls })
    }
}

/// Returns whether the motion from one pose to another is free, with a proof.
fn edge_is_free(
    solver: &mut Solver,
    room: &Room,
    body: &Body,
    edge: [Pose; 2],
) -> Result<bool, Error> {
    let moves = Motion::between(edge[0], edge[1], MIDDLE, 1.0)?;
    for (wall, stands) in &room.walls {
        if !solver.is_free((body, moves), (wall, *stands), 1.0)? {
            return Ok(false);
        }
    }
    Ok(true)
}

/// The approximate middle of the bracket, which is not its origin.
const MIDDLE: [f64; 3] = [0.8, 0.5, 0.4];

/// Returns whether the body is free at equal steps of a motion, which is no proof.
fn steps_are_free(
    solver: &mut Solver,
    room: &Room,
    body: &Body,
    edge: [Pose; 2],
    steps: u32,
) -> Result<bool, Error> {
    let moves = Motion::between(edge[0], edge[1], MIDDLE, 1.0)?;
    for step in 0..=steps {
        let at = Motion::still(moves.pose(f64::from(step) / f64::from(steps)));
        for (wall, stands) in &room.walls {
            if !solver.is_free((body, at), (wall, *stands), 0.0)? {
                return Ok(false);
            }
        }
    }
    Ok(true)
}

/// Draws poses at which the body is free: the first is the start, the second the goal.
fn places(solver: &mut Solver, room: &Room, body: &Body) -> Result<Vec<Pose>, Error> {
    let mut random = Pcg64::seed_from_u64(7);
    let mut places = vec![Pose::at([-4.0, 0.0, 0.0])?, Pose::at([3.0, 0.0, 0.0])?];
    while places.len() < PLACES {
        // A third of them are in the slot or near it.
        let width = if places.len() % 3 == 0 { 1.2 } else { 4.0 };
        let at = DVec3::new(
            random.random_range(-width..width),
            random.random_range(-2.0..2.0),
            random.random_range(-2.0..2.0),
        );
        let turned = DQuat::from_scaled_axis(DVec3::new(
            random.random_range(-1.6..1.6),
            random.random_range(-1.6..1.6),
            random.random_range(-1.6..1.6),
        ));
        let pose = Pose::new(at - turned * DVec3::from_array(MIDDLE), turned)?;
        if steps_are_free(solver, room, body, [pose, pose], 1)? {
            places.push(pose);
        }
    }
    Ok(places)
}

/// Returns the edges of the roadmap, which connect each place with its nearest ones.
fn edges(places: &[Pose]) -> Vec<[usize; 2]> {
    let middle = |pose: &Pose| pose.transform_point(MIDDLE.into());
    let apart = |a: &Pose, b: &Pose| {
        middle(a).distance(middle(b)) + a.rotation().angle_between(b.rotation())
    };
    let mut edges = Vec::new();
    for (k, place) in places.iter().enumerate() {
        let mut others: Vec<usize> = (0..places.len()).filter(|&other| other != k).collect();
        others.sort_by(|&a, &b| apart(place, &places[a]).total_cmp(&apart(place, &places[b])));
        let near = others.into_iter().take(NEIGHBOURS);
        edges.extend(near.filter(|&other| other > k).map(|other| [k, other]));
    }
    edges
}

/// Returns a path from the first place to the second one along free edges.
fn path(count: usize, free: &[[usize; 2]]) -> Option<Vec<usize>> {
    let mut before = vec![None; count];
    let mut queue = VecDeque::from([0]);
    while let Some(at) = queue.pop_front() {
        for edge in free.iter().filter(|edge| edge.contains(&at)) {
            let next = if edge[0] == at { edge[1] } else { edge[0] };
            if next != 0 && before[next].is_none() {
                before[next] = Some(at);
                queue.push_back(next);
            }
        }
    }
    let mut path = vec![1];
    while let Some(&at) = path.last().filter(|&&at| at != 0) {
        path.push(before[at]?);
    }
    path.reverse();
    Some(path)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let body = load(Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/bracket.obj"))?;
    let room = Room::new()?;
    let mut solver = Solver::new().with_settings(Settings {
        tolerance: 1e-4,
        ..Settings::DEFAULT
    });
    let places = places(&mut solver, &room, &body)?;
    let edges = edges(&places);
    let mut free = Vec::new();
    for &edge in &edges {
        if edge_is_free(&mut solver, &room, &body, edge.map(|k| places[k]))? {
            free.push(edge);
        }
    }
    let mut print = std::io::stdout().lock();
    writeln!(
        print,
        "{} of {} edges are free, certified",
        free.len(),
        edges.len()
    )?;
    for steps in [5, 10, 20, 50, 100] {
        let mut wrong = 0;
        for &edge in edges.iter().filter(|edge| !free.contains(edge)) {
            let poses = edge.map(|k| places[k]);
            wrong += u32::from(steps_are_free(&mut solver, &room, &body, poses, steps)?);
        }
        writeln!(print, "{steps:>4} steps accept {wrong} edges that are not")?;
    }
    match path(places.len(), &free) {
        None => writeln!(print, "no path")?,
        Some(path) => writeln!(print, "a path of {} edges", path.len() - 1)?,
    }
    Ok(())
}
