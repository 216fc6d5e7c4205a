//! Proves that two links always touch on the axis of the hinge between them. The hinge moves no point of its axis.

use super::LinkContactClass;
use super::measuring::LinkPair;
use super::search::LinkPairSearch;
use crate::tuning::{JOINT_AXIS_INTERVALS, JOINT_AXIS_REFINEMENTS};
use ccd_core::order::{greater, lesser};
use rigid_ccd::glam::DVec3;
use rigid_ccd::{Body, Error, Pose};

/// The distance, in metres, within which a body counts as containing a point of the axis. Two bodies that contain the
/// same point are at most twice as far apart.
const AXIS_CONTACT_DISTANCE: f64 = 1e-9;

/// A joint axis: a point on it, and its direction.
#[derive(Clone, Copy)]
struct Axis {
    origin: DVec3,
    direction: DVec3,
}

impl LinkPairSearch<'_> {
    /// Proves that two links always touch if the only joint between them is revolute and both contain the same point
    /// of its axis.
    ///
    /// Samples points of the axis at equal distances, then refines around the best one. The distance of an axis point
    /// from a convex body has only one local minimum, so the refinement drops a third of the interval in each step.
    /// It finds links that meet in a single point of the axis.
    pub(super) fn prove_contact_on_hinge_axis(
        &mut self,
        links: [usize; 2],
        pair: &LinkPair,
    ) -> Result<Option<LinkContactClass>, Error> {
        let cell = self.measurer.cell;
        let &[between] = &*pair.joints.joints else {
            return Ok(None);
        };
        let joint = &cell.kinematics().joints()[between.moving_index];
        if joint.is_prismatic {
            return Ok(None);
        }
        let middle = pair.joints.all_positions.middle();
        self.measurer.place(&pair.joints, &middle);
        let parent = self.measurer.placement.frames[joint.parent];
        let axis = Axis {
            origin: parent.transform_point(joint.origin),
            direction: parent.rotation * joint.axis,
        };
        let parts = cell.parts()[..cell.robot_part_count()].iter();
        let own = parts.filter(|part| links.contains(&cell.link_of(part.owner)));
        let reach = own.map(|part| {
            let center = self.measurer.placement.frames[part.frame].transform_point(part.center);
            center.distance(axis.origin) + part.ball_radius
        });
        let reach = reach.fold(0.0, greater);
        let interval = 2.0 * reach / f64::from(JOINT_AXIS_INTERVALS);
        let (mut best, mut least) = (0.0, f64::INFINITY);
        for k in 0..=JOINT_AXIS_INTERVALS {
            let along = f64::from(k) * interval - reach;
            let [distance, of_shapes] = self.distances_on_axis(links, axis, along)?;
            if of_shapes <= 0.0 {
                return Ok(Some(LinkContactClass::Always));
            }
            if distance < least {
                (best, least) = (along, distance);
            }
        }
        let [mut low, mut high] = [best - interval, best + interval];
        for _ in 0..JOINT_AXIS_REFINEMENTS {
            let third = (high - low) / 3.0;
            let [left, right] = [low + third, high - third];
            let [to_left, shapes_left] = self.distances_on_axis(links, axis, left)?;
            let [to_right, shapes_right] = self.distances_on_axis(links, axis, right)?;
            if lesser(shapes_left, shapes_right) <= 0.0 {
                return Ok(Some(LinkContactClass::Always));
            }
            least = lesser(least, lesser(to_left, to_right));
            if to_left < to_right {
                high = right;
            } else {
                low = left;
            }
        }
        Ok((least <= 0.0).then_some(LinkContactClass::AlwaysAsEnclosed))
    }

    /// Returns two upper bounds of the distance of an axis point from the farther one of two links: from their bodies,
    /// and from the shapes that the bodies enclose. [`AXIS_CONTACT_DISTANCE`] is subtracted from both.
    fn distances_on_axis(
        &mut self,
        links: [usize; 2],
        axis: Axis,
        along: f64,
    ) -> Result<[f64; 2], Error> {
        let point = Body::sphere(AXIS_CONTACT_DISTANCE)?;
        let at = Pose::at(axis.origin + along * axis.direction)?;
        let mut farthest = [0.0; 2];
        for link in links {
            let [body, shape] = self.measurer.distances_to_link(link, (&point, at))?;
            farthest = [greater(farthest[0], body), greater(farthest[1], shape)];
        }
        Ok(farthest)
    }
}
