//! Eight consecutive intervals of a path.

use ccd_core::order::{greater, lesser};

/// The number of intervals that are tested at once.
pub(crate) const LANES: usize = 8;

/// Eight consecutive intervals of a path. Ends are measured in segments, as in [`PathInterval`](super::interval::PathInterval).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lanes {
    boundaries: [f64; LANES + 1],
}

impl Lanes {
    /// Divides an interval of a path. An interval of fewer than eight segments is divided into parts of segments, a
    /// longer one at configurations.
    pub(crate) fn dividing(from: f64, to: f64) -> Self {
        let first = from.floor();
        let count = (to.ceil() - first) as usize;
        let boundary = |k: usize| {
            if k == 0 || k == LANES {
                return if k == 0 { from } else { to };
            }
            if count <= 1 {
                return from + (to - from) * (k as f64 / LANES as f64);
            }
            if count >= LANES {
                let segments = (count * k) as f64 / LANES as f64;
                return (first + segments.round()).clamp(from, to);
            }
            // The intervals from `low` on, before `high`, divide this segment.
            let segment = k * count / LANES;
            let [low, high] = [segment, segment + 1].map(|s| (LANES * s).div_ceil(count));
            let start = greater(first + segment as f64, from);
            let end = lesser(first + (segment + 1) as f64, to);
            start + (end - start) * ((k - low) as f64 / (high - low) as f64)
        };
        Lanes {
            boundaries: std::array::from_fn(boundary),
        }
    }

    /// Returns where an interval begins; for [`LANES`], where the last one ends.
    pub(crate) fn boundary(&self, lane: usize) -> f64 {
        self.boundaries[lane]
    }

    /// Returns both ends of an interval.
    pub(crate) fn ends(&self, lane: usize) -> [f64; 2] {
        [self.boundaries[lane], self.boundaries[lane + 1]]
    }

    pub(crate) fn middle(&self, lane: usize) -> f64 {
        0.5 * (self.boundaries[lane] + self.boundaries[lane + 1])
    }

    /// Returns the segment that contains an interval; `None` if it has parts of several.
    pub(crate) fn segment(&self, lane: usize) -> Option<usize> {
        segment_of(self.ends(lane))
    }

    /// Returns the segment that contains all intervals; `None` if they are in several.
    pub(crate) fn only_segment(&self) -> Option<usize> {
        segment_of([self.boundaries[0], self.boundaries[LANES]])
    }
}

fn segment_of([from, to]: [f64; 2]) -> Option<usize> {
    let segment = from.floor();
    (to <= segment + 1.0).then_some(segment as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_of_segments_follow_each_other() {
        for (from, to, whole) in [
            (0.0, 1.0, false),
            (0.25, 0.5, false),
            (3.0, 5.0, false),
            (2.5, 5.25, false),
            (0.0, 7.0, false),
            (0.0, 8.0, true),
            (0.0, 49.0, true),
            (1.75, 30.5, true),
        ] {
            let lanes = Lanes::dividing(from, to);
            assert_eq!([lanes.boundary(0), lanes.boundary(LANES)], [from, to]);
            for lane in 0..LANES {
                let [start, end] = lanes.ends(lane);
                assert!(start < end, "{lanes:?}");
                assert!(whole || lanes.segment(lane) == Some(start as usize));
                let is_configuration = start.fract() == 0.0 || lane == 0;
                assert!(!whole || is_configuration, "{lanes:?}");
            }
            let is_one = to <= from.floor() + 1.0;
            assert_eq!(lanes.only_segment(), is_one.then_some(from as usize));
        }
    }
}
