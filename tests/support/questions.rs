//! Asks the questions other than the first contact, by every oracle and for every kind of piece. For user-defined
//! trajectories, it asks all questions.

use crate::backends::OracleKind;
use crate::models::PieceKind;
use crate::query::{Bodies, Query};
use ccd_core::Schedule;
use ccd_core::schedule::{BestFirst, DepthFirst};
use ccd_core::{
    AccelerationBounds, Answer, DistanceOracle, InputError, Motion, Settings, SmoothTrajectory,
};
use ccd_distance_gjk::{ClosedForm, Direct, Gjk};
use ccd_distance_vmarch::Vmarch;

/// A motion in the form of a user-defined trajectory, by its tangent motions and accelerations of zero.
#[derive(Clone, Copy, Debug)]
pub struct MotionAsSmoothTrajectory(pub Motion);

impl SmoothTrajectory for MotionAsSmoothTrajectory {
    fn tangent_motion(&self, time: f64) -> Result<Motion, InputError> {
        let MotionAsSmoothTrajectory(motion) = self;
        let (velocity, spin) = (motion.velocity(), motion.angular_velocity());
        Motion::about(motion.pose(time), velocity, spin, motion.center())
    }

    fn acceleration_bounds(&self, _from: f64, _to: f64) -> AccelerationBounds {
        AccelerationBounds::default()
    }
}

/// The distance oracle and the kinds of pieces with which an answer was found. It is printed if an assertion fails.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OracleSetup {
    /// The distance oracle that gave the answer.
    pub oracle: OracleKind,
    /// The kinds of pieces of bodies A and B.
    pub piece_kinds: [PieceKind; 2],
}

/// The answers to all questions but the first contact, about two motions.
#[derive(Clone, Copy, Debug)]
pub struct MotionAnswers {
    /// The answer to whether the bodies touch at all.
    pub any_contact: Answer,
    /// The answer about the least distance.
    pub closest_approach: Answer,
    /// A required distance, and the answer to whether the bodies keep it.
    pub clearance_check: (f64, Answer),
}

/// The answers to all questions about two motions, given as user-defined trajectories.
#[derive(Clone, Copy, Debug)]
pub struct TrajectoryAnswers {
    /// The answer about the first contact.
    pub first_contact: Answer,
    /// The answer to whether the bodies touch at all.
    pub any_contact: Answer,
    /// The answer about the least distance.
    pub closest_approach: Answer,
    /// A required distance, and the answer to whether the bodies keep it.
    pub clearance_check: (f64, Answer),
    /// The answer about the first and the last contact.
    pub contact_interval: Answer,
}

impl OracleKind {
    /// All distance oracles that are tested.
    pub const ALL: [OracleKind; 4] = [
        OracleKind::ClosedForm,
        OracleKind::Gjk,
        OracleKind::Direct,
        OracleKind::Vmarch,
    ];
}

/// Calls `check` with the answers by every oracle that supports the bodies, for all kinds of pieces of the query.
pub fn for_each_answer_set(
    query: &Query,
    config: &Settings,
    mut check: impl FnMut(&Bodies, OracleSetup, MotionAnswers),
) {
    for_each_oracle_setup(query, |bodies, asked| {
        let answers = match asked.oracle {
            OracleKind::ClosedForm => motion_answers(query, bodies, config, ClosedForm::default()),
            OracleKind::Gjk => motion_answers(query, bodies, config, Gjk),
            OracleKind::Direct => motion_answers(query, bodies, config, Direct::default()),
            OracleKind::Vmarch => {
                motion_answers(query, bodies, config, Vmarch::default().or_else(Gjk))
            }
        };
        check(bodies, asked, answers);
    });
}

