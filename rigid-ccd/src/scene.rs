//! Many moving bodies: which of them touch, and in which order.

mod clock;
mod event;
mod goal;
mod groups;
mod pair_queue;
mod pairs;
mod queue_entry;
mod shifted;
mod stops;

use crate::ParallelSolver;
use ccd_core::glam::DVec3;
use ccd_core::{Body, InputError, Motion, Movement, MovingBody, Pose, Query, Settings, SweptBox};
use clock::TimeLimits;
use event::Event;
pub use event::{Impact, PairError};
use goal::Goal;
pub use groups::Groups;
use pair_queue::{PairQueue, WorkerMemory};
use std::num::NonZeroUsize;
pub use stops::Stop;

/// Many bodies, each with a [motion](ccd_core::Motion) or a [trajectory](crate::trajectory); finds which of them touch,
/// and when.
///
/// Only pairs whose swept boxes meet are examined, the pair with the earliest proven time first: no pair is proven much
/// further than the answer needs. Keep a scene from step to step: it reuses its memory.
///
/// # Guarantee
/// The guarantee of [`first_contact`](crate::first_contact), for all pairs together. The answers are those of the pairs
/// asked one by one, the same bits on any number of threads, unless a [deadline](Settings::deadline) or a stop flag
/// ends a search. Pairs that boxes tell apart are free, also where one by one they would reach a limit, or be refused
/// for their distance.
///
/// ```
/// use rigid_ccd::{Body, Motion, Pose, Scene};
/// let (ball, level) = (Body::sphere(0.5)?, Body::cuboid([50.0, 50.0, 1.0])?);
/// let mut scene = Scene::new();
/// let ground = scene.add_fixed(&level, Pose::at([0.0, 0.0, -1.0])?);
/// for k in 0..100 {
///     let [x, y] = [k % 10, k / 10].map(|number| 2.0 * f64::from(number));
///     let above = Pose::at([x, y, 2.0 + 0.01 * f64::from(k)])?;
///     scene.add(&ball, Motion::new(above, [0.0, 0.0, -3.0], [0.0; 3])?);
/// }
/// let first = scene.first_contact(1.0)?.expect("all of them fall to the ground");
/// assert_eq!(first.bodies, [ground, 1]);
/// assert!(first.hit.time <= 0.5 && first.hit.time > 0.499);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Scene<'a> {
    members: Vec<SceneBody<'a>>,
    settings: Settings,
    pair_filter: Option<Box<dyn Fn(usize, usize) -> bool + 'a>>,
    parallel_solver: ParallelSolver<WorkerMemory>,
}

#[derive(Clone, Copy)]
struct SceneBody<'a> {
    body: &'a Body,
    movement: Movement<'a>,
    mobility: Mobility,
    groups: Groups,
}

#[derive(Clone, Copy, PartialEq)]
enum Mobility {
    Fixed,
    Moving,
}

/// The error of a fixed body that is given a motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "body {index} is fixed and cannot move; add it with Scene::add, or give it a motion at rest"
)]
pub struct FixedBodyError {
    /// The index of the fixed body.
    pub index: usize,
}

/// The number of pairs for each thread that is started: starting a thread takes as long as a few tens of pairs.
const MIN_PAIRS_PER_THREAD: usize = 32;

/// A box that meets the box of every valid motion: coordinates and displacements are at most 1e12.
const EVERYWHERE_BOX: SweptBox = SweptBox {
    min: DVec3::splat(-1e15),
    max: DVec3::splat(1e15),
};

impl<'a> Scene<'a> {
    /// Creates a scene without bodies, which uses all cores.
    pub fn new() -> Self {
        Scene::from(ParallelSolver::new(WorkerMemory::default))
    }

    /// Creates a scene that uses `threads` threads.
    pub fn with_threads(threads: NonZeroUsize) -> Self {
        Scene::from(ParallelSolver::with_threads(threads, WorkerMemory::default))
    }

