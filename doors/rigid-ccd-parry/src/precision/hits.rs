//! Converts hits to parry's types.

use super::convert::{time, vector};
use super::library::query::{ShapeCastHit, ShapeCastStatus};
use crate::scene::{CastHit, CastStatus};

/// Converts a hit to parry's type, with the time rounded down so that it is never late.
pub(super) fn hit(found: &CastHit) -> ShapeCastHit {
    let [witness1, witness2] = found.witnesses.map(vector);
    let [normal1, normal2] = found.normals.map(vector);
    let [subshape1, subshape2] = found.sub_shape_indices;
    ShapeCastHit {
        time_of_impact: time(found.time),
        witness1,
        witness2,
        normal1,
        normal2,
        status: match found.status {
            CastStatus::Contact => ShapeCastStatus::Converged,
            CastStatus::Overlap | CastStatus::Inside | CastStatus::WithinTargetAtStart => {
                ShapeCastStatus::PenetratingOrWithinTargetDist
            }
            CastStatus::Limit => ShapeCastStatus::OutOfIterations,
        },
        subshape1,
        subshape2,
    }
}