/// Calls `check` as [`for_each_answer_set`] does, with the answers for the motions given as user-defined trajectories.
pub fn for_each_trajectory_answer_set(
    query: &Query,
    config: &Settings,
    mut check: impl FnMut(&Bodies, OracleSetup, TrajectoryAnswers),
) {
    for_each_oracle_setup(query, |bodies, asked| {
        let answers = match asked.oracle {
            OracleKind::ClosedForm => {
                trajectory_answers(query, bodies, config, ClosedForm::default())
            }
            OracleKind::Gjk => trajectory_answers(query, bodies, config, Gjk),
            OracleKind::Direct => trajectory_answers(query, bodies, config, Direct::default()),
            OracleKind::Vmarch => {
                trajectory_answers(query, bodies, config, Vmarch::default().or_else(Gjk))
            }
        };
        check(bodies, asked, answers);
    });
}

fn for_each_oracle_setup(query: &Query, mut call: impl FnMut(&Bodies, OracleSetup)) {
    for bodies in query.bodies_of_kind_pairs() {
        for oracle in OracleKind::ALL
            .into_iter()
            .filter(|oracle| oracle.supports(&bodies))
        {
            let kinds = bodies.piece_kinds;
            call(
                &bodies,
                OracleSetup {
                    oracle,
                    piece_kinds: kinds,
                },
            );
        }
    }
}

/// Returns a required distance below, at or above the least distance, and the settings with that clearance.
fn required_distance_near(closest: &Answer, config: &Settings) -> (f64, Settings) {
    let (lower, upper) = (closest.outcome.lower(), closest.outcome.upper());
    // A pseudo-random choice.
    let required = match closest.stats.iterations % 4 {
        0 => 0.9 * lower,
        1 => upper + 2.0 * closest.tolerance,
        2 => 0.5 * (lower + upper),
        _ => 2.0 * upper,
    };
    let clearance = Some(required).filter(|required| *required <= 1e12);
    let keeping = Settings {
        clearance: Some(clearance.unwrap_or(1.0)),
        ..config.clone()
    };
    (clearance.unwrap_or(1.0), keeping)
}

fn motion_answers<O: DistanceOracle>(
    query: &Query,
    bodies: &Bodies,
    config: &Settings,
    mut oracle: O,
) -> MotionAnswers {
    let problem = query.problem(bodies, config);
    let mut schedule = DepthFirst::<O>::default();
    let well_posed = "motions within range";
    let closest = schedule
        .closest_approach(&problem, &mut oracle)
        .expect(well_posed);
    let (required, keeping) = required_distance_near(&closest, config);
    let problem = query.problem(bodies, &keeping);
    MotionAnswers {
        any_contact: schedule
            .any_contact(&problem, &mut oracle)
            .expect(well_posed),
        closest_approach: closest,
        clearance_check: (
            required,
            schedule
                .closest_approach(&problem, &mut oracle)
                .expect(well_posed),
        ),
    }
}

fn trajectory_answers<O: DistanceOracle>(
    query: &Query,
    bodies: &Bodies,
    config: &Settings,
    mut oracle: O,
) -> TrajectoryAnswers {
    let (a, b) = (
        MotionAsSmoothTrajectory(query.a.motion),
        MotionAsSmoothTrajectory(query.b.motion),
    );
    let (a, b) = ((bodies.a(), &a), (bodies.b(), &b));
    let along = ccd_core::Query::new(a, b, query.duration, config).expect("a well-posed query");
    let mut best_first = BestFirst::<O>::default();
    let mut depth_first = DepthFirst::<O>::default();
    let well_posed = "motions within range";
    let closest = (depth_first.closest_approach(&along, &mut oracle)).expect(well_posed);
    let (required, keeping) = required_distance_near(&closest, config);
    let keeping = ccd_core::Query::new(a, b, query.duration, &keeping).expect("a well-posed query");
    let cleared = (depth_first.closest_approach(&keeping, &mut oracle)).expect(well_posed);
    TrajectoryAnswers {
        first_contact: (best_first.first_contact(&along, &mut oracle)).expect(well_posed),
        any_contact: (depth_first.any_contact(&along, &mut oracle)).expect(well_posed),
        closest_approach: closest,
        clearance_check: (required, cleared),
        contact_interval: (best_first.contact_interval(&along, &mut oracle)).expect(well_posed),
    }
}
