//! Runs the peer library's nonlinear casts of the same pairs, and counts their errors.

use crate::flight::{STEP, Shape};
use ccd_bench::method::peer::parry::double::shapes::{pose, rigid_motion};
use ccd_core::Motion;
use parry3d_f64::query::{cast_shapes_nonlinear, distance};
use parry3d_f64::shape::SharedShape;
use rigid_ccd::scene::Impact;
use std::sync::mpsc::channel;
use std::time::{Duration, Instant};

/// The time limit of a cast by the peer library.
const PATIENCE: Duration = Duration::from_millis(500);

/// The comparison of the peer library's answers with ours over many pairs.
#[derive(Default)]
pub(crate) struct Tally {
    pub(crate) pairs: usize,
    pub(crate) agree: usize,
    /// The number of the peer's times that are later than a contact confirmed by the peer's own distance.
    pub(crate) late: usize,
    /// The number of the peer's casts without a contact or an answer where its own distance confirms a contact.
    pub(crate) missed: usize,
    /// The number of the peer's contacts at which its own distance exceeds the tolerance.
    pub(crate) early: usize,
    /// The number of our contacts that the peer's distance does not confirm.
    pub(crate) unconfirmed: usize,
    /// The number of the peer's contacts that its own distance confirms, and before which we have no contact.
    pub(crate) later_than_peer: usize,
    pub(crate) hung: usize,
    pub(crate) time: Duration,
}

/// Runs a cast on its own thread, because some casts do not return; `None` at the time limit. Returns the time of the
/// contact, if there is one.
fn cast(motions: [&Motion; 2], shapes: [&SharedShape; 2]) -> Option<(Duration, Option<f64>)> {
    let (sender, receiver) = channel();
    let motions = motions.map(rigid_motion);
    let shapes = shapes.map(SharedShape::clone);
    std::thread::spawn(move || {
        let begun = Instant::now();
        let [a, b] = &shapes;
        let hit = cast_shapes_nonlinear(&motions[0], &**a, &motions[1], &**b, 0.0, STEP, true);
        let time = hit.ok().flatten().map(|hit| hit.time_of_impact);
        // The receiver is gone if the answer is too late.
        let _ = sender.send((begun.elapsed(), time));
    });
    receiver.recv_timeout(PATIENCE).ok()
}

impl Tally {
    /// Runs the peer's cast on a pair, and compares its answer with ours. Contacts are within `tolerance`.
    pub(crate) fn add(
        &mut self,
        motions: [&Motion; 2],
        shapes: [&Shape; 2],
        ours: Option<&Impact>,
        tolerance: f64,
    ) {
        self.pairs += 1;
        let Some((time, theirs)) = cast(motions, shapes.map(|shape| &shape.peer)) else {
            self.hung += 1;
            return;
        };
        self.time += time;
        let gap = |time: f64| {
            let [a, b] = [0, 1].map(|k| (pose(motions[k], time), &*shapes[k].peer));
            distance(&a.0, a.1, &b.0, b.1).map_or(f64::INFINITY, |found| found.distance)
        };
        // The peer's distances are rounded.
        let confirmed = |time: f64| gap(time) <= tolerance + 1e-7;
        let ours = ours.map(|impact| impact.hit.time);
        // Bodies approach by at most the tolerance between the two times.
        let near = |x: f64, y: f64| (x - y).abs() <= 1e-3 * STEP || (confirmed(x) && confirmed(y));
        match (ours, theirs) {
            (None, None) => self.agree += 1,
            (Some(ours), Some(theirs)) if near(ours, theirs) => self.agree += 1,
            (Some(ours), _) if !confirmed(ours) => self.unconfirmed += 1,
            (Some(_), None) => self.missed += 1,
            (Some(ours), Some(theirs)) if theirs > ours => self.late += 1,
            (_, Some(theirs)) if confirmed(theirs) => self.later_than_peer += 1,
            (_, Some(_)) => self.early += 1,
        }
    }
}
