//! Makes a stand-in for the Stanford bunny from convex parts, the same for rapier and for this engine.

use anyhow::Result;
use ccd_bench::scene::model::Blob;
use rapier3d_f64::prelude::{SharedShape, Vector};
use rigid_ccd::Body;
use rigid_ccd_parry::Options;
use rigid_ccd_parry::f64::body;

/// The bounding radius of the bunny, in metres.
const RADIUS: f64 = 0.25;

pub(crate) fn bunny() -> Result<(SharedShape, Body)> {
    let mesh = Blob::BUNNY.mesh(400)?;
    let vertices = mesh.vertices().iter();
    let vertices: Vec<Vector> = vertices
        .map(|&vertex| Vector::from_array((RADIUS * vertex).to_array()))
        .collect();
    let shape = SharedShape::convex_decomposition(&vertices, mesh.faces());
    let body = body(&*shape, &Options::default())?.body().clone();
    Ok((shape, body))
}
