//! A summary of what is checked: counts of links, bodies and pairs.

use crate::cell::Cell;
use crate::pairs::LinkPairs;
use crate::remark::counted;
use crate::robot::Robot;
use crate::skip_reason::LeftOutPairs;
use std::fmt;

/// Counts of the checked links, bodies and pairs of a robot or a cell. Its text is one line.
///
/// [`LinkPairs::check_summary`] creates it for a robot, [`Cell::check_summary`] for a cell.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct CheckSummary {
    /// The number of links.
    pub link_count: usize,
    /// The number of bodies of all links, planes included.
    pub body_count: usize,
    /// The number of links without bodies. Such a link is not checked.
    pub bare_link_count: usize,
    /// The number of pairs of links that are checked.
    pub checked_pair_count: usize,
    /// The pairs of links with bodies that are not checked, grouped by reason.
    pub left_out_pairs: Vec<LeftOutPairs>,
    /// Counts of the obstacles and attached bodies; `None` for a robot alone.
    pub surroundings: Option<Surroundings>,
}

/// Counts of the obstacles, the attached bodies and the allowed contacts of a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Surroundings {
    /// The number of obstacles.
    pub obstacle_count: usize,
    /// The number of attached bodies.
    pub attached_count: usize,
    /// The number of pairs that are allowed to touch, except pairs of two links.
    pub allowed_contact_count: usize,
}

impl LinkPairs {
    /// Returns the summary for a robot, to which these pairs must belong.
    pub fn check_summary(&self, robot: &Robot) -> CheckSummary {
        let links = robot.links().iter();
        CheckSummary {
            link_count: robot.links().len(),
            body_count: links
                .clone()
                .map(|link| link.bodies.len() + link.planes.len())
                .sum(),
            bare_link_count: links.filter(|link| !link.has_shapes()).count(),
            checked_pair_count: self.checked_pairs().count(),
            left_out_pairs: self.left_out_pairs(robot),
            surroundings: None,
        }
    }
}

impl Cell {
    /// Returns the summary for the cell.
    pub fn check_summary(&self) -> CheckSummary {
        CheckSummary {
            surroundings: Some(Surroundings {
                obstacle_count: self.obstacle_names().len(),
                attached_count: self.attached_names().count(),
                allowed_contact_count: self.allowed_contacts().len(),
            }),
            ..self.link_pairs().check_summary(self.robot())
        }
    }
}

impl fmt::Display for CheckSummary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", counted(self.link_count, "link"))?;
        if self.bare_link_count > 0 {
            write!(f, ", {} without bodies", self.bare_link_count)?;
        }
        let bodies = match self.body_count {
            1 => "1 body".to_owned(),
            count => format!("{count} bodies"),
        };
        let checked = counted(self.checked_pair_count, "pair");
        write!(f, "; {bodies}; {checked} of links checked")?;
        for LeftOutPairs { reason, pairs } in &self.left_out_pairs {
            write!(f, ", {} not ({reason})", pairs.len())?;
        }
        let Some(surroundings) = self.surroundings else {
            return Ok(());
        };
        write!(f, "; {}", counted(surroundings.obstacle_count, "obstacle"))?;
        if surroundings.attached_count > 0 {
            write!(f, ", {} attached", surroundings.attached_count)?;
        }
        if surroundings.allowed_contact_count > 0 {
            let allowed = counted(surroundings.allowed_contact_count, "contact");
            write!(f, ", {allowed} allowed")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
