//! What of a robot is checked, in numbers, and remarks about what is not.

use crate::cell::Cell;
use crate::pairs::{LinkPairs, SkipReason};
use crate::robot::Robot;
use std::fmt;

/// What of a robot, and of the cell around it, is compared with what.
///
/// [`LinkPairs::check_summary`] makes that of a robot, [`Cell::check_summary`] that of a cell. Its text is one line of counts.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct CheckSummary {
    /// The number of links.
    pub link_count: usize,
    /// The number of bodies of links.
    pub body_count: usize,
    /// The links without bodies, which are compared with nothing.
    pub links_without_bodies: Vec<String>,
    /// The number of pairs of links that are checked.
    pub checked_pair_count: usize,
    /// The pairs of links with bodies that are not checked, by reason.
    pub left_out_pairs: Vec<LeftOutPairs>,
    /// What is around the robot; `None` for a robot alone.
    pub surroundings: Option<Surroundings>,
    /// The links with bodies that joints move, and those that span a distance from one joint to the next.
    moving_links: Vec<MovingLink>,
}

/// Pairs of links that are not checked, for the same reason.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct LeftOutPairs {
    /// The reason.
    pub reason: SkipReason,
    /// The names of the links.
    pub pairs: Vec<[String; 2]>,
}

/// What is around a robot.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Surroundings {
    /// The number of obstacles.
    pub obstacle_count: usize,
    /// The number of bodies that are attached to links.
    pub attached_count: usize,
    /// The pairs that were allowed to touch, other than two links.
    pub allowed_contacts: Vec<[String; 2]>,
}

/// A link that a joint moves, of which a check may be expected.
#[derive(Clone, Debug, PartialEq, Eq)]
struct MovingLink {
    name: String,
    has_body: bool,
    /// Whether it is checked against another link, or every reason why it is not is the robot's structure.
    is_checked_as_far_as_possible: bool,
}

/// A remark about what is not checked. It changes no answer.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum CheckRemark {
    /// More than half of the moving links have no bodies. This is a [warning](CheckRemark::is_warning).
    MostLinksWithoutBodies {
        /// The moving links without bodies.
        links: Vec<String>,
        /// The number of moving links.
        moving_count: usize,
    },
    /// More than half of the moving links are checked against no other link, because a file or a caller leaves their pairs out.
    /// This is a [warning](CheckRemark::is_warning).
    MostLinksUnchecked {
        /// The moving links that are checked against no other link.
        links: Vec<String>,
        /// The number of moving links with bodies.
        moving_count: usize,
    },
    /// Links have no bodies.
    LinksWithoutBodies {
        /// The links.
        links: Vec<String>,
    },
    /// Pairs of links are not checked.
    PairsLeftOut(LeftOutPairs),
    /// Pairs other than two links were allowed to touch.
    ContactsAllowed {
        /// The pairs.
        pairs: Vec<[String; 2]>,
    },
}

impl LinkPairs {
    /// Returns what of a robot is checked; the pairs have to be those of this robot.
    pub fn check_summary(&self, robot: &Robot) -> CheckSummary {
        let name = |link: usize| robot.links()[link].name.clone();
        let mut left_out: Vec<LeftOutPairs> = Vec::new();
        for (pair, reason) in self.skipped_pairs() {
            let names = pair.map(name);
            match left_out.iter_mut().find(|group| group.reason == *reason) {
                Some(group) => group.pairs.push(names),
                None => left_out.push(LeftOutPairs {
                    reason: reason.clone(),
                    pairs: vec![names],
                }),
            }
        }
        let links = || robot.links().iter();
        let bare = links().filter(|link| !link.has_shapes());
        CheckSummary {
            link_count: robot.links().len(),
            body_count: links()
                .map(|link| link.bodies.len() + link.planes.len())
                .sum(),
            links_without_bodies: bare.map(|link| link.name.clone()).collect(),
            checked_pair_count: self.checked_pairs().count(),
            left_out_pairs: left_out,
            surroundings: None,
            moving_links: moving_links(robot, self),
        }
    }
}

impl Cell {
    /// Returns what of the robot and of the cell is compared.
    pub fn check_summary(&self) -> CheckSummary {
        let allowed = self.allowed_contacts().into_iter();
        let names = allowed.map(|pair| pair.map(|item| item.name().to_owned()));
        CheckSummary {
            surroundings: Some(Surroundings {
                obstacle_count: self.obstacle_names().len(),
                attached_count: self.attached_names().count(),
                allowed_contacts: names.collect(),
            }),
            ..self.link_pairs().check_summary(self.robot())
        }
    }
}

