//! Reads bodies from mesh files, and from files of prepared bodies.

use crate::errors::{InputError, file_error, input_error};
use crate::numbers::whole_number;
use pyo3::prelude::*;
use pyo3::types::PyString;
use rigid_ccd::Remark;
use rigid_ccd::mesh::{
    AdjustedStoredBody, Adjustments, Axis, MeshSource, PieceChoice, STORED_BODY_EXTENSION,
    StoredBodyContent, Unit, prepare,
};
use std::path::{Path, PathBuf};

/// A file of a mesh or of a prepared body, and the options for reading it.
pub(crate) struct BodyFile {
    pub(crate) path: PathBuf,
    pub(crate) part: Option<String>,
    pub(crate) adjustments: Adjustments,
    pub(crate) choice: PieceChoice,
    /// Whether the file may be a prepared body: no option would change it.
    pub(crate) may_be_prepared: bool,
    /// Whether coordinates are used as they are in the file: the options have neither a unit nor a factor.
    pub(crate) keeps_numbers: bool,
}

impl BodyFile {
    /// Reads the file. Returns its content, and remarks on the mesh.
    pub(crate) fn read(self) -> PyResult<(StoredBodyContent, Vec<Remark>)> {
        let path = self.path;
        // An unreadable file is an OSError. A pipe is refused, because it would block.
        let metadata = std::fs::metadata(&path).map_err(|error| file_error(&error, &path))?;
        if !metadata.is_file() {
            return Err(input_error(format!("{}: is not a file", path.display())));
        }
        std::fs::File::open(&path).map_err(|error| file_error(&error, &path))?;
        if is_prepared_body_path(&path) && self.part.is_none() {
            if !self.may_be_prepared {
                let error = AdjustedStoredBody { file: path };
                return Err(input_error(error));
            }
            let stored = StoredBodyContent::load(&path).map_err(input_error)?;
            return Ok((stored, Vec::new()));
        }
        let source = MeshSource {
            file: path,
            part: self.part,
            adjustments: self.adjustments,
        };
        let (mesh, unit) = source.read().map_err(input_error)?;
        let prepared = prepare(&mesh, self.choice);
        let model = prepared.map_err(|error| input_error(format!("{source}: {error}")))?;
        let kept_unit = unit.filter(|_| self.keeps_numbers);
        let remarks = Remark::remark_on_mesh(self.choice, &mesh, &model.report).into_iter();
        Ok((
            model,
            remarks.chain(Remark::remark_on_unit(kept_unit)).collect(),
        ))
    }
}

/// Reads the unit of a file's numbers, a factor on them, and an axis along which they are mirrored.
pub(crate) fn read_adjustments(
    file_unit: Option<&str>,
    scale: Option<f64>,
    mirror: Option<&str>,
) -> PyResult<Adjustments> {
    let mut adjustments = Adjustments::NONE;
    if let Some(unit) = parse_unit("file_unit", file_unit)? {
        adjustments = adjustments.with_stated_unit(unit);
    }
    if let Some(scale) = scale {
        adjustments = adjustments.scaled(scale).map_err(input_error)?;
    }
    if let Some(axis) = mirror {
        adjustments = adjustments.mirrored(parse_axis(axis)?);
    }
    Ok(adjustments)
}

/// Reads the name or the index of a part.
pub(crate) fn read_part(argument: &Bound<'_, PyAny>) -> PyResult<Option<String>> {
    if argument.is_none() || argument.is_instance_of::<PyString>() {
        return argument.extract();
    }
    Ok(Some(
        whole_number(argument, "part", 0..=u64::MAX)?.to_string(),
    ))
}

/// Reads a unit of length. Errors name it as `argument`.
pub(crate) fn parse_unit(argument: &str, name: Option<&str>) -> PyResult<Option<Unit>> {
    let unit = name.map(str::parse::<Unit>).transpose();
    unit.map_err(|error| input_error(format!("{argument}: {error}")))
}

fn parse_axis(name: &str) -> PyResult<Axis> {
    match name {
        "x" => Ok(Axis::X),
        "y" => Ok(Axis::Y),
        "z" => Ok(Axis::Z),
        _ => Err(InputError::new_err(format!(
            "mirror: {name:?} is none of \"x\", \"y\", \"z\""
        ))),
    }
}

/// Returns whether a file is a prepared body, judged by its extension.
fn is_prepared_body_path(path: &Path) -> bool {
    let extension = path.extension().unwrap_or_default();
    extension.eq_ignore_ascii_case(STORED_BODY_EXTENSION)
}
