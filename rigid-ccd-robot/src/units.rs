//! Remarks on sizes and positions that are probably in another unit.

use crate::remark::CellRemark;
use crate::robot::Robot;
use ccd_core::order::{greater, lesser};
use rigid_ccd::glam::DVec3;
use rigid_ccd::trajectory::JointKind;
use rigid_ccd::{Pose, Remark};

/// The largest usual ratio of a body's size to the robot's size. A larger ratio gives a remark. Millimetres and metres
/// differ by a factor of 1000.
const MAX_USUAL_SIZE_RATIO: f64 = 100.0;

/// The largest usual ratio for a robot with unlimited prismatic joints, such as a drone in a building.
const MAX_USUAL_SIZE_RATIO_IF_UNLIMITED: f64 = 1000.0;

/// The smallest usual ratio of a body's size to the robot's size. A smaller ratio gives a remark. A screw is a few
/// hundredths of a robot.
const MIN_USUAL_SIZE_RATIO: f64 = 0.001;

/// The robot's dimensions, with which the sizes of bodies are compared.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SizeScale {
    /// The size of the robot, or the extent of its joint origins; `None` if it has no bodies, or no links.
    size: Option<f64>,
    /// The longest range of a prismatic joint; infinite if one is unlimited.
    travel: f64,
}

impl Robot {
    /// Returns the longest side of the bounding box of all bodies, with each joint at 0 or at its limit nearest to 0;
    /// `None` without bodies.
    ///
    /// # Complexity
    /// Linear in the points of all bodies.
    pub fn size(&self) -> Option<f64> {
        largest_side(self.frames_near_zero().flat_map(|(link, frame)| {
            let bodies = self.links()[link].bodies.iter();
            bodies.flat_map(move |link_body| {
                let pose = frame.compose(&link_body.pose);
                link_body.body.pieces().iter().flat_map(move |piece| {
                    let radius = DVec3::splat(piece.radius);
                    let points = piece.points.iter();
                    points.flat_map(move |&point| {
                        let center = pose.transform_point(point);
                        [center - radius, center + radius]
                    })
                })
            })
        }))
    }

    /// Returns a remark if the position of a revolute joint seems to be in degrees: many turns and a round number of
    /// degrees.
    pub fn remark_on_configuration(&self, configuration: &[f64]) -> Option<CellRemark> {
        let positions = self.independent_joint_names().zip(configuration);
        let mut remarks = positions.filter_map(|(name, &position)| {
            let remark = Remark::remark_on_joint(position)?;
            let mut joints = self.joints().iter();
            let joint = joints.find(|joint| joint.name == name)?;
            matches!(joint.geometry.kind(), JointKind::Revolute(_))
                .then(|| CellRemark::on(format!("joint {name}"), remark))
        });
        remarks.next()
    }

    /// Returns the robot's dimensions, for comparison with other bodies.
    pub(crate) fn size_scale(&self) -> SizeScale {
        SizeScale {
            size: self.size(),
            travel: self.longest_travel(),
        }
    }

    /// Returns a remark for each link that is far larger than the extent of the robot's joints.
    pub(crate) fn remarks_on_link_sizes(&self) -> Vec<CellRemark> {
        let origins = self
            .frames_near_zero()
            .map(|(_, frame)| frame.translation());
        let scale = SizeScale {
            size: largest_side(origins),
            travel: self.longest_travel(),
        };
        let links = self.links().iter().filter_map(|link| {
            let sides = link
                .bodies
                .iter()
                .map(|link_body| Remark::sides(&link_body.body));
            let mut remarks = sides.filter_map(|sides| scale.remark_on_large(&link.name, sides));
            remarks.next()
        });
        links.collect()
    }

    /// Returns the frames of all links, with each joint at 0 or at its limit nearest to 0.
    fn frames_near_zero(&self) -> impl Iterator<Item = (usize, Pose)> {
        let configuration = self.configuration_nearest_zero();
        let links = self.links().iter().enumerate();
        links.filter_map(move |(index, link)| {
            Some((index, self.pose(&link.name, &configuration).ok()?))
        })
    }

    /// Returns the longest range of a prismatic joint.
    fn longest_travel(&self) -> f64 {
        let joints = self.joints().iter().map(|joint| &joint.geometry);
        let prismatic = joints.filter(|joint| matches!(joint.kind(), JointKind::Prismatic(_)));
        let travels = prismatic.map(|joint| joint.limits().end() - joint.limits().start());
        travels.fold(0.0, greater)
    }
}

impl SizeScale {
    /// Returns a remark if the bounding-box sides of an item are implausible next to the robot.
    pub(crate) fn remark(&self, item: &str, sides: [f64; 3]) -> Option<CellRemark> {
        let size = sides.into_iter().fold(0.0, greater);
        let robot_size = self.size?;
        let is_small = size > 0.0 && size < MIN_USUAL_SIZE_RATIO * robot_size;
        is_small
            .then(|| unlikely_size(item, size, robot_size))
            .or_else(|| self.remark_on_large(item, sides))
    }

    /// Returns a remark if an item is far too large. An item that is thinner than the robot may have any length, because
    /// it may be a floor or a wall.
    fn remark_on_large(&self, item: &str, sides: [f64; 3]) -> Option<CellRemark> {
        let robot_size = self.size.filter(|&size| size > 0.0)?;
        let [thickness, size] = [
            sides.into_iter().fold(f64::INFINITY, lesser),
            sides.into_iter().fold(0.0, greater),
        ];
        let largest_usual_size = if self.travel.is_finite() {
            MAX_USUAL_SIZE_RATIO * greater(robot_size, self.travel)
        } else {
            MAX_USUAL_SIZE_RATIO_IF_UNLIMITED * robot_size
        };
        let is_large = size > largest_usual_size && thickness > robot_size;
        is_large.then(|| unlikely_size(item, size, robot_size))
    }
}

fn unlikely_size(item: &str, size: f64, robot_size: f64) -> CellRemark {
    CellRemark::UnlikelySize {
        item: item.to_owned(),
        size,
        robot_size,
    }
}

/// Returns the longest side of the bounding box of points; `None` if there are none.
fn largest_side(points: impl IntoIterator<Item = DVec3>) -> Option<f64> {
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for point in points {
        for axis in 0..3 {
            low[axis] = lesser(low[axis], point[axis]);
            high[axis] = greater(high[axis], point[axis]);
        }
    }
    let sides = (high - low).to_array();
    let side = sides.into_iter().fold(f64::NEG_INFINITY, greater);
    (side >= 0.0).then_some(side)
}
