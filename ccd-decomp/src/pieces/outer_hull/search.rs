//! Computes an upper bound on how far a hull extends beyond a solid, by branch and bound.

use super::enclosed_mesh::{EnclosedMesh, Location};
use super::facet_planes::FacetPlanes;
use super::under;
use crate::tolerance::{
    EXCESS_TOLERANCE_PER_HALF_DIAGONAL, EXCESS_WORK_BUDGET, MAX_EXCESS_BOXES, PLANE_TESTS_PER_STEP,
    SUFFICIENT_EXCESS_RATIO,
};
use crate::work::WorkBudget;
use ccd_core::Hull;
use ccd_core::glam::{BVec3, DVec3};
use ccd_core::order::{greater, lesser};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Returns an upper bound of the distance from the solid to any point of the hull.
///
/// The distance is 1-Lipschitz, so that its value at the center of a box bounds it in the box. For nearly flat surfaces
/// [`under`] gives a better bound. Boxes around the hull are split, largest bound first, until that bound is near a
/// distance that was found, the work is spent, or too many boxes wait.
pub(super) fn excess_bound(target: &EnclosedMesh<'_>, hull: &Hull) -> f64 {
    let floor = EXCESS_TOLERANCE_PER_HALF_DIAGONAL * target.half_diagonal;
    let mut search = Search {
        enclosed_mesh: target,
        hull: FacetPlanes::new(hull, target),
        steps_spent: 0,
        largest_found_distance: 0.0,
        waiting_boxes: BTreeMap::new(),
        examined_box_count: 0,
    };
    search.examine_bounding_box();
    while search.split_worst_boxes(floor) {}
    let open = search.waiting_boxes.last_key_value();
    let open = open.map_or(0.0, |(_, cell)| cell.bound);
    greater(open, search.largest_found_distance)
}

/// The maximum number of boxes that are split at the same time, in parallel.
const BOXES_PER_BATCH: usize = 16;

struct Search<'a> {
    enclosed_mesh: &'a EnclosedMesh<'a>,
    hull: FacetPlanes,
    /// The number of steps of the work budget that the search has spent.
    steps_spent: u64,
    /// The largest distance found so far from the solid to a point of the hull.
    largest_found_distance: f64,
    /// The boxes that may still be split, sorted by bound, then by the order in which they were examined. Bounds are
    /// positive: their bits are in the order of their values.
    waiting_boxes: BTreeMap<(u64, u64), BoundedBox>,
    examined_box_count: u64,
}

/// A box with an upper bound on the distance from the solid to the hull within the box.
#[derive(Clone, Debug)]
struct BoundedBox {
    bound: f64,
    bounds: [DVec3; 2],
    /// The facet planes of the hull that do not have the whole box behind them.
    planes: Vec<u32>,
}

/// The result of bounding a box: a distance at its center, and the box itself if it must be searched further.
#[derive(Default)]
struct BoxExamination {
    /// The distance from the solid to the box's center; 0 if the center is in the solid or outside the hull.
    center_distance_bound: f64,
    /// The box with its bound; `None` if no point of the hull in the box is farther from the solid than
    /// `largest_found_distance`.
    bounded_box: Option<BoundedBox>,
    steps_spent: u64,
}

impl Search<'_> {
    fn examine_bounding_box(&mut self) {
        let whole = BoundedBox {
            bound: f64::INFINITY,
            bounds: self.enclosed_mesh.bounds,
            planes: (0..self.hull.planes.len() as u32).collect(),
        };
        let examined = self.examine_box(&whole, whole.bounds);
        self.record(examined);
    }

    /// Splits each of the boxes with the largest bounds into octants, and bounds these. Returns false if the bounds are
    /// near the largest distance found, the work is spent, or too many boxes wait.
    fn split_worst_boxes(&mut self, floor: f64) -> bool {
        let target = greater(
            SUFFICIENT_EXCESS_RATIO * self.largest_found_distance,
            self.largest_found_distance + floor,
        );
        let worst: Vec<BoundedBox> = (0..BOXES_PER_BATCH)
            .map_while(|_| {
                let worst = self.waiting_boxes.last_entry()?;
                (worst.get().bound > target).then(|| worst.remove())
            })
            .collect();
        let octants: Vec<_> = worst
            .iter()
            .flat_map(|cell| octants(cell.bounds).map(|bounds| (cell, bounds)))
            .collect();
        let examine = |&(cell, bounds): &(&BoundedBox, _)| self.examine_box(cell, bounds);
        let examined: Vec<BoxExamination> = octants.par_iter().map(examine).collect();
        for examined in examined {
            self.record(examined);
        }
        !worst.is_empty()
            && self.steps_spent < EXCESS_WORK_BUDGET
            && self.waiting_boxes.len() < MAX_EXCESS_BOXES
    }

    fn record(&mut self, examined: BoxExamination) {
        self.steps_spent += examined.steps_spent;
        self.largest_found_distance =
            greater(self.largest_found_distance, examined.center_distance_bound);
        self.examined_box_count += 1;
        let key = |cell: &BoundedBox| (cell.bound.to_bits(), self.examined_box_count);
        self.waiting_boxes
            .extend(examined.bounded_box.map(|cell| (key(&cell), cell)));
    }

    /// Bounds the distance from the solid to the hull in the box `bounds`, a part of the examined box `within`.
    fn examine_box(&self, within: &BoundedBox, bounds: [DVec3; 2]) -> BoxExamination {
        let planes = &within.planes;
        let (target, hull, work) = (self.enclosed_mesh, &self.hull, &WorkBudget::unbounded());
        let [lo, hi] = bounds;
        let (center, half) = ((lo + hi) / 2.0, (hi - lo) / 2.0);
        let reach = half.length() + target.distance_rounding;
        work.spend(1 + planes.len() / PLANE_TESTS_PER_STEP);
        let mut examined = BoxExamination::default();
        if let Some(meeting) = hull.box_position(center, half, planes) {
            let near = match target.locate(center, work) {
                Location::Inside { least_depth: depth } => reach - depth,
                Location::Outside {
                    distance_bound: distance,
                } => {
                    if meeting.is_center_inside {
                        examined.center_distance_bound = distance;
                    }
                    distance + reach
                }
            };
            let planes = meeting.planes;
            let above = planes.iter().map(|&k| hull.planes[k as usize]);
            let under = || under::excess_bound_above_surface(target, above, [center, half], work);
            let is_known = |bound: f64| bound <= self.largest_found_distance;
            let mut bound = lesser(near, within.bound);
            if !is_known(bound) {
                bound = under().map_or(bound, |under| lesser(under, bound));
            }
            examined.bounded_box = (!is_known(bound)).then_some(BoundedBox {
                bound,
                bounds,
                planes,
            });
        }
        examined.steps_spent = work.steps_spent();
        examined
    }
}

/// Splits a box into eight at its center.
fn octants([lo, hi]: [DVec3; 2]) -> [[DVec3; 2]; 8] {
    let middle = (lo + hi) / 2.0;
    std::array::from_fn(|k| {
        let upper = BVec3::new(k & 1 != 0, k & 2 != 0, k & 4 != 0);
        [
            DVec3::select(upper, middle, lo),
            DVec3::select(upper, hi, middle),
        ]
    })
}
