//! Remarks on a robot: on its files, on sizes, and on what is not checked.

use crate::pairs::LinkPairs;
use crate::remark::CellRemark;
use crate::robot::Robot;
use crate::skip_reason::SkipReason;

impl LinkPairs {
    /// Returns the remarks on a robot, to which these pairs must belong. Warnings come first. The remarks are about the
    /// robot's files, about links that seem to be in another unit of length than the joints, and about unchecked links
    /// and pairs.
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
        let names = |is_affected: fn(&MovingLink) -> bool| {
            let affected = moving.iter().filter(|link| is_affected(link));
            affected
                .map(|link| link.name.clone())
                .collect::<Vec<String>>()
        };
        let mut warnings = Vec::new();
        let (links, moving_count) = (names(|link| !link.has_body), moving.len());
        let count_with_bodies = moving_count - links.len();
        if 2 * links.len() > moving_count {
            warnings.push(CellRemark::MostLinksWithoutBodies {
                links,
                moving_count,
            });
        }
        let links = names(|link| link.has_body && !link.is_checked_as_far_as_possible);
        if 2 * links.len() > count_with_bodies {
            warnings.push(CellRemark::MostLinksUnchecked {
                links,
                moving_count: count_with_bodies,
            });
        }
        warnings
    }
}

/// A moving link that should be checked.
struct MovingLink {
    name: String,
    has_body: bool,
    /// Whether the link is checked against another link, or is unchecked only because of the robot's structure: all
    /// other links are adjacent to it or do not move relative to it.
    is_checked_as_far_as_possible: bool,
}

/// Returns the moving links with a body, and the moving links without a body that have a child joint at a distance from
/// their origin. A link between two joints at the same place needs no body.
fn moving_links(robot: &Robot, pairs: &LinkPairs) -> Vec<MovingLink> {
    let is_moving = |joint: usize| !robot.joints()[joint].geometry.is_fixed();
    let links_and_joints = robot.joints_parents_first();
    let has_length = |link: usize| {
        let mut child_joints = links_and_joints
            .iter()
            .filter(|&&(_, parent, _)| parent == link);
        child_joints.any(|&(_, _, joint)| {
            let origin = robot.joints()[joint].geometry.origin();
            is_moving(joint) && origin.translation().length() > 0.0
        })
    };
    let is_unchecked_by_structure = |link: usize| {
        let mut skipped = pairs
            .skipped_pairs()
            .filter(|(pair, _)| pair.contains(&link));
        skipped.all(|(_, reason)| matches!(reason, SkipReason::Adjacent | SkipReason::NoMotion))
    };
    let moving = links_and_joints
        .iter()
        .filter(|&&(_, _, joint)| is_moving(joint));
    let links = moving.filter_map(|&(link, ..)| {
        let has_body = robot.links()[link].has_shapes();
        (has_body || has_length(link)).then(|| MovingLink {
            name: robot.links()[link].name.clone(),
            has_body,
            is_checked_as_far_as_possible: is_unchecked_by_structure(link)
                || pairs.checked_pairs().any(|pair| pair.contains(&link)),
        })
    });
    links.collect()
}

#[cfg(test)]
mod tests;
