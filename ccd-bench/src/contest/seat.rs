//! Where an entrant sits while it is asked: in this process, or in one of its own that can be stopped.

use super::entrant::{Entrant, Ours};
use super::{MOST_PAIRS_FOR_NAIVE, REPEATED_WITHIN, REPEATS};
use crate::contender::{Contender, Reply};
use crate::engine::ScheduleKind;
use crate::motions::Query;
use crate::peer::{Asked, Guarded};
use crate::query::median;
use crate::scene::Scene;
use std::io;
use std::time::{Duration, Instant};

/// An entrant that can be asked.
pub(super) enum Seat<'s> {
    Here(Box<dyn Contender + 's>),
    Guarded(Box<Guarded>),
}

/// Why there is no seat.
pub(super) enum SeatError {
    /// The scene is none for this entrant.
    Unfit,
    /// Its process cannot be started.
    Start(io::Error),
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
    pub(super) fn take(
        entrant: Entrant,
        scene: &'s Scene,
        tolerance: f64,
    ) -> Result<Self, SeatError> {
        Ok(match entrant {
            Entrant::Ours(method, pieces) => {
                let too_many = scene.pairs() > MOST_PAIRS_FOR_NAIVE;
                if method.schedule == ScheduleKind::Naive && too_many {
                    return Err(SeatError::Unfit);
                }
                let bodies = scene.bodies_of(pieces).ok_or(SeatError::Unfit)?;
                Seat::Here(Box::new(Ours::new(method, bodies, tolerance)))
            }
            Entrant::Rival(kind) => Seat::Here(kind.enter(scene, tolerance)),
            Entrant::Peer(kind) => {
                let (a, b) = (scene.a.mesh(), scene.b.mesh());
                let guarded = Guarded::start(kind, a, b, tolerance).map_err(SeatError::Start)?;
                Seat::Guarded(Box::new(guarded))
            }
        })
    }

    /// Asks one query.
    pub(super) fn ask(&mut self, query: &Query, patience: Duration) -> Answered {
        match self {
            Seat::Here(contender) => timed(contender.as_mut(), query),
            Seat::Guarded(guarded) => {
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

fn timed(contender: &mut dyn Contender, query: &Query) -> Answered {
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
