//! Where an entrant sits while it is asked: in this process, or in one of its own that can be stopped.

use super::entrant::{Entrant, Ours};
use super::{MOST_PAIRS_FOR_NAIVE, REPEATED_WITHIN, REPEATS};
use crate::contender::{Adjustable, Reply};
use crate::engine::ScheduleKind;
use crate::motions::Query;
use crate::peer::{Asked, Guarded};
use crate::query::median;
use crate::scene::Scene;
use std::io;
use std::time::{Duration, Instant};

/// An entrant that can be asked about one scene.
pub struct Seat<'s> {
    entrant: Entrant,
    tolerance: f64,
    place: Place<'s>,
}

enum Place<'s> {
    Here(Box<dyn Adjustable + 's>),
    Guarded(Box<Guarded>),
}

/// What came of a question.
pub(super) enum Answered {
    InTime {
        reply: Reply,
        micros: f64,
    },
    /// Stopped, or dead, after that many microseconds.
    CutOff {
        micros: f64,
    },
}

impl<'s> Seat<'s> {
    /// None where the scene is none for this entrant.
    pub(super) fn take(
        entrant: Entrant,
        scene: &'s Scene,
        tolerance: f64,
    ) -> io::Result<Option<Self>> {
        let place = match entrant {
            Entrant::Ours(method, pieces) => {
                let too_many = scene.pairs() > MOST_PAIRS_FOR_NAIVE;
                let suits = method.schedule != ScheduleKind::Naive || !too_many;
                let Some(bodies) = scene.bodies_of(pieces).filter(|_| suits) else {
                    return Ok(None);
                };
                Place::Here(Box::new(Ours::new(method, bodies, tolerance)))
            }
            Entrant::Rival(kind) => Place::Here(kind.enter(scene, tolerance)),
            Entrant::Peer(kind) => {
                let (a, b) = (scene.a.mesh(), scene.b.mesh());
                Place::Guarded(Box::new(Guarded::start(kind, a, b, tolerance)?))
            }
        };
        Ok(Some(Seat {
            entrant,
            tolerance,
            place,
        }))
    }

    /// Who sits here.
    pub fn entrant(&self) -> Entrant {
        self.entrant
    }

    /// With which tolerance it answers.
    pub fn tolerance(&self) -> f64 {
        self.tolerance
    }

    /// Tells it another tolerance.
    ///
    /// # Errors
    /// When a peer's process does not start again.
    pub fn set_tolerance(&mut self, tolerance: f64) -> io::Result<()> {
        self.tolerance = tolerance;
        match &mut self.place {
            Place::Here(contender) => {
                contender.set_tolerance(tolerance);
                Ok(())
            }
            Place::Guarded(guarded) => guarded.restart_with(tolerance),
        }
    }

    /// Lets a method that prepares what it meets first do so with some queries, for so long.
    pub(super) fn rehearse<'q>(
        &mut self,
        queries: impl Iterator<Item = &'q Query>,
        time: Duration,
    ) {
        let start = Instant::now();
        if let (Place::Here(contender), Entrant::Ours(..)) = (&mut self.place, self.entrant) {
            for query in queries.take_while(|_| start.elapsed() < time) {
                contender.answer(query);
            }
        }
    }

    /// Asks one query.
    pub(super) fn ask(&mut self, query: &Query, patience: Duration) -> Answered {
        match &mut self.place {
            Place::Here(contender) => timed(contender.as_mut(), query),
            Place::Guarded(guarded) => {
                let start = Instant::now();
                match guarded.ask(query, patience) {
                    Ok(Asked::Answered { reply, micros }) => Answered::InTime { reply, micros },
                    Ok(Asked::CutOff | Asked::Died) | Err(_) => Answered::CutOff {
                        micros: start.elapsed().as_secs_f64() * 1e6,
                    },
                }
            }
        }
    }
}

impl Answered {
    pub(super) fn micros(&self) -> f64 {
        match *self {
            Answered::InTime { micros, .. } | Answered::CutOff { micros } => micros,
        }
    }

    pub(super) fn steps(&self) -> u64 {
        match self {
            Answered::InTime { reply, .. } => reply.steps,
            Answered::CutOff { .. } => 0,
        }
    }
}

fn timed(contender: &mut dyn Adjustable, query: &Query) -> Answered {
    let mut micros = Vec::with_capacity(REPEATS);
    let first = Instant::now();
    loop {
        let start = Instant::now();
        let reply = contender.answer(query);
        micros.push(start.elapsed().as_secs_f64() * 1e6);
        if first.elapsed() > REPEATED_WITHIN || micros.len() == REPEATS {
            let warm = if micros.len() > 1 { 1 } else { 0 };
            let micros = median(&mut micros[warm..]);
            return Answered::InTime { reply, micros };
        }
    }
}
