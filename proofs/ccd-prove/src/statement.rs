//! Reads the statement of a certificate, to compare it with another statement and to print it. The checker does not use this reader.

use crate::cursor::{Cursor, signed, unsigned};
use crate::statement_link::StatementLink;
use crate::step::Step;
use std::fmt::{self, Display};

/// The statement of a certificate: which pairs of bodies stay apart, by how much, and until when.
#[derive(Clone, Debug, PartialEq)]
pub struct Statement {
    /// The exponents of the units of length and of time.
    pub units: [i32; 2],
    /// The links.
    pub links: Vec<StatementLink>,
    /// The bodies, each with the digest of its mesh and its link. Link 0 is the world.
    pub bodies: Vec<([u8; 32], u32)>,
    /// The pairs, each with the indices of both bodies and the margin.
    pub pairs: Vec<([u32; 2], f64)>,
    /// The time until which the pairs stay farther apart than their margins.
    pub until: f64,
    /// The witness, if there is one.
    pub witness: Option<StatementWitness>,
    /// The number of bytes of the statement. The steps of the proof follow it.
    pub bytes: usize,
}

/// The meshes, motions and pairs of a statement, without margins and times. Two statements with equal subjects are about the same
/// question.
///
/// The comparison ignores the prover's scaling of motions by powers of two.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Subject {
    links: Vec<Vec<u64>>,
    bodies: Vec<([u8; 32], u32)>,
    pairs: Vec<[u32; 2]>,
}

/// A point of each body of a pair, and a time at which the points are near each other.
#[derive(Clone, Debug, PartialEq)]
pub struct StatementWitness {
    /// The index of the pair.
    pub pair: u32,
    /// The time.
    pub time: f64,
    /// The distance of the points is at most the pair's margin plus this tolerance.
    pub tolerance: f64,
    /// A point of each body: the index of its triangle in the order of the tree, and the weights of the corners in 2⁻⁵⁵.
    pub points: [(u32, [u64; 3]); 2],
}

impl StatementWitness {
    fn read(cursor: &mut Cursor<'_>) -> Option<Self> {
        let (pair, time, tolerance) = (cursor.u32()?, cursor.f64()?, cursor.f64()?);
        let mut point = || {
            let (triangle, mut weight) = (cursor.u32()?, || Some(unsigned(cursor.take(7)?)));
            Some((triangle, [weight()?, weight()?, weight()?]))
        };
        Some(StatementWitness {
            pair,
            time,
            tolerance,
            points: [point()?, point()?],
        })
    }
}

impl Statement {
    /// Reads the statement of a certificate. Returns `None` if the file is of another kind, or ends too early.
    pub fn read(certificate: &[u8]) -> Option<Self> {
        let mut cursor = Cursor(certificate);
        if cursor.take(8)? != b"CCDPROF1" {
            return None;
        }
        let units = [cursor.u32()? as i32, cursor.u32()? as i32];
        let [links, bodies, pairs] = [cursor.u32()?, cursor.u32()?, cursor.u32()?];
        let links = (0..links).map(|_| StatementLink::read(&mut cursor));
        let links = links.collect::<Option<_>>()?;
        let bodies = (0..bodies).map(|_| Some((cursor.take(32)?.try_into().ok()?, cursor.u32()?)));
        let bodies = bodies.collect::<Option<_>>()?;
        let pairs = (0..pairs).map(|_| Some(([cursor.u32()?, cursor.u32()?], cursor.f64()?)));
        let pairs = pairs.collect::<Option<_>>()?;
        let until = cursor.f64()?;
        let witness = match cursor.u32()? {
            0 => None,
            1 => Some(StatementWitness::read(&mut cursor)?),
            _ => return None,
        };
        Some(Statement {
            units,
            links,
            bodies,
            pairs,
            until,
            witness,
            bytes: certificate.len() - cursor.0.len(),
        })
    }

    /// Returns the subject of the statement, for comparison with the subject of an expected statement.
    pub fn subject(&self) -> Subject {
        Subject {
            links: self.links.iter().map(StatementLink::numbers).collect(),
            bodies: self.bodies.clone(),
            pairs: self.pairs.iter().map(|(bodies, _)| *bodies).collect(),
        }
    }

    /// Returns whether the margin of each pair is at least its margin in `expected`, a statement with the same subject.
    pub fn keeps_margins_of(&self, expected: &Statement) -> bool {
        let pairs = self.pairs.iter().zip(&expected.pairs);
        self.pairs.len() == expected.pairs.len()
            && pairs
                .into_iter()
                .all(|((_, margin), (_, expected_margin))| margin >= expected_margin)
    }

    /// Compares two statements that may have other joint positions, times and scalings by powers of two. Returns for each link the
    /// factor that undoes the scaling of its start and its rate in `other`. Returns `None` if the statements differ in anything else.
    pub(crate) fn scales(&self, other: &Statement) -> Option<Vec<f64>> {
        let has_same_pairs = self.bodies == other.bodies
            && self.pairs == other.pairs
            && self.links.len() == other.links.len();
        let links = self.links.iter().zip(&other.links);
        has_same_pairs.then(|| links.map(|(link, other)| link.scale(other)).collect())?
    }

    /// Returns a summary of one line.
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
            let StatementWitness {
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

/// Writes the whole statement as text, with one line for each link, body and pair. The numbers of a link are [without the prover's
/// scaling](StatementLink::without_scaling). A number has the fewest digits that identify its binary64.
impl Display for Statement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [length, time] = self.units;
        writeln!(f, "units 2^{length} of length, 2^{time} of time")?;
        for (number, link) in self.links.iter().enumerate() {
            let link = link.without_scaling();
            let axes = if link.axes == 0 { "parent" } else { "joint" };
            let StatementLink {
                parent,
                position,
                quaternion,
                center,
                velocity,
                axis,
                start,
                rate,
                ..
            } = &link;
            writeln!(
                f,
                "link {} on {parent} position {position:?} quaternion {quaternion:?} center {center:?} axes of the {axes} velocity \
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
            let StatementWitness {
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

/// Returns the steps of a proof as text, with one step per line. The text ends with `broken` at a step that cannot be read.
pub fn steps_text(certificate: &[u8], statement: &Statement) -> String {
    let mut cursor = Cursor(certificate.get(statement.bytes..).unwrap_or_default());
    let mut text = String::new();
    while let Some(&[step]) = cursor.take(1) {
        match step_text(step, &mut cursor) {
            Some(line) => text += &(line + "\n"),
            None => return text + "broken\n",
        }
    }
    text
}

/// Returns a step as text. Reads the numbers of a plane from `cursor`.
fn step_text(opcode: u8, cursor: &mut Cursor<'_>) -> Option<String> {
    let body = |index: usize| ["A", "B"][index];
    Some(match Step::from_opcode(opcode)? {
        Step::SplitNode(index) => format!("split {}", body(index)),
        Step::SplitTime => "split time".to_owned(),
        Step::Plane(frame) => {
            let frame = ["world", "A", "B"][frame];
            format!("plane with {frame} {}", plane_text(cursor)?)
        }
        Step::Ball(index) => format!("ball around {}", body(index)),
    })
}

/// Reads the normal and the offset of a plane, of 7 bytes each, and returns them as text.
fn plane_text(cursor: &mut Cursor<'_>) -> Option<String> {
    let mut number = || Some(signed(cursor.take(7)?));
    let normal = [number()?, number()?, number()?];
    Some(format!("{normal:?} {}", number()?))
}
