//! Tables of motions, answered row by row.

pub(crate) mod answering;
mod batch;
mod input;
mod numpy_column;
mod pieces;
mod results;

pub(crate) use input::Reader;

use crate::arrays::indices;
use crate::body::PyBody;
use crate::errors::{input as refuse, interrupted, with_attribute, wrong_type};
use crate::pages;
use crate::polled::polled;
use crate::settings::{self, OF_CONTACTS, OF_DISTANCES, config};
use answering::{Answered, Asked, Micros};
use arrow_array::cast::AsArray;
use arrow_array::{Array, ArrayRef, RecordBatch, StructArray};
use arrow_schema::Field;
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;
use pyo3::types::{PyCapsule, PyDict, PyList, PyTuple};
use pyo3_arrow::ffi::{
    ArrayIterator, to_array_pycapsules, to_schema_pycapsule, to_stream_pycapsule,
};
use rigid_ccd::batch::{Bodies, Question};
use rigid_ccd::table::motions::TableError;
use std::collections::HashSet;
use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// A table in Arrow columns.
///
/// It speaks the Arrow PyCapsule protocol: `pyarrow.table(t)`, `polars.DataFrame(t)`, `pandas.DataFrame.from_arrow(t)`
/// take it without a copy, and duckdb queries it by its variable's name. `t["time"]` is a column as a NumPy array: of
/// numbers a view that cannot be written, with NaN in empty cells; of text an array of str and None. `dict(t)` has all
/// columns.
#[pyclass(name = "Table", module = "rigid_ccd", frozen, mapping)]
pub(crate) struct PyTable {
    batch: RecordBatch,
}

#[pymethods]
impl PyTable {
    /// Takes any Arrow table, or a dict of arrays.
    #[new]
    fn new(py: Python<'_>, table: &Bound<'_, PyAny>) -> PyResult<Self> {
        let reader = input::open(table)?;
        if reader.schema().fields().is_empty() {
            return Err(refuse("table: there is no column"));
        }
        let (found, seen) = polled(py, |stop| batch::whole(reader, stop), |_| Ok(()));
        seen?;
        let batch = found.map_err(|error| refuse(format!("table: {error}")))?;
        Ok(PyTable { batch })
    }

    /// The names of the columns, in order.
    #[getter]
    fn column_names(&self) -> Vec<String> {
        batch::header(&self.batch.schema())
    }

    /// The names of the columns, as of a dict.
    fn keys(&self) -> Vec<String> {
        self.column_names()
    }

    /// The rows with these numbers, in that order, as a table.
    fn take(&self, rows: &Bound<'_, PyAny>) -> PyResult<Self> {
        let all = self.batch.num_rows();
        let rows = indices(rows, "rows")?;
        if let Some(wrong) = rows.iter().find(|&&row| !(0..all as i64).contains(&row)) {
            return Err(refuse(format!("row {wrong}: the table has {all} rows")));
        }
        let rows = arrow_array::Int64Array::from(rows);
        let batch = arrow_select::take::take_record_batch(&self.batch, &rows).map_err(refuse)?;
        Ok(PyTable { batch })
    }

    fn __len__(&self) -> usize {
        self.batch.num_rows()
    }

    fn __contains__(&self, name: &str) -> bool {
        self.batch.column_by_name(name).is_some()
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, pyo3::types::PyIterator>> {
        PyList::new(py, self.column_names())?.try_iter()
    }

    fn __getitem__<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        match self.batch.column_by_name(name) {
            Some(column) => numpy_column::to_numpy(py, column),
            None => Err(PyKeyError::new_err(name.to_owned())),
        }
    }

    fn __repr__(&self) -> String {
        let (rows, columns) = (self.batch.num_rows(), self.batch.num_columns());
        format!("Table({rows} rows, {columns} columns{})", self.counts())
    }

    /// The columns' names and types, for whatever takes an Arrow schema.
    fn __arrow_c_schema__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyCapsule>> {
        Ok(to_schema_pycapsule(py, self.batch.schema().as_ref())?)
    }

    #[pyo3(signature = (requested_schema = None))]
    fn __arrow_c_array__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<Bound<'py, PyCapsule>>,
    ) -> PyResult<Bound<'py, PyTuple>> {
        let (field, columns) = self.as_struct();
        Ok(to_array_pycapsules(py, field, &columns, requested_schema)?)
    }

    #[pyo3(signature = (requested_schema = None))]
    fn __arrow_c_stream__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<Bound<'py, PyCapsule>>,
    ) -> PyResult<Bound<'py, PyCapsule>> {
        let (field, columns) = self.as_struct();
        let columns: ArrayRef = Arc::new(columns);
        let reader = ArrayIterator::new([Ok(columns)], field);
        Ok(to_stream_pycapsule(py, Box::new(reader), requested_schema)?)
    }
}

impl PyTable {
    fn as_struct(&self) -> (Arc<Field>, StructArray) {
        let columns = StructArray::from(self.batch.clone());
        let field = Field::new("", columns.data_type().clone(), false);
        let metadata = self.batch.schema().metadata().clone();
        (Arc::new(field.with_metadata(metadata)), columns)
    }

