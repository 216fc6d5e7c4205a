//! Decides whether two bodies on trajectories touch at all.

use super::contacts::{WantedContact, search_contact};
use crate::answer::Answer;
use crate::distance::oracle::DistanceOracle;
use crate::engine::answer::EngineSchedule;
use crate::engine::scratch::Scratch;
use crate::error::InputError;
use crate::problem::Problem;
use crate::query::Query;
use crate::questions::depth_first::DepthFirst;

impl<O: DistanceOracle> DepthFirst<O> {
    /// Decides whether the bodies touch at all along their trajectories.
    pub(crate) fn any_contact_along(
        &mut self,
        query: &Query<'_>,
        oracle: &mut O,
    ) -> Result<Answer, InputError> {
        search_contact(
            &mut AnyContactStrategy(self),
            WantedContact::Any,
            query,
            oracle,
        )
    }
}

/// The schedule that answers with any contact of a stretch's motions instead of the first one.
struct AnyContactStrategy<'s, O: DistanceOracle>(&'s mut DepthFirst<O>);

impl<O: DistanceOracle> EngineSchedule<O> for AnyContactStrategy<'_, O> {
    fn handles_accelerations(&self) -> bool {
        true
    }

    fn answer_first_contact(&mut self, problem: &Problem<'_>, oracle: &mut O) -> Answer {
        self.0.any_contact_of(problem, oracle)
    }

    fn scratch(&mut self) -> &mut Scratch {
        &mut self.0.scratch
    }
}
