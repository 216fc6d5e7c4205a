//! Whether a robot's joints may be at the positions that a certificate gives them.

use crate::tolerances::POSITION;
use rigid_ccd_robot::{Joint, PositionRule, Robot};
use std::collections::BTreeMap;

/// A position of a joint in a certificate that the robot cannot have.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ImpossiblePosition {
    /// The position is beyond a limit of the joint.
    #[error("joint {joint} is at {position}, beyond its limits {low} to {high}")]
    BeyondLimit {
        /// The name of the joint.
        joint: String,
        /// Where it is at an end of the edge.
        position: f64,
        /// The lower limit.
        low: f64,
        /// The upper limit.
        high: f64,
    },
    /// The joint follows another one, and is not where that moves it.
    #[error("joint {joint} is at {position}, but follows {followed}, which moves it to {expected}")]
    NotFollowing {
        /// The name of the joint.
        joint: String,
        /// Where it is at an end of the edge.
        position: f64,
        /// The name of the joint that it follows in the end.
        followed: String,
        /// Where it would be.
        expected: f64,
    },
}

/// How the position of a joint is made of one that has a position of its own: `factor · position + offset`.
struct Rule<'r> {
    root: &'r Joint,
    factor: f64,
    offset: f64,
    /// The sum of the magnitudes of what is added up to `offset`.
    magnitude: f64,
    /// The number of joints from the one to the other.
    chain: f64,
}

/// A position, and a bound of what it is off by.
type Rounded = (f64, f64);

/// Checks the positions of joints at both ends of an edge. Between them all are linear, so limits and rules hold there, too.
pub(crate) fn check_positions(
    robot: &Robot,
    joints: &[(&str, [f64; 2])],
) -> Result<(), ImpossiblePosition> {
    let by_name = robot.joints().iter().map(|joint| (&*joint.name, joint));
    let by_name: BTreeMap<&str, &Joint> = by_name.collect();
    let rules = joints
        .iter()
        .filter_map(|&(name, ends)| Some((name, ends, rule(&by_name, by_name.get(name)?)?)));
    let rules: Vec<_> = rules.collect();
    for end in 0..2 {
        // A joint that is followed may carry no body, and have no position here: then one that follows it says where it is.
        let mut roots: BTreeMap<&str, Rounded> = BTreeMap::new();
        let own_first = [true, false].into_iter();
        for is_own in own_first {
            for (_, ends, rule) in rules
                .iter()
                .filter(|(.., rule)| (rule.chain == 0.0) == is_own)
            {
                if rule.factor != 0.0 {
                    let off = POSITION * (1.0 + rule.chain) * (size(*ends) + rule.magnitude);
                    let found = (
                        (ends[end] - rule.offset) / rule.factor,
                        off / rule.factor.abs(),
                    );
                    roots.entry(&rule.root.name).or_insert(found);
                }
            }
        }
        for (root, &position) in &roots {
            check_limits(by_name[root], position)?;
        }
        for (name, ends, rule) in &rules {
            check_follows((name, *ends, rule), end, roots.get(&*rule.root.name))?;
        }
    }
    Ok(())
}

/// Returns the rule of a joint; `None` if it follows none that has a position of its own, which no robot has.
fn rule<'r>(by_name: &BTreeMap<&str, &'r Joint>, joint: &'r Joint) -> Option<Rule<'r>> {
    let mut rule = Rule {
        root: joint,
        factor: 1.0,
        offset: 0.0,
        magnitude: 0.0,
        chain: 0.0,
    };
    for _ in 0..=by_name.len() {
        let PositionRule::Follows {
            joint: followed,
            multiplier,
            offset,
        } = &rule.root.position_rule
        else {
            return Some(rule);
        };
        rule = Rule {
            root: by_name.get(&**followed)?,
            factor: rule.factor * multiplier,
            offset: rule.offset + rule.factor * offset,
            magnitude: rule.magnitude + (rule.factor * offset).abs(),
            chain: rule.chain + 1.0,
        };
    }
    None
}

fn size([from, to]: [f64; 2]) -> f64 {
    from.abs() + to.abs()
}

fn check_limits(joint: &Joint, (position, off): Rounded) -> Result<(), ImpossiblePosition> {
    let limits = joint.geometry.limits();
    let (low, high) = (*limits.start(), *limits.end());
    // Written so that NaN is refused.
    if position >= low - off && position <= high + off {
        return Ok(());
    }
    Err(ImpossiblePosition::BeyondLimit {
        joint: joint.name.clone(),
        position,
        low,
        high,
    })
}

fn check_follows(
    (name, ends, rule): (&str, [f64; 2], &Rule<'_>),
    end: usize,
    root: Option<&Rounded>,
) -> Result<(), ImpossiblePosition> {
    // Of a joint that is at rest whatever it follows the offset is known.
    let &(root, off) = root.unwrap_or(&(0.0, 0.0));
    let expected = rule.factor * root + rule.offset;
    let size = size(ends) + (rule.factor * root).abs() + rule.magnitude;
    let allowed = rule.factor.abs() * off + POSITION * (1.0 + rule.chain) * size;
    let position = ends[end];
    if (position - expected).abs() <= allowed {
        return Ok(());
    }
    Err(ImpossiblePosition::NotFollowing {
        joint: name.to_owned(),
        position,
        followed: rule.root.name.clone(),
        expected,
    })
}

#[cfg(test)]
mod tests;
