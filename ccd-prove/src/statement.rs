//! What a certificate states, read for people: the checker reads it by itself.

use std::fmt::{self, Display};

/// The statement of a certificate.
#[derive(Clone, Debug, PartialEq)]
pub struct Statement {
    /// The exponents of the units of length and of time.
    pub units: [i32; 2],
    /// The links: the number of the parent, counted from 1, the kind, and the numbers.
    pub links: Vec<(u32, u8, Vec<f64>)>,
    /// The bodies: the digest of the mesh, the number of the link.
    pub bodies: Vec<([u8; 32], u32)>,
    /// The pairs: both bodies, and the margin.
    pub pairs: Vec<([u32; 2], f64)>,
    /// The time until which the pairs are farther apart.
    pub until: f64,
    /// The witness, if there is one.
    pub witness: Option<StatedWitness>,
    /// The number of bytes of the statement; what follows is its proof.
    pub bytes: usize,
}

/// Two points of a pair that are near each other at a time.
#[derive(Clone, Debug, PartialEq)]
pub struct StatedWitness {
    /// The number of the pair.
    pub pair: u32,
    /// The time.
    pub time: f64,
    /// What the points may be farther apart than the pair has to be.
    pub tolerance: f64,
    /// For each body the place of a triangle in the order of its tree, and the weights of two corners in 2⁻⁶².
    pub points: [(u32, [u64; 2]); 2],
}

impl Statement {
    /// Reads the statement of a certificate; `None` if it ends too early, or is none.
    pub fn read(certificate: &[u8]) -> Option<Self> {
        let mut at = Cursor(certificate);
        if at.take(8)? != b"CCDPROF1" {
            return None;
        }
        let units = [at.u32()? as i32, at.u32()? as i32];
        let [links, bodies, pairs] = [at.u32()?, at.u32()?, at.u32()?];
        let links = (0..links).map(|_| {
            let (parent, kind) = (at.u32()?, at.take(1)?[0]);
            let count = if kind == 0 { 16 } else { 12 };
            Some((
                parent,
                kind,
                (0..count).map(|_| at.f64()).collect::<Option<_>>()?,
            ))
        });
        let links = links.collect::<Option<_>>()?;
        let bodies = (0..bodies).map(|_| Some((at.take(32)?.try_into().ok()?, at.u32()?)));
        let bodies = bodies.collect::<Option<_>>()?;
        let pairs = (0..pairs).map(|_| Some(([at.u32()?, at.u32()?], at.f64()?)));
        let pairs = pairs.collect::<Option<_>>()?;
        let until = at.f64()?;
        let witness = match at.take(1)?[0] {
            0 => None,
            _ => {
                let (pair, time, tolerance) = (at.u32()?, at.f64()?, at.f64()?);
                let mut point = || Some((at.u32()?, [at.u64()?, at.u64()?]));
                Some(StatedWitness {
                    pair,
                    time,
                    tolerance,
                    points: [point()?, point()?],
                })
            }
        };
        Some(Statement {
            units,
            links,
            bodies,
            pairs,
            until,
            witness,
            bytes: certificate.len() - at.0.len(),
        })
    }

    /// Returns whether two statements are about the same bodies, on the same links, with the same pairs and margins. The positions
    /// of joints may differ, and times.
    pub(crate) fn has_cell_of(&self, other: &Statement) -> bool {
        let links = || self.links.iter().zip(&other.links);
        self.bodies == other.bodies
            && self.pairs == other.pairs
            && self.links.len() == other.links.len()
            && links().all(
                |((parent, kind, numbers), (other_parent, other_kind, others))| {
                    // The last two numbers of a joint are its position at time 0 and its rate.
                    let count = if *kind == 0 { 16 } else { 10 };
                    (parent, kind) == (other_parent, other_kind)
                        && numbers[..count] == others[..count]
                },
            )
    }

