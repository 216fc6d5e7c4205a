//! Questions about two bodies.

use super::answer::{AnswerKind, AnswerNumbers, ContactNumbers};
use super::body::Body;
use super::fault::Fault;
use super::fields::named_numbers;
use super::host::tell;
use super::movement::{MOTION_LENGTH, Movement, motion_from_numbers};
use rigid_ccd::trajectory::MovingBody;
use rigid_ccd::{Answer, InputError, Motion, Remark, Settings};
use wasm_bindgen::prelude::wasm_bindgen;

named_numbers! {
    /// The numbers of a question and of its answer. JavaScript reads and writes them by the names of the fields.
    struct Numbers {
        tolerance: f64,
        margin: f64,
        clearance: f64,
        budget: f64,
        duration: f64,
        motion_a: [f64; MOTION_LENGTH],
        motion_b: [f64; MOTION_LENGTH],
        answer: AnswerNumbers,
    }
}

impl Numbers {
    fn settings(&self, question: Question) -> Settings {
        Settings {
            tolerance: self.tolerance,
            margin: self.margin,
            clearance: (question == Question::KeptClearance).then_some(self.clearance),
            // The cast saturates: a larger number is the largest budget.
            budget: self.budget as u64,
            ..Settings::DEFAULT
        }
    }
}

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

/// Answers questions about two bodies. JavaScript writes the numbers of a question to the solver's memory, and reads
/// the numbers of the answer there.
#[wasm_bindgen]
pub struct Solver {
    solver: rigid_ccd::Solver,
    numbers: Box<Numbers>,
    /// The movements of the bodies in the next question. Each replaces a motion among the numbers.
    movements: [Option<Movement>; 2],
}

#[wasm_bindgen]
impl Solver {
    /// Creates a solver with the default settings.
    #[wasm_bindgen(constructor)]
    pub fn new() -> Self {
        let Settings {
            tolerance,
            margin,
            budget,
            ..
        } = Settings::DEFAULT;
        let numbers = Box::new(Numbers {
            tolerance,
            margin,
            budget: budget as f64,
            ..Numbers::default()
        });
        Solver {
            solver: rigid_ccd::Solver::new(),
            numbers,
            movements: [None, None],
        }
    }

    /// Returns the address of the array of numbers.
    pub fn numbers_address(&self) -> usize {
        std::ptr::from_ref(&*self.numbers) as usize
    }

    /// Returns the length of the array of numbers.
    pub fn number_count(&self) -> usize {
        size_of::<Numbers>() / size_of::<f64>()
    }

    /// Returns the layout of the numbers as lines such as `contact.witness_a 2`: the name of a struct and of its field, and
    /// the index of the field's first number.
    pub fn layout() -> String {
        let groups = [
            ("solver", Numbers::FIELDS),
            ("answer", AnswerNumbers::FIELDS),
            ("contact", ContactNumbers::FIELDS),
        ];
        let fields = groups.into_iter().flat_map(|(group, fields)| {
            let line = move |(name, index): &(&str, usize)| format!("{group}.{name} {index}");
            fields.iter().map(line)
        });
        fields.collect::<Vec<String>>().join("\n")
    }

    /// Sets the movement of body 0 or 1 for the next question.
    pub fn move_by(&mut self, body: usize, movement: &Movement) {
        if let Some(slot) = self.movements.get_mut(body) {
            *slot = Some(movement.clone());
        }
    }

    /// Answers a question.
    ///
    /// # Errors
    /// A number that is out of range.
    pub fn ask(&mut self, question: Question, a: &Body, b: &Body) -> Result<AnswerKind, Fault> {
        let answer = self.answer(question, a, b)?;
        tell(Remark::remark_on_tolerance(
            self.numbers.tolerance,
            [a.size, b.size],
        ));
        let duration = self.numbers.duration;
        Ok(self.numbers.answer.write(&answer, duration))
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
        let duration = self.numbers.duration;
        for movement in [&move_a, &move_b].into_iter().flatten() {
            let latest = movement.latest_duration();
            if duration > latest {
                return Err(Fault::of_range(format!(
                    "duration: {duration} is later than {latest}, the end of the link's motion, after which joints could exceed their limits"
                )));
            }
        }
        self.solver.set_settings(self.numbers.settings(question));
        let [motion_a, motion_b] = [&self.numbers.motion_a, &self.numbers.motion_b]
            .map(|numbers| motion_from_numbers(numbers));
        let solver = &mut self.solver;
        let movements = [(&move_a, &motion_a), (&move_b, &motion_b)].into_iter();
        let angular_velocities = movements.filter_map(|(movement, motion)| match movement {
            Some(movement) => movement.constant_spin(),
            None => motion.as_ref().ok().map(Motion::angular_velocity),
        });
        tell(angular_velocities.filter_map(|spin| Remark::remark_on_spin(spin, duration)));
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
    call: impl FnOnce(MovingBody<'_>) -> Result<T, InputError>,
) -> Result<T, InputError> {
    match movement {
        Some(movement) => movement.with_body(&body.body, call),
        None => call((&*body.body, motion?).into()),
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
