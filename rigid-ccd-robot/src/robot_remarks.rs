//! Remarks on a robot: on its files, on sizes, and on what is not checked.

use crate::pairs::LinkPairs;
use crate::remark::CellRemark;
use crate::robot::Robot;
use crate::skip_reason::SkipReason;

impl LinkPairs {
    /// Lists the remarks on a robot, warnings first. They concern its files, links that seem to be in another unit of
    /// length than its joints, and what is not checked. The pairs must be those of this robot.
    ///
    /// # Complexity
    /// Linear in the points of all bodies, quadratic in the number of links.
    pub fn remarks(&self, robot: &Robot) -> Vec<CellRemark> {
        let mut remarks = self.warnings_of_unchecked(robot);
        remarks.extend(robot.file_remarks().iter().cloned());
        remarks.extend(self.file_remarks().iter().cloned());
        remarks.extend(robot.remarks_on_link_sizes());
        let bare = robot.links().iter().filter(|link| !link.has_shapes());
        let links: Vec<String> = bare.map(|link| link.name.clone()).collect();
        if !links.is_empty() {
            remarks.push(CellRemark::LinksWithoutBodies { links });
        }
        let left_out = self.left_out_pairs(robot).into_iter();
        remarks.extend(left_out.map(CellRemark::PairsLeftOut));
        CellRemark::warnings_first(remarks)
    }

    /// Returns warnings if most of the robot is not checked.
    fn warnings_of_unchecked(&self, robot: &Robot) -> Vec<CellRemark> {
        let moving = moving_links(robot, self);
        let names = |is_left: fn(&MovingLink) -> bool| {
            let left = moving.iter().filter(|link| is_left(link));
            left.map(|link| link.name.clone()).collect::<Vec<String>>()
        };
        let mut warnings = Vec::new();
        let (links, moving_count) = (names(|link| !link.has_body), moving.len());
        let with_bodies = moving_count - links.len();
        if 2 * links.len() > moving_count {
            warnings.push(CellRemark::MostLinksWithoutBodies {
                links,
                moving_count,
            });
        }
        let links = names(|link| link.has_body && !link.is_checked_as_far_as_possible);
        if 2 * links.len() > with_bodies {
            warnings.push(CellRemark::MostLinksUnchecked {
                links,
                moving_count: with_bodies,
            });
        }
        warnings
    }
}

/// A moving link that should be checked.
struct MovingLink {
    name: String,
    has_body: bool,
    /// Whether the link is checked against another link, or all reasons why it is not follow from the robot's
    /// structure.
    is_checked_as_far_as_possible: bool,
}

/// Returns the moving links with a body, and those without a body that span a distance to another moving joint. A
/// frame between two joints at the same place needs no shape.
fn moving_links(robot: &Robot, pairs: &LinkPairs) -> Vec<MovingLink> {
    let is_moving = |joint: usize| !robot.joints()[joint].geometry.is_fixed();
    let all = robot.joints_parents_first();
    let spans = |link: usize| {
        let carried = all.iter().filter(|&&(_, parent, _)| parent == link);
        carried.clone().any(|&(_, _, joint)| {
            let origin = robot.joints()[joint].geometry.origin();
            is_moving(joint) && origin.translation().length() > 0.0
        })
    };
    let is_structural = |link: usize| {
        let mut own = pairs
            .skipped_pairs()
            .filter(|(pair, _)| pair.contains(&link));
        own.all(|(_, reason)| matches!(reason, SkipReason::Adjacent | SkipReason::NoMotion))
    };
    let moved = all.iter().filter(|&&(_, _, joint)| is_moving(joint));
    let found = moved.filter_map(|&(link, ..)| {
        let has_body = robot.links()[link].has_shapes();
        (has_body || spans(link)).then(|| MovingLink {
            name: robot.links()[link].name.clone(),
            has_body,
            is_checked_as_far_as_possible: is_structural(link)
                || pairs.checked_pairs().any(|pair| pair.contains(&link)),
        })
    });
    found.collect()
}

#[cfg(test)]
mod tests;
