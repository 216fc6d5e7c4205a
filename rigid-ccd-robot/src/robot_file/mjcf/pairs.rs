//! The pairs of bodies that MuJoCo checks.

use super::{MjcfModel, WORLD};
use crate::pairs::{LinkPairs, SkipReason};
use crate::robot::Robot;
use crate::robot_file::BodyElements;
use crate::robot_file::error::RobotFileError;
use mjcf_rs::body::Geom;

/// Returns the pairs of links that MuJoCo checks. A pair of links is checked if some of their geoms are.
pub(super) fn link_pairs(
    mjcf: &MjcfModel,
    robot: &Robot,
    elements: BodyElements,
) -> Result<LinkPairs, RobotFileError> {
    let names = mjcf.link_names.iter();
    let links: Vec<usize> = names
        .map(|name| robot.link_number(name))
        .collect::<Result<_, _>>()?;
    let mut pairs = LinkPairs::from_robot(robot);
    for one in 0..links.len() {
        for other in 0..one {
            let [a, b] = [links[one], links[other]];
            pairs.include(a, b);
            if let Some(reason) = mjcf.skip_reason([one, other], elements) {
                pairs.skip(a, b, reason);
            }
        }
    }
    for pair in &mjcf.model.contact.pairs {
        let body = |geom: &str| mjcf.model.geom_by_name(geom).map(|(body, _)| links[body]);
        if let (Some(a), Some(b)) = (body(&pair.geom1), body(&pair.geom2)) {
            pairs.include(a, b);
        }
    }
    Ok(pairs)
}

impl MjcfModel {
    /// Returns why a pair of bodies is not checked; `None` if it is.
    fn skip_reason(&self, bodies: [usize; 2], elements: BodyElements) -> Option<SkipReason> {
        let [a, b] = bodies.map(|body| self.moving_ancestor(body));
        if a == b {
            return Some(SkipReason::NoMotion);
        }
        let parent = |body: usize| self.model.bodies[body].parent.unwrap_or(WORLD);
        let is_child = |body: usize, of: usize| self.moving_ancestor(parent(body)) == of;
        if a != WORLD && b != WORLD && (is_child(a, b) || is_child(b, a)) {
            return Some(SkipReason::Adjacent);
        }
        let names = bodies.map(|body| self.link_names[body].as_str());
        let excluded = self.model.contact.excludes.iter().any(|exclude| {
            let own = [exclude.body1.as_str(), exclude.body2.as_str()];
            own == names || own == [names[1], names[0]]
        });
        if excluded {
            return Some(SkipReason::Disabled("exclude".to_owned()));
        }
        let masks_matter = elements == BodyElements::Collision;
        (masks_matter && !self.can_collide(bodies))
            .then(|| SkipReason::Disabled("contype and conaffinity".to_owned()))
    }

    /// Returns the body itself, or the nearest one above it that moves by joints of its own; the world if none does.
    fn moving_ancestor(&self, mut body: usize) -> usize {
        while self.model.bodies[body].body.joints.is_empty() {
            match self.model.bodies[body].parent {
                Some(parent) => body = parent,
                None => return WORLD,
            }
        }
        body
    }

    /// Returns whether some geoms of two bodies collide by their masks.
    fn can_collide(&self, [a, b]: [usize; 2]) -> bool {
        let collide = |one: &Geom, other: &Geom| {
            one.contype & other.conaffinity != 0 || other.contype & one.conaffinity != 0
        };
        let [a, b] = [a, b].map(|body| &self.model.bodies[body].body.geoms);
        a.iter()
            .any(|one| b.iter().any(|other| collide(one, other)))
    }
}
