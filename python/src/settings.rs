//! Settings of queries, as keyword arguments.

use crate::errors::{caused, input};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rigid_ccd::Config;
use std::num::NonZeroUsize;
use std::time::Duration;

/// The settings of a query that looks for contacts.
pub(crate) const OF_CONTACTS: &[&str] = &["tolerance", "margin", "budget", "deadline"];

/// The settings of a query that measures distances.
pub(crate) const OF_DISTANCES: &[&str] = &["tolerance", "budget", "deadline"];

/// The most threads: as many as the command takes.
pub(crate) const MOST_THREADS: i64 = 1024;

/// Reads the settings of a query, which may have those that are `known`.
pub(crate) fn config(
    settings: Option<&Bound<'_, PyDict>>,
    known: &[&'static str],
) -> PyResult<Config> {
    let mut config = Config::default();
    for (name, value) in settings.into_iter().flatten() {
        let name: String = name.extract()?;
        match name.as_str() {
            _ if !known.contains(&name.as_str()) => return Err(unknown(&name, known)),
            "tolerance" => config.tolerance = read(&name, &value)?,
            "margin" => config.margin = read(&name, &value)?,
            "budget" => {
                config.budget = read::<Option<u64>>(&name, &value)?.unwrap_or(config.budget)
            }
            _ => config.deadline = deadline(read(&name, &value)?)?,
        }
    }
    Ok(config)
}

/// Reads a number of threads; none for one on each core.
pub(crate) fn threads(given: Option<i64>) -> PyResult<Option<NonZeroUsize>> {
    let in_range = |threads: &i64| (1..=MOST_THREADS).contains(threads);
    match given {
        None => Ok(None),
        Some(threads) if in_range(&threads) => Ok(NonZeroUsize::new(threads as usize)),
        Some(threads) => Err(input(format!(
            "threads: {threads} is not from 1 to {MOST_THREADS}"
        ))),
    }
}

fn read<'py, T>(name: &str, value: &Bound<'py, PyAny>) -> PyResult<T>
where
    T: for<'a> FromPyObject<'a, 'py, Error = PyErr>,
{
    let py = value.py();
    value.extract().map_err(
        |error: PyErr| match error.is_instance_of::<PyTypeError>(py) {
            true => PyTypeError::new_err(format!("{name}: {}", error.value(py))),
            false => caused(py, name, error),
        },
    )
}

/// Reads seconds; infinitely many are none.
fn deadline(seconds: Option<f64>) -> PyResult<Option<Duration>> {
    let finite = seconds.filter(|&seconds| seconds != f64::INFINITY);
    let deadline = finite.map(Duration::try_from_secs_f64).transpose();
    deadline.map_err(|error| input(format!("deadline: {error}")))
}

fn unknown(name: &str, known: &[&str]) -> PyErr {
    PyTypeError::new_err(format!(
        "unexpected keyword argument '{name}'; the settings are {}",
        known.join(", ")
    ))
}
