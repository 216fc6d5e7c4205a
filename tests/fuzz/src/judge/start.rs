//! Determines the state of the bodies at the start: their distance, and whether one is inside the other.

use crate::double::DoubleDouble;
use crate::referee::Scene;
use crate::solid::{PointLocation, Solid, distance_to_surface, points_beside_triangles};
use crate::vector::Vector;
use ccd_core::Solidity;

/// The distance of the bodies at the start, and whether they overlap, as far as the referee can tell.
pub(super) struct StartState {
    pub(super) distance: f64,
    /// Whether the bodies certainly overlap: triangles penetrate by more than rounding, or one body is inside the
    /// other.
    pub(super) certainly_overlaps: bool,
    /// Whether an answer may report one body inside the other.
    pub(super) may_contain: bool,
}

impl StartState {
    pub(super) fn new(
        scene: &Scene,
        placed: &[Solid; 2],
        volumes: [Solidity; 2],
        rounding: f64,
    ) -> Self {
        let distance = scene.distance(0.0);
        // At a smaller distance, inside and outside depend on rounding.
        let touching = distance <= rounding;
        let deep = touching && scene.penetration_depth(0.0) > rounding;
        let inside = if touching {
            containment_of_touching_surfaces(placed, volumes, rounding)
        } else {
            containment_of_separate_surfaces(placed, volumes)
        };
        StartState {
            distance,
            certainly_overlaps: deep || inside == PointLocation::Inside,
            may_contain: touching || inside != PointLocation::Outside,
        }
    }
}

/// Returns whether a part of one body is inside the other body, given that the surfaces are apart.
fn containment_of_separate_surfaces(placed: &[Solid; 2], volumes: [Solidity; 2]) -> PointLocation {
    let mut doubtful = PointLocation::Outside;
    for outer in [0, 1]
        .into_iter()
        .filter(|&k| volumes[k] == Solidity::Solid)
    {
        for corner in placed[1 - outer].corner_per_part() {
            match placed[outer].locate(corner) {
                PointLocation::Inside => return PointLocation::Inside,
                PointLocation::Outside => {}
                PointLocation::InSeveralParts | PointLocation::Unknown => {
                    doubtful = PointLocation::InSeveralParts;
                }
            }
        }
    }
    doubtful
}

/// Returns `Inside` for bodies that touch if a point is found well inside one body, and on or inside the other body.
fn containment_of_touching_surfaces(
    placed: &[Solid; 2],
    volumes: [Solidity; 2],
    far: f64,
) -> PointLocation {
    let well_inside = |p: Vector<DoubleDouble>, solid: &Solid| {
        solid.locate(p) == PointLocation::Inside && distance_to_surface(p, &solid.triangles) > far
    };
    for outer in [0, 1]
        .into_iter()
        .filter(|&k| volumes[k] == Solidity::Solid)
    {
        let inner = &placed[1 - outer];
        let mut points: Vec<_> = inner.triangles.iter().map(|t| t[0]).collect();
        if volumes[1 - outer] == Solidity::Solid {
            let near = points_beside_triangles(&inner.triangles).into_iter();
            points.extend(near.filter(|&p| well_inside(p, inner)));
        }
        if points.into_iter().any(|p| well_inside(p, &placed[outer])) {
            return PointLocation::Inside;
        }
    }
    PointLocation::Outside
}
