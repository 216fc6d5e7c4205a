//! Answers about paths: one struct for all questions.

use crate::answer::{RccdLimit, RccdOutcome};
use crate::arguments::check_output;
use crate::cell::RccdText;
use crate::feature::RccdFeature;
use crate::growing::{self, Growing};
use crate::status::Failure;
use rigid_ccd::Question;
use rigid_ccd::glam::DVec3;
use rigid_ccd_robot::evidence::RecordedAnswer;
use rigid_ccd_robot::{PathAnswer, PathContact, PathOutcome, PathPoint};

/// An answer about a path. Numbers that do not apply to the outcome are NaN, and such names are null.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct RccdPathAnswer {
    /// The size of this struct in the caller's header. Set it before the call.
    pub size: usize,
    /// The outcome: free, contact, least distance, or unresolved.
    pub outcome: RccdOutcome,
    /// The limit that ended the search.
    pub limit: RccdLimit,
    /// The index of the segment, from 0, with the contact or the least distance found. For a free path it is the last
    /// segment. An unresolved path is free up to `fraction` of this segment.
    pub segment: usize,
    /// The position within that segment, from 0 at its start to 1 at its end. Nothing touches before a first contact.
    pub fraction: f64,
    /// A lower bound of the distance at the contact, or of the least distance on the whole path.
    pub lower: f64,
    /// An upper bound of the same distance.
    pub upper: f64,
    /// The name of the first item of the pair: a link, attached body or obstacle that touches or is nearest. The solver owns
    /// the text.
    pub item_a: RccdText,
    /// The name of the second item of the pair.
    pub item_b: RccdText,
    /// The point of the first item that is nearest to the second, in the frame of the robot's base.
    pub witness_a: [f64; 3],
    /// The point of the second item that is nearest to the first, in the same frame.
    pub witness_b: [f64; 3],
    /// The feature of the first item that is in contact.
    pub feature_a: RccdFeature,
    /// The feature of the second item that is in contact.
    pub feature_b: RccdFeature,
    /// The tolerance of the answer. It is the tolerance of the settings, or larger if rounding of positions requires it.
    pub tolerance: f64,
}

// SAFETY: the struct is `repr(C)` and begins with its size. Only its last field was appended after the first version.
unsafe impl Growing for RccdPathAnswer {
    const FIRST_SIZE: usize = std::mem::offset_of!(RccdPathAnswer, tolerance);
}

impl RccdPathAnswer {
    const EMPTY: RccdPathAnswer = RccdPathAnswer {
        size: size_of::<RccdPathAnswer>(),
        outcome: RccdOutcome::Free,
        limit: RccdLimit::None,
        segment: 0,
        fraction: f64::NAN,
        lower: f64::NAN,
        upper: f64::NAN,
        item_a: RccdText::NONE,
        item_b: RccdText::NONE,
        witness_a: [f64::NAN; 3],
        witness_b: [f64::NAN; 3],
        feature_a: RccdFeature::NONE,
        feature_b: RccdFeature::NONE,
        tolerance: f64::NAN,
    };

    /// Converts an answer from Rust. `question` is the question that it answers.
    pub(crate) fn new(question: Question, answer: &PathAnswer<'_>) -> Self {
        let outcome = &answer.outcome;
        let converted = RccdPathAnswer {
            outcome: RccdOutcome::of_path(outcome),
            limit: outcome.limit().map_or(RccdLimit::None, RccdLimit::from),
            tolerance: answer.tolerance,
            ..match outcome.nearest() {
                Some(nearest) => RccdPathAnswer::from_contact(&nearest),
                None => RccdPathAnswer::EMPTY,
            }
        };
        if question.is_for_a_distance() {
            return RccdPathAnswer {
                lower: outcome.lower(),
                upper: outcome.upper(),
                ..converted
            };
        }
        let PathPoint { segment, fraction } = answer.free_until;
        match outcome {
            PathOutcome::Contact(_) => converted,
            // A free path is free to the end of its last segment, even if it has one configuration only.
            PathOutcome::Free => RccdPathAnswer {
                segment,
                fraction: 1.0,
                ..converted
            },
            _ => RccdPathAnswer {
                segment,
                fraction,
                ..converted
            },
        }
    }

    fn from_contact(contact: &PathContact<'_>) -> Self {
        let [item_a, item_b] = contact.items.map(|item| RccdText::from(item.name()));
        let witnesses = contact.witnesses.unwrap_or([DVec3::NAN; 2]);
        let [witness_a, witness_b] = witnesses.map(|witness| witness.to_array());
        let [feature_a, feature_b] = contact
            .features
            .map(|feature| feature.map_or(RccdFeature::NONE, RccdFeature::from));
        let [lower, upper] = contact.distance_bounds;
        RccdPathAnswer {
            segment: contact.at.segment,
            fraction: contact.at.fraction,
            lower,
            upper,
            item_a,
            item_b,
            witness_a,
            witness_b,
            feature_a,
            feature_b,
            ..RccdPathAnswer::EMPTY
        }
    }

    /// Copies an answer, to write it to a file.
    ///
    /// # Safety
    /// `answer` is null or points to an answer of this library whose solver has not been freed.
    pub(crate) unsafe fn record(answer: *const RccdPathAnswer) -> Result<RecordedAnswer, Failure> {
        // SAFETY: the contract of this function. Outcome and limit are read as numbers, because the caller may have set any.
        // Only an answer about a distance has bounds without a contact.
        let (segment, fraction, lower, outcome, limit, [a, b]) = unsafe {
            check_output("answer", answer.cast_mut())?;
            growing::caller_size("answer", answer.cast_mut())?;
            (
                (*answer).segment,
                (*answer).fraction,
                (*answer).lower,
                (&raw const (*answer).outcome).cast::<i32>().read(),
                (&raw const (*answer).limit).cast::<i32>().read(),
                [(*answer).item_a, (*answer).item_b],
            )
        };
        if outcome == RccdOutcome::Free as i32 {
            Ok(RecordedAnswer::Free)
        } else if outcome == RccdOutcome::Contact as i32 {
            // SAFETY: the contract of this function.
            let items = unsafe { [a.to_owned()?, b.to_owned()?] };
            Ok(RecordedAnswer::Contact {
                segment,
                fraction,
                items,
            })
        } else if outcome == RccdOutcome::Unresolved as i32 && lower.is_nan() {
            let limit = RccdLimit::name_of(limit);
            Ok(RecordedAnswer::Unresolved {
                limit,
                segment,
                fraction,
            })
        } else {
            let text = format!("the outcome {outcome} is not one of rccd_cell_first_contact");
            Err(Failure::argument(text))
        }
    }
}
