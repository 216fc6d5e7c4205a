//! Measures pairs of links at single configurations and over boxes of joint positions.

use super::box_motion::{BoxMotion, Displacement};
use super::joint_box::JointBox;
use super::joints_between::JointsBetween;
use crate::cell::Cell;
use crate::cell::part::HullPart;
use crate::solver::measure::{initial_direction, minkowski_support_vertex};
use crate::solver::part_pairs::PartPair;
use crate::solver::placement::Placement;
use crate::solver::violation::are_convex_parts_nearer;
use ccd_core::order::{greater, lesser};
use ccd_distance_gjk::{TerminationBounds, bound_distance};
use rigid_ccd::glam::DVec3;
use rigid_ccd::oracle::Frame;
use rigid_ccd::{Body, Error, Outcome, Pose, Settings, Solver};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Two links, the joints between them, and the pairs of their parts.
pub(super) struct LinkPair {
    pub(super) joints: JointsBetween,
    part_pairs: Vec<PairOfParts>,
}

/// A pair of parts, one of each link.
struct PairOfParts {
    /// The indices of the parts, in the order of the links.
    parts: [usize; 2],
    /// The same parts; a static part comes second.
    pair: PartPair,
}

/// Measures pairs of links, one after another.
pub(super) struct Measurer<'c> {
    pub(super) cell: &'c Cell,
    pub(super) placement: Placement,
    motion: BoxMotion,
    solver: Solver,
}

/// Whether two links touch at a configuration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Contact {
    Touching,
    Apart,
    /// Undecided because of rounding.
    Unknown,
}

/// The state of two links at a configuration.
#[derive(Clone, Copy, Debug)]
pub(super) struct ConfigurationCheck {
    pub(super) contact: Contact,
    /// An approximate distance. If it is not below a limit, this is the limit.
    pub(super) distance: f64,
}

/// The result of checking a box.
#[derive(Clone, Copy, Debug)]
pub(super) struct BoxCheck {
    pub(super) class: BoxClass,
    pub(super) at_center: ConfigurationCheck,
    /// The index, in the box, of the position that contributes most to the displacement of the links.
    pub(super) main_position_index: Option<usize>,
}

/// Whether two links touch everywhere in a box.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum BoxClass {
    Apart,
    /// The shapes inside the bodies touch.
    ShapesTouching,
    /// The bodies touch. Their shapes may not.
    BodiesTouching,
    Undecided,
}

/// Two parts at the center of a box.
struct PlacedParts<'a> {
    parts: [&'a HullPart; 2],
    frames: [Frame; 2],
    centers: [DVec3; 2],
}

/// The inputs of a proof about two parts over a box.
struct PartQuery<'a> {
    part_pair: &'a PairOfParts,
    displacement: Displacement,
    /// The error bound of a point.
    rounding: f64,
    /// The kind of witness that other configurations have provided.
    known: Contact,
}

/// What is proven about two parts over a box.
enum BoxProof {
    Apart,
    ShapesTouching,
    BodiesTouching,
    /// Nothing is proven. The number is the required distance minus the distance at the center.
    Undecided(f64),
}

impl LinkPair {
    /// Finds the joints and the pairs of parts of two links. Returns `None` if the joint positions cannot be bounded, see
    /// [`JointsBetween::new`].
    pub(super) fn new(cell: &Cell, placement: &Placement, links: [usize; 2]) -> Option<Self> {
        let parts_of = |link: usize| {
            (0..cell.robot_part_count())
                .filter(move |&part| cell.link_of(cell.parts()[part].owner) == link)
        };
        let displacements = &placement.displacement_bounds;
        let part_pairs = parts_of(links[0]).flat_map(|a| {
            parts_of(links[1]).map(move |b| PairOfParts {
                parts: [a, b],
                pair: PartPair::of_robot(cell, displacements, [a, b]),
            })
        });
        Some(LinkPair {
            joints: JointsBetween::new(cell, links)?,
            part_pairs: part_pairs.collect(),
        })
    }

    /// Returns whether any body of the links exceeds the shape that it encloses.
    pub(super) fn encloses_shapes(&self, cell: &Cell) -> bool {
        let parts = self.part_pairs.iter().flat_map(|pair| pair.parts);
        let mut excess = parts.map(|part| cell.parts()[part].excess_over_shape);
        excess.any(|excess| excess > 0.0)
    }
}

impl<'c> Measurer<'c> {
    pub(super) fn new(cell: &'c Cell, stop: Option<Arc<AtomicBool>>) -> Self {
        Measurer {
            cell,
            placement: Placement::new(cell),
            motion: BoxMotion::default(),
            solver: Solver::new().with_settings(Settings {
                stop,
                ..Settings::DEFAULT
            }),
        }
    }

