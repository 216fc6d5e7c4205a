//! Converts hits to parry's types.

use super::convert::{time, vector};
use super::library::query::{ShapeCastHit, ShapeCastStatus};
use crate::scene::{CastHit, CastStatus};

/// Converts a hit to parry's type, with the time rounded down so that it is never late.
pub(super) fn hit(cast_hit: &CastHit) -> ShapeCastHit {
    let [witness1, witness2] = cast_hit.witnesses.map(vector);
    let [normal1, normal2] = cast_hit.normals.map(vector);
    let [subshape1, subshape2] = cast_hit.sub_shape_indices;
    ShapeCastHit {
        time_of_impact: time(cast_hit.time),
        witness1,
        witness2,
        normal1,
        normal2,
        status: match cast_hit.status {
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
