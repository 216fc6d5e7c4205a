//! Reads robots from files, with the options of Python.

use crate::errors::{input_error, wrong_type_error};
use crate::interruptible::run_or_leave;
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
    file: RobotFile,
    srdf: Option<PathBuf>,
) -> PyResult<(Robot, LinkPairs)> {
    let read = move || {
        let robot = file.read().map_err(input_error)?;
        let pairs = file.link_pairs(&robot, srdf.as_deref());
        Ok((robot, pairs.map_err(input_error)?))
    };
    // The sizes of mesh files are not known yet, so the work runs on another thread.
    run_or_leave(py, u64::MAX, read)?
}

/// Returns an error if a path is the text of a robot.
pub(crate) fn check_path(path: &Path) -> PyResult<()> {
    if path.to_string_lossy().trim_start().starts_with('<') {
        return Err(input_error(
            "path: this is the text of a robot, not the path of a file; Robot.from_urdf_text reads the text of a URDF",
        ));
    }
    Ok(())
}

/// Returns an error if the text of a robot is the path of a file.
pub(crate) fn check_text(text: &str) -> PyResult<()> {
    if text.contains('<') {
        return Ok(());
    }
    Err(input_error(
        "text: this is not XML; Robot.from_urdf reads the file at a path",
    ))
}

/// Reads a folder or a list of folders.
pub(crate) fn read_folders(folders: &Bound<'_, PyAny>) -> PyResult<Option<Vec<PathBuf>>> {
    if folders.is_none() {
        return Ok(None);
    }
    if let Ok(folder) = folders.extract() {
        return Ok(Some(vec![folder]));
    }
    let needed = "a folder, or a list of folders,";
    let iterator = folders
        .try_iter()
        .map_err(|_| wrong_type_error("packages", needed, folders))?;
    let folder = |folder: PyResult<Bound<'_, PyAny>>| {
        let folder = folder?;
        folder
            .extract()
            .map_err(|_| wrong_type_error("packages", needed, &folder))
    };
    iterator.map(folder).collect::<PyResult<_>>().map(Some)
}

fn unknown_name_error(argument_name: &str, name: &str, known: &str) -> PyErr {
    input_error(format!("{argument_name}: '{name}' is not {known}"))
}