    fn from(workers: ParallelSolver<WorkerMemory>) -> Self {
        Scene {
            members: Vec::new(),
            settings: Settings::DEFAULT,
            pair_filter: None,
            parallel_solver: workers,
        }
    }

    /// Sets the tolerance, the margin, the start policy, the budget of each pair, and a flag by which other threads
    /// stop the search. Pairs in progress are then unresolved, with a certified time. A deadline is for all pairs
    /// together.
    #[must_use]
    pub fn with_settings(mut self, settings: Settings) -> Self {
        self.settings = settings;
        self
    }

    /// Restricts the queries to the pairs that a function accepts, given both indices, the lower index first.
    ///
    /// Most filters are [`Groups`]; a function suits a list of parts that are fitted to each other.
    #[must_use]
    pub fn with_filter(self, asked: impl Fn(usize, usize) -> bool + 'a) -> Self {
        Scene {
            pair_filter: Some(Box::new(asked)),
            ..self
        }
    }

    /// Adds a body with a motion or a trajectory, and returns the body's index. Indices count from 0.
    pub fn add(&mut self, body: &'a Body, movement: impl Into<Movement<'a>>) -> usize {
        self.push(body, movement.into(), Mobility::Moving)
    }

    /// Adds a body that never moves, such as a level or a workpiece. Two fixed bodies are no pair.
    pub fn add_fixed(&mut self, body: &'a Body, pose: Pose) -> usize {
        self.push(body, Motion::still(pose).into(), Mobility::Fixed)
    }

    fn push(&mut self, body: &'a Body, movement: Movement<'a>, mobility: Mobility) -> usize {
        self.members.push(SceneBody {
            body,
            movement,
            mobility,
            groups: Groups::ALL,
        });
        self.members.len() - 1
    }

    /// Changes the motion or trajectory of a body, for the next step. A fixed body takes a motion at rest: it is put
    /// elsewhere.
    ///
    /// # Errors
    /// [`FixedBodyError`] for a fixed body that would move: pairs of two fixed bodies are never checked.
    ///
    /// # Panics
    /// No body has the index.
    pub fn set_movement(
        &mut self,
        index: usize,
        movement: impl Into<Movement<'a>>,
    ) -> Result<(), FixedBodyError> {
        let (member, movement) = (&mut self.members[index], movement.into());
        let rests = match movement {
            Movement::Motion(motion) => {
                [motion.velocity(), motion.angular_velocity()] == [DVec3::ZERO; 2]
            }
            Movement::Trajectory(_) => false,
        };
        if member.mobility == Mobility::Fixed && !rests {
            return Err(FixedBodyError { index });
        }
        member.movement = movement;
        Ok(())
    }

