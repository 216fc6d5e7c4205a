//! The surfaces of two bodies around the nearest points of two pieces.

use crate::distance::common_normals::CommonNormals;
use crate::engine::meter::Meter;
use crate::engine::pieces::snapshot::Snapshot;
use crate::rounding::{ADJACENCY_DISTANCE, LEVEL_HEIGHT};
use glam::DVec3;

/// The surfaces around the nearest points of two pieces, without their radii, in A's frame.
pub(crate) struct SurroundingSurfaces<'s> {
    points: [DVec3; 2],
    normals: &'s mut CommonNormals,
}

impl<'s> SurroundingSurfaces<'s> {
    /// Collects the surfaces around two points, of A and of B, in A's frame.
    pub(crate) fn at(snapshot: &Snapshot<'_>, points: [DVec3; 2], meter: &'s mut Meter) -> Self {
        let Snapshot {
            problem, pieces, ..
        } = snapshot;
        let reach = ADJACENCY_DISTANCE * problem.rounding;
        let (mut looks, turn) = (0, pieces.b_to_a.rotation);
        let normals = &mut meter.scratch_memory().normals;
        normals.reset(LEVEL_HEIGHT * problem.rounding);
        problem.a.body.offsets_around(points[0], reach, |way| {
            looks += 1;
            normals.add_offset_of_a(way);
        });
        let in_b = pieces.b_to_a.inverse_point(points[1]);
        problem.b.body.offsets_around(in_b, reach, |way| {
            looks += 1;
            normals.add_offset_of_b(turn * way);
        });
        normals.sort();
        meter.stats.point_evaluations += looks;
        SurroundingSurfaces {
            points,
            normals: &mut meter.scratch_memory().normals,
        }
    }

    /// Returns the common normal of both surfaces that is nearest to a direction, if the vector between the points is
    /// along it up to rounding.
    pub(crate) fn common_normal(&self, towards: DVec3) -> Option<DVec3> {
        let [on_a, on_b] = self.points;
        self.normals.nearest_normal_along(towards, on_b - on_a)
    }
}
