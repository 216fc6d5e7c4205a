//! The search for proofs about pairs of links, one after another.

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

/// What is known of a pair of links so far. Positions are those of the joints between them.
#[derive(Clone, Debug)]
pub(super) struct LinkPairRecord {
    pub(super) links: [usize; 2],
    pub(super) verdict: Option<Verdict>,
    pub(super) touching: Option<Vec<f64>>,
    pub(super) apart: Option<Vec<f64>>,
    /// The least distance that was found, with its positions.
    pub(super) nearest: Option<(f64, Vec<f64>)>,
    /// The shares of the volume of all positions for which the links are proven apart, and for which nothing is proven.
    pub(super) apart_share: f64,
    pub(super) undecided_share: f64,
    /// The number of boxes that were examined in the last search.
    pub(super) boxes: usize,
    /// Whether witnesses were sought.
    is_sampled: bool,
    /// Whether the links touch without depth at some positions: no box around them can be decided, and only positions at which the
    /// links are apart decide about the pair.
    pub(super) touches_without_depth: bool,
    /// Whether more boxes hardly decide: positions have no bounds, a box that is a point stays open, or the links touch without
    /// depth in the middle of all boxes.
    pub(super) is_exhausted: bool,
}

/// What is proven of a pair of links.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Verdict {
    Never,
    Always,
    /// The bodies always touch; that the shapes do that they enclose is not proven.
    AlwaysAsEnclosed,
}

/// Memory for searches about pairs of links.
pub(super) struct LinkPairSearch<'c> {
    pub(super) measurer: Measurer<'c>,
    end: SearchEnd,
}

/// A box that waits to be examined; the largest comes first.
struct WaitingBox(JointBox);

impl LinkPairRecord {
    pub(super) fn new(links: [usize; 2]) -> Self {
        LinkPairRecord {
            links,
            verdict: None,
            touching: None,
            apart: None,
            nearest: None,
            apart_share: 0.0,
            undecided_share: 1.0,
            boxes: 0,
            is_sampled: false,
            touches_without_depth: false,
            is_exhausted: false,
        }
    }

