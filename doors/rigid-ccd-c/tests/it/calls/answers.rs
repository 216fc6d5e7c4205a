//! Checks that every answer must pass.

use super::places::{Context, require};
use super::world::World;
use rigid_ccd_c::*;
use std::fmt::Debug;

/// The values of `rccd_limit`.
const LIMITS: [i32; 8] = [0, 1, 2, 3, 4, 5, 6, 255];
const UNRESOLVED: i32 = RccdOutcome::Unresolved as i32;

pub(super) trait Answer: Copy + Debug {
    /// Checks an answer whose enums are valid.
    fn check(&self, world: &mut World<'_>, context: &Context) -> Result<(), String>;

    /// Checks the enums of an answer in its bytes. They follow the size.
    fn check_enums(bytes: &[u8]) -> Result<(), String> {
        let [outcome, limit] = [8, 12].map(|from| {
            let bytes = bytes[from..from + 4].try_into();
            i32::from_ne_bytes(bytes.unwrap())
        });
        require((0..=6).contains(&outcome), "an outcome is unknown")?;
        require(LIMITS.contains(&limit), "a limit is unknown")?;
        require(
            outcome != UNRESOLVED || limit != 0,
            "an unresolved answer has no limit",
        )
    }
}

impl Answer for RccdAnswer {
    fn check(&self, world: &mut World<'_>, context: &Context) -> Result<(), String> {
        let duration = context.duration;
        let within = |time: f64| (0.0..=duration).contains(&time);
        require(self.time.is_nan() || within(self.time), "time is outside")?;
        require(within(self.safe_until), "safe_until is outside")?;
        require(!(self.lower > self.upper), "lower is above upper")?;
        require(self.tolerance > 0.0, "tolerance is not positive")?;
        let contact = matches!(
            self.outcome,
            RccdOutcome::Contact | RccdOutcome::Touching | RccdOutcome::Interval
        );
        if contact {
            require(within(self.time), "a contact has no time")?;
            require(
                self.safe_until <= self.time,
                "a contact is safe beyond its time",
            )?;
            // An interval that begins with one body inside the other has no first contact.
            if self.outcome != RccdOutcome::Interval || self.time > 0.0 {
                check_direction(self.normal)?;
                require(
                    finite(self.witness_a) && finite(self.witness_b),
                    "no witness",
                )?;
            }
            let margin = world.settings.get(&context.owner).map(|own| own.margin);
            let distance = context.clearance.or(margin).unwrap_or(0.0);
            let bound = distance + self.tolerance;
            // `upper` also bounds the distance at a contact, but not that of an interval.
            let is_interval = self.outcome == RccdOutcome::Interval;
            let distance = if is_interval { self.lower } else { self.upper };
            require(
                distance <= bound * (1.0 + 1e-9),
                "a contact is beyond its distance",
            )?;
        }
        if self.outcome == RccdOutcome::Interval {
            require(
                self.time <= self.last_time && within(self.last_time),
                "last_time is outside",
            )?;
        }
        require(
            self.outcome != RccdOutcome::Free || self.safe_until == duration,
            "a free answer is not safe",
        )?;
        check_features([self.feature_a, self.feature_b])
    }
}

impl Answer for RccdPathAnswer {
    fn check(&self, world: &mut World<'_>, context: &Context) -> Result<(), String> {
        let is_point = (0.0..=1.0).contains(&self.fraction);
        let segments = context.segments.saturating_sub(1).max(1);
        require(is_point || self.fraction.is_nan(), "fraction is outside")?;
        require(
            context.segments == 0 || self.segment < segments,
            "segment is outside",
        )?;
        require(!(self.lower > self.upper), "lower is above upper")?;
        match self.outcome {
            RccdOutcome::Contact => {
                // A deadline may leave no time to find witness points.
                let settings = world.settings.get(&context.owner);
                let has_deadline = settings.is_some_and(|own| own.deadline.is_finite());
                let witnesses = finite(self.witness_a) && finite(self.witness_b);
                require(
                    is_point && (witnesses || has_deadline),
                    "a contact is nowhere",
                )?;
            }
            RccdOutcome::Free => require(
                self.fraction == 1.0 && self.item_a.data.is_null(),
                "a free path ends",
            )?,
            RccdOutcome::LeastDistance | RccdOutcome::Unresolved => {}
            _ => return Err("no outcome of a path".to_owned()),
        }
        let named = [self.item_a, self.item_b].map(|item| !item.data.is_null());
        require(
            named == [true; 2] || self.outcome != RccdOutcome::Contact,
            "a contact has no names",
        )?;
        world.lend(context.owner, self.item_a)?;
        world.lend(context.owner, self.item_b)?;
        check_features([self.feature_a, self.feature_b])
    }
}

fn finite(point: [f64; 3]) -> bool {
    point.iter().all(|own| own.is_finite())
}

fn check_direction(normal: [f64; 3]) -> Result<(), String> {
    let length = normal.map(|own| own * own).iter().sum::<f64>().sqrt();
    require((length - 1.0).abs() < 1e-9, "a normal has no length of 1")
}

fn check_features(features: [RccdFeature; 2]) -> Result<(), String> {
    for feature in features {
        let is_none = feature.kind == RccdFeatureKind::None;
        require(
            !is_none || [feature.first, feature.second] == [0; 2],
            "no feature has numbers",
        )?;
    }
    Ok(())
}
