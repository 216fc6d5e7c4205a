//! The state of a Python cell: the cell with its solvers, and in parallel its contents as Python passed them.

use crate::body::{PyBody, extract_body};
use crate::cell_contents::{AttachedBody, CellContents, Contact};
use crate::cell_solver::CellWithCachedSolvers;
use crate::errors::input_error;
use crate::motion::GivenPose;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rigid_ccd_robot::{Cell, RobotError};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// A cell, and the arguments of the calls that made it.
pub(crate) struct CellState {
    pub(crate) solvers: CellWithCachedSolvers,
    contents: Mutex<CellContents>,
}

impl CellState {
    pub(crate) fn new(cell: Cell) -> Self {
        CellState {
            solvers: CellWithCachedSolvers::new(cell),
            contents: Mutex::default(),
        }
    }

    pub(crate) fn add(&self, name: &str, body: Py<PyBody>, pose: GivenPose) -> PyResult<()> {
        let (added_body, placement) = (body.get().body.clone(), pose.pose("pose")?);
        self.change(|cell| cell.add_obstacle(name, added_body, placement))?;
        self.contents().add(name, Some(body), pose);
        Ok(())
    }

    pub(crate) fn add_plane(&self, name: &str, pose: GivenPose) -> PyResult<()> {
        let placement = pose.pose("pose")?;
        self.change(|cell| cell.add_plane(name, placement))?;
        self.contents().add(name, None, pose);
        Ok(())
    }

    pub(crate) fn move_obstacle(&self, name: &str, pose: GivenPose) -> PyResult<()> {
        let placement = pose.pose("pose")?;
        self.change(|cell| cell.move_obstacle(name, placement))?;
        self.contents().move_obstacle(name, pose);
        Ok(())
    }

    pub(crate) fn remove(&self, name: &str) -> PyResult<()> {
        self.change(|cell| cell.remove_obstacle(name))?;
        self.contents().remove(name);
        Ok(())
    }

    pub(crate) fn attach(&self, attached: AttachedBody) -> PyResult<()> {
        let (name, body, link, pose, may_touch) = &attached;
        let (body, placement) = (body.get().body.clone(), pose.pose("pose")?);
        let may_touch: Vec<&str> = may_touch.iter().map(String::as_str).collect();
        self.change(|cell| cell.attach(name, body, (link.as_str(), placement), &may_touch))?;
        self.contents().attach(attached);
        Ok(())
    }

    pub(crate) fn detach(&self, name: &str) -> PyResult<()> {
        self.change(|cell| cell.detach(name))?;
        self.contents().remove(name);
        Ok(())
    }

    pub(crate) fn set_contact(&self, a: &str, b: &str, contact: Contact) -> PyResult<()> {
        self.change(|cell| {
            let pair = [cell.item_named(a)?, cell.item_named(b)?];
            match contact {
                Contact::Allowed => cell.allow_contact(pair),
                Contact::Forbidden => cell.forbid_contact(pair),
            }
        })?;
        self.contents().set_contact(a, b, contact);
        Ok(())
    }

    pub(crate) fn set_padding(&self, link: &str, distance: f64) -> PyResult<()> {
        self.change(|cell| cell.set_padding(link, distance))?;
        self.contents().set_padding(link, distance);
        Ok(())
    }

    pub(crate) fn set_clearance(&self, a: &str, b: &str, distance: f64) -> PyResult<()> {
        self.change(|cell| {
            let pair = [cell.item_named(a)?, cell.item_named(b)?];
            cell.set_clearance(pair, distance)
        })?;
        self.contents().set_clearance(a, b, distance);
        Ok(())
    }

    /// Returns the contents, for pickle.
    pub(crate) fn pickled<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.contents().into_pyobject(py)
    }

    /// Restores the contents that pickle stored.
    pub(crate) fn restore(&self, contents: CellContents) -> PyResult<()> {
        for (name, body, pose) in contents.obstacles {
            match body {
                Some(body) => self.add(&name, body, pose)?,
                None => self.add_plane(&name, pose)?,
            }
        }
        for attached in contents.attached {
            self.attach(attached)?;
        }
        for (link, distance) in &contents.paddings {
            self.set_padding(link, *distance)?;
        }
        for (a, b, distance) in &contents.clearances {
            self.set_clearance(a, b, *distance)?;
        }
        for (a, b, is_allowed) in &contents.contacts {
            let contact = if *is_allowed {
                Contact::Allowed
            } else {
                Contact::Forbidden
            };
            self.set_contact(a, b, contact)?;
        }
        Ok(())
    }

    fn contents(&self) -> MutexGuard<'_, CellContents> {
        self.contents.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn change(&self, change: impl FnOnce(&mut Cell) -> Result<(), RobotError>) -> PyResult<()> {
        self.solvers.change(change).map_err(input_error)
    }
}

/// Reads an argument that must be a body.
pub(crate) fn read_body(body: &Bound<'_, PyAny>) -> PyResult<Py<PyBody>> {
    extract_body(body, "body")?;
    Ok(body.clone().cast_into::<PyBody>()?.unbind())
}
