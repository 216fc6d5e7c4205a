//! Links of robots that are made in Python, and what is fixed to them.

use crate::body::{PyBody, extract_body};
use crate::motion::{GivenPose, read_given_pose};
use pyo3::prelude::*;
use rigid_ccd_robot::Link;

/// Returns the link that has a name, which is new if there is none.
pub(crate) fn find_or_add_link<'a>(links: &'a mut Vec<Link>, name: &str) -> &'a mut Link {
    let number = links.iter().position(|link| link.name == name);
    let number = number.unwrap_or_else(|| {
        links.push(Link::named(name));
        links.len() - 1
    });
    &mut links[number]
}

/// Reads what is fixed to a link: a body, or pairs of a body and its pose.
pub(crate) fn read_link_bodies(held: &Bound<'_, PyAny>) -> PyResult<Vec<(Py<PyBody>, GivenPose)>> {
    let body = |given: &Bound<'_, PyAny>| -> PyResult<Py<PyBody>> {
        extract_body(given, "bodies")?;
        Ok(given.clone().cast_into::<PyBody>()?.unbind())
    };
    if held.is_instance_of::<PyBody>() {
        return Ok(vec![(body(held)?, GivenPose::IDENTITY)]);
    }
    let pairs = held.try_iter()?.map(|pair| {
        let (given, pose): (Bound<'_, PyAny>, Bound<'_, PyAny>) = pair?.extract()?;
        Ok((body(&given)?, read_given_pose(&pose, "bodies")?))
    });
    pairs.collect()
}
