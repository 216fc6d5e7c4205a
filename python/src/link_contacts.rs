//! The question which links of a robot can touch, and the table of its answer.

use crate::errors::{file_error, input_error, interruption_error, wrong_type_error};
use crate::interruptible::run_interruptibly;
use crate::numbers::whole_number;
use crate::table::PyTable;
use arrow_array::{ArrayRef, Float64Array, RecordBatch, StringArray};
use arrow_schema::ArrowError;
use pyo3::prelude::*;
use rigid_ccd_robot::{LinkContactClass, LinkContactSettings, Robot};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// The arguments of `Robot.acm`.
pub(crate) struct LinkContactQuestion<'a, 'py> {
    pub(crate) robot: &'a Robot,
    pub(crate) max_boxes: usize,
    /// The SRDF file to write, and the name of the robot in it.
    pub(crate) srdf: Option<(PathBuf, &'a str)>,
    pub(crate) progress: Option<Bound<'py, PyAny>>,
}

impl LinkContactQuestion<'_, '_> {
    /// Answers the question; Ctrl-C ends it with what is decided by then.
    pub(crate) fn answer(self, py: Python<'_>) -> PyResult<PyTable> {
        let LinkContactQuestion {
            robot,
            max_boxes,
            srdf,
            progress,
        } = self;
        if let Some(progress) = progress.as_ref().filter(|progress| !progress.is_callable()) {
            return Err(wrong_type_error("progress", "a function", progress));
        }
        if let Some((path, _)) = &srdf {
            check_folder_of(path)?;
        }
        let progress = progress.map(Bound::unbind);
        let (decided, all) = (AtomicUsize::new(0), AtomicUsize::new(0));
        let work = |stop: &Arc<AtomicBool>| {
            let settings = LinkContactSettings {
                max_boxes,
                deadline: None,
                stop: Some(Arc::clone(stop)),
            };
            robot.classify_link_contacts(&settings, |now, pairs| {
                decided.fetch_max(now, Ordering::Relaxed);
                all.store(pairs, Ordering::Relaxed);
            })
        };
        let mut reported = None;
        let mut report = |py: Python<'_>| {
            let now = [&decided, &all].map(|count| count.load(Ordering::Relaxed));
            match &progress {
                Some(progress) if reported.replace(now) != Some(now) => {
                    progress.call1(py, (now[0], now[1])).map(drop)
                }
                _ => Ok(()),
            }
        };
        let (meetings, interruption) = run_interruptibly(py, work, &mut report)?;
        let meetings = meetings.map_err(input_error)?;
        if let Err(cause) = interruption.and_then(|()| report(py)) {
            let batch = link_contact_table(robot, &meetings).map_err(input_error)?;
            return Err(interruption_error(py, cause, PyTable { batch }));
        }
        if let Some((path, name)) = srdf {
            let text = robot.to_srdf(name, &meetings);
            std::fs::write(&path, text).map_err(|error| file_error(&error, &path))?;
        }
        let batch = link_contact_table(robot, &meetings).map_err(input_error)?;
        Ok(PyTable { batch })
    }
}

/// Refuses the path of a file to write whose folder is missing, before the work and not after it.
fn check_folder_of(path: &Path) -> PyResult<()> {
    let folder = match path.parent() {
        Some(folder) if folder.as_os_str().is_empty() => Path::new("."),
        Some(folder) => folder,
        None => path,
    };
    let found = std::fs::metadata(folder);
    found.map_err(|error| file_error(&error, path)).map(drop)
}

/// Reads the number of boxes that are examined for a pair.
pub(crate) fn read_max_boxes(given: &Bound<'_, PyAny>) -> PyResult<usize> {
    whole_number(given, "max_boxes", 0..=usize::MAX)
}

/// Makes a table with a row for each pair of links.
fn link_contact_table(
    robot: &Robot,
    meetings: &[([usize; 2], LinkContactClass)],
) -> Result<RecordBatch, ArrowError> {
    let names = |side: usize| -> ArrayRef {
        let links = meetings.iter().map(|(links, _)| links[side]);
        let names = links.map(|link| Some(robot.links()[link].name.as_str()));
        Arc::new(names.collect::<StringArray>())
    };
    let evidence = meetings.iter().map(|(_, meeting)| {
        Some(match meeting {
            LinkContactClass::Never => "never",
            LinkContactClass::Always => "always",
            LinkContactClass::AlwaysAsEnclosed => "always-as-enclosed",
            LinkContactClass::Sometimes { .. } => "sometimes",
            LinkContactClass::Undecided { .. } => "undecided",
        })
    });
    let numbers = |number: usize| -> ArrayRef {
        let found = meetings.iter().map(|(_, meeting)| match meeting {
            LinkContactClass::Undecided {
                proven_apart_share,
                undecided_share,
                least_distance,
                ..
            } => Some([*proven_apart_share, *undecided_share, *least_distance][number]),
            _ => None,
        });
        Arc::new(found.collect::<Float64Array>())
    };
    let columns: [(&str, ArrayRef, bool); 6] = [
        ("link_a", names(0), false),
        ("link_b", names(1), false),
        (
            "evidence",
            Arc::new(evidence.collect::<StringArray>()),
            false,
        ),
        ("apart", numbers(0), true),
        ("undecided", numbers(1), true),
        ("least_distance", numbers(2), true),
    ];
    RecordBatch::try_from_iter_with_nullable(columns)
}
