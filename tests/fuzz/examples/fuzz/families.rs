//! The families of random queries, one for each kind of difficulty, with parameters over many magnitudes.

mod budget;
mod far;
mod flat;
mod hulls;
mod leave;
mod margins;
mod needles;
mod scales;
mod shells;
mod turns;

use crate::case::{Case, Expectation, Shape};
use crate::draw::{RandomSource, add_arrays, scale_array};
use crate::raw_motion::{RawMotion, RawPose};
use ccd_core::Settings;
use clap::ValueEnum;

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Family {
    /// Needles and slivers, denormal components, faces without area.
    Needles,
    /// End poses and centers of rotation far from the origin, and tight tolerances.
    Far,
    /// Closed parts next to each other and nested, oriented outward or inward.
    Shells,
    /// Margins from a thousandth of the size of the bodies to a hundred times their size.
    Margins,
    /// Budgets too small for most queries.
    Budget,
    /// Bodies in contact at the start, under `StartPolicy::Leave`.
    Leave,
    /// Rotations of up to a thousand radians.
    Turns,
    /// Bodies of very different sizes.
    Scales,
    /// Faces that move flat onto each other.
    Flat,
    /// Convex pieces of 4 to 2,000 points each.
    Hulls,
}

impl Family {
    pub fn draw(self, draw: &mut RandomSource) -> Case {
        match self {
            Family::Needles => needles::draw(draw),
            Family::Far => far::draw(draw),
            Family::Shells => shells::draw(draw),
            Family::Margins => margins::draw(draw),
            Family::Budget => budget::draw(draw),
            Family::Leave => leave::draw(draw),
            Family::Turns => turns::draw(draw),
            Family::Scales => scales::draw(draw),
            Family::Flat => flat::draw(draw),
            Family::Hulls => hulls::draw(draw),
        }
    }
}

/// Returns a case of two moving shapes that pass each other, or meet, at about half the duration. Their centers come
/// within about the sum of their radii. Both rotate by up to `turn` over a duration of 1.
fn passing_case(draw: &mut RandomSource, shapes: [Shape; 2], turn: f64, config: Settings) -> Case {
    let reach = shapes[0].radius() + shapes[1].radius() + config.margin;
    let (way, aside) = (draw.direction(), draw.point());
    let travel = reach * draw.uniform(1.0..4.0);
    let miss = scale_array(aside, reach * draw.uniform(0.0..0.9));
    let common = scale_array(draw.point(), reach);
    let spin =
        |draw: &mut RandomSource| scale_array(draw.direction(), turn * draw.uniform(0.2..1.0));
    let half = scale_array(way, 0.5 * travel);
    let course = |draw: &mut RandomSource, side: f64, at: [f64; 3]| {
        let start = draw.pose(add_arrays(scale_array(half, -side), at));
        let moved = add_arrays(scale_array(half, 2.0 * side), common);
        RawMotion::from_velocities(start, moved, spin(draw))
    };
    let courses = [course(draw, 1.0, miss), course(draw, -1.0, [0.0; 3])];
    Case {
        shapes,
        motions: courses,
        duration: 1.0,
        config,
        expected: Expectation::Unknown,
    }
}

/// Returns the motion of a body at rest at the origin.
fn motion_at_rest() -> RawMotion {
    RawMotion::from_velocities(RawPose::at([0.0; 3]), [0.0; 3], [0.0; 3])
}

fn settings_with_random_tolerance(draw: &mut RandomSource) -> Settings {
    Settings {
        tolerance: draw.log_uniform(1e-9..1e-2),
        ..Settings::DEFAULT
    }
}
