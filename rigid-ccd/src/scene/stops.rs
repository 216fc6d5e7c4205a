//! Finds when each body stops if it stops at its first contact.

use super::clock::TimeLimits;
use super::event::{Event, Impact};
use super::goal::Goal;
use super::pairs::in_ascending_order;
use super::queue_entry::QueueEntry;
use super::shifted::TimeShiftedTrajectory;
use super::{Mobility, PairError, Scene};
use ccd_core::glam::DVec3;
use ccd_core::limits::{LEAST_TOLERANCE, MAX_COORDINATE};
use ccd_core::order::{greater, lesser};
use ccd_core::rounding::RETIMED_POSE_ERROR_F64;
use ccd_core::schedule::{BestFirst, Schedule};
use ccd_core::vector::length;
use ccd_core::{
    Answer, Body, InputError, Motion, Movement, Query, Settings, StartPolicy, Stretch, Trajectory,
};
use ccd_distance_gjk::Direct;
use std::collections::BinaryHeap;

/// The time at which a body stops, with the other body and the contact that stop it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stop {
    /// The time at which the body stops; the duration if it does not stop.
    pub time: f64,
    /// The index of the body that stops it; `None` if it does not stop.
    pub stopped_by: Option<usize>,
    /// The contact with the body that stops it; `None` if it does not stop, or if a limit was reached before a contact
    /// was found. Bodies that rest on each other stop at once, before the time of the hit.
    pub contact: Option<Impact>,
}

impl Stop {
    /// Returns the unit normal of the contact, from this body to the one that stops it; `None` without a
    /// [contact](Stop::contact).
    ///
    /// ```
    /// use rigid_ccd::{Body, Motion, Pose, Scene};
    /// let (ball, ground) = (Body::sphere(0.5)?, Body::cuboid([5.0, 5.0, 1.0])?);
    /// let mut scene = Scene::new();
    /// scene.add_fixed(&ground, Pose::at([0.0, 0.0, -1.0])?);
    /// let falls = Motion::new(Pose::at([0.0, 0.0, 2.0])?, [1.0, 0.0, -3.0], [0.0; 3])?;
    /// let ball = scene.add(&ball, falls);
    /// let stop = scene.find_stops(1.0)?[ball];
    /// // It may slide on along the ground.
    /// let down = stop.normal().expect("the ground stops it");
    /// let slides = falls.velocity() - falls.velocity().dot(down) * down;
    /// assert!((slides.x - 1.0).abs() < 1e-12 && slides.z.abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn normal(&self) -> Option<DVec3> {
        let Impact { bodies, hit } = self.contact?;
        let normal = hit.contact()?.separation.normal;
        // The normal of a hit points from the lower index to the higher one.
        if self.stopped_by == Some(bodies[0]) {
            Some(-normal)
        } else {
            Some(normal)
        }
    }
}

impl Scene<'_> {
    /// Finds the time until which each body may move, by index, if it stops at its first contact while the others
    /// continue. A simulation that sets these poses after each step lets nothing pass through anything.
    ///
    /// A contact at the start is ignored, as by [`StartPolicy::Leave`], whatever the settings are: the bodies may slide
    /// and part, but not come nearer than half of their distance. Both bodies have to move by a [`Motion`] or be at
    /// rest; if one is on another trajectory, both stop at once. Bodies that overlap at the start do not stop each
    /// other.
    ///
    /// # Guarantee
    /// No two bodies that move until they stop, and then stand still, overlap at any time, but for those that
    /// overlap at the start. A body whose way is not known to be free, because a limit is reached, stops before.
    ///
    /// # Errors
    /// A motion or the duration is out of range.
    ///
    /// # Complexity
    /// That of all contacts, and as much again for the pairs of each body that stops. Bodies that touch at the start
    /// cost more: see [`StartPolicy::Leave`].
    ///
    /// ```
    /// use rigid_ccd::{Body, Motion, Pose, Scene};
    /// let (bullet, paper) = (Body::sphere(0.01)?, Body::cuboid([0.001, 1.0, 1.0])?);
    /// let mut scene = Scene::new();
    /// scene.add_fixed(&paper, Pose::IDENTITY);
    /// let shot = Motion::new(Pose::at([-2.0, 0.0, 0.0])?, [800.0, 0.0, 0.0], [0.0; 3])?;
    /// let bullet = scene.add(&bullet, shot);
    /// let stop = scene.find_stops(1.0 / 60.0)?[bullet];
    /// assert_eq!(stop.stopped_by, Some(0));
    /// assert!(shot.pose(stop.time).translation().x < -0.01);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn find_stops(&mut self, duration: f64) -> Result<Vec<Stop>, PairError> {
        let given = self.settings.clone();
        self.settings = stop_search_settings(&given);
        let clock = TimeLimits::new(duration, &self.settings);
        let pairs = self.candidate_pairs(duration);
        let events = self.run_pair_queue(&pairs, &clock, &Goal::AllPairs);
        let stops = StopSearch::new(self, &pairs, clock).run(events);
        self.settings = given;
        stops
    }
}