    /// Checks two links at given joint positions. The distance matters only if it is below `limit`.
    pub(super) fn check(
        &mut self,
        pair: &LinkPair,
        positions: &[f64],
        limit: f64,
    ) -> Result<ConfigurationCheck, Error> {
        let rounding = pair.joints.rounding.of_points;
        self.place(&pair.joints, positions);
        let mut check = ConfigurationCheck {
            contact: Contact::Apart,
            distance: limit,
        };
        for part_pair in &pair.part_pairs {
            let placed = self.placed_parts(part_pair);
            let gap = placed.ball_gap();
            if gap > 2.0 * rounding && gap >= check.distance {
                continue;
            }
            let [lower, upper] = placed.hull_distance([check.distance, -rounding]).0;
            let is_convex = part_pair.pair.is_convex(self.cell.parts());
            if lower > 2.0 * rounding && (is_convex || lower >= check.distance) {
                check.distance = lesser(check.distance, upper);
                continue;
            }
            self.check_bodies(part_pair, rounding, &mut check)?;
            if check.contact == Contact::Touching {
                break;
            }
        }
        Ok(check)
    }

    /// Checks two links over a box. `known` is the kind of witness that other positions have provided. The center need
    /// not provide a witness of this kind.
    pub(super) fn check_box(
        &mut self,
        pair: &LinkPair,
        joint_box: &JointBox,
        known: Contact,
    ) -> Result<BoxCheck, Error> {
        let rounding = pair.joints.rounding;
        self.place_box(&pair.joints, joint_box);
        let mut check = BoxCheck {
            class: BoxClass::Apart,
            at_center: ConfigurationCheck {
                contact: Contact::Apart,
                distance: f64::INFINITY,
            },
            main_position_index: None,
        };
        let mut largest_deficit = f64::NEG_INFINITY;
        for part_pair in &pair.part_pairs {
            let placed = self.placed_parts(part_pair);
            let displacement = self.motion.displacement(placed.parts, placed.centers);
            if placed.ball_gap() > displacement.bound + 2.0 * rounding.of_points {
                continue;
            }
            let query = PartQuery {
                part_pair,
                displacement,
                rounding: rounding.of_points,
                known,
            };
            match self.prove(&placed, &query, &mut check.at_center)? {
                BoxProof::Apart => {}
                BoxProof::ShapesTouching => {
                    check.class = BoxClass::ShapesTouching;
                    return Ok(check);
                }
                BoxProof::BodiesTouching => {
                    check.class = BoxClass::BodiesTouching;
                    return Ok(check);
                }
                BoxProof::Undecided(deficit) => {
                    check.class = BoxClass::Undecided;
                    // Written so that an unknown (NaN) distance comes first.
                    if !(deficit <= largest_deficit) {
                        largest_deficit = deficit;
                        let joint = self.motion.main_joint(displacement);
                        check.main_position_index =
                            joint.map(|joint| pair.joints.joints[joint].box_index);
                    }
                }
            }
        }
        Ok(check)
    }

    /// Tries to prove something about two parts over the box.
    fn prove(
        &mut self,
        placed: &PlacedParts<'_>,
        query: &PartQuery<'_>,
        at_center: &mut ConfigurationCheck,
    ) -> Result<BoxProof, Error> {
        let rounding = query.rounding;
        let required = query.displacement.bound + 2.0 * rounding;
        let ([gap, upper], axis) = placed.hull_distance([required, -rounding]);
        if gap > required {
            return Ok(BoxProof::Apart);
        }
        let is_convex = query.part_pair.pair.is_convex(self.cell.parts());
        let are_hulls_apart = gap > 2.0 * rounding;
        if are_hulls_apart {
            at_center.distance = lesser(at_center.distance, upper);
            let frames = [&placed.frames[0], &placed.frames[1]];
            let direction = axis / axis.length();
            let lower = self
                .motion
                .gap_lower_bound(direction, placed.parts, frames, gap);
            if lower > 0.0 {
                return Ok(BoxProof::Apart);
            }
        }
        let undecided = BoxProof::Undecided(required - gap);
        if is_convex && are_hulls_apart {
            return Ok(undecided);
        }
        // A body may lie deep inside its hull, but the depth is at most its size.
        let [size_a, size_b] = placed.parts.map(|part| 2.0 * part.ball_radius);
        let may_be_free = !is_convex && required < greater(gap, 0.0) + lesser(size_a, size_b);
        let mut touching = query.known == Contact::Touching;
        if may_be_free || !(are_hulls_apart || is_convex && touching) {
            let lower = self.check_bodies(query.part_pair, rounding, at_center)?;
            // Written so that NaN is not free.
            if lower > query.displacement.bound + 4.0 * rounding {
                return Ok(BoxProof::Apart);
            }
            touching |= at_center.contact == Contact::Touching;
        } else if at_center.contact == Contact::Apart && !are_hulls_apart {
            at_center.contact = Contact::Unknown;
        }
        let depth = query.displacement.bound + 4.0 * rounding;
        if !(is_convex && touching && query.known != Contact::Apart) {
            return Ok(undecided);
        }
        let excess: f64 = placed.parts.iter().map(|part| part.excess_over_shape).sum();
        let are_shapes_nearer = |distance| {
            are_convex_parts_nearer(self.cell, &self.placement, &query.part_pair.pair, distance)
        };
        Ok(if are_shapes_nearer(-depth) {
            BoxProof::ShapesTouching
        } else if excess > 0.0 && are_shapes_nearer(excess - depth) {
            BoxProof::BodiesTouching
        } else {
            undecided
        })
    }

