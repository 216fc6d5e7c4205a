//! Questions about two bodies.

use super::answer::{self, ANSWER_LENGTH, AnswerKind};
use super::body::Body;
use super::fault::Fault;
use super::host::tell;
use super::movement::{MOTION_LENGTH, Movement, motion_from_numbers};
use rigid_ccd::trajectory::MovingBody;
use rigid_ccd::{Answer, InputError, Motion, Remark, Settings};
use wasm_bindgen::prelude::wasm_bindgen;

/// Indices in the numbers of a solver. `doors/js/module/solver.js` has the same.
const SETTINGS: usize = 0;
const DURATION: usize = 4;
const MOTIONS: [usize; 2] = [5, 5 + MOTION_LENGTH];
const ANSWER: usize = 5 + 2 * MOTION_LENGTH;

/// A question about two bodies.
#[wasm_bindgen]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Question {
    /// When do the bodies first touch?
    FirstContact,
    /// Do the bodies touch at all?
    AnyContact,
    /// When do the bodies first touch, and when last?
    ContactInterval,
    /// How near do the bodies come?
    ClosestApproach,
    /// Do the bodies keep a clearance?
    KeptClearance,
}

/// Answers questions about two bodies. Numbers are passed in an array in its memory.
///
/// The shared array. JavaScript writes tolerance, margin, clearance, budget, duration, and the numbers of two motions.
/// A question writes the numbers of its answer behind them.
#[wasm_bindgen]
pub struct Solver {
    solver: rigid_ccd::Solver,
    numbers: Box<[f64; ANSWER + ANSWER_LENGTH]>,
    /// The movements of the bodies in the next question. Each replaces a motion in `numbers`.
    movements: [Option<Movement>; 2],
}

#[wasm_bindgen]
impl Solver {
    /// Creates a solver with the default settings.
    #[wasm_bindgen(constructor)]
    pub fn new() -> Self {
        let mut numbers = Box::new([0.0; ANSWER + ANSWER_LENGTH]);
        let Settings {
            tolerance,
            margin,
            budget,
            ..
        } = Settings::DEFAULT;
        numbers[SETTINGS..DURATION].copy_from_slice(&[tolerance, margin, 0.0, budget as f64]);
        Solver {
            solver: rigid_ccd::Solver::new(),
            numbers,
            movements: [None, None],
        }
    }

    /// Returns the address of the array of numbers.
    pub fn numbers_address(&self) -> usize {
        self.numbers.as_ptr() as usize
    }

    /// Returns the length of the array of numbers.
    pub fn number_count(&self) -> usize {
        self.numbers.len()
    }

    /// Sets the movement of body 0 or 1 for the next question.
    pub fn move_by(&mut self, body: usize, movement: &Movement) {
        if let Some(place) = self.movements.get_mut(body) {
            *place = Some(movement.clone());
        }
    }

    /// Answers a question.
    ///
    /// # Errors
    /// A number that is out of range.
    pub fn ask(&mut self, question: Question, a: &Body, b: &Body) -> Result<AnswerKind, Fault> {
        let answer = self.answer(question, a, b)?;
        tell(Remark::remark_on_tolerance(
            self.numbers[SETTINGS],
            [a.size, b.size],
        ));
        let duration = self.numbers[DURATION];
        let numbers = &mut self.numbers[ANSWER..];
        Ok(answer::write(&answer, duration, numbers))
    }
}

impl Default for Solver {
    fn default() -> Self {
        Solver::new()
    }
}

impl Solver {
    fn answer(&mut self, question: Question, a: &Body, b: &Body) -> Result<Answer, Fault> {
        let [move_a, move_b] = std::mem::take(&mut self.movements);
        let duration = self.numbers[DURATION];
        for movement in [&move_a, &move_b].into_iter().flatten() {
            let latest = movement.latest_duration();
            if duration > latest {
                return Err(Fault::of_range(format!(
                    "duration: {duration} is later than {latest}, the end of the link's motion: its joints would go on"
                )));
            }
        }
        self.solver
            .set_settings(settings(question, &self.numbers[SETTINGS..DURATION]));
        let motion = |k: usize| motion_from_numbers(&self.numbers[MOTIONS[k]..][..MOTION_LENGTH]);
        let (solver, motion_a, motion_b) = (&mut self.solver, motion(0), motion(1));
        let by_numbers = [(&move_a, &motion_a), (&move_b, &motion_b)].into_iter();
        let spins = by_numbers.filter_map(|(movement, motion)| match movement {
            Some(movement) => movement.constant_spin(),
            None => motion.as_ref().ok().map(Motion::spin),
        });
        tell(spins.filter_map(|spin| Remark::remark_on_spin(spin, duration)));
        Ok(with_moving(move_a, motion_a, a, |a| {
            with_moving(move_b, motion_b, b, |b| {
                solver.answer(question.into(), a, b, duration)
            })
        })?)
    }
}

/// Calls a function with a body and its movement, or its motion if there is no movement.
fn with_moving<T>(
    movement: Option<Movement>,
    motion: Result<Motion, InputError>,
    body: &Body,
    then: impl FnOnce(MovingBody<'_>) -> Result<T, InputError>,
) -> Result<T, InputError> {
    match movement {
        Some(movement) => movement.with_body(&body.body, then),
        None => then((&*body.body, motion?).into()),
    }
}

impl From<Question> for rigid_ccd::Question {
    fn from(question: Question) -> Self {
        match question {
            Question::FirstContact => rigid_ccd::Question::FirstContact,
            Question::AnyContact => rigid_ccd::Question::AnyContact,
            Question::ContactInterval => rigid_ccd::Question::ContactInterval,
            Question::ClosestApproach | Question::KeptClearance => {
                rigid_ccd::Question::ClosestApproach
            }
        }
    }
}

/// Reads the settings of a question: tolerance, margin, clearance and budget.
fn settings(question: Question, numbers: &[f64]) -> Settings {
    Settings {
        tolerance: numbers[0],
        margin: numbers[1],
        clearance: (question == Question::KeptClearance).then_some(numbers[2]),
        // A cast saturates: a larger number is the largest budget.
        budget: numbers[3] as u64,
        ..Settings::DEFAULT
    }
}
