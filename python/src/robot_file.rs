//! Reads robots from files, with options by their names in Python.

use crate::errors::input_error;
use pyo3::prelude::*;
use rigid_ccd_robot::{BodyElements, LinkPairs, MeshConversion, Robot, RobotFile};
use std::path::{Path, PathBuf};

/// Sets the options of `Robot.from_urdf` and `Robot.from_mjcf`.
pub(crate) fn with_options(
    file: RobotFile,
    packages: Option<Vec<PathBuf>>,
    geometry: &str,
    meshes: &str,
) -> PyResult<RobotFile> {
    let geometry = match geometry {
        "collision" => BodyElements::Collision,
        "visual" => BodyElements::Visual,
        _ => {
            let known = "collision or visual";
            return Err(unknown_name_error("geometry", geometry, known));
        }
    };
    let meshes = match meshes {
        "exact" => MeshConversion::Exact,
        "hull" => MeshConversion::OuterHull,
        _ => return Err(unknown_name_error("meshes", meshes, "exact or hull")),
    };
    let file = file
        .with_body_element_kind(geometry)
        .with_mesh_conversion(meshes);
    // The first folder is searched first.
    let folders = packages.into_iter().flatten().rev();
    Ok(folders.fold(file, RobotFile::with_package_folder))
}

/// Reads a robot, and the pairs of its links that are checked.
pub(crate) fn read_robot(
    py: Python<'_>,
    file: &RobotFile,
    srdf: Option<&Path>,
) -> PyResult<(Robot, LinkPairs)> {
    py.detach(|| {
        let robot = file.read().map_err(input_error)?;
        let pairs = file.link_pairs(&robot, srdf).map_err(input_error)?;
        Ok((robot, pairs))
    })
}

fn unknown_name_error(what: &str, given: &str, known: &str) -> PyErr {
    input_error(format!("{what}: '{given}' is not {known}"))
}
