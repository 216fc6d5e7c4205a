//! The files for a check, and the positions of the entries of a proof.

use std::io::{self, Write};
use std::ops::Range;

/// The number of bytes of a link.
pub(crate) const LINK: usize = 152;

/// The position of the code of the axes in a link.
pub(crate) const AXES: usize = 84;

/// The number of bytes of a witness.
pub(crate) const WITNESS: usize = 70;

/// A generator of random numbers.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005);
        self.0 = self.0.wrapping_add(1_442_695_040_888_963_407);
        self.0 >> 33
    }

    pub(crate) fn below(&mut self, limit: usize) -> usize {
        self.bits() as usize % limit
    }

    /// Returns a number from -1 to 1.
    pub(crate) fn number(&mut self) -> f64 {
        self.bits() as f64 / (1u64 << 30) as f64 - 1.0
    }

    pub(crate) fn vector(&mut self, size: f64) -> [f64; 3] {
        [(); 3].map(|()| self.number() * size)
    }
}

/// A proof about two meshes, with the meshes and the certificates of their trees.
#[derive(Clone, PartialEq)]
pub(crate) struct Files {
    pub(crate) proof: Vec<u8>,
    pub(crate) meshes: [Vec<u8>; 2],
    pub(crate) trees: [Vec<u8>; 2],
}

/// The positions of the entries of a proof, in bytes.
pub(crate) struct Positions {
    pub(crate) links: Vec<usize>,
    pub(crate) bodies: Vec<usize>,
    pub(crate) pairs: Vec<usize>,
    pub(crate) until: usize,
    pub(crate) witness: Option<usize>,
    pub(crate) steps: Vec<Range<usize>>,
}

impl Files {
    /// Returns the positions of the entries of a proof that is not forged.
    pub(crate) fn positions(&self) -> Positions {
        let count = |at: usize| u32::from_le_bytes([0, 1, 2, 3].map(|k| self.proof[at + k]));
        let mut at = 28;
        let mut entries = |count: u32, size: usize| -> Vec<usize> {
            let first = at;
            at += count as usize * size;
            (first..at).step_by(size).collect()
        };
        let links = entries(count(16), LINK);
        let bodies = entries(count(20), 36);
        let pairs = entries(count(24), 16);
        let (until, witness) = (at, at + 12);
        let witness = (self.proof[at + 8] == 1).then_some(witness);
        at += 12 + WITNESS * usize::from(witness.is_some());
        let mut steps = Vec::new();
        while at < self.proof.len() {
            let size = match self.proof[at] {
                3..=5 => 29,
                _ => 1,
            };
            steps.push(at..at + size);
            at += size;
        }
        Positions {
            links,
            bodies,
            pairs,
            until,
            witness,
            steps,
        }
    }

    /// Returns the first letter of the checker's verdict: `h`, `b` or `u`.
    pub(crate) fn verdict(&self) -> u8 {
        let read = |k: usize| ccd_check::Body::new(&self.meshes[k], &self.trees[k], &self.proof);
        let verdict = read(0).and_then(|a| ccd_check::check(&[a, read(1)?], &self.proof));
        match verdict {
            Ok(()) => b'h',
            Err(ccd_check::Stop::Broken(..)) => b'b',
            Err(ccd_check::Stop::Unverifiable(_)) => b'u',
        }
    }

    /// Writes a record: the kind of the forgery, the verdict, whether samples show the statement to be false, and all files.
    pub(crate) fn write(
        &self,
        out: &mut impl Write,
        kind: &str,
        verdict: u8,
        is_true: bool,
    ) -> io::Result<()> {
        let [a, b] = &self.meshes;
        let [tree_a, tree_b] = &self.trees;
        let result = [verdict, u8::from(is_true)];
        for part in [kind.as_bytes(), &result, &self.proof, a, tree_a, b, tree_b] {
            out.write_all(&(part.len() as u32).to_le_bytes())?;
            out.write_all(part)?;
        }
        Ok(())
    }
}
