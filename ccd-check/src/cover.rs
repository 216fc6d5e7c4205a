//! The check of a certificate: a tree of splits, whose leaves cover all pairs of triangles at all times.

use crate::body::Part;
use crate::leaf::{Links, Stretch};
use crate::motion::Placed;
use crate::number::{FRACTION, Number, Point, dot, product};
use crate::reader::Reader;
use crate::statement::Statement;
use crate::{Body, Stop};
use alloc::collections::BTreeMap;

type Times = [i64; 2];

/// All links in the middle of each stretch of time over which a leaf was checked so far.
type Seen = BTreeMap<Times, Links>;

/// Checks a certificate about meshes. Nothing is said of any other statement than the one in the certificate: the caller
/// compares it with the one that he wants.
///
/// # Errors
/// [`Stop`] if the certificate does not prove its statement, or the checker cannot tell.
pub fn check(meshes: &[Body], certificate: &[u8]) -> Result<(), Stop> {
    let mut reader = Reader::new(certificate);
    let statement = Statement::read(&mut reader, meshes)?;
    let mut seen = Seen::new();
    for (bodies, least) in &statement.pairs {
        let bodies = bodies.map(|body| &statement.bodies[body]);
        let mut stretches = BTreeMap::new();
        // What is to be proven: first both whole bodies over the whole time. Each step splits the last entry, or proves it.
        let roots: [Part; 2] = bodies.map(|body| body.mesh.root());
        let mut waiting = alloc::vec![(roots, [0, statement.until])];
        while let Some((parts, times @ [from, to])) = waiting.pop() {
            match reader.unsigned(1)? as usize {
                side @ 0..=1 => {
                    let children = bodies[side].mesh.children(parts[side]);
                    reader.require(!children.is_empty(), "a triangle is split")?;
                    waiting.extend(children.rev().map(|child| {
                        let mut parts = parts;
                        parts[side] = child;
                        (parts, times)
                    }));
                }
                2 => {
                    let at = from + (product(to - from, reader.unsigned(2)? as i64) >> 16) as i64;
                    reader.require(from < at && at < to, "a time is split at an end")?;
                    waiting.extend([(parts, [at, to]), (parts, [from, at])]);
                }
                step @ 3..=8 => {
                    let axis = read_axis(&mut reader, step >= 6)?;
                    let frame = [0, bodies[0].link, bodies[1].link][step % 3];
                    let stretch = stretches.entry((times, frame)).or_insert_with(|| {
                        let middle = from + (to - from) / 2;
                        let [middle, half] =
                            [middle, to - middle].map(|time| Number::exact([time]));
                        let place = || Links::new(Placed::all(&statement.links, middle, half));
                        Stretch::new(bodies, seen.entry(times).or_insert_with(place), frame)
                    });
                    let is_apart = |stretch: &Stretch<'_>| stretch.keeps_apart(parts, axis, *least);
                    let is_apart = stretch.as_ref().is_some_and(is_apart);
                    reader.require(is_apart, "an axis does not keep its parts apart")?;
                }
                _ => return Err(reader.broken("there is no such step")),
            }
        }
    }
    reader.require(reader.is_at_end(), "the file goes on after its end")
}

/// Reads an axis that is no longer than 1, in multiples of 2⁻¹⁴, or fine ones of 2⁻⁵⁰.
fn read_axis(reader: &mut Reader<'_>, is_fine: bool) -> Result<Point, Stop> {
    let (bytes, bits) = if is_fine { (7, 50) } else { (2, 14) };
    let axis = reader.axis(bytes)?;
    let is_short = dot(axis, axis) <= 1 << (2 * bits);
    reader.require(is_short, "an axis is longer than 1")?;
    Ok(axis.map(|x| x << (FRACTION - bits)))
}
