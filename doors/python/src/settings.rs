//! Reads the settings of queries from Python keyword arguments.

use crate::errors::{input_error, input_error_from};
use crate::numbers::{refuse_truth, whole_number};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rigid_ccd::{Question, Setting, SettingField, Settings, StartPolicy};
use std::time::Duration;

/// The settings that questions about two bodies, proofs and ranges do not take, because they always report contacts at the
/// start.
pub(crate) const REPORTING_START: &[&str] = &["start"];

/// Returns the names of the settings of a question, except for `left_out`.
pub(crate) fn names(question: Question, left_out: &[&str]) -> Vec<&'static str> {
    let names = Setting::taken_by(question).map(|setting| setting.name);
    names.filter(|name| !left_out.contains(name)).collect()
}

/// The names of settings that only table queries have. They are parameters of the function.
pub(crate) const TABLE_SETTING_NAMES: &[&str] = &["threads", "progress", "micros"];

/// The largest number of threads, the same as in the command.
const MAX_THREADS: u16 = 1024;

/// Reads the settings of a query. A keyword that is not in `known` is an error.
pub(crate) fn read(
    keywords: Option<&Bound<'_, PyDict>>,
    known: &[&'static str],
) -> PyResult<Settings> {
    let mut settings = Settings::DEFAULT;
    for (name, value) in keywords.into_iter().flatten() {
        let name: String = name.extract()?;
        let setting = Setting::from_name(&name).filter(|setting| known.contains(&setting.name));
        let setting = setting.ok_or_else(|| unknown_setting_error(&name, known))?;
        match setting.field {
            SettingField::Length(field) => *field(&mut settings) = extract_setting(&name, &value)?,
            SettingField::OptionalLength(field) => {
                *field(&mut settings) = extract_setting(&name, &value)?;
            }
            SettingField::Work(field) => {
                if !value.is_none() {
                    *field(&mut settings) = whole_number(&value, &name, 0..=u64::MAX)?;
                }
            }
            SettingField::Time(field) => {
                *field(&mut settings) = deadline(extract_setting(&name, &value)?)?;
            }
            SettingField::StartPolicy(field) => {
                *field(&mut settings) = start_policy(&extract_setting::<String>(&name, &value)?)?;
            }
        }
    }
    Ok(settings)
}

/// Reads the number of threads of a table query. `None` stands for one thread on each core.
pub(crate) fn read_thread_count(threads: Option<&Bound<'_, PyAny>>) -> PyResult<Option<u16>> {
    let read = |threads| whole_number(threads, "threads", 1..=MAX_THREADS);
    threads.map(read).transpose()
}

fn extract_setting<'py, T>(name: &str, value: &Bound<'py, PyAny>) -> PyResult<T>
where
    T: for<'a> FromPyObject<'a, 'py, Error = PyErr>,
{
    let py = value.py();
    refuse_truth(value, name)?;
    value.extract().map_err(|error: PyErr| {
        if error.is_instance_of::<PyTypeError>(py) {
            PyTypeError::new_err(format!("{name}: {}", error.value(py)))
        } else {
            input_error_from(py, name, error)
        }
    })
}

/// Reads the start policy: how pairs in contact at the start are treated.
fn start_policy(name: &str) -> PyResult<StartPolicy> {
    StartPolicy::from_name(name)
        .ok_or_else(|| input_error(format!("start: '{name}' is not report or leave")))
}

/// Reads a time limit in seconds. Infinity gives `None`, which is no limit.
fn deadline(seconds: Option<f64>) -> PyResult<Option<Duration>> {
    let finite = seconds.filter(|&seconds| seconds != f64::INFINITY);
    let deadline = finite.map(Duration::try_from_secs_f64).transpose();
    deadline.map_err(|_| {
        input_error(format!(
            "deadline: {} is not a number of seconds from 0 on",
            seconds.unwrap_or_default()
        ))
    })
}

fn unknown_setting_error(name: &str, known: &[&str]) -> PyErr {
    PyTypeError::new_err(format!(
        "unexpected keyword argument '{name}'; settings are {}",
        known.join(", ")
    ))
}
