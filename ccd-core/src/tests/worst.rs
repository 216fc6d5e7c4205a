//! A search for the test case in which a rounding error is the largest share of its bound.
//!
//! Random cases come nowhere near a bound that adds up the worst of every operation. Here each case is a tape of
//! words, which become numbers when it is read. The search changes the words of the worst case so far, and keeps each
//! change after which it is at least as bad. It starts again when no worse case is found for long. The seed is fixed:
//! the same test examines the same cases.
//!
//! `CCD_TEST_CASES` in the environment multiplies the number of cases. `docs/allowances.md` has the results,
//! and the commands that print them.
//!
//! Other crates of the workspace include this file by its path. It uses the standard library alone.

use std::ops::RangeInclusive;

/// A random test case: a list of random words from which its numbers are read. It grows as more words are read.
pub(crate) struct RandomCase {
    words: Vec<u64>,
    read_count: usize,
    rng: SplitMix64,
}

/// A search for the case in which the error is the largest share of one bound.
pub(crate) struct WorstCaseSearch {
    name: &'static str,
    case_count: f64,
}

/// The largest error that a search found, relative to its bound.
pub(crate) struct LargestError {
    name: &'static str,
    /// The largest error, as a share of the bound.
    error_fraction: f64,
    /// Whether the search examined so many cases (more than 1,000) that its largest error should be near the bound.
    is_thorough: bool,
}

/// Two numbers of cases: a search restarts after the first, plus the second for each random word of a case, without a
/// larger error.
const RESTART_CASE_COUNTS: [u64; 2] = [200, 10];

/// The number of random cases that are drawn when a search restarts; it continues from the worst of them.
const CASES_BEFORE_CLIMB: u64 = 24;

impl WorstCaseSearch {
    /// Creates a search of `cases` cases, multiplied by the environment variable `CCD_TEST_CASES` if it is set.
    pub(crate) fn new(name: &'static str, cases: u32) -> Self {
        let given = std::env::var("CCD_TEST_CASES").ok();
        let times: f64 = given.and_then(|text| text.parse().ok()).unwrap_or(1.0);
        WorstCaseSearch {
            name,
            case_count: f64::from(cases) * times,
        }
    }

    /// Searches for the case in which `judge` returns the largest value: the error as a share of its bound, or `None`
    /// if the bound does not apply to a case.
    ///
    /// # Panics
    /// If a share is NaN, or if most cases give `None`.
    #[allow(clippy::print_stdout)]
    pub(crate) fn search(
        self,
        mut judge: impl FnMut(&mut RandomCase) -> Option<f64>,
    ) -> LargestError {
        let count = self.case_count.ceil() as u64;
        let mut dice = SplitMix64(self.name.bytes().fold(7, |seed, byte| {
            mix_bits(seed ^ u64::from(byte)) // A seed of its own for every name.
        }));
        let nothing = || (f64::NEG_INFINITY, Vec::new());
        let (mut here, mut worst, mut number) = (nothing(), nothing(), 0);
        let (mut drawn, mut stale, mut judged) = (0, 0, 0u64);
        for case in 1..=count {
            let words = if drawn < CASES_BEFORE_CLIMB {
                Vec::new()
            } else {
                dice.mutated_words(&here.1)
            };
            drawn += 1;
            let mut tape = RandomCase {
                words,
                read_count: 0,
                rng: SplitMix64(dice.next()),
            };
            let Some(share) = judge(&mut tape) else {
                continue;
            };
            assert!(!share.is_nan(), "{}: {:?}", self.name, tape.words);
            judged += 1;
            stale += 1;
            // A case that is equally bad is taken as well: it may lead on where the last one does not.
            if share >= here.0 {
                stale = if share > here.0 { 0 } else { stale };
                here = (share, tape.words);
            }
            if here.0 > worst.0 {
                (worst, number) = (here.clone(), case);
            }
            if stale > RESTART_CASE_COUNTS[0] + RESTART_CASE_COUNTS[1] * here.1.len() as u64 {
                // Every other climb continues from the worst case of all.
                let anew = dice.next() & 1 == 0;
                here = if anew { nothing() } else { worst.clone() };
                (drawn, stale) = (if anew { 0 } else { CASES_BEFORE_CLIMB }, 0);
            }
        }
        let (name, share) = (self.name, worst.0);
        let ratio = 1.0 / share;
        let ratio = if ratio < 1e6 {
            format!("{ratio:.3}")
        } else {
            format!("{ratio:.1e}")
        };
        println!("{name}: allowance / worst error = {ratio} at case {number} of {judged}");
        assert!(4 * judged > count, "{name}: {judged} of {count} are cases");
        LargestError {
            name,
            error_fraction: share,
            is_thorough: self.case_count >= count as f64 && count > 1000,
        }
    }
}

impl LargestError {
    /// Checks that no error exceeded its bound, and that the largest came within a factor `looseness` of it.
    pub(crate) fn assert_tight_bound(&self, looseness: f64) {
        let (name, ratio) = (self.name, 1.0 / self.error_fraction);
        assert!(
            self.error_fraction <= 1.0,
            "{name}: only {ratio:e} of an error"
        );
        // A search that examines nothing would prove nothing.
        let near = self.error_fraction > 0.0 && ratio <= looseness;
        assert!(
            near || !self.is_thorough,
            "{name}: {ratio:e} times all errors"
        );
    }
}

