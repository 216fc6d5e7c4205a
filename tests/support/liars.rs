//! Oracles that break their contract, each in a way of its own. None of them may make an answer late.

use ccd_core::glam::DVec3;
use ccd_core::{Claim, ConvexCombination, DistanceOracle, GiveUpReason, PiecePair};

/// A way in which an oracle breaks its contract.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ContractBreach {
    /// Returns a random axis and random points of the pieces.
    RandomClaim,
    /// Returns an axis with a component that is NaN.
    NanAxis,
    /// Returns an axis of length zero, and no points.
    ZeroAxis,
    /// Returns an axis of infinite components.
    InfiniteAxis,
    /// Returns indices of points that the pieces do not have.
    OutOfRange,
    /// Returns an axis that points from B to A.
    ReversedAxis,
    /// Always reports that it gives up.
    GivesUp,
}

impl ContractBreach {
    /// Every way to break the contract.
    pub const ALL: [ContractBreach; 7] = [
        ContractBreach::RandomClaim,
        ContractBreach::NanAxis,
        ContractBreach::ZeroAxis,
        ContractBreach::InfiniteAxis,
        ContractBreach::OutOfRange,
        ContractBreach::ReversedAxis,
        ContractBreach::GivesUp,
    ];
}

/// An oracle that breaks its contract in one way, always with the same pseudo-random numbers.
#[derive(Clone, Debug)]
pub struct FaultyOracle {
    breach: ContractBreach,
    state: u64,
}

impl FaultyOracle {
    /// Creates an oracle that breaks its contract in a given way.
    pub fn new(lie: ContractBreach) -> Self {
        FaultyOracle {
            breach: lie,
            state: 1,
        }
    }

    /// Returns a pseudo-random number from −1 to 1, by a linear congruential generator `[Knuth TAOCP 3.3.4]`.
    fn number(&mut self) -> f64 {
        self.state = self
            .state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    fn vector(&mut self) -> DVec3 {
        DVec3::new(self.number(), self.number(), self.number())
    }

    fn index(&mut self, count: usize) -> u32 {
        ((0.5 + 0.5 * self.number()) * count as f64) as u32 % count.max(1) as u32
    }
}

impl DistanceOracle for FaultyOracle {
    type Cache = ();

    fn separation(&mut self, pair: &PiecePair<'_>, (): &mut ()) -> Result<Claim, GiveUpReason> {
        let (count_a, count_b) = (pair.a.points.len(), pair.b.points.len());
        let mut claim = Claim {
            axis: self.vector(),
            a: ConvexCombination::from_single_point(self.index(count_a)),
            b: ConvexCombination::from_single_point(self.index(count_b)),
        };
        match self.breach {
            ContractBreach::RandomClaim => {}
            ContractBreach::NanAxis => claim.axis.y = f64::NAN,
            ContractBreach::ZeroAxis => {
                (claim.axis, claim.a, claim.b) = (
                    DVec3::ZERO,
                    ConvexCombination::EMPTY,
                    ConvexCombination::EMPTY,
                );
            }
            ContractBreach::InfiniteAxis => claim.axis = DVec3::splat(f64::INFINITY),
            ContractBreach::OutOfRange => {
                claim.a = ConvexCombination::from_single_point(count_a as u32 + 7);
                claim.b = ConvexCombination::of_two_points([u32::MAX, 0], 0.5);
            }
            ContractBreach::ReversedAxis => {
                claim.axis = pair.a.points[0] - pair.b_to_a.transform_point(pair.b.points[0]);
            }
            ContractBreach::GivesUp => return Err(GiveUpReason::Cycle),
        }
        Ok(claim)
    }
}
