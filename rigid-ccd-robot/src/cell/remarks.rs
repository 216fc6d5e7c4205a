//! What is probably a mistake in a cell.

use super::{Cell, Item};
use crate::remark::CellRemark;
use crate::robot::Robot;
use ccd_core::order::{greater, lesser};
use rigid_ccd::glam::DVec3;
use rigid_ccd::{Pose, Remark};

/// The ratio of sizes above which a remark is made; millimetres and metres differ by 1000.
const MAX_USUAL_SIZE_RATIO: f64 = 100.0;

/// The ratio of sizes below which a remark is made. Screws are a few hundredths of a robot.
const MIN_USUAL_SIZE_RATIO: f64 = 0.001;

impl Cell {
    /// Lists the remarks on the robot's files, on sizes that differ as millimetres and metres do, and on a tolerance that is
    /// large against what it is used for.
    ///
    /// # Complexity
    /// Linear in the points of all bodies.
    pub fn remarks(&self, tolerance: f64) -> Vec<CellRemark> {
        let of_files = self.robot().remarks().iter();
        let of_pairs = self.link_pairs().remarks().iter();
        let mut remarks: Vec<CellRemark> = of_files.chain(of_pairs).cloned().collect();
        let sizes = self.item_sizes();
        remarks.extend(self.remarks_on_sizes(&sizes));
        remarks.extend(sizes.iter().filter_map(|&(item, size)| {
            let remark = Remark::remark_on_tolerance(tolerance, [size; 2])?;
            let item = item.name().to_owned();
            Some(CellRemark::Input { item, remark })
        }));
        remarks
    }

    /// Returns the largest side of a box around the robot's bodies, while its joints are as near to 0 as their limits allow;
    /// `None` without bodies.
    ///
    /// It may be too large by a small factor, because a ball stands for each body.
    pub fn robot_size(&self) -> Option<f64> {
        let placed = self
            .placed_at_rest()
            .filter(|(item, _)| matches!(item, Item::Link(_)));
        largest_side(placed.flat_map(|(_, corners)| corners))
    }

    /// Returns the size of each link with bodies, attached body and obstacle: the largest side of its largest body's bounding
    /// box. Planes have none.
    pub fn item_sizes(&self) -> Vec<(Item<'_>, f64)> {
        let mut sizes: Vec<(Item<'_>, f64)> = Vec::new();
        let bodies = self.carried_bodies().enumerate();
        for (_, carried) in bodies.filter(|&(number, _)| !self.is_plane(number)) {
            let size = Remark::body_size(carried.body);
            match sizes.iter_mut().find(|(item, _)| *item == carried.item) {
                Some((_, largest)) => *largest = greater(*largest, size),
                None => sizes.push((carried.item, size)),
            }
        }
        sizes
    }

    fn remarks_on_sizes(&self, sizes: &[(Item<'_>, f64)]) -> Vec<CellRemark> {
        let reach = largest_side(self.robot().frames_at_rest());
        let robot_size = self.robot_size();
        let unlikely = |&(item, size): &(Item<'_>, f64)| {
            let (robot_size, is_unlikely) = match item {
                Item::Link(_) => {
                    let reach = reach.filter(|&reach| reach > 0.0)?;
                    (reach, size > MAX_USUAL_SIZE_RATIO * reach)
                }
                Item::Attached(_) | Item::Obstacle(_) => {
                    let robot = robot_size.filter(|&robot| robot > 0.0)?;
                    let is_large = size > MAX_USUAL_SIZE_RATIO * robot;
                    let is_small = size > 0.0 && size < MIN_USUAL_SIZE_RATIO * robot;
                    (robot, is_large || is_small)
                }
            };
            is_unlikely.then(|| CellRemark::UnlikelySize {
                item: item.name().to_owned(),
                size,
                robot_size,
            })
        };
        sizes.iter().filter_map(unlikely).collect()
    }

    /// Returns two opposite corners of a box around each body, while joints are as near to 0 as their limits allow.
    fn placed_at_rest(&self) -> impl Iterator<Item = (Item<'_>, [DVec3; 2])> {
        let placed = self.placed_bodies(&self.robot().configuration_nearest_zero());
        let corners = |(item, body, pose): (_, &rigid_ccd::Body, Pose)| {
            let radius = DVec3::splat(body.bounding_radius());
            let centre = pose.translation();
            (item, [centre - radius, centre + radius])
        };
        let bodies = placed.unwrap_or_default().into_iter().enumerate();
        let bodies = bodies.filter(|&(number, _)| !self.is_plane(number));
        bodies.map(move |(_, body)| corners(body))
    }
}

impl Robot {
    /// Returns the origins of all links, while joints are as near to 0 as their limits allow.
    fn frames_at_rest(&self) -> impl Iterator<Item = DVec3> {
        let at = self.configuration_nearest_zero();
        let links = self.links().iter();
        links.filter_map(move |link| Some(self.pose(&link.name, &at).ok()?.translation()))
    }
}

/// Returns the largest side of a box around points; `None` if there are none.
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

#[cfg(test)]
mod tests;