    /// Measures the distance of the bodies of two parts. Returns its lower bound.
    fn check_bodies(
        &mut self,
        part_pair: &PairOfParts,
        rounding: f64,
        check: &mut ConfigurationCheck,
    ) -> Result<f64, Error> {
        let [a, b] = part_pair.pair.body_indices(self.cell.parts());
        let a = self.placement.body(self.cell, a)?;
        let b = self.placement.body(self.cell, b)?;
        let outcome = self.solver.distance(a, b)?.outcome;
        if bodies_touch(&outcome, [a.0, b.0]) {
            *check = ConfigurationCheck {
                contact: Contact::Touching,
                distance: 0.0,
            };
        } else {
            // The engine measures the original bodies. Converting frames to poses doubles the rounding error.
            if !(outcome.lower() > 4.0 * rounding) && check.contact == Contact::Apart {
                check.contact = Contact::Unknown;
            }
            check.distance = lesser(check.distance, outcome.upper());
        }
        Ok(outcome.lower())
    }

    /// Computes the frames between two links for given joint positions.
    pub(super) fn place(&mut self, joints: &JointsBetween, positions: &[f64]) {
        let configuration = joints.configuration(positions);
        let chain = (joints.common_frame, &*joints.parents_first);
        self.placement
            .place_joints(self.cell, chain, &configuration);
    }

    /// Computes the frames at the center of a box, and sets the largest deviations of the joints from there.
    fn place_box(&mut self, joints: &JointsBetween, joint_box: &JointBox) {
        self.place(joints, &joint_box.center());
        let deviations = joints.joints.iter().map(|joint| {
            let deviation = joint.abs_multiplier * joint_box.max_deviation(joint.box_index);
            (joint.moving_index, deviation)
        });
        let frames = &self.placement.frames;
        self.motion
            .set_joint_axes(self.cell.kinematics(), frames, joints.rounding, deviations);
    }

    /// Returns two upper bounds of the distance from a point to a link: to its bodies, and to the shapes that the bodies
    /// enclose.
    pub(super) fn distances_to_link(
        &mut self,
        link: usize,
        point: (&Body, Pose),
    ) -> Result<[f64; 2], Error> {
        let mut least = [f64::INFINITY; 2];
        for index in 0..self.cell.robot_body_count() {
            if self.cell.link_of(index) == link {
                let body = self.placement.body(self.cell, index)?;
                let outcome = self.solver.distance(body, point)?.outcome;
                let to_body = if bodies_touch(&outcome, [body.0, point.0]) {
                    0.0
                } else {
                    outcome.upper() - body.0.excess()
                };
                least = [lesser(least[0], to_body), lesser(least[1], outcome.upper())];
            }
        }
        Ok(least)
    }

    fn placed_parts(&self, part_pair: &PairOfParts) -> PlacedParts<'c> {
        let parts = part_pair.parts.map(|part| &self.cell.parts()[part]);
        let frames = parts.map(|part| self.placement.frames[part.frame]);
        let centers = [
            frames[0].transform_point(parts[0].center),
            frames[1].transform_point(parts[1].center),
        ];
        PlacedParts {
            parts,
            frames,
            centers,
        }
    }
}

impl PlacedParts<'_> {
    /// Returns a lower bound of the distance of both parts, from their bounding balls.
    fn ball_gap(&self) -> f64 {
        let [a, b] = self.parts.map(|part| part.ball_radius);
        self.centers[0].distance(self.centers[1]) - a - b
    }

    /// Returns lower and upper bounds of the distance of both hulls, and the axis of the lower bound. The computation
    /// stops once the lower bound exceeds `sufficient_lower` or the upper bound is at most `sufficient_upper`.
    fn hull_distance(&self, [sufficient_lower, sufficient_upper]: [f64; 2]) -> ([f64; 2], DVec3) {
        let radii: f64 = self.parts.iter().map(|part| part.radius).sum();
        let until = TerminationBounds {
            sufficient_lower_bound: sufficient_lower + radii,
            sufficient_upper_bound: sufficient_upper + radii,
        };
        let initial_axis = initial_direction(self.parts[1], self.centers);
        let vertex = |direction| minkowski_support_vertex(self.parts, &self.frames, direction);
        let bounds = bound_distance(vertex, initial_axis, |bounds| until.are_met_by(bounds));
        ([bounds.lower - radii, bounds.upper - radii], bounds.axis)
    }
}

/// Returns whether two bodies touch, up to rounding. The upper bound of the outcome is about the shapes inside the
/// bodies, so it includes the excess of both bodies.
fn bodies_touch(outcome: &Outcome, bodies: [&Body; 2]) -> bool {
    let excess: f64 = bodies.iter().map(|body| body.excess()).sum();
    outcome.upper() <= excess * (1.0 + 4.0 * f64::EPSILON)
}

#[cfg(test)]
mod tests;