/// Returns the quotient of an error and its allowance; infinite for an error above an allowance of 0.
pub(crate) fn error_fraction(error: f64, allowance: f64) -> f64 {
    if allowance > 0.0 {
        error / allowance
    } else if error > 0.0 {
        f64::INFINITY
    } else {
        // There is no error, by this much. Written so that NaN stays.
        error
    }
}

impl RandomCase {
    /// Reads the next word of the case, and draws a random word at the end of the list.
    pub(crate) fn next_word(&mut self) -> u64 {
        if self.read_count == self.words.len() {
            self.words.push(self.rng.next());
        }
        self.read_count += 1;
        self.words[self.read_count - 1]
    }

    /// Reads a number of any sign and mantissa, with a binary exponent in the given range; sometimes 0.
    pub(crate) fn any_number(&mut self, exponents: RangeInclusive<i32>) -> f64 {
        let word = self.next_word();
        let (field, mantissa) = (word >> 52 & 0x7ff, word & MANTISSA_MASK);
        if field < 32 {
            return 0.0;
        }
        let (least, most) = exponents.into_inner();
        let exponent = least + field as i32 % (most - least + 1);
        let size = f64::from_bits(ONE_EXPONENT_BITS | mantissa);
        let signed = if word >> 63 == 1 { -size } else { size };
        // The power is computed in two steps, as 2⁻¹⁰⁷⁴ cannot be computed in one.
        let half = exponent / 2;
        signed * 2f64.powi(half) * 2f64.powi(exponent - half)
    }

    /// Reads three numbers of any sign and mantissa, with binary exponents in the given range; sometimes 0.
    pub(crate) fn vector(&mut self, exponents: RangeInclusive<i32>) -> [f64; 3] {
        [(); 3].map(|()| self.any_number(exponents.clone()))
    }

    /// Reads a positive number with a binary exponent in the given range.
    pub(crate) fn size(&mut self, exponents: RangeInclusive<i32>) -> f64 {
        let least = 2f64.powi(*exponents.start());
        match self.any_number(exponents).abs() {
            size if size > 0.0 => size,
            _ => least,
        }
    }

    /// Takes a number near `x` from the tape: the relative difference has any magnitude from 0 to about 1.
    pub(crate) fn number_near(&mut self, x: f64) -> f64 {
        x + x * self.any_number(-54..=0)
    }

    /// Reads a number in [0, 1).
    pub(crate) fn next_fraction(&mut self) -> f64 {
        (self.next_word() >> 11) as f64 * 0.5f64.powi(53)
    }

    /// Reads a whole number from 0 to `count − 1`.
    pub(crate) fn index_below(&mut self, count: usize) -> usize {
        (self.next_word() % count as u64) as usize
    }
}

const MANTISSA_MASK: u64 = (1 << 52) - 1;
const ONE_EXPONENT_BITS: u64 = 1023 << 52;

/// The SplitMix64 random number generator.
struct SplitMix64(u64);

impl SplitMix64 {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        mix_bits(self.0)
    }

    fn index_below(&mut self, count: usize) -> usize {
        (self.next() % count as u64) as usize
    }

    /// Returns a copy of a case with one or a few words changed.
    fn mutated_words(&mut self, words: &[u64]) -> Vec<u64> {
        let mut words = words.to_vec();
        if words.is_empty() {
            return words;
        }
        let changes = 1 + self.next().trailing_zeros().min(5);
        for _ in 0..changes {
            let at = self.index_below(words.len());
            words[at] = self.other(words[at], &words);
        }
        words
    }

    /// Returns a random variation of `word`, such as one with a changed bit or with changes in the last digits of the
    /// number.
    fn other(&mut self, word: u64, all: &[u64]) -> u64 {
        let digits = self.next() & MANTISSA_MASK;
        // The change is a few units in the last place if the word is a number.
        let few = digits % 16;
        match self.index_below(10) {
            0 => self.next(),
            1 => word & !MANTISSA_MASK | digits,
            2 => word ^ 1 << self.index_below(64),
            3 => word ^ 1 << self.index_below(52),
            4 => word.wrapping_add(few),
            5 => word.wrapping_sub(few),
            // The number is just above a power of two, or just below one.
            6 => word & !MANTISSA_MASK | few,
            7 => word | MANTISSA_MASK ^ few,
            // The number is equal or opposite to another one, up to a few last digits: sums of such numbers cancel.
            8 => {
                let sign = (self.next() & 1) << 63;
                let digits = if self.next() & 1 == 0 { few } else { 0 };
                all[self.index_below(all.len())] ^ sign ^ digits
            }
            _ => word
                .wrapping_add((self.next() % 5) << 52)
                .wrapping_sub(2 << 52),
        }
    }
}

fn mix_bits(x: u64) -> u64 {
    let x = (x ^ x >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ x >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ x >> 31
}
