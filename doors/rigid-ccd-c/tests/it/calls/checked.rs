//! A call, and the checks of its result.

use super::call::Call;
use super::places::{Context, require};
use super::table::{FUNCTIONS, Function, Returned};
use super::world::World;
use crate::support::{Handle, Random, default_settings, last_error};
use rigid_ccd_c::*;

/// Calls a function, and repeats the question if it was answered. Returns the result.
pub(super) fn call_and_check(
    function: &Function,
    world: &mut World<'_>,
    random: &Random,
) -> Result<Made, String> {
    let made = make(function, world, random, None)?;
    if let Some(answer) = &made.answer {
        let settings = world.settings.get(&made.owner).copied();
        let settings = settings.ok_or("a solver has no settings")?;
        // With a deadline the answer depends on the machine. A default budget would take too long to spend several
        // times.
        let is_short = settings.budget < default_settings().budget;
        if settings.deadline == f64::INFINITY && is_short {
            let again = make(function, world, random, None)?;
            require_same(&made, &again)?;
            if let Some(answer) = pair_answer(answer) {
                ask_others(function, world, random, (&made, answer, settings))?;
            }
        }
    }
    world.check_texts()?;
    Ok(made)
}

fn require_same(made: &Made, again: &Made) -> Result<(), String> {
    let shown = |made: &Made| {
        made.answer
            .as_ref()
            .map(|bytes| format!("{:?}", pair_answer(bytes)))
    };
    require(
        made.answer == again.answer,
        &format!("{:?} and {:?} to {}", shown(made), shown(again), made.text),
    )
}

/// Repeats the question with a new solver. Then asks for the least distance, which must agree with the first contact.
fn ask_others(
    function: &Function,
    world: &mut World<'_>,
    random: &Random,
    (made, answer, settings): (&Made, RccdAnswer, RccdSettings),
) -> Result<(), String> {
    if answer.limit == RccdLimit::Stopped {
        return Ok(());
    }
    let settings = RccdSettings {
        stop: std::ptr::null(),
        ..settings
    };
    let solver = crate::support::solver(Some(&settings));
    let again = make(function, world, random, Some(&solver))?;
    require_same(made, &again)?;
    let of_report = settings.start_policy == RccdStartPolicy::Report as u32;
    if function.name != "rccd_first_contact" || !of_report {
        return Ok(());
    }
    let closest = FUNCTIONS
        .iter()
        .find(|own| own.name == "rccd_closest_approach");
    let nearest = make(closest.unwrap(), world, random, Some(&solver))?.answer;
    let nearest = nearest.as_deref().and_then(pair_answer);
    // A contact at the start may be found before the rest of the motion is found to be out of range.
    let Some(nearest) = nearest else {
        return Ok(());
    };
    let agrees = match answer.outcome {
        RccdOutcome::Free => {
            nearest.upper >= settings.margin && nearest.outcome != RccdOutcome::Overlapping
        }
        RccdOutcome::Contact | RccdOutcome::Touching => {
            nearest.lower <= settings.margin + answer.tolerance
        }
        _ => true,
    };
    require(
        agrees,
        &format!("{answer:?} and {nearest:?} disagree: {}", made.text),
    )
}

/// Reads an answer about two bodies; `None` for one about a path.
fn pair_answer(bytes: &[u8]) -> Option<RccdAnswer> {
    let is_pair = bytes.len() == size_of::<RccdAnswer>();
    // SAFETY: the bytes are those of an answer whose enums were checked.
    is_pair.then(|| unsafe { bytes.as_ptr().cast::<RccdAnswer>().read_unaligned() })
}

/// The result of a call.
pub(super) struct Made {
    pub(super) has_worked: bool,
    owner: usize,
    pub(super) text: String,
    /// The bytes of the answer, if it is one.
    answer: Option<Vec<u8>>,
}

/// Calls a function with the arguments that this generator draws.
fn make(
    function: &Function,
    world: &mut World<'_>,
    random: &Random,
    other_solver: Option<&Handle<RccdSolver>>,
) -> Result<Made, String> {
    let mut call = Call::new(world, random.clone(), function.name);
    call.other_solver = other_solver.map(Handle::pointer);
    let returned = (function.call)(&mut call);
    call.end();
    let context = Context {
        owner: call.owner,
        joint_count: call.joint_count,
        clearance: call.clearance,
        settings: call.settings,
        duration: call.duration,
        segments: call.segments,
    };
    let (places, text) = (
        std::mem::take(&mut call.places),
        std::mem::take(&mut call.text),
    );
    drop(call);
    let has_worked = matches!(
        returned,
        Returned::Nothing | Returned::Status(RccdStatus::Ok)
    );
    check_status(&returned).map_err(|why| format!("{why}: {text}"))?;
    for place in &places {
        place
            .check(has_worked, world, &context)
            .map_err(|why| format!("{why}; {text}"))?;
    }
    if let (true, true, Some(settings)) = (has_worked, places.is_empty(), context.settings) {
        world.settings.insert(context.owner, settings);
    }
    let answer = places.iter().find_map(|place| place.answer());
    let text = match world.settings.get(&context.owner) {
        Some(settings) if answer.is_some() => format!("{settings:?}: {text}"),
        _ => text,
    };
    Ok(Made {
        has_worked,
        owner: context.owner,
        text,
        answer: answer.filter(|_| has_worked).map(<[u8]>::to_vec),
    })
}

fn check_status(returned: &Returned) -> Result<(), String> {
    match returned {
        Returned::Nothing | Returned::Status(RccdStatus::Ok) => Ok(()),
        Returned::Status(RccdStatus::Panic) => Err(format!("panic {:?}", last_error())),
        Returned::Status(_) => require(!last_error().is_empty(), "a failure has no message"),
    }
}
