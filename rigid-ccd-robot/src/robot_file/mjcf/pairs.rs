//! The pairs of bodies that MuJoCo checks for collision.

use super::attributes::Attributes;
use super::bodies::{MjcfGeom, WORLD};
use super::model::MjcfModel;
use crate::pairs::LinkPairs;
use crate::robot::Robot;
use crate::robot_file::body_elements::BodyElements;
use crate::robot_file::error::RobotFileError;
use crate::robot_file::mjcf_error::MjcfError;
use crate::skip_reason::SkipReason;

impl MjcfModel {
    /// Returns the pairs of links that MuJoCo checks. A pair is checked if any two of its geoms are.
    pub(in crate::robot_file) fn link_pairs(
        &self,
        robot: &Robot,
        elements: BodyElements,
    ) -> Result<LinkPairs, RobotFileError> {
        let names = self.bodies.iter().map(|body| &body.name);
        let links: Vec<usize> = names
            .map(|name| robot.link_number(name))
            .collect::<Result<_, _>>()?;
        let excluded = self.excluded_pairs()?;
        let mut pairs = LinkPairs::from_robot(robot);
        for body_a in 0..links.len() {
            for body_b in 0..body_a {
                let [a, b] = [links[body_a], links[body_b]];
                pairs.include(a, b);
                let reason = self.skip_reason([body_a, body_b], elements);
                let exclude = || SkipReason::Disabled("exclude".to_owned());
                let is_excluded =
                    excluded.contains(&[body_a, body_b]) || excluded.contains(&[body_b, body_a]);
                if let Some(reason) = reason.or_else(|| is_excluded.then(exclude)) {
                    pairs.skip(a, b, reason);
                }
            }
        }
        for pair in self.constraints_named("pair") {
            let mut bodies = [WORLD; 2];
            for (body, name) in bodies.iter_mut().zip(["geom1", "geom2"]) {
                *body = self.body_of_geom(pair.required_name(name)?)?;
            }
            let [a, b] = bodies;
            if a == b {
                return Err(MjcfError::PairOfOneBody {
                    pair: pair.label(),
                    body: self.bodies[a].name.clone(),
                }
                .into());
            }
            pairs.include(links[a], links[b]);
        }
        Ok(pairs)
    }

    /// Returns whether MuJoCo checks a geom against anything.
    pub(super) fn is_solid(&self, geom: &MjcfGeom) -> bool {
        geom.contype != 0 || geom.conaffinity != 0 || self.is_in_pair(geom)
    }

    /// Returns whether a `pair` element names a geom.
    fn is_in_pair(&self, geom: &MjcfGeom) -> bool {
        let is_named = |pair: &Attributes| {
            let names = [pair.name("geom1"), pair.name("geom2")];
            geom.name().is_some() && names.contains(&geom.name())
        };
        self.constraints_named("pair").any(is_named)
    }

    fn body_of_geom(&self, name: &str) -> Result<usize, MjcfError> {
        let has_geom = |geoms: &[MjcfGeom]| geoms.iter().any(|geom| geom.name() == Some(name));
        let body = self.bodies.iter().find(|body| has_geom(&body.geoms));
        let body = body.ok_or_else(|| MjcfError::unknown_name("geom", name))?;
        Ok(body.number)
    }

    fn excluded_pairs(&self) -> Result<Vec<[usize; 2]>, MjcfError> {
        let excludes = self.constraints_named("exclude");
        excludes
            .map(|exclude| {
                let body = |name: &str| self.body_named(exclude.required_name(name)?);
                Ok([body("body1")?, body("body2")?])
            })
            .collect()
    }

    /// Returns the reason why a pair of bodies is not checked; `None` if it is checked. Ignores `exclude` elements.
    fn skip_reason(&self, bodies: [usize; 2], elements: BodyElements) -> Option<SkipReason> {
        let [a, b] = bodies.map(|body| self.moving_ancestor(body));
        if a == b {
            return Some(SkipReason::NoMotion);
        }
        let parent = |body: usize| self.bodies[body].parent.unwrap_or(WORLD);
        let is_child = |body: usize, other: usize| self.moving_ancestor(parent(body)) == other;
        let is_near_world = a == WORLD || b == WORLD;
        if self.settings.skips_parents && !is_near_world && (is_child(a, b) || is_child(b, a)) {
            return Some(SkipReason::Adjacent);
        }
        let masks_matter = elements == BodyElements::Collision;
        (masks_matter && !self.can_collide(bodies))
            .then(|| SkipReason::Disabled("contype and conaffinity".to_owned()))
    }

    /// Returns the nearest body with joints among a body and its ancestors; the world if there is none.
    fn moving_ancestor(&self, mut body: usize) -> usize {
        while self.bodies[body].joints.is_empty() {
            match self.bodies[body].parent {
                Some(parent) => body = parent,
                None => return WORLD,
            }
        }
        body
    }

    /// Returns whether the masks of any two geoms of the bodies allow a collision.
    fn can_collide(&self, [a, b]: [usize; 2]) -> bool {
        let collide = |one: &MjcfGeom, other: &MjcfGeom| {
            one.contype & other.conaffinity != 0 || other.contype & one.conaffinity != 0
        };
        let [a, b] = [a, b].map(|body| &self.bodies[body].geoms);
        a.iter()
            .any(|one| b.iter().any(|other| collide(one, other)))
    }
}
