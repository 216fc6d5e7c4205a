//! The Python functions that answer a question about each row of a table.

use crate::body::{extract_body, warn_of_large_tolerance};
use crate::errors::{
    input_error as refuse, input_error_or_interrupt, interruption_error, warn, with_attribute,
};
use crate::progress::{GivenProgress, run_with_progress};
use crate::settings::{self, REPORTING_START, TABLE_SETTING_NAMES};
use crate::table::answering::{TableAnswers, TableQuestion, answer};
use crate::table::{PyTable, input};
use ccd_tables::batch::BodyPair;
use ccd_tables::motions::TableError;
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rigid_ccd::Question;

/// Answers a question about each row of a table of motions. `rigid_ccd.first_contacts` and the other table functions
/// call it.
#[pyfunction]
#[pyo3(signature = (question, a, b, motions, *, threads = None, progress = None, micros = true, **settings))]
#[allow(clippy::too_many_arguments, reason = "keyword arguments of Python")]
pub(crate) fn answer_table(
    py: Python<'_>,
    question: &str,
    a: &Bound<'_, PyAny>,
    b: &Bound<'_, PyAny>,
    motions: &Bound<'_, PyAny>,
    threads: Option<&Bound<'_, PyAny>>,
    progress: Option<&Bound<'_, PyAny>>,
    micros: bool,
    settings: Option<&Bound<'_, PyDict>>,
) -> PyResult<PyTable> {
    let question = question_named(question)?;
    let settings = settings::read(settings, &allowed_setting_names(question))?;
    let table_question = TableQuestion {
        bodies: BodyPair {
            a: extract_body(a, "a")?,
            b: extract_body(b, "b")?,
        },
        settings: &settings,
        question,
        thread_count: settings::read_thread_count(threads)?,
        has_micros: micros,
    };
    // Checks the settings once, because each row would repeat the same error.
    settings.check().map_err(refuse)?;
    let reader = input::open(motions)?;
    let progress = GivenProgress {
        progress,
        total: input::expected_answer_count(motions, &reader),
    };
    let work = |stop: &_, done: &_| answer(table_question, reader, stop, done);
    let (answers, interruption) = run_with_progress(py, progress, work)?;
    let answers = answers.map_err(|error| table_error(&error))?;
    let TableAnswers {
        results,
        error: row_error,
        remarks,
    } = answers;
    let table = PyTable { batch: results };
    match (interruption, row_error) {
        (Err(cause), _) => Err(interruption_error(py, cause, table)),
        (Ok(()), Some(row_error)) => Err(match table_error(&row_error) {
            error if error.is_instance_of::<PyKeyboardInterrupt>(py) => {
                interruption_error(py, error, table)
            }
            error => with_attribute(py, error, "results", table),
        }),
        (Ok(()), None) => {
            warn(py, remarks, STACK_FRAMES_TO_CALLER)?;
            warn_of_large_tolerance([a, b], settings.tolerance, STACK_FRAMES_TO_CALLER)?;
            Ok(table)
        }
    }
}

/// The number of stack frames from `answer_table` to the caller of `rigid_ccd.first_contacts`.
const STACK_FRAMES_TO_CALLER: i32 = 3;

fn question_named(name: &str) -> PyResult<Question> {
    Question::from_name(name).ok_or_else(|| {
        let names = Question::ALL.map(|question| format!("{:?}", question.name()));
        refuse(format!(
            "question: {name:?} is none of {}",
            names.join(", ")
        ))
    })
}

fn allowed_setting_names(question: Question) -> Vec<&'static str> {
    let mut names = settings::names(question, REPORTING_START);
    names.extend(TABLE_SETTING_NAMES);
    names
}

fn table_error(error: &TableError) -> PyErr {
    input_error_or_interrupt(match error {
        TableError::Empty => "motions: there is no column".to_owned(),
        TableError::Unreadable(why) => format!("motions: {why}"),
        other => format!("motions: {other}"),
    })
}