    /// Returns how many rows there are of each status, in words.
    fn counts(&self) -> String {
        let column = self.batch.column_by_name("status");
        let Some(column) = column.and_then(|column| column.as_string_opt::<i32>()) else {
            return String::new();
        };
        let mut counts: Vec<(&str, usize)> = Vec::new();
        for status in column.iter().flatten() {
            match counts.iter_mut().find(|(name, _)| *name == status) {
                Some((_, count)) => *count += 1,
                None => counts.push((status, 1)),
            }
        }
        counts
            .iter()
            .map(|(name, count)| format!(", {count} {name}"))
            .collect()
    }
}

/// Answers a question about each row of a table of motions; `rigid_ccd.first_contacts` and the like call it.
#[pyfunction]
#[pyo3(signature = (question, a, b, motions, *, clearance = None, threads = None, progress = None, micros = true, **settings))]
#[allow(clippy::too_many_arguments, reason = "keyword arguments of Python")]
pub(crate) fn answer_table(
    py: Python<'_>,
    question: &str,
    a: &Bound<'_, PyBody>,
    b: &Bound<'_, PyBody>,
    motions: &Bound<'_, PyAny>,
    clearance: Option<f64>,
    threads: Option<i64>,
    progress: Option<Bound<'_, PyAny>>,
    micros: bool,
    settings: Option<&Bound<'_, PyDict>>,
) -> PyResult<PyTable> {
    let question = self::question(question)?;
    let asked = Asked {
        bodies: Bodies {
            a: &a.get().body,
            b: &b.get().body,
        },
        config: config(settings, known(question))?,
        question,
        clearance,
        threads: settings::threads(threads)?,
        micros: match micros {
            true => Micros::Told,
            false => Micros::LeftOut,
        },
    };
    // One query shows whether the settings can be used: an error of each row would only repeat it.
    check(asked)?;
    if let Some(progress) = progress.as_ref().filter(|progress| !progress.is_callable()) {
        return Err(wrong_type("progress", "a function", progress));
    }
    let progress = progress.map(Bound::unbind);
    let reader = input::open(motions)?;
    let (rows, done) = (input::rows(motions, &reader), AtomicUsize::new(0));
    let mut told = None;
    let mut tell = |py: Python<'_>| {
        let now = done.load(Ordering::Relaxed);
        match &progress {
            Some(progress) if told.replace(now) != Some(now) => {
                progress.call1(py, (now, rows)).map(drop)
            }
            _ => Ok(()),
        }
    };
    let work = |stop: &_| answering::answer(asked, reader, stop, &done);
    let (found, seen) = polled(py, work, &mut tell);
    let Answered { results, fault } = found.map_err(|error| table_error(&error))?;
    let table = PyTable { batch: results };
    match (seen.and_then(|()| tell(py)), fault) {
        (Err(cause), _) => Err(interrupted(py, cause, table)),
        (Ok(()), Some(fault)) => Err(with_attribute(py, table_error(&fault), "results", table)),
        (Ok(()), None) => Ok(table),
    }
}

/// Writes a page for each of some rows of a table of motions, by their numbers; `rigid_ccd.audit` calls it.
#[pyfunction]
#[pyo3(signature = (a, b, motions, rows, folder, **settings))]
pub(crate) fn write_pages(
    py: Python<'_>,
    a: &Bound<'_, PyBody>,
    b: &Bound<'_, PyBody>,
    motions: &Bound<'_, PyAny>,
    rows: HashSet<usize>,
    folder: PathBuf,
    settings: Option<&Bound<'_, PyDict>>,
) -> PyResult<Vec<PathBuf>> {
    let asked = Asked {
        bodies: Bodies {
            a: &a.get().body,
            b: &b.get().body,
        },
        question: Question::FirstContact,
        config: config(settings, OF_CONTACTS)?,
        clearance: None,
        threads: NonZeroUsize::new(1),
        micros: Micros::LeftOut,
    };
    let reader = input::open(motions)?;
    let work = |stop: &Arc<_>| pages::write(asked, reader, &rows, &folder, stop);
    let (written, seen) = polled(py, work, |_| Ok(()));
    seen?;
    Ok(written?)
}

fn question(name: &str) -> PyResult<Question> {
    let found = Question::ALL
        .into_iter()
        .find(|question| question.name() == name);
    found.ok_or_else(|| {
        let names: Vec<String> = Question::ALL
            .iter()
            .map(|q| format!("{:?}", q.name()))
            .collect();
        refuse(format!("ask: {name:?} is none of {}", names.join(", ")))
    })
}

fn known(question: Question) -> &'static [&'static str] {
    match question.is_for_a_distance() {
        true => OF_DISTANCES,
        false => OF_CONTACTS,
    }
}

/// Refuses settings that no query can have.
fn check(asked: Asked<'_>) -> PyResult<()> {
    match asked.clearance {
        Some(_) if !asked.question.is_for_a_distance() => {
            return Err(refuse(
                "clearance: only distances are compared with one; use margin",
            ));
        }
        // Written so that NaN is refused.
        Some(clearance) if !(clearance >= 0.0 && clearance.is_finite()) => {
            return Err(refuse(format!("clearance: {clearance} is no distance")));
        }
        _ => {}
    }
    let Bodies { a, b } = asked.bodies;
    let still = rigid_ccd::Motion::STILL;
    let problem = rigid_ccd::Problem::new((a, still), (b, still), 1.0, &asked.config);
    problem.map(drop).map_err(refuse)
}

fn table_error(error: &TableError) -> PyErr {
    refuse(match error {
        TableError::Empty => "motions: there is no column".to_owned(),
        TableError::Unreadable(why) => format!("motions: {why}"),
        other => format!("motions: {other}"),
    })
}
