//! Decides which links of a robot can touch, and makes the table of answers.

use crate::errors::{file_error, input_error};
use crate::numbers::whole_number;
use crate::progress::{GivenProgress, results_or_interruption, run_with_progress};
use crate::table::PyTable;
use arrow_array::{ArrayRef, Float64Array, RecordBatch, StringArray};
use arrow_schema::ArrowError;
use pyo3::prelude::*;
use rigid_ccd_robot::{LinkContactClass, LinkContactSettings, LinkPairs, Robot};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// The arguments of `Robot.classify_link_contacts`.
pub(crate) struct LinkContactQuestion<'a, 'py> {
    pub(crate) robot: &'a Robot,
    pub(crate) pairs: &'a LinkPairs,
    pub(crate) max_boxes: usize,
    /// The SRDF file to write.
    pub(crate) srdf: Option<PathBuf>,
    pub(crate) progress: Option<&'a Bound<'py, PyAny>>,
}

impl LinkContactQuestion<'_, '_> {
    /// Answers the question. Ctrl-C ends it with the pairs decided so far.
    pub(crate) fn answer(self, py: Python<'_>) -> PyResult<PyTable> {
        let LinkContactQuestion {
            robot,
            pairs,
            max_boxes,
            srdf,
            progress,
        } = self;
        if let Some(path) = &srdf {
            check_folder_of(path)?;
        }
        let pair_count = pairs.checked_pairs().count() + pairs.skipped_pairs().count();
        let progress = GivenProgress {
            progress,
            total: Some(pair_count),
        };
        let work = |stop: &Arc<AtomicBool>, decided: &AtomicUsize| {
            let settings = LinkContactSettings {
                max_boxes,
                deadline: None,
                stop: Some(Arc::clone(stop)),
            };
            robot.classify_link_contacts(&settings, |decided_count, _| {
                decided.fetch_max(decided_count, Ordering::Relaxed);
            })
        };
        let (classes, interruption) = run_with_progress(py, progress, work)?;
        let classes = classes.map_err(input_error)?;
        if let (Some(path), Ok(())) = (srdf, &interruption) {
            let text = robot.to_srdf(pairs, &classes);
            std::fs::write(&path, text).map_err(|error| file_error(&error, &path))?;
        }
        let batch = link_contact_table(robot, &classes).map_err(input_error)?;
        results_or_interruption(py, PyTable { batch }, interruption)
    }
}

/// Refuses the path of an output file whose folder is missing. Called before the work, so that the work is not lost.
fn check_folder_of(path: &Path) -> PyResult<()> {
    let folder = match path.parent() {
        Some(folder) if folder.as_os_str().is_empty() => Path::new("."),
        Some(folder) => folder,
        None => path,
    };
    let found = std::fs::metadata(folder);
    found.map_err(|error| file_error(&error, path)).map(drop)
}

/// Reads the number of boxes to examine for a pair.
pub(crate) fn read_max_boxes(argument: &Bound<'_, PyAny>) -> PyResult<usize> {
    whole_number(argument, "max_boxes", 0..=usize::MAX)
}

/// Makes a table with a row for each pair of links.
fn link_contact_table(
    robot: &Robot,
    classes: &[([usize; 2], LinkContactClass)],
) -> Result<RecordBatch, ArrowError> {
    let names = |side: usize| -> ArrayRef {
        let links = classes.iter().map(|(links, _)| links[side]);
        let names = links.map(|link| Some(robot.links()[link].name.as_str()));
        Arc::new(names.collect::<StringArray>())
    };
    let evidence = classes.iter().map(|(_, class)| Some(class.name()));
    let numbers = |index: usize| -> ArrayRef {
        let column = classes.iter().map(|(_, class)| match class {
            LinkContactClass::Undecided {
                proven_apart_fraction,
                undecided_fraction,
                least_distance,
                ..
            } => Some([*proven_apart_fraction, *undecided_fraction, *least_distance][index]),
            _ => None,
        });
        Arc::new(column.collect::<Float64Array>())
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
