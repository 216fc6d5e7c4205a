//! What a certificate states, read for people: the checker reads it by itself.

use ccd_core::glam::DVec3;
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

/// A link, and how it moves on the one that carries it: a point y is at `p + R c + s v + exp(s [a]×) R (y − c)` with
/// s = start + t rate, where p is the position, R the rotation of the quaternion, c the centre, v the velocity, a the axis.
#[derive(Clone, Debug, PartialEq)]
pub struct StatedLink {
    /// The number of the link that carries it, counted from 1; 0 is the world.
    pub parent: u32,
    /// The position.
    pub position: [f64; 3],
    /// The quaternion x, y, z, w.
    pub quaternion: [f64; 4],
    /// The point of the link about which it turns.
    pub centre: [f64; 3],
    /// What velocity and axis are along: 0 the axes of the parent, 1 those of the joint, so that v and a are R times them.
    pub axes: u32,
    /// The velocity, by which the centre moves.
    pub velocity: [f64; 3],
    /// The axis, about which it turns.
    pub axis: [f64; 3],
    /// What it has moved by at time 0.
    pub start: f64,
    /// What it moves by in a unit of time.
    pub rate: f64,
}

impl StatedLink {
    fn read(at: &mut Cursor<'_>) -> Option<Self> {
        Some(StatedLink {
            parent: at.u32()?,
            position: at.numbers()?,
            quaternion: at.numbers()?,
            centre: at.numbers()?,
            axes: at.u32()?,
            velocity: at.numbers()?,
            axis: at.numbers()?,
            start: at.f64()?,
            rate: at.f64()?,
        })
    }

    /// Returns by what start and rate of the same joint at other positions are to be multiplied, from which a power of two may have
    /// been taken; `None` if that is another joint.
    fn scale(&self, other: &StatedLink) -> Option<f64> {
        let is_fixed = self.axes == 0;
        let [own, theirs] = [self.velocity, other.velocity].map(DVec3::from_array);
        let largest = own.abs().max_position();
        let scale = if own == DVec3::ZERO {
            1.0
        } else {
            own[largest] / theirs[largest]
        };
        let is_power = scale.is_normal() && scale > 0.0 && scale.to_bits() << 12 == 0;
        let as_theirs = StatedLink {
            velocity: (own / scale).to_array(),
            start: if is_fixed { self.start } else { other.start },
            rate: if is_fixed { self.rate } else { other.rate },
            ..self.clone()
        };
        (is_power && as_theirs == *other).then_some(1.0 / scale)
    }
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

/// The statement as text, a line for each link, body and pair. Numbers are the shortest that are read as the same binary64.
impl Display for Statement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [length, time] = self.units;
        writeln!(f, "units 2^{length} of length, 2^{time} of time")?;
        for (number, link) in self.links.iter().enumerate() {
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
            } = link;
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

/// Returns a number of 7 bytes in two's complement.
fn signed(bytes: &[u8]) -> i64 {
    (unsigned(bytes) as i64) << 8 >> 8
}

fn unsigned(bytes: &[u8]) -> u64 {
    let bytes = bytes.iter().rev();
    bytes.fold(0, |number, &byte| number << 8 | u64::from(byte))
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

    fn numbers<const N: usize>(&mut self) -> Option<[f64; N]> {
        let mut numbers = [0.0; N];
        for number in &mut numbers {
            *number = self.f64()?;
        }
        Some(numbers)
    }

    fn f64(&mut self) -> Option<f64> {
        Some(f64::from_le_bytes(self.take(8)?.try_into().ok()?))
    }
}
