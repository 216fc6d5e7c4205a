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
    /// Samples points of the axis at equal distances, then refines around the nearest one. The distance from an axis
    /// point to a convex body has only one local minimum along the axis, so each refinement drops a third of the
    /// interval. This finds a common point even if the links share only one point of the axis.
    pub(super) fn prove_contact_on_hinge_axis(
        &mut self,
        links: [usize; 2],
        pair: &LinkPair,
    ) -> Result<Option<LinkContactClass>, Error> {
        let cell = self.measurer.cell;
        let &[only_joint] = &*pair.joints.joints else {
            return Ok(None);
        };
        let joint = &cell.kinematics().joints()[only_joint.moving_index];
        if joint.is_prismatic {
            return Ok(None);
        }
        let center = pair.joints.all_positions.center();
        self.measurer.place(&pair.joints, &center);
        let parent = self.measurer.placement.frames[joint.parent];
        let axis = Axis {
            origin: parent.transform_point(joint.origin),
            direction: parent.rotation * joint.axis,
        };
        let parts = cell.parts()[..cell.robot_part_count()].iter();
        let parts_of_links = parts.filter(|part| links.contains(&cell.link_of(part.owner)));
        let reach = parts_of_links.map(|part| {
            let center = self.measurer.placement.frames[part.frame].transform_point(part.center);
            center.distance(axis.origin) + part.ball_radius
        });
        let reach = reach.fold(0.0, greater);
        let interval = 2.0 * reach / f64::from(JOINT_AXIS_INTERVALS);
        let (mut best_coordinate, mut least_distance) = (0.0, f64::INFINITY);
        for k in 0..=JOINT_AXIS_INTERVALS {
            let coordinate = f64::from(k) * interval - reach;
            let [distance, shape_distance] = self.distances_on_axis(links, axis, coordinate)?;
            if shape_distance <= 0.0 {
                return Ok(Some(LinkContactClass::Always));
            }
            if distance < least_distance {
                (best_coordinate, least_distance) = (coordinate, distance);
            }
        }
        let [mut low, mut high] = [best_coordinate - interval, best_coordinate + interval];
        for _ in 0..JOINT_AXIS_REFINEMENTS {
            let third = (high - low) / 3.0;
            let [left, right] = [low + third, high - third];
            let [distance_left, shape_distance_left] = self.distances_on_axis(links, axis, left)?;
            let [distance_right, shape_distance_right] =
                self.distances_on_axis(links, axis, right)?;
            if lesser(shape_distance_left, shape_distance_right) <= 0.0 {
                return Ok(Some(LinkContactClass::Always));
            }
            least_distance = lesser(least_distance, lesser(distance_left, distance_right));
            if distance_left < distance_right {
                high = right;
            } else {
                low = left;
            }
        }
        Ok((least_distance <= 0.0).then_some(LinkContactClass::AlwaysAsEnclosed))
    }

    /// Returns two upper bounds of the distance from an axis point to the farther one of two links: to their bodies, and
    /// to the shapes that the bodies enclose. [`AXIS_CONTACT_DISTANCE`] is subtracted from both.
    fn distances_on_axis(
        &mut self,
        links: [usize; 2],
        axis: Axis,
        coordinate: f64,
    ) -> Result<[f64; 2], Error> {
        let point = Body::sphere(AXIS_CONTACT_DISTANCE)?;
        let at = Pose::at(axis.origin + coordinate * axis.direction)?;
        let mut farthest = [0.0; 2];
        for link in links {
            let [body, shape] = self.measurer.distances_to_link(link, (&point, at))?;
            farthest = [greater(farthest[0], body), greater(farthest[1], shape)];
        }
        Ok(farthest)
    }
}
