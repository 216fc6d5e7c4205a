//! Changes files at random for the replay of the fuzz targets.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// A generator of randomly changed corpus files: it replaces, removes and repeats bytes, and inserts parts of other
/// files.
pub(crate) struct Mutator<'a> {
    rng: Pcg64,
    corpus: &'a [Vec<u8>],
}

/// The maximum number of changes made to one file.
const MAX_CHANGES: usize = 6;
/// Bytes that have a meaning in some file format.
const MEANINGFUL_BYTES: &[u8] = b"\0\x01\x7f\x80\xff \n\r\",;#/\\-+.0123456789eEnN";

impl<'a> Mutator<'a> {
    pub(crate) fn new(seed: u64, corpus: &'a [Vec<u8>]) -> Self {
        let random = Pcg64::seed_from_u64(seed);
        Mutator {
            rng: random,
            corpus,
        }
    }

    pub(crate) fn next_changed_file(&mut self) -> Vec<u8> {
        let mut bytes = self.pick_file().to_vec();
        for _ in 0..1 + self.random_below(MAX_CHANGES) {
            self.change(&mut bytes);
        }
        bytes
    }

    fn pick_file(&mut self) -> &'a [u8] {
        let at = self.random_below(self.corpus.len());
        &self.corpus[at]
    }

    fn change(&mut self, bytes: &mut Vec<u8>) {
        let at = self.random_below(bytes.len() + 1);
        let end = at + self.random_below(bytes.len() - at + 1);
        match self.random_below(7) {
            0 => {
                let byte = self.rng.random();
                bytes.splice(at..bytes.len().min(at + 1), [byte]);
            }
            1 => {
                let byte = MEANINGFUL_BYTES[self.random_below(MEANINGFUL_BYTES.len())];
                bytes.splice(at..bytes.len().min(at + 1), [byte]);
            }
            2 => bytes.insert(
                at,
                MEANINGFUL_BYTES[self.random_below(MEANINGFUL_BYTES.len())],
            ),
            3 => drop(bytes.drain(at..end.min(at + 16))),
            4 => {
                let copy = bytes[at..end.min(at + 64)].to_vec();
                let to = self.random_below(bytes.len() + 1);
                bytes.splice(to..to, copy);
            }
            5 => {
                let other = self.pick_file();
                let from = self.random_below(other.len() + 1);
                bytes.splice(at..end, other[from..].iter().copied().take(64));
            }
            _ => {
                let bit = self.random_below(8);
                bytes
                    .iter_mut()
                    .skip(at)
                    .take(1)
                    .for_each(|b| *b ^= 1 << bit);
            }
        }
    }

    fn random_below(&mut self, end: usize) -> usize {
        self.rng.random_range(0..end)
    }
}
