//! Finds extremal points by evaluating all points, eight at once.

use crate::math::order::greater;
use glam::DVec3;

/// The number of points whose heights are computed together, in two vector registers of 256 bits.
const LANES: usize = 8;

/// A search for extremal points that scans all points of a piece, in a layout for vector instructions. A scan is slow
/// for many points, fast for few.
#[derive(Clone, Debug)]
pub struct SupportScan {
    /// Blocks of the x, y and z of eight points each; the last point is repeated to fill the last block.
    blocks: Vec<[[f64; LANES]; 3]>,
    last_index: u32,
}

impl SupportScan {
    /// Creates the search for one or more points.
    pub fn new(points: &[DVec3]) -> Self {
        let last = points.len().saturating_sub(1);
        let point = |k: usize| points.get(k.min(last)).copied().unwrap_or_default();
        let block = |first: usize| {
            [0, 1, 2].map(|axis| std::array::from_fn(|lane| point(first + lane)[axis]))
        };
        SupportScan {
            blocks: (0..points.len()).step_by(LANES).map(block).collect(),
            last_index: last as u32,
        }
    }

    /// Returns the index of the point that is farthest along a direction; the first one if several are equally far.
    ///
    /// # Guarantee
    /// The guarantee of [`SupportMap::extremal_point`](crate::SupportMap::extremal_point).
    ///
    /// # Complexity
    /// Linear in the number of points.
    #[inline(always)]
    pub fn extremal_point(&self, direction: DVec3) -> u32 {
        let (mut highest, mut of) = ([f64::NEG_INFINITY; LANES], [0u64; LANES]);
        for ([x, y, z], block) in self.blocks.iter().zip(0u64..) {
            for lane in 0..LANES {
                let height =
                    x[lane] * direction.x + (y[lane] * direction.y + z[lane] * direction.z);
                let higher = height > highest[lane];
                highest[lane] = if higher { height } else { highest[lane] };
                of[lane] = if higher { block } else { of[lane] };
            }
        }
        let most = highest.into_iter().fold(f64::NEG_INFINITY, greater);
        let index = |lane: usize| (of[lane] * LANES as u64) as u32 + lane as u32;
        let level = (0..LANES).filter(|&lane| highest[lane] == most);
        level.map(index).min().unwrap_or(0).min(self.last_index)
    }
}
