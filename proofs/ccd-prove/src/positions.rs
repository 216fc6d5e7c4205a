//! Checks that a robot can have the joint positions of a certificate.

use crate::tolerances::POSITION_ERROR;
use rigid_ccd_robot::{Joint, PositionRule, Robot};
use std::collections::BTreeMap;

/// A joint position in a certificate that the robot cannot have.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ImpossiblePosition {
    /// The position is beyond a limit of the joint.
    #[error("joint {joint} is at {position}, beyond its limits {low} to {high}")]
    BeyondLimit {
        /// The name of the joint.
        joint: String,
        /// Its position at an end of the edge.
        position: f64,
        /// The lower limit.
        low: f64,
        /// The upper limit.
        high: f64,
    },
    /// The joint is a mimic joint, and its position does not agree with its rule.
    #[error(
        "joint {joint} is at {position}, but by its mimic rule for {followed} it would be at {expected}"
    )]
    NotFollowing {
        /// The name of the joint.
        joint: String,
        /// Its position at an end of the edge.
        position: f64,
        /// The name of the joint at the end of the chain of rules.
        followed: String,
        /// Its position by the rule.
        expected: f64,
    },
}

/// The position of a joint as a function of its root: `factor · root + offset`. The root is the independent joint at the end of the
/// chain of mimic rules.
struct Rule<'r> {
    root: &'r Joint,
    factor: f64,
    offset: f64,
    /// The sum of the magnitudes of the terms of `offset`.
    offset_magnitude: f64,
    /// The number of rules in the chain, as a factor of error bounds. It is 0 for an independent joint.
    chain_length: f64,
}

/// A position, and a bound of its error.
#[derive(Clone, Copy)]
struct BoundedPosition {
    position: f64,
    error: f64,
}

/// Checks the positions of joints at both ends of an edge. Positions are linear in time, so the limits and the rules then hold on the
/// whole edge.
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
        // The statement has no position of a root that moves no body. In this case a follower's position determines the root's position.
        let mut roots: BTreeMap<&str, BoundedPosition> = BTreeMap::new();
        for is_root in [true, false] {
            for (_, ends, rule) in rules
                .iter()
                .filter(|(.., rule)| (rule.chain_length == 0.0) == is_root)
            {
                if rule.factor != 0.0 {
                    let error = POSITION_ERROR
                        * (1.0 + rule.chain_length)
                        * (magnitude(*ends) + rule.offset_magnitude);
                    let root = BoundedPosition {
                        position: (ends[end] - rule.offset) / rule.factor,
                        error: error / rule.factor.abs(),
                    };
                    roots.entry(&rule.root.name).or_insert(root);
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

/// Returns the rule of a joint. Returns `None` if its chain of rules has no independent joint, which no robot has.
fn rule<'r>(by_name: &BTreeMap<&str, &'r Joint>, joint: &'r Joint) -> Option<Rule<'r>> {
    let mut rule = Rule {
        root: joint,
        factor: 1.0,
        offset: 0.0,
        offset_magnitude: 0.0,
        chain_length: 0.0,
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
            offset_magnitude: rule.offset_magnitude + (rule.factor * offset).abs(),
            chain_length: rule.chain_length + 1.0,
        };
    }
    None
}

fn magnitude([from, to]: [f64; 2]) -> f64 {
    from.abs() + to.abs()
}

fn check_limits(
    joint: &Joint,
    BoundedPosition { position, error }: BoundedPosition,
) -> Result<(), ImpossiblePosition> {
    let limits = joint.geometry.limits();
    let (low, high) = (*limits.start(), *limits.end());
    // This form of the comparison refuses NaN.
    if position >= low - error && position <= high + error {
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
    root: Option<&BoundedPosition>,
) -> Result<(), ImpossiblePosition> {
    // With a factor of 0 the joint stays at its offset, whatever the position of the root.
    let (root, root_error) = root.map_or((0.0, 0.0), |root| (root.position, root.error));
    let expected = rule.factor * root + rule.offset;
    let magnitude = magnitude(ends) + (rule.factor * root).abs() + rule.offset_magnitude;
    let max_error =
        rule.factor.abs() * root_error + POSITION_ERROR * (1.0 + rule.chain_length) * magnitude;
    let position = ends[end];
    if (position - expected).abs() <= max_error {
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