    /// Returns what is known of the links as an answer.
    pub(super) fn class(self, cell: &Cell) -> LinkContactClass {
        let configurations = |positions: [Option<Vec<f64>>; 2]| {
            let joints = JointsBetween::new(cell, self.links);
            positions.map(|positions| Some(joints.as_ref()?.configuration(&positions?)))
        };
        let least_distance = self.nearest.map_or(f64::INFINITY, |(least, _)| least);
        let [touching, apart] = configurations([self.touching, self.apart]);
        match (self.verdict, touching, apart) {
            (Some(Verdict::Never), ..) => LinkContactClass::Never,
            (Some(Verdict::Always), ..) => LinkContactClass::Always,
            (Some(Verdict::AlwaysAsEnclosed), ..) => LinkContactClass::AlwaysAsEnclosed,
            (None, Some(touching_configuration), Some(apart_configuration)) => {
                LinkContactClass::Sometimes {
                    touching_configuration,
                    apart_configuration,
                }
            }
            (None, touching, apart) => LinkContactClass::Undecided {
                proven_apart_share: self.apart_share,
                undecided_share: self.undecided_share,
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

    /// Returns what is known of whether the links touch, if there is a witness for one of both alone.
    fn known(&self) -> Contact {
        match (&self.touching, &self.apart) {
            (Some(_), None) => Contact::Touching,
            (None, Some(_)) => Contact::Apart,
            _ => Contact::Unknown,
        }
    }

    /// Returns whether the question about the links is answered.
    pub(super) fn is_decided(&self) -> bool {
        self.verdict.is_some() || (self.touching.is_some() && self.apart.is_some())
    }

    /// Returns the number of boxes that a search is to examine at most, if it may examine `limit`, and `own_share` is what a pair
    /// has in the mean.
    pub(super) fn quota(&self, limit: usize, own_share: usize) -> usize {
        if self.touches_without_depth {
            lesser(limit, own_share)
        } else {
            limit
        }
    }

    /// Keeps positions at which the links touch, or are apart.
    pub(super) fn record_witness(&mut self, contact: Contact, positions: &[f64]) {
        let witness = match contact {
            Contact::Touching => &mut self.touching,
            Contact::Apart => &mut self.apart,
            Contact::Unknown => return,
        };
        witness.get_or_insert_with(|| positions.to_vec());
    }

    /// Keeps a distance if it is the least so far, and returns whether it is.
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

    /// Goes on with the search about a pair of links: at first for witnesses, then through at most `max_boxes` boxes, from the
    /// box of all positions.
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
            record.verdict = self.prove_contact_on_hinge_axis(record.links, &pair)?;
            if record.verdict.is_some() {
                return Ok(());
            }
            self.find_witnesses(&pair, record)?;
            record.is_sampled = !self.is_over();
            // What touches once, and never moves, always touches.
            if pair.joints.joints.is_empty() && record.touching.is_some() {
                self.examine_boxes(&pair, record, 1)?;
                let fallback = if pair.encloses_shapes(cell) {
                    Verdict::AlwaysAsEnclosed
                } else {
                    Verdict::Always
                };
                record.verdict.get_or_insert(fallback);
            }
        }
        if !record.is_decided() {
            self.examine_boxes(&pair, record, max_boxes)?;
        }
        Ok(())
    }

    pub(super) fn is_over(&self) -> bool {
        self.end.is_reached()
    }

    /// Proves that the links never or always touch, if at most `max_boxes` boxes suffice, or finds witnesses for both.
    fn examine_boxes(
        &mut self,
        pair: &LinkPair,
        record: &mut LinkPairRecord,
        max_boxes: usize,
    ) -> Result<(), Error> {
        let mut waiting = BinaryHeap::from([WaitingBox(pair.joints.all_positions.clone())]);
        let (mut apart_share, mut touching_share) = (0.0, 0.0);
        let mut always = Verdict::Always;
        let mut without_depth = 0;
        record.boxes = 0;
        while record.boxes < max_boxes && !self.is_over() {
            if record.boxes == MAX_BOXES_WITHOUT_DEPTH && without_depth == record.boxes {
                record.is_exhausted = true;
                break;
            }
            let Some(WaitingBox(joint_box)) = waiting.pop() else {
                break;
            };
            record.boxes += 1;
            let check = self.measurer.check_box(pair, &joint_box, record.known())?;
            let middle = joint_box.middle();
            record.record_witness(check.in_middle.contact, &middle);
            let is_nearer = record.record_distance(check.in_middle.distance, &middle);
            if is_nearer && record.touching.is_none() {
                self.descend(pair, record, middle.clone(), check.in_middle.distance)?;
            }
            if record.is_decided() {
                return Ok(());
            }
            let is_asked = !record.touches_without_depth || without_depth + 1 == record.boxes;
            if is_asked && self.stays_undecided((pair, record), &check, &middle)? {
                without_depth += 1;
                record.touches_without_depth = true;
            }
            match check.class {
                BoxClass::Apart => apart_share += joint_box.volume_share,
                BoxClass::ShapesTouching => touching_share += joint_box.volume_share,
                BoxClass::BodiesTouching => {
                    touching_share += joint_box.volume_share;
                    always = Verdict::AlwaysAsEnclosed;
                }
                BoxClass::Undecided => {
                    let index = check.main_position_index;
                    match index.and_then(|index| joint_box.halves(index)) {
                        Some(halves) => waiting.extend(halves.map(WaitingBox)),
                        // A box that is a point stays open.
                        None => {
                            record.is_exhausted = true;
                            waiting.push(WaitingBox(joint_box));
                            break;
                        }
                    }
                }
            }
        }
        let undecided_share = greater(1.0 - apart_share - touching_share, 0.0);
        // A search that is stopped may prove less than the one before.
        if undecided_share <= record.undecided_share {
            (record.apart_share, record.undecided_share) = (apart_share, undecided_share);
        }
        if waiting.is_empty() {
            // Boxes of both kinds would have witnesses.
            let is_apart = record.touching.is_none() && touching_share == 0.0;
            record.verdict = Some(if is_apart { Verdict::Never } else { always });
        }
        Ok(())
    }

    /// Returns whether a box that is not decided would not be, however small it were around its middle: the links touch there,
    /// without depth.
    fn stays_undecided(
        &mut self,
        (pair, record): (&LinkPair, &LinkPairRecord),
        check: &BoxCheck,
        middle: &[f64],
    ) -> Result<bool, Error> {
        if check.class != BoxClass::Undecided || check.in_middle.contact == Contact::Apart {
            return Ok(false);
        }
        let point = JointBox::at(middle);
        let check = self.measurer.check_box(pair, &point, record.known())?;
        Ok(check.class == BoxClass::Undecided)
    }
}

impl PartialEq for WaitingBox {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for WaitingBox {}

impl PartialOrd for WaitingBox {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for WaitingBox {
    fn cmp(&self, other: &Self) -> Ordering {
        self.0.volume_share.total_cmp(&other.0.volume_share)
    }
}