/// Returns the settings with half of the tolerance moved into the margin, so that bodies that rest on each other do not
/// sink into each other over many steps.
fn stop_search_settings(given: &Settings) -> Settings {
    let half = 0.5 * given.tolerance;
    Settings {
        margin: lesser(given.margin + half, MAX_COORDINATE),
        tolerance: greater(half, LEAST_TOLERANCE),
        start_policy: StartPolicy::Leave,
        ..given.clone()
    }
}

/// The state of [`Scene::find_stops`]: the bodies that have stopped so far, and a solver for the contacts still to come.
struct StopSearch<'s, 'a> {
    scene: &'s Scene<'a>,
    /// For each body, the indices of the bodies that it may touch.
    partners_by_body: Vec<Vec<usize>>,
    stop_by_body: Vec<Stop>,
    time_limits: TimeLimits,
    search_schedule: BestFirst<Direct>,
    oracle: Direct,
}

/// A contact that is still to come, and for each of its two bodies whether it was moving when the contact was found. At
/// most one of them has stopped.
type FutureContact = QueueEntry<(Event, [bool; 2])>;

impl<'s, 'a> StopSearch<'s, 'a> {
    fn new(scene: &'s Scene<'a>, pairs: &[[usize; 2]], clock: TimeLimits) -> Self {
        let mut partners = vec![Vec::new(); scene.len()];
        for &[a, b] in pairs {
            partners[a].push(b);
            partners[b].push(a);
        }
        let goes_on = Stop {
            time: clock.duration,
            stopped_by: None,
            contact: None,
        };
        StopSearch {
            scene,
            partners_by_body: partners,
            stop_by_body: vec![goes_on; scene.len()],
            time_limits: clock,
            search_schedule: BestFirst::default(),
            oracle: Direct::default(),
        }
    }

    /// Processes the contacts in order of time: stops their bodies, and finds new contacts with the stopped bodies.
    fn run(mut self, events: Vec<Event>) -> Result<Vec<Stop>, PairError> {
        let mut coming = BinaryHeap::new();
        for event in events {
            let [a, b] = event.bodies;
            if event.is_start_overlap() {
                self.partners_by_body[a].retain(|&other| other != b);
                self.partners_by_body[b].retain(|&other| other != a);
            } else {
                coming.push(self.future_contact_from_event(event, 0.0));
            }
        }
        while let Some(FutureContact { item: what, .. }) = coming.pop() {
            let (event, moving) = what;
            // If one of the bodies stopped in the meantime, the pair was examined again then.
            if event.bodies.map(|index| self.moves(index)) != moving {
                continue;
            }
            let contact = match event.impact() {
                Err(error) if event.is_refused() => return Err(error),
                impact => impact.ok(),
            };
            let [a, b] = event.bodies;
            for (index, other) in [(a, b), (b, a)] {
                if self.moves(index) {
                    self.stop_by_body[index] = Stop {
                        time: event.time,
                        stopped_by: Some(other),
                        contact,
                    };
                }
            }
            let stopped = event.bodies.into_iter().zip(moving);
            for (index, _) in stopped.filter(|&(_, moved)| moved) {
                coming.extend(self.find_future_contacts_of(index));
            }
        }
        Ok(self.stop_by_body)
    }

    /// Returns the future contacts of moving bodies with a body that has just stopped.
    fn find_future_contacts_of(&mut self, index: usize) -> Vec<FutureContact> {
        let time = self.stop_by_body[index].time;
        let partners = self.partners_by_body[index].iter();
        let moving = partners.filter(|&&other| self.moves(other));
        let pairs: Vec<[usize; 2]> = moving
            .map(|&other| in_ascending_order(index, other))
            .collect();
        let found = pairs
            .into_iter()
            .filter_map(|pair| self.find_contact_after(time, pair));
        found.collect()
    }

