//! Searches for proofs about pairs of links by branch and bound.

use super::LinkContactClass;
use super::joint_box::JointBox;
use super::joints_between::JointsBetween;
use super::measuring::{BoxCheck, BoxClass, Contact, LinkPair, Measurer};
use super::search_end::SearchEnd;
use crate::cell::Cell;
use crate::tuning::MAX_BOXES_WITHOUT_DEPTH;
use ccd_core::order::{greater, lesser};
use rigid_ccd::Error;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// The progress of the search for one pair of links. All positions are positions of the joints between the links.
#[derive(Clone, Debug, Default)]
pub(super) struct LinkPairRecord {
    pub(super) links: [usize; 2],
    /// The class, once it is proven without witnesses: never, always, or always as enclosed.
    pub(super) proven_class: Option<LinkContactClass>,
    /// The first positions where the links touch.
    pub(super) touching: Option<Vec<f64>>,
    /// The first positions where the links are apart.
    pub(super) apart: Option<Vec<f64>>,
    /// The least distance so far, with its positions.
    pub(super) nearest: Option<(f64, Vec<f64>)>,
    /// The fraction of all positions, by volume, where the links are proven apart.
    pub(super) apart_fraction: f64,
    /// The fraction of all positions, by volume, where nothing is proven.
    pub(super) undecided_fraction: f64,
    /// The number of boxes that the last search examined.
    pub(super) boxes: usize,
    /// Whether random sampling for witnesses is finished.
    is_sampled: bool,
    /// Whether the links touch without overlapping at some positions. No box around these positions can be decided, so
    /// only a witness where the links are apart can decide the pair.
    pub(super) touches_without_depth: bool,
    /// Whether more boxes are unlikely to decide the pair: positions are unbounded, a box cannot be halved, or the
    /// links touch without overlapping at the center of all boxes.
    pub(super) is_exhausted: bool,
}

/// Searches for proofs about pairs of links. Reuses its memory from pair to pair.
pub(super) struct LinkPairSearch<'c> {
    pub(super) measurer: Measurer<'c>,
    pub(super) end: SearchEnd,
}

/// A box in the queue. The largest box comes first.
struct QueuedBox(JointBox);

impl LinkPairRecord {
    pub(super) fn new(links: [usize; 2]) -> Self {
        LinkPairRecord {
            links,
            undecided_fraction: 1.0,
            ..LinkPairRecord::default()
        }
    }

    /// Converts the record to the public class.
    pub(super) fn class(self, cell: &Cell) -> LinkContactClass {
        let configurations = |positions: [Option<Vec<f64>>; 2]| {
            let joints = JointsBetween::new(cell, self.links);
            positions.map(|positions| Some(joints.as_ref()?.configuration(&positions?)))
        };
        let least_distance = self.nearest.map_or(f64::INFINITY, |(least, _)| least);
        let [touching, apart] = configurations([self.touching, self.apart]);
        match (self.proven_class, touching, apart) {
            (Some(class), ..) => class,
            (None, Some(touching_configuration), Some(apart_configuration)) => {
                LinkContactClass::Sometimes {
                    touching_configuration,
                    apart_configuration,
                }
            }
            (None, touching, apart) => LinkContactClass::Undecided {
                proven_apart_fraction: self.apart_fraction,
                undecided_fraction: self.undecided_fraction,
                least_distance: if touching.is_some() {
                    0.0
                } else {
                    least_distance
                },
                touching_configuration: touching,
                apart_configuration: apart,
            },
        }
    }

    /// Returns the kind of witness that was found, if only one kind was.
    fn known(&self) -> Contact {
        match (&self.touching, &self.apart) {
            (Some(_), None) => Contact::Touching,
            (None, Some(_)) => Contact::Apart,
            _ => Contact::Unknown,
        }
    }

    /// Returns whether the pair is decided.
    pub(super) fn is_decided(&self) -> bool {
        self.proven_class.is_some() || (self.touching.is_some() && self.apart.is_some())
    }

    /// Returns the number of boxes that a search may examine: `limit`, but at most `average` for a pair that touches
    /// without overlapping.
    pub(super) fn quota(&self, limit: usize, average: usize) -> usize {
        if self.touches_without_depth {
            lesser(limit, average)
        } else {
            limit
        }
    }

    /// Records the first positions where the links touch, or where they are apart.
    pub(super) fn record_witness(&mut self, contact: Contact, positions: &[f64]) {
        let witness = match contact {
            Contact::Touching => &mut self.touching,
            Contact::Apart => &mut self.apart,
            Contact::Unknown => return,
        };
        witness.get_or_insert_with(|| positions.to_vec());
    }

    /// Records a distance if it is the least so far. Returns whether it is.
    pub(super) fn record_distance(&mut self, distance: f64, positions: &[f64]) -> bool {
        let known = self
            .nearest
            .as_ref()
            .map_or(f64::INFINITY, |&(least, _)| least);
        let is_least = distance < known;
        if is_least {
            self.nearest = Some((distance, positions.to_vec()));
        }
        is_least
    }
}

impl<'c> LinkPairSearch<'c> {
    pub(super) fn new(cell: &'c Cell, end: SearchEnd) -> Self {
        LinkPairSearch {
            measurer: Measurer::new(cell, end.stop.clone()),
            end,
        }
    }

