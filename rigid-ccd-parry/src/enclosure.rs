//! Convex polytopes about cylinders and cones.

use crate::tolerance::{ABOUT, EXCESS, MOST_CORNERS};
use crate::{Excess, ShapeError};
use ccd_core::glam::DVec3;
use ccd_core::order::{greater, lesser};
use std::f64::consts::{PI, TAU};

/// A cylinder or a cone along y, about the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Round {
    pub(crate) kind: Kind,
    pub(crate) half_height: f64,
    pub(crate) radius: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Cylinder,
    /// The apex is above the base.
    Cone,
}

/// A convex polytope about a shape.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Enclosure {
    pub(crate) points: Vec<DVec3>,
    /// The corners of each facet, counterclockwise seen from outside. Each is a plane convex polygon, exactly.
    pub(crate) loops: Vec<Vec<u32>>,
    /// The largest distance of its points from the shape.
    pub(crate) excess: f64,
}

impl Enclosure {
    /// Returns a polytope about a cylinder or a cone.
    ///
    /// # Guarantee
    /// Its facets are its exact boundary: those that are no triangles have all corners at one height, or in pairs above
    /// each other, and the ring of corners is far from straight compared to rounding.
    pub(crate) fn of(round: &Round, excess: Excess) -> Result<Self, ShapeError> {
        match round.kind {
            Kind::Cylinder => Enclosure::of_cylinder(round.half_height, round.radius, excess),
            Kind::Cone => Enclosure::of_cone(round.half_height, round.radius, excess),
        }
    }

    /// Returns the facets as triangles, each with the number of its facet.
    pub(crate) fn triangles(&self) -> (Vec<[u32; 3]>, Vec<u32>) {
        let fans = (0..).zip(&self.loops).flat_map(|(number, corners)| {
            let fan = (1..corners.len().saturating_sub(1))
                .map(|k| [corners[0], corners[k], corners[k + 1]]);
            fan.map(move |triangle| (triangle, number))
        });
        fans.unzip()
    }

    /// Returns a prism about a cylinder along y.
    fn of_cylinder(half_height: f64, radius: f64, excess: Excess) -> Result<Self, ShapeError> {
        let (ring, excess) = ring(radius, excess)?;
        let at = |y: f64| ring.iter().map(move |[x, z]| DVec3::new(*x, y, *z));
        let count = ring.len() as u32;
        // Counterclockwise about y is from z to x: the ring goes the other way.
        let mut loops = vec![(0..count).collect(), (count..2 * count).rev().collect()];
        for k in 0..count {
            let next = (k + 1) % count;
            loops.push(vec![next, k, count + k, count + next]);
        }
        Ok(Enclosure {
            points: at(-half_height).chain(at(half_height)).collect(),
            loops,
            excess,
        })
    }

    /// Returns a pyramid about a cone along y, whose apex is above its base.
    fn of_cone(half_height: f64, radius: f64, excess: Excess) -> Result<Self, ShapeError> {
        let (ring, excess) = ring(radius, excess)?;
        let count = ring.len() as u32;
        let base = ring.iter().map(|[x, z]| DVec3::new(*x, -half_height, *z));
        let mut loops: Vec<Vec<u32>> = vec![(0..count).collect()];
        for k in 0..count {
            loops.push(vec![(k + 1) % count, k, count]);
        }
        Ok(Enclosure {
            points: base.chain([half_height * DVec3::Y]).collect(),
            loops,
            excess,
        })
    }
}

/// Returns the corners of a regular polygon about a circle, and the largest distance of its points from the disc.
///
/// The number of corners is a multiple of four, and the middles of edges are on the axes, where the polygon touches
/// the circle.
fn ring(radius: f64, excess: Excess) -> Result<(Vec<[f64; 2]>, f64), ShapeError> {
    let count = corners(radius, excess)?;
    let step = TAU / count;
    // Of the corners; the edges are `radius` from the middle.
    let reach = radius / (0.5 * step).cos() * ABOUT;
    let corner = |k: usize| {
        let (sine, cosine) = ((k as f64 + 0.5) * step).sin_cos();
        [reach * cosine, reach * sine]
    };
    let excess = greater(0.0, reach * ABOUT - radius);
    Ok(((0..count as usize).map(corner).collect(), excess))
}

/// Returns the number of corners of a polygon that exceeds a circle by no more than is allowed.
fn corners(radius: f64, excess: Excess) -> Result<f64, ShapeError> {
    let asked = match excess {
        Excess::Fine => EXCESS * radius,
        Excess::Length(length) => length,
        Excess::Refuse => return Err(ShapeError::Round),
    };
    if !(asked >= 0.0) {
        return Err(ShapeError::Size {
            what: "excess",
            value: asked,
        });
    }
    if radius == 0.0 {
        return Ok(4.0);
    }
    // A corner is at `radius / cos(π/n)`. The share of the excess is clamped where angles lose no digits; what the
    // rounding of the corners adds is taken off.
    let share = lesser(asked / radius - 4.0 * (ABOUT - 1.0), 1.0);
    let half_angle = (share * (2.0 + share)).sqrt().atan();
    let count = 4.0 * greater(1.0, (PI / half_angle / 4.0).ceil());
    if share > 0.0 && count <= MOST_CORNERS {
        return Ok(count);
    }
    let least = radius * (1.0 / (PI / MOST_CORNERS).cos() - 1.0);
    Err(ShapeError::Excess {
        asked,
        least: 1.01 * least,
    })
}

#[cfg(test)]
mod tests;
