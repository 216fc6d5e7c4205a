//! Settings of queries, as keyword arguments.

use crate::errors::input;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rigid_ccd::Config;
use std::time::Duration;

/// The settings of a query that looks for contacts.
pub(crate) const OF_CONTACTS: &[&str] = &["tolerance", "margin", "budget", "deadline"];

/// The settings of a query that measures distances.
pub(crate) const OF_DISTANCES: &[&str] = &["tolerance", "budget", "deadline"];

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
            "tolerance" => config.tolerance = value.extract()?,
            "margin" => config.margin = value.extract()?,
            "budget" => config.budget = value.extract::<Option<u64>>()?.unwrap_or(config.budget),
            _ => {
                let seconds = value.extract::<Option<f64>>()?;
                let deadline = seconds.map(Duration::try_from_secs_f64).transpose();
                config.deadline = deadline.map_err(|error| input(format!("deadline: {error}")))?;
            }
        }
    }
    Ok(config)
}

fn unknown(name: &str, known: &[&str]) -> PyErr {
    PyTypeError::new_err(format!(
        "unexpected keyword argument '{name}'; the settings are {}",
        known.join(", ")
    ))
}