/// Returns the links that a joint moves and that have a body, or that hold another moving joint at a distance from their own: a
/// frame between two joints at the same place has no shape.
fn moving_links(robot: &Robot, pairs: &LinkPairs) -> Vec<MovingLink> {
    let is_moving = |joint: usize| !robot.joints()[joint].axis_and_limits.is_fixed();
    let all = robot.joints_parents_first();
    let spans = |link: usize| {
        let carried = all.iter().filter(|&&(_, parent, _)| parent == link);
        carried.clone().any(|&(_, _, joint)| {
            let origin = robot.joints()[joint].axis_and_limits.origin();
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

impl CheckSummary {
    /// Returns what is not checked, group by group: the warnings first.
    pub fn remarks(&self) -> Vec<CheckRemark> {
        let mut remarks = self.warnings();
        if !self.links_without_bodies.is_empty() {
            let links = self.links_without_bodies.clone();
            remarks.push(CheckRemark::LinksWithoutBodies { links });
        }
        let left_out = self.left_out_pairs.iter().cloned();
        remarks.extend(left_out.map(CheckRemark::PairsLeftOut));
        let around = self.surroundings.as_ref();
        if let Some(around) = around.filter(|around| !around.allowed_contacts.is_empty()) {
            let pairs = around.allowed_contacts.clone();
            remarks.push(CheckRemark::ContactsAllowed { pairs });
        }
        remarks
    }

    /// Returns the remarks that most of a robot is not checked.
    pub fn warnings(&self) -> Vec<CheckRemark> {
        let names = |is_left: fn(&MovingLink) -> bool| {
            let left = self.moving_links.iter().filter(|link| is_left(link));
            left.map(|link| link.name.clone()).collect::<Vec<String>>()
        };
        let mut warnings = Vec::new();
        let (links, moving_count) = (names(|link| !link.has_body), self.moving_links.len());
        let with_bodies = moving_count - links.len();
        if 2 * links.len() > moving_count {
            warnings.push(CheckRemark::MostLinksWithoutBodies {
                links,
                moving_count,
            });
        }
        let links = names(|link| link.has_body && !link.is_checked_as_far_as_possible);
        if 2 * links.len() > with_bodies {
            warnings.push(CheckRemark::MostLinksUnchecked {
                links,
                moving_count: with_bodies,
            });
        }
        warnings
    }
}

impl CheckRemark {
    /// Returns whether most of a robot is not checked, so that an answer says little.
    pub fn is_warning(&self) -> bool {
        matches!(
            self,
            CheckRemark::MostLinksWithoutBodies { .. } | CheckRemark::MostLinksUnchecked { .. }
        )
    }
}

impl fmt::Display for CheckSummary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", counted(self.link_count, "link"))?;
        if !self.links_without_bodies.is_empty() {
            write!(f, ", {} without bodies", self.links_without_bodies.len())?;
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
        let Some(around) = &self.surroundings else {
            return Ok(());
        };
        write!(f, "; {}", counted(around.obstacle_count, "obstacle"))?;
        if around.attached_count > 0 {
            write!(f, ", {} attached", around.attached_count)?;
        }
        if !around.allowed_contacts.is_empty() {
            let allowed = counted(around.allowed_contacts.len(), "contact");
            write!(f, ", {allowed} allowed")?;
        }
        Ok(())
    }
}

impl fmt::Display for CheckRemark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            CheckRemark::MostLinksWithoutBodies {
                links,
                moving_count,
            } => write!(
                f,
                "most of the robot is not checked: {} of {moving_count} moving links have no bodies: {}; the shapes for drawing \
                 may have them",
                links.len(),
                links.join(", ")
            ),
            CheckRemark::MostLinksUnchecked {
                links,
                moving_count,
            } => write!(
                f,
                "most of the robot is not checked against itself: {} of {moving_count} moving links are checked against no other \
                 link: {}",
                links.len(),
                links.join(", ")
            ),
            CheckRemark::LinksWithoutBodies { links } => write!(
                f,
                "{} without bodies, compared with nothing: {}",
                counted(links.len(), "link"),
                links.join(", ")
            ),
            CheckRemark::PairsLeftOut(LeftOutPairs { reason, pairs }) => write!(
                f,
                "{} of links not checked ({reason}): {}",
                counted(pairs.len(), "pair"),
                listed(pairs)
            ),
            CheckRemark::ContactsAllowed { pairs } => write!(
                f,
                "{} allowed: {}",
                counted(pairs.len(), "contact"),
                listed(pairs)
            ),
        }
    }
}

fn listed(pairs: &[[String; 2]]) -> String {
    let texts: Vec<String> = pairs.iter().map(|[a, b]| format!("{a} and {b}")).collect();
    texts.join(", ")
}

fn counted(count: usize, thing: &str) -> String {
    match count {
        1 => format!("1 {thing}"),
        _ => format!("{count} {thing}s"),
    }
}

#[cfg(test)]
mod tests;