    /// Returns the motion or trajectory of a body.
    ///
    /// # Panics
    /// No body has the index.
    pub fn movement(&self, index: usize) -> Movement<'a> {
        self.members[index].movement
    }

    /// Changes the groups that decide which other bodies a body is checked against.
    ///
    /// # Panics
    /// No body has the index.
    pub fn set_groups(&mut self, index: usize, groups: Groups) {
        self.members[index].groups = groups;
    }

    /// Returns the number of bodies.
    pub fn len(&self) -> usize {
        self.members.len()
    }

    /// Returns whether there are no bodies.
    pub fn is_empty(&self) -> bool {
        self.members.is_empty()
    }

    /// Removes all bodies, and keeps the settings and the memory.
    pub fn clear(&mut self) {
        self.members.clear();
    }

    /// Finds the first contact of any two bodies, from time 0 to `duration`; `None` if all stay apart.
    ///
    /// Of contacts at the same time, that of the lowest indices is the first.
    ///
    /// # Errors
    /// What is wrong with a pair, if there is no earlier contact: a limit is reached, or a motion or the duration
    /// is out of range.
    pub fn first_contact(&mut self, duration: f64) -> Result<Option<Impact>, PairError> {
        let events = self.find_events(duration, &Goal::first());
        let first = events.iter().min_by(|a, b| a.order(b));
        first.map(Event::impact).transpose()
    }

    /// Finds the first contact of each body with any other one, by index; `None` for a body without contacts.
    ///
    /// # Errors
    /// Each body has a result of its own; its error is what is wrong with a pair, if it has no earlier contact.
    pub fn first_contact_of_each(
        &mut self,
        duration: f64,
    ) -> Vec<Result<Option<Impact>, PairError>> {
        let mut events = self.find_events(duration, &Goal::first_of_each_body(self.len()));
        events.sort_unstable_by(Event::order);
        let mut firsts: Vec<Option<&Event>> = vec![None; self.len()];
        for event in &events {
            for index in event.bodies {
                firsts[index].get_or_insert(event);
            }
        }
        let impact = |first: Option<&Event>| first.map(Event::impact).transpose();
        firsts.into_iter().map(impact).collect()
    }

    /// Finds the first contact of each pair of bodies that touch, in order of time.
    ///
    /// # Errors
    /// Each pair has a result of its own. A pair that is unresolved is in the place of the time until which it is
    /// known to be apart, and one that is refused comes at time 0.
    pub fn contacts(&mut self, duration: f64) -> Vec<Result<Impact, PairError>> {
        let mut events = self.find_events(duration, &Goal::AllPairs);
        events.sort_unstable_by(Event::order);
        events.iter().map(Event::impact).collect()
    }

    /// Finds the contacts and errors of the pairs, as far as `goal` needs them, and returns them in arbitrary order.
    fn find_events(&mut self, duration: f64, goal: &Goal) -> Vec<Event> {
        let clock = TimeLimits::new(duration, &self.settings);
        let pairs = self.candidate_pairs(duration);
        self.run_pair_queue(&pairs, &clock, goal)
    }

    fn run_pair_queue(
        &mut self,
        pairs: &[[usize; 2]],
        clock: &TimeLimits,
        goal: &Goal,
    ) -> Vec<Event> {
        let (members, settings) = (&self.members, &self.settings);
        let query = |pair: [usize; 2]| -> Result<Query<'_>, InputError> {
            let [a, b] = pair.map(|index| members[index].moving_body());
            Ok(Query::new(a, b, clock.duration, settings)?.with_deadline(clock.remaining_time()))
        };
        let pair_queue = PairQueue::new(pairs, &query, clock.duration, goal);
        let threads = self
            .parallel_solver
            .threads()
            .min(pairs.len().div_ceil(MIN_PAIRS_PER_THREAD));
        let events = self
            .parallel_solver
            .map(&vec![(); threads], |worker, ()| worker.run(&pair_queue));
        events.into_iter().flatten().collect()
    }

    /// Returns the pairs that the filters accept and whose swept boxes meet.
    fn candidate_pairs(&self, duration: f64) -> Vec<[usize; 2]> {
        let swept = |member: &SceneBody<'_>| {
            let swept = member.moving_body().swept_box(duration, &self.settings);
            // Each pair of such a body reports its error.
            swept.unwrap_or(EVERYWHERE_BOX)
        };
        let boxes: Vec<SweptBox> = self.members.iter().map(swept).collect();
        pairs::overlapping_pairs(&boxes, |[a, b]| {
            let pair = [&self.members[a], &self.members[b]];
            pair.iter()
                .any(|member| member.mobility == Mobility::Moving)
                && pair[0].groups.may_pair_with(pair[1].groups)
                && self.pair_filter.as_ref().is_none_or(|asked| asked(a, b))
        })
    }
}

impl Default for Scene<'_> {
    fn default() -> Self {
        Scene::new()
    }
}

impl<'a> SceneBody<'a> {
    fn moving_body(&self) -> MovingBody<'a> {
        (self.body, self.movement).into()
    }
}

#[cfg(test)]
mod tests;
