//! Searches for witnesses: configurations where two links touch, and where they are apart.
//!
//! First samples positions at random, including limits. A pattern search then descends from the samples with the least
//! distances: it tries a step along each position in turn, and halves the step when no step lowers the distance.

use super::measuring::{Contact, LinkPair};
use super::search::{LinkPairRecord, LinkPairSearch};
use crate::tuning::{
    DESCENT_HALVINGS, DESCENT_STARTS, FIRST_DESCENT_STEP, MAX_DESCENT_CHECKS, WITNESS_SAMPLES,
};
use rigid_ccd::Error;

impl LinkPairSearch<'_> {
    /// Searches for positions where two links touch, and where they are apart.
    pub(super) fn find_witnesses(
        &mut self,
        pair: &LinkPair,
        record: &mut LinkPairRecord,
    ) -> Result<(), Error> {
        let ranges = &pair.joints.all_positions.ranges;
        let mut random = Random(0);
        // The samples with the least distances so far, sorted by distance.
        let mut starts: Vec<(f64, Vec<f64>)> = Vec::new();
        for _ in 0..WITNESS_SAMPLES {
            if self.end.is_reached() || record.is_decided() {
                return Ok(());
            }
            let positions: Vec<f64> = ranges.iter().map(|&range| random.position(range)).collect();
            let limit = match starts.get(DESCENT_STARTS - 1) {
                Some(&(distance, _)) => distance,
                None => f64::INFINITY,
            };
            let check = self.measurer.check(pair, &positions, limit)?;
            record.record_witness(check.contact, &positions);
            if check.distance < limit {
                let index = starts.partition_point(|&(distance, _)| distance < check.distance);
                starts.insert(index, (check.distance, positions));
                starts.truncate(DESCENT_STARTS);
            }
            if ranges.is_empty() {
                break;
            }
        }
        for (distance, positions) in starts {
            if record.touching.is_some() {
                break;
            }
            record.record_distance(distance, &positions);
            self.descend(pair, record, positions, distance)?;
        }
        Ok(())
    }

    /// Searches for lower distances from given positions, until the links touch.
    pub(super) fn descend(
        &mut self,
        pair: &LinkPair,
        record: &mut LinkPairRecord,
        mut positions: Vec<f64>,
        mut distance: f64,
    ) -> Result<(), Error> {
        let ranges = &pair.joints.all_positions.ranges;
        let (mut step, mut check_count) = (FIRST_DESCENT_STEP, 0);
        for _ in 0..MAX_DESCENT_CHECKS {
            let distance_before = distance;
            for (index, &[low, high]) in ranges.iter().enumerate() {
                for step in [step, -step] {
                    let mut trial = positions.clone();
                    trial[index] = (positions[index] + step * (high - low)).clamp(low, high);
                    if trial == positions {
                        continue;
                    }
                    if check_count >= MAX_DESCENT_CHECKS || self.end.is_reached() {
                        return Ok(());
                    }
                    check_count += 1;
                    let check = self.measurer.check(pair, &trial, distance)?;
                    if check.contact == Contact::Touching {
                        record.record_witness(check.contact, &trial);
                        record.record_distance(0.0, &trial);
                        return Ok(());
                    }
                    if check.distance < distance {
                        (positions, distance) = (trial, check.distance);
                        record.record_distance(distance, &positions);
                        break;
                    }
                }
            }
            if !(distance < distance_before) {
                step *= 0.5;
                if step < FIRST_DESCENT_STEP * 0.5f64.powi(DESCENT_HALVINGS) {
                    break;
                }
            }
        }
        Ok(())
    }
}

/// The generator SplitMix64, which gives the same numbers in each search.
struct Random(u64);

impl Random {
    /// Returns a number in [0, 1).
    fn number(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        bits ^= bits >> 31;
        (bits >> 11) as f64 * (0.5 * f64::EPSILON)
    }

    /// Returns a random position in a range. One in eight is at a limit.
    fn position(&mut self, [low, high]: [f64; 2]) -> f64 {
        let fraction = (1.125 * self.number() - 0.0625).clamp(0.0, 1.0);
        (low + fraction * (high - low)).clamp(low, high)
    }
}
