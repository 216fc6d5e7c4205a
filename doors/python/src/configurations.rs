//! Reads configurations of a robot from arrays, data frames and other containers with labels.

use crate::arrays::{Elements, numpy_array, visit_parts};
use crate::errors::input_error;
use ccd_tables::joint_columns::{AngleUnit, joint_column};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyList, PyString, PyTuple};
use rigid_ccd_robot::Robot;

/// Reads configurations of a robot from anything that NumPy can convert to an array of numbers. The last index is the
/// index of the joint.
///
/// NumPy drops labels, so this function checks them. The labels of the last index, at any depth of nested lists, must be
/// the names of the joints in their order, or default numbers. If they are default numbers, the other indices must not
/// have names, because one of them could be the index of the joint. Names on the outermost object may end in `_deg`, for
/// degrees.
pub(crate) fn read_configurations(
    values: &Bound<'_, PyAny>,
    robot: &Robot,
    argument_name: &str,
) -> PyResult<Elements<f64>> {
    let array = numpy_array(values, argument_name)?;
    let depth = array.getattr("ndim")?.extract()?;
    let mut units = Vec::new();
    visit_parts(values, depth, &mut |part, depth| {
        let labels = Labels::read(part, depth)?;
        if let Some(label_units) = labels.units(robot, argument_name)? {
            if !part.is(values) && label_units.contains(&AngleUnit::Degree) {
                return Err(labels_error(&labels.last[0], robot, argument_name));
            }
            units = label_units;
        }
        Ok(())
    })?;
    let mut configurations = Elements::<f64>::read(&array, argument_name)?;
    if units.contains(&AngleUnit::Degree) {
        let positions = configurations.values.iter_mut().zip(units.iter().cycle());
        positions.for_each(|(position, unit)| *position = unit.to_radians(*position));
    }
    Ok(configurations)
}

/// Returns an error for data frames of starts and ends whose rows have the same labels in different orders, because NumPy
/// pairs rows by position. Different labels are accepted: for instance, one frame may lack the last row of a table, and
/// the other one its first row.
pub(crate) fn check_same_rows([start, end]: [&Bound<'_, PyAny>; 2]) -> PyResult<()> {
    let (Some(starts), Some(ends)) = (labels_of_rows(start)?, labels_of_rows(end)?) else {
        return Ok(());
    };
    if starts.call_method1("equals", (&ends,))?.is_truthy()? {
        return Ok(());
    }
    let differing = starts.call_method1("symmetric_difference", (ends,))?;
    if differing.len()? > 0 {
        return Ok(());
    }
    Err(input_error(
        "start, end: the rows of the frames have the same labels in different orders; end.loc[start.index] orders the ends like \
         the starts, and reset_index(drop=True) of both frames pairs rows by position",
    ))
}

/// Returns the labels of a data frame's rows.
fn labels_of_rows<'py>(frame: &Bound<'py, PyAny>) -> PyResult<Option<Bound<'py, PyAny>>> {
    match attribute(frame, "columns")? {
        Some(_) => attribute(frame, "index"),
        None => Ok(None),
    }
}

/// The arguments for the start and the end of edges, and the prefixes of their columns in a table of edges.
const PREFIXES: [(&str, &str); 2] = [("start", "from_"), ("end", "to_")];

/// The labels of an array, or of an object in nested lists.
#[derive(Default)]
struct Labels<'py> {
    /// All lists of labels of the last index.
    last: Vec<Vec<Bound<'py, PyAny>>>,
    /// The labels of all other indices.
    others: Vec<Bound<'py, PyAny>>,
}

impl<'py> Labels<'py> {
    /// Reads the labels of an object. Its elements are `depth` lists deep.
    fn read(part: &Bound<'py, PyAny>, depth: usize) -> PyResult<Self> {
        let mut labels = Labels::default();
        if part.is_exact_instance_of::<PyList>() || part.is_exact_instance_of::<PyTuple>() {
            return Ok(labels);
        }
        let columns = match attribute(part, "column_names")? {
            Some(columns) => Some(columns),
            None => attribute(part, "columns")?,
        };
        if let Some(columns) = columns.map(elements).transpose()?.flatten() {
            labels.last.push(columns);
            if let Some(rows) = attribute(part, "index")? {
                labels.others = elements(rows)?.unwrap_or_default();
            }
        } else if part.hasattr("to_frame")? {
            // A series of pandas. Its name is the label of a column or of a row of a frame.
            let index = attribute(part, "index")?.map(elements).transpose()?;
            labels.last.extend(index.flatten());
            labels.others.extend(attribute(part, "name")?);
        } else if let (Some(dimensions), Some(coordinates)) =
            (attribute(part, "dims")?, attribute(part, "coords")?)
        {
            labels.read_coordinates(&dimensions, &coordinates)?;
        } else if let Some(fields) = attribute(part, "_fields")? {
            let fields = elements(fields)?.unwrap_or_default();
            match depth {
                0 | 1 => labels.last.push(fields),
                _ => labels.others = fields,
            }
        } else if let Some(dtype) = attribute(part, "dtype")?
            && let Some(fields) = attribute(&dtype, "names")?
        {
            labels.last.extend(elements(fields)?);
        }
        Ok(labels)
    }

