//! Halves intervals of time, and encloses the motion over each of them.

use super::relative::{MotionEnclosure, RelativeMotion, TimeSpan};

/// The maximum number of times that an interval is halved, since 2⁻⁵² of the duration is the resolution of numbers.
pub(super) const MAX_HALVING_DEPTH: usize = 52;

/// An interval of time that arises from repeated halving of the duration; its end may be cut short.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct HalvedInterval {
    pub(super) span: TimeSpan,
    /// The number of halvings that led to this interval.
    pub(super) halving_depth: usize,
}

/// Encloses the motion over intervals of time, with a cache of the last enclosure at each level of halving.
#[derive(Clone, Debug)]
pub(super) struct MotionEncloser {
    pub(super) relative_motion: RelativeMotion,
    pub(super) resolution: f64,
    max_halvings: u64,
    placement_cache: Vec<CachedEnclosure>,
    rate_cache: Vec<CachedEnclosure>,
    /// The number of halvings made so far.
    pub(super) halving_count: u64,
}

#[derive(Clone, Copy, Debug)]
struct CachedEnclosure {
    span: TimeSpan,
    motion_enclosure: MotionEnclosure,
}

impl HalvedInterval {
    /// Returns the interval from 0 to `end`.
    pub(super) fn whole_duration(end: f64) -> Self {
        HalvedInterval {
            span: TimeSpan { start: 0.0, end },
            halving_depth: 0,
        }
    }

    /// Returns the first and the second half of the interval.
    pub(super) fn halves(self) -> [HalvedInterval; 2] {
        let TimeSpan { start, end } = self.span;
        let middle = self.span.middle();
        [(start, middle), (middle, end)].map(|(start, end)| HalvedInterval {
            span: TimeSpan { start, end },
            halving_depth: self.halving_depth + 1,
        })
    }
}

impl MotionEncloser {
    /// Creates the encloser of a motion, with the interval width and the number of halvings at which halving ends.
    pub(super) fn new(relative: RelativeMotion, resolution: f64, most_halvings: u64) -> Self {
        let nothing = CachedEnclosure {
            span: TimeSpan {
                start: f64::NAN,
                end: f64::NAN,
            },
            motion_enclosure: relative.enclosure_over(TimeSpan {
                start: 0.0,
                end: 0.0,
            }),
        };
        MotionEncloser {
            relative_motion: relative,
            resolution,
            max_halvings: most_halvings,
            placement_cache: vec![nothing; MAX_HALVING_DEPTH + 1],
            rate_cache: vec![nothing; MAX_HALVING_DEPTH + 1],
            halving_count: 0,
        }
    }

    /// Returns true if an interval is no wider than the resolution, or was halved as often as is allowed.
    pub(super) fn is_too_short_to_halve(&self, interval: HalvedInterval) -> bool {
        !(interval.span.width() > self.resolution) || interval.halving_depth >= MAX_HALVING_DEPTH
    }

    /// Returns true if the limit on the number of halvings is reached.
    pub(super) fn is_at_halving_limit(&self) -> bool {
        self.halving_count >= self.max_halvings
    }

    /// Returns the enclosure of all placements of the first body in the second body's frame over an interval.
    pub(super) fn placement_enclosure(&mut self, interval: HalvedInterval) -> &MotionEnclosure {
        self.placement_cache[interval.halving_depth].enclosure_over(interval.span, |span| {
            self.relative_motion.enclosure_over(span)
        })
    }

    /// Returns the enclosure of the rates of change of the placements over an interval.
    pub(super) fn placement_rate_enclosure(
        &mut self,
        interval: HalvedInterval,
    ) -> &MotionEnclosure {
        self.rate_cache[interval.halving_depth].enclosure_over(interval.span, |span| {
            self.relative_motion.rate_enclosure_over(span)
        })
    }
}

impl CachedEnclosure {
    fn enclosure_over(
        &mut self,
        span: TimeSpan,
        enclosure: impl FnOnce(TimeSpan) -> MotionEnclosure,
    ) -> &MotionEnclosure {
        if self.span != span {
            self.span = span;
            self.motion_enclosure = enclosure(span);
        }
        &self.motion_enclosure
    }
}