    /// Returns the first contact of two bodies after `time`, when one of them stopped; `None` if they stay apart.
    fn find_contact_after(&mut self, time: f64, bodies: [usize; 2]) -> Option<FutureContact> {
        let event = match self.answer(time, bodies) {
            Ok(answer) => Event::from_answer(bodies, &answer)?,
            // The pose of a body is out of range, so the body stops here.
            Err(_) => Event::unexamined_pair(bodies),
        };
        Some(self.future_contact_from_event(event, time))
    }

    /// Returns the queue entry for an event of a query that started at time `from`. Bodies in contact that are nearer
    /// than the margin stop at `from`: otherwise rounding could bring them nearer in each step of a simulation.
    fn future_contact_from_event(&self, mut event: Event, from: f64) -> FutureContact {
        if event.contact_may_be_nearer_than(self.scene.settings.margin) {
            event.time = 0.0;
        }
        let event = event.shifted_in_time(from);
        let moving = event.bodies.map(|index| self.moves(index));
        FutureContact {
            time: event.time,
            pair: event.bodies,
            item: (event, moving),
        }
    }

    fn answer(&mut self, time: f64, bodies: [usize; 2]) -> Result<Answer, InputError> {
        let shifted = bodies.map(|index| TimeShiftedTrajectory {
            unshifted_movement: self.scene.members[index].movement,
            from: time,
        });
        let [a, b] = [0, 1].map(|k| self.movement_from(&shifted[k], bodies[k]));
        let (a, b) = (a?, b?);
        let duration = self.time_limits.duration;
        let body = |k: usize| self.scene.members[bodies[k]].body;
        let rounding = restart_position_error(body(0), &a, duration)?
            + restart_position_error(body(1), &b, duration)?;
        let stray =
            self.deviation_bound_at_stop(bodies[0])? + self.deviation_bound_at_stop(bodies[1])?;
        let settings = Settings {
            margin: self.scene.settings.margin + rounding + stray,
            deadline: self.time_limits.remaining_time(),
            ..self.scene.settings.clone()
        };
        let query = Query::new((body(0), a), (body(1), b), duration - time, &settings)?;
        self.search_schedule.first_contact(&query, &mut self.oracle)
    }

    /// Returns the motion or trajectory of a body from a given time on.
    fn movement_from<'r>(
        &self,
        shifted: &'r TimeShiftedTrajectory<'a>,
        index: usize,
    ) -> Result<Movement<'r>, InputError> {
        if !self.moves(index) {
            return Ok(Motion::still(
                shifted
                    .unshifted_movement
                    .pose(self.stop_by_body[index].time)?,
            )
            .into());
        }
        let Movement::Motion(motion) = shifted.unshifted_movement else {
            return Ok(shifted.into());
        };
        let [velocity, spin] = [motion.velocity(), motion.angular_velocity()];
        Ok(Motion::about(motion.pose(shifted.from), velocity, spin, motion.center())?.into())
    }

    /// Bounds how far the points of a stopped body may be from those of its computed pose; 0 for a body that moves.
    fn deviation_bound_at_stop(&self, index: usize) -> Result<f64, InputError> {
        if self.moves(index) {
            return Ok(0.0);
        }
        let (member, time) = (&self.scene.members[index], self.stop_by_body[index].time);
        let stretch = member.movement.stretch_between(time, time)?;
        Ok(stretch
            .deviation_bound
            .at_reach(reach(member.body, &stretch)))
    }

    fn moves(&self, index: usize) -> bool {
        self.scene.members[index].mobility == Mobility::Moving
            && self.stop_by_body[index].stopped_by.is_none()
    }
}

/// Bounds the distance of a body's points from the center of rotation of a stretch's motion.
fn reach(body: &Body, stretch: &Stretch) -> f64 {
    body.bounding_radius() + length(stretch.motion.center())
}

/// Bounds the error of the positions of a body's points when its movement continues from a rounded pose.
fn restart_position_error(
    body: &Body,
    movement: &Movement<'_>,
    duration: f64,
) -> Result<f64, InputError> {
    let stretch = movement.stretch_between(0.0, 0.0)?;
    let motion = &stretch.motion;
    let [place, center] = [motion.start().translation(), motion.center()].map(length);
    let [travel, turn] =
        [motion.velocity(), motion.angular_velocity()].map(|rate| length(rate) * duration);
    let reach = reach(body, &stretch);
    let stray = stretch.deviation_bound.at_reach(reach);
    Ok(stray + RETIMED_POSE_ERROR_F64 * (place + center + travel + (1.0 + turn) * reach))
}

#[cfg(test)]
mod tests;
