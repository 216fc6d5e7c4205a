//! How fast bodies approach at their contact.

use crate::rows::Row;
use ccd_bench::method::peer::parry::double::shapes::{pose, rigid_motion, vector};
use ccd_core::Motion;
use parry3d_f64::math::Vector;
use rigid_ccd_parry::f64::cast_shapes_nonlinear;

/// Returns the rate at which the bodies of a row approach along the normal of their contact; none without one.
pub(crate) fn closing_speed(row: &Row) -> Option<f64> {
    let [a, b] = [0, 1].map(|k| crate::double::answers::shape(&row.shapes[k]));
    let [m, n] = [&row.query.a, &row.query.b].map(rigid_motion);
    let hit = cast_shapes_nonlinear(&m, &*a.ok()?, &n, &*b.ok()?, 0.0, row.query.duration, true)
        .ok()??;
    let velocity = |motion: &Motion, witness: Vector| {
        let at = pose(motion, hit.time_of_impact);
        let arm = at * witness - at * vector(motion.centre());
        vector(motion.velocity()) + vector(motion.spin()).cross(arm)
    };
    let normal = pose(&row.query.a, hit.time_of_impact).rotation * hit.normal1;
    let [v, w] = [
        velocity(&row.query.a, hit.witness1),
        velocity(&row.query.b, hit.witness2),
    ];
    Some((v - w).dot(normal))
}