    /// Returns the statement in one line.
    pub fn summary(&self) -> String {
        let Statement { pairs, until, .. } = self;
        let margins = pairs.iter().map(|pair| pair.1);
        let least = margins.fold(f64::INFINITY, ccd_core::order::lesser);
        let count = if pairs.len() == 1 {
            "1 pair".into()
        } else {
            format!("{} pairs", pairs.len())
        };
        let mut text = format!("{count} farther apart than {least} until {until}");
        if let Some(witness) = &self.witness {
            let StatedWitness {
                pair,
                time,
                tolerance,
                ..
            } = witness;
            text += &format!("; pair {pair} within {tolerance} more at {time}");
        }
        text
    }
}

/// The statement as text, a line for each link, body and pair. Numbers are the shortest that are read as the same binary64.
impl Display for Statement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [length, time] = self.units;
        writeln!(f, "units 2^{length} of length, 2^{time} of time")?;
        for (number, (parent, kind, numbers)) in self.links.iter().enumerate() {
            let names = ["free", "turns", "slides"];
            let kind = names.get(usize::from(*kind)).unwrap_or(&"of no kind");
            writeln!(f, "link {} on {parent} {kind} {numbers:?}", number + 1)?;
        }
        for (number, (digest, link)) in self.bodies.iter().enumerate() {
            let digest: String = digest.iter().map(|byte| format!("{byte:02x}")).collect();
            writeln!(f, "body {number} {digest} on {link}")?;
        }
        for (number, ([a, b], margin)) in self.pairs.iter().enumerate() {
            writeln!(f, "pair {number} of {a} and {b} margin {margin:?}")?;
        }
        write!(f, "until {:?}", self.until)?;
        if let Some(witness) = &self.witness {
            let StatedWitness {
                pair,
                time,
                tolerance,
                points,
            } = witness;
            write!(
                f,
                "\nwitness of pair {pair} at {time:?} tolerance {tolerance:?} points {points:?}"
            )?;
        }
        Ok(())
    }
}

/// Returns the steps of a proof as text, one in each line; what cannot be read ends it.
pub fn steps_text(certificate: &[u8], statement: &Statement) -> String {
    let mut at = Cursor(certificate.get(statement.bytes..).unwrap_or_default());
    let mut text = String::new();
    while let Some(&[step]) = at.take(1) {
        let line = match step {
            0 => Some("split A".to_owned()),
            1 => Some("split B".to_owned()),
            2 => Some("split time".to_owned()),
            3 => plane(&mut at).map(|plane| format!("plane with world {plane}")),
            4 => plane(&mut at).map(|plane| format!("plane with A {plane}")),
            5 => plane(&mut at).map(|plane| format!("plane with B {plane}")),
            6 => Some("ball around A".to_owned()),
            7 => Some("ball around B".to_owned()),
            _ => None,
        };
        match line {
            Some(line) => text += &(line + "\n"),
            None => return text + "broken\n",
        }
    }
    text
}

/// Reads the normal of a plane and its offset, of 7 bytes each.
fn plane(at: &mut Cursor<'_>) -> Option<String> {
    let mut number = || Some(signed(at.take(7)?));
    let normal = [number()?, number()?, number()?];
    Some(format!("{normal:?} {}", number()?))
}

/// Returns a number in two's complement.
fn signed(bytes: &[u8]) -> i64 {
    let negative = bytes.last().is_some_and(|byte| byte & 0x80 != 0);
    let first = if negative { -1 } else { 0 };
    let bytes = bytes.iter().rev();
    bytes.fold(first, |number, &byte| number << 8 | i64::from(byte))
}

/// What is not read yet.
struct Cursor<'a>(&'a [u8]);

impl<'a> Cursor<'a> {
    fn take(&mut self, count: usize) -> Option<&'a [u8]> {
        let (taken, rest) = self.0.split_at_checked(count)?;
        self.0 = rest;
        Some(taken)
    }

    fn u32(&mut self) -> Option<u32> {
        Some(u32::from_le_bytes(self.take(4)?.try_into().ok()?))
    }

    fn u64(&mut self) -> Option<u64> {
        Some(u64::from_le_bytes(self.take(8)?.try_into().ok()?))
    }

    fn f64(&mut self) -> Option<f64> {
        Some(f64::from_le_bytes(self.take(8)?.try_into().ok()?))
    }
}
