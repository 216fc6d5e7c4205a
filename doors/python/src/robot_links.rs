//! Links of robots made in Python, and the bodies fixed to them.

use crate::body::{PyBody, extract_body};
use crate::motion::{GivenPose, read_given_pose};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyMapping};
use rigid_ccd_robot::{Joint, Link, LinkBody};
use std::sync::Arc;

/// Makes the links that joints name, and the links that have bodies. Also returns a copy of the dict of bodies for pickle,
/// because the caller may change the dict.
pub(crate) fn read_links<'py>(
    py: Python<'py>,
    joints: &[Joint],
    bodies: Option<&Bound<'py, PyMapping>>,
) -> PyResult<(Vec<Link>, Bound<'py, PyDict>)> {
    let mut links: Vec<Link> = Vec::new();
    for name in joints
        .iter()
        .flat_map(|joint| [&joint.parent, &joint.child])
    {
        find_or_add_link(&mut links, name);
    }
    let read_bodies = PyDict::new(py);
    let items = bodies.map(|bodies| bodies.items()).transpose()?;
    for item in items.iter().flatten() {
        let (name, bodies): (String, Bound<'_, PyAny>) = item.extract()?;
        let bodies = read_link_bodies(&bodies)?;
        let link = find_or_add_link(&mut links, &name);
        for (body, pose) in &bodies {
            link.bodies.push(LinkBody {
                body: Arc::new(body.get().body.clone()),
                pose: pose.pose("bodies")?,
            });
        }
        read_bodies.set_item(name, bodies)?;
    }
    Ok((links, read_bodies))
}

/// Returns the link with a name. Adds it if there is none.
fn find_or_add_link<'a>(links: &'a mut Vec<Link>, name: &str) -> &'a mut Link {
    let number = links.iter().position(|link| link.name == name);
    let number = number.unwrap_or_else(|| {
        links.push(Link::named(name));
        links.len() - 1
    });
    &mut links[number]
}

/// Reads the bodies fixed to a link: one body, or pairs of a body and its pose.
fn read_link_bodies(bodies: &Bound<'_, PyAny>) -> PyResult<Vec<(Py<PyBody>, GivenPose)>> {
    let body = |body: &Bound<'_, PyAny>| -> PyResult<Py<PyBody>> {
        extract_body(body, "bodies")?;
        Ok(body.clone().cast_into::<PyBody>()?.unbind())
    };
    if bodies.is_instance_of::<PyBody>() {
        return Ok(vec![(body(bodies)?, GivenPose::IDENTITY)]);
    }
    let pairs = bodies.try_iter()?.map(|pair| {
        let (pair_body, pose): (Bound<'_, PyAny>, Bound<'_, PyAny>) = pair?.extract()?;
        Ok((body(&pair_body)?, read_given_pose(&pose, "bodies")?))
    });
    pairs.collect()
}