    /// Searches for the class of a pair of links. The first call for a pair also searches for witnesses. Each call
    /// examines at most `max_boxes` boxes, and starts with the box of all positions.
    pub(super) fn search(
        &mut self,
        record: &mut LinkPairRecord,
        max_boxes: usize,
    ) -> Result<(), Error> {
        let cell = self.measurer.cell;
        let Some(pair) = LinkPair::new(cell, &self.measurer.placement, record.links) else {
            record.is_exhausted = true;
            return Ok(());
        };
        if !record.is_sampled {
            record.proven_class = self.prove_contact_on_hinge_axis(record.links, &pair)?;
            if record.proven_class.is_some() {
                return Ok(());
            }
            self.find_witnesses(&pair, record)?;
            record.is_sampled = !self.end.is_reached();
            // Links that do not move relative to each other touch always or never.
            if pair.joints.joints.is_empty() && record.touching.is_some() {
                self.examine_boxes(&pair, record, 1)?;
                let fallback = if pair.encloses_shapes(cell) {
                    LinkContactClass::AlwaysAsEnclosed
                } else {
                    LinkContactClass::Always
                };
                record.proven_class.get_or_insert(fallback);
            }
        }
        if !record.is_decided() {
            self.examine_boxes(&pair, record, max_boxes)?;
        }
        Ok(())
    }

    /// Tries to prove that the links never or always touch. Examines at most `max_boxes` boxes, and stops if both kinds
    /// of witnesses are found.
    fn examine_boxes(
        &mut self,
        pair: &LinkPair,
        record: &mut LinkPairRecord,
        max_boxes: usize,
    ) -> Result<(), Error> {
        let mut undecided_boxes = BinaryHeap::from([QueuedBox(pair.joints.all_positions.clone())]);
        let (mut apart_fraction, mut touching_fraction) = (0.0, 0.0);
        let mut class_if_touching = LinkContactClass::Always;
        let mut undecidable_count = 0;
        record.boxes = 0;
        while record.boxes < max_boxes && !self.end.is_reached() {
            if record.boxes == MAX_BOXES_WITHOUT_DEPTH && undecidable_count == record.boxes {
                record.is_exhausted = true;
                break;
            }
            let Some(QueuedBox(joint_box)) = undecided_boxes.pop() else {
                break;
            };
            record.boxes += 1;
            let check = self.measurer.check_box(pair, &joint_box, record.known())?;
            let center = joint_box.center();
            record.record_witness(check.at_center.contact, &center);
            let is_nearer = record.record_distance(check.at_center.distance, &center);
            if is_nearer && record.touching.is_none() {
                self.descend(pair, record, center.clone(), check.at_center.distance)?;
            }
            if record.is_decided() {
                return Ok(());
            }
            let may_be_undecidable =
                !record.touches_without_depth || undecidable_count + 1 == record.boxes;
            if may_be_undecidable && self.stays_undecided((pair, record), &check, &center)? {
                undecidable_count += 1;
                record.touches_without_depth = true;
            }
            match check.class {
                BoxClass::Apart => apart_fraction += joint_box.volume_fraction,
                BoxClass::ShapesTouching => touching_fraction += joint_box.volume_fraction,
                BoxClass::BodiesTouching => {
                    touching_fraction += joint_box.volume_fraction;
                    class_if_touching = LinkContactClass::AlwaysAsEnclosed;
                }
                BoxClass::Undecided => {
                    let index = check.main_position_index;
                    match index.and_then(|index| joint_box.halves(index)) {
                        Some(halves) => undecided_boxes.extend(halves.map(QueuedBox)),
                        // A box that cannot be halved stays undecided.
                        None => {
                            record.is_exhausted = true;
                            undecided_boxes.push(QueuedBox(joint_box));
                            break;
                        }
                    }
                }
            }
        }
        let undecided_fraction = greater(1.0 - apart_fraction - touching_fraction, 0.0);
        // A stopped search may prove less than an earlier one.
        if undecided_fraction <= record.undecided_fraction {
            (record.apart_fraction, record.undecided_fraction) =
                (apart_fraction, undecided_fraction);
        }
        if undecided_boxes.is_empty() {
            // The boxes are not of both kinds, because then witnesses of both kinds would have decided the pair.
            let is_apart = record.touching.is_none() && touching_fraction == 0.0;
            record.proven_class = Some(if is_apart {
                LinkContactClass::Never
            } else {
                class_if_touching
            });
        }
        Ok(())
    }

    /// Returns whether the links touch at this center without overlapping. If they do, no box around the center can be
    /// decided, however small it is.
    fn stays_undecided(
        &mut self,
        (pair, record): (&LinkPair, &LinkPairRecord),
        check: &BoxCheck,
        center: &[f64],
    ) -> Result<bool, Error> {
        if check.class != BoxClass::Undecided || check.at_center.contact == Contact::Apart {
            return Ok(false);
        }
        let point = JointBox::from_point(center);
        let check = self.measurer.check_box(pair, &point, record.known())?;
        Ok(check.class == BoxClass::Undecided)
    }
}

impl PartialEq for QueuedBox {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for QueuedBox {}

impl PartialOrd for QueuedBox {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for QueuedBox {
    fn cmp(&self, other: &Self) -> Ordering {
        self.0.volume_fraction.total_cmp(&other.0.volume_fraction)
    }
}
