//! What a certificate states, read for people: the checker reads it by itself.

use crate::cursor::{Cursor, signed, unsigned};
use crate::stated_link::StatedLink;
use std::fmt::{self, Display};

/// The statement of a certificate.
#[derive(Clone, Debug, PartialEq)]
pub struct Statement {
    /// The exponents of the units of length and of time.
    pub units: [i32; 2],
    /// The links.
    pub links: Vec<StatedLink>,
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

/// What a statement is about but for its margins and times: which meshes move how, and which pairs are compared. Two statements
/// have the same subject if their numbers are the same, up to powers of two that a certificate moves between factors.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Subject {
    links: Vec<Vec<u64>>,
    bodies: Vec<([u8; 32], u32)>,
    pairs: Vec<[u32; 2]>,
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
    /// For each body the place of a triangle in the order of its tree, and the weights of its corners in 2⁻⁵⁵.
    pub points: [(u32, [u64; 3]); 2],
}

impl StatedWitness {
    fn read(at: &mut Cursor<'_>) -> Option<Self> {
        let (pair, time, tolerance) = (at.u32()?, at.f64()?, at.f64()?);
        let mut point = || {
            let (triangle, mut weight) = (at.u32()?, || Some(unsigned(at.take(7)?)));
            Some((triangle, [weight()?, weight()?, weight()?]))
        };
        Some(StatedWitness {
            pair,
            time,
            tolerance,
            points: [point()?, point()?],
        })
    }
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
        let links = (0..links).map(|_| StatedLink::read(&mut at));
        let links = links.collect::<Option<_>>()?;
        let bodies = (0..bodies).map(|_| Some((at.take(32)?.try_into().ok()?, at.u32()?)));
        let bodies = bodies.collect::<Option<_>>()?;
        let pairs = (0..pairs).map(|_| Some(([at.u32()?, at.u32()?], at.f64()?)));
        let pairs = pairs.collect::<Option<_>>()?;
        let until = at.f64()?;
        let witness = match at.u32()? {
            0 => None,
            1 => Some(StatedWitness::read(&mut at)?),
            _ => return None,
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

    /// Returns what the statement is about, for comparison with the one that is wanted.
    pub fn subject(&self) -> Subject {
        Subject {
            links: self.links.iter().map(StatedLink::numbers).collect(),
            bodies: self.bodies.clone(),
            pairs: self.pairs.iter().map(|(bodies, _)| *bodies).collect(),
        }
    }

    /// Returns whether all pairs keep at least the margins that they have in another statement of the same subject.
    pub fn keeps_margins_of(&self, wanted: &Statement) -> bool {
        let pairs = self.pairs.iter().zip(&wanted.pairs);
        self.pairs.len() == wanted.pairs.len()
            && pairs.into_iter().all(|(own, wanted)| own.1 >= wanted.1)
    }

    /// Returns by what start and rate of each link of another statement are to be multiplied; `None` if it is not about the same
    /// bodies, on the same links, with the same pairs and margins. The positions of joints may differ, and times.
    pub(crate) fn scales(&self, other: &Statement) -> Option<Vec<f64>> {
        let is_of_cell = self.bodies == other.bodies
            && self.pairs == other.pairs
            && self.links.len() == other.links.len();
        let links = self.links.iter().zip(&other.links);
        is_of_cell.then(|| links.map(|(own, theirs)| own.scale(theirs)).collect())?
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

/// The statement as text, a line for each link, body and pair; links move by the numbers that they were [given
/// with](StatedLink::as_given). Numbers are the shortest that are read as the same binary64.
impl Display for Statement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [length, time] = self.units;
        writeln!(f, "units 2^{length} of length, 2^{time} of time")?;
        for (number, link) in self.links.iter().enumerate() {
            let link = link.as_given();
            let axes = if link.axes == 0 { "parent" } else { "joint" };
            let StatedLink {
                parent,
                position,
                quaternion,
                centre,
                velocity,
                axis,
                start,
                rate,
                ..
            } = &link;
            writeln!(
                f,
                "link {} on {parent} position {position:?} quaternion {quaternion:?} centre {centre:?} axes of the {axes} velocity \
                 {velocity:?} axis {axis:?} start {start:?} rate {rate:?}",
                number + 1
            )?;
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