    /// Adds the labels in the coordinates of an array of xarray.
    fn read_coordinates(
        &mut self,
        dimensions: &Bound<'py, PyAny>,
        coordinates: &Bound<'py, PyAny>,
    ) -> PyResult<()> {
        let dimensions: Vec<Bound<'_, PyAny>> = dimensions.try_iter()?.collect::<PyResult<_>>()?;
        for name in coordinates.try_iter()? {
            let coordinate = coordinates.get_item(name?)?;
            let coordinate_dimensions = coordinate.getattr("dims")?.try_iter()?;
            let coordinate_dimensions: Vec<Bound<'_, PyAny>> =
                coordinate_dimensions.collect::<PyResult<_>>()?;
            let values = coordinate.getattr("values")?.call_method0("ravel")?;
            let values = elements(values)?.unwrap_or_default();
            let is_last = match (&coordinate_dimensions[..], dimensions.last()) {
                ([only], Some(last)) => only.eq(last)?,
                _ => false,
            };
            if is_last {
                self.last.push(values);
            } else {
                self.others.extend(values);
            }
        }
        Ok(())
    }

    /// Returns the unit of each joint, or `None` if the labels are no names. Returns an error for names that are not the
    /// joints of the robot in their order.
    fn units(&self, robot: &Robot, argument_name: &str) -> PyResult<Option<Vec<AngleUnit>>> {
        let mut units = None;
        for labels in self.last.iter().filter(|labels| !are_default(labels)) {
            let label_units = units_of_names(labels, robot, argument_name)?;
            if label_units.is_none() || (units.is_some() && units != label_units) {
                return Err(labels_error(labels, robot, argument_name));
            }
            units = label_units;
        }
        if units.is_none() && self.others.iter().any(is_name) {
            return Err(labels_error(&self.others, robot, argument_name));
        }
        Ok(units)
    }
}

/// Returns the unit of each joint if the labels are the names of the joints in their order, or `None`.
fn units_of_names(
    labels: &[Bound<'_, PyAny>],
    robot: &Robot,
    argument_name: &str,
) -> PyResult<Option<Vec<AngleUnit>>> {
    let Ok(names) = labels.iter().map(|label| label.extract()).collect() else {
        return Ok(None);
    };
    let names: Vec<String> = names;
    let prefix = PREFIXES
        .iter()
        .find(|(argument, _)| *argument == argument_name);
    for prefix in ["", prefix.map_or("", |(_, prefix)| prefix)] {
        let mut units = Vec::new();
        for (number, joint) in robot.independent_joint_names().enumerate() {
            let column = joint_column(&names, robot, (prefix, joint), AngleUnit::Radian);
            let column =
                column.map_err(|error| input_error(format!("{argument_name}: {error}")))?;
            units.extend(
                column
                    .filter(|column| column.column == number)
                    .map(|column| column.unit),
            );
        }
        if units.len() == names.len() && units.len() == robot.independent_joint_names().len() {
            return Ok(Some(units));
        }
    }
    Ok(None)
}

/// Makes the error for labels that are not the names of the joints in their order.
fn labels_error(labels: &[Bound<'_, PyAny>], robot: &Robot, argument_name: &str) -> PyErr {
    let joints: Vec<&str> = robot.independent_joint_names().collect();
    let labels = texts(labels).unwrap_or_else(|_| "no texts".to_owned());
    input_error(format!(
        "{argument_name}: the labels are {labels}, but the joints are {}: label the columns by robot.joint_names, in this order",
        joints.join(", ")
    ))
}

/// Returns an attribute, or `None` if the object does not have it, or its value is a method or None.
fn attribute<'py>(object: &Bound<'py, PyAny>, name: &str) -> PyResult<Option<Bound<'py, PyAny>>> {
    let value = object.getattr_opt(name)?;
    Ok(value.filter(|value| !value.is_none() && !value.is_callable()))
}

/// Returns the elements of a list of labels, or `None` if the object is not a list.
fn elements(labels: Bound<'_, PyAny>) -> PyResult<Option<Vec<Bound<'_, PyAny>>>> {
    labels.try_iter().ok().map(Iterator::collect).transpose()
}

/// Returns whether labels are the defaults of a library for data without labels: numbers, or `column_0` and so on.
fn are_default(labels: &[Bound<'_, PyAny>]) -> bool {
    labels.iter().enumerate().all(|(k, label)| {
        let is_number = label.extract::<i64>().is_ok();
        let text = || label.extract::<String>();
        is_number || text().is_ok_and(|text| text == format!("column_{k}"))
    })
}

/// Returns whether a label is a name: a text that is not empty, or several labels of a hierarchy.
fn is_name(label: &Bound<'_, PyAny>) -> bool {
    let is_empty = || label.extract::<String>().is_ok_and(|text| text.is_empty());
    (label.is_instance_of::<PyString>() && !is_empty())
        || label.is_instance_of::<PyBytes>()
        || label.is_instance_of::<PyTuple>()
}

/// The largest number of labels in a message.
const MAX_SHOWN_LABELS: usize = 16;

fn texts(labels: &[Bound<'_, PyAny>]) -> PyResult<String> {
    let shown = labels.iter().take(MAX_SHOWN_LABELS);
    let texts: Vec<String> = shown
        .map(|label| Ok(label.str()?.to_string()))
        .collect::<PyResult<_>>()?;
    let more = if labels.len() > MAX_SHOWN_LABELS {
        ", …"
    } else {
        ""
    };
    Ok(texts.join(", ") + more)
}
