//! The tree of links: each link's parent, and the path of joints between two links.

use super::{Joint, Link};
use crate::error::RobotError;
use std::collections::HashMap;

/// The parent joint and the parent link of each link.
#[derive(Clone, Debug)]
pub(super) struct Tree {
    /// For each link, its parent joint and link; `None` for the base.
    parents: Vec<Option<Parent>>,
    pub(super) base: usize,
}

#[derive(Clone, Copy, Debug)]
struct Parent {
    joint: usize,
    link: usize,
}

/// A joint on the path from one link to another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct PathJoint {
    pub(super) joint: usize,
    /// Whether the path goes from the joint's child link to its parent link.
    pub(super) leads_to_parent: bool,
}

impl Tree {
    pub(super) fn new(links: &[Link], joints: &[Joint]) -> Result<Self, RobotError> {
        let mut link_indices = HashMap::new();
        for (index, Link { name, .. }) in links.iter().enumerate() {
            if link_indices.insert(name.as_str(), index).is_some() {
                return Err(RobotError::LinkNameTaken { link: name.clone() });
            }
        }
        let link_index = |name: &String| {
            let index = link_indices.get(name.as_str()).copied();
            index.ok_or_else(|| RobotError::NoSuchLink { link: name.clone() })
        };
        let mut parents = vec![None; links.len()];
        let mut joint_names = HashMap::new();
        for (k, joint) in joints.iter().enumerate() {
            let name = joint.name.clone();
            if joint_names.insert(name.clone(), k).is_some() {
                return Err(RobotError::JointNameTaken { joint: name });
            }
            let (child, parent) = (link_index(&joint.child)?, link_index(&joint.parent)?);
            let link = || joint.child.clone();
            if parents[child]
                .replace(Parent {
                    joint: k,
                    link: parent,
                })
                .is_some()
            {
                return Err(RobotError::TwoParents {
                    link: link(),
                    joint: name,
                });
            }
        }
        let mut bases = (0..links.len()).filter(|&link| parents[link].is_none());
        let name = |link: usize| links[link].name.clone();
        let base = match (bases.next(), bases.next()) {
            (Some(base), None) => base,
            (Some(first), Some(second)) => {
                let is_parent =
                    |link: usize| parents.iter().flatten().any(|parent| parent.link == link);
                if let (true, false) | (false, true) = (is_parent(first), is_parent(second)) {
                    let (base, unconnected) = if is_parent(first) {
                        (first, second)
                    } else {
                        (second, first)
                    };
                    let (link, base) = (name(unconnected), name(base));
                    return Err(RobotError::LinkWithoutJoint { link, base });
                }
                let (first, second) = (name(first), name(second));
                return Err(RobotError::TwoBases {
                    first_base: first,
                    second_base: second,
                });
            }
            (None, _) if links.is_empty() => return Err(RobotError::NoLinks),
            (None, _) => return Err(RobotError::Loop { link: name(0) }),
        };
        let tree = Tree { parents, base };
        let is_below_loop = |&link: &usize| tree.link_and_ancestors(link).count() > links.len();
        match (0..links.len()).find(is_below_loop) {
            Some(link) => Err(RobotError::Loop { link: name(link) }),
            None => Ok(tree),
        }
    }

    pub(super) fn parent(&self, link: usize) -> Option<usize> {
        self.parents[link].map(|parent| parent.link)
    }

    /// Returns (link, parent link, joint) for all links except the base. Parents come before children.
    pub(super) fn links_parents_first(&self) -> Vec<(usize, usize, usize)> {
        let mut links: Vec<(usize, usize)> = (0..self.parents.len())
            .map(|link| (self.link_and_ancestors(link).count(), link))
            .collect();
        links.sort_unstable();
        let with_parent = |&(_, link): &(usize, usize)| {
            self.parents[link].map(|parent| (link, parent.link, parent.joint))
        };
        links.iter().filter_map(with_parent).collect()
    }

    /// Iterates over a link and its ancestors, up to the base. In a loop of joints, ends after one more step than there
    /// are links.
    fn link_and_ancestors(&self, link: usize) -> impl Iterator<Item = usize> {
        let parent = |&link: &usize| self.parent(link);
        std::iter::successors(Some(link), parent).take(self.parents.len() + 1)
    }

    /// Returns the joints on the path between two links, through their nearest common ancestor.
    pub(super) fn path_between(&self, from: usize, to: usize) -> Vec<PathJoint> {
        let targets: Vec<usize> = self.link_and_ancestors(to).collect();
        let is_common = |link: &usize| targets.contains(link);
        // The base is an ancestor of both.
        let common = self
            .link_and_ancestors(from)
            .find(is_common)
            .unwrap_or(self.base);
        let steps_to_common = |link: usize, is_up: bool| {
            self.link_and_ancestors(link)
                .take_while(move |&link| link != common)
                .filter_map(move |link| self.parents[link])
                .map(move |parent| PathJoint {
                    joint: parent.joint,
                    leads_to_parent: is_up,
                })
        };
        let mut steps: Vec<PathJoint> = steps_to_common(to, false).collect();
        steps.reverse();
        steps_to_common(from, true).chain(steps).collect()
    }
}
