//! The check of a certificate: a tree of splits, whose leaves cover all pairs of triangles at all times.

use crate::body::Part;
use crate::leaf::Stretch;
use crate::number::{FRACTION, Vector};
use crate::reader::Reader;
use crate::statement::Statement;
use crate::{Body, Fault, Stop};

/// Two parts over a stretch of time, which are to be proven apart.
#[derive(Clone, Copy)]
struct Task {
    parts: [Part; 2],
    times: [i128; 2],
}

/// Checks a certificate about two bodies. Nothing is said of any other statement than the one in the certificate: the caller
/// compares it with the one that he wants.
///
/// It begins with both whole bodies over the whole time. Each step of the certificate splits what is to be proven, or proves it.
///
/// # Errors
/// [`Stop`] if the certificate does not prove its statement, or the checker cannot tell.
pub fn check(a: &Body, b: &Body, certificate: &[u8]) -> Result<(), Stop> {
    let (bodies, mut reader) = (
        [a, b],
        Reader {
            bytes: certificate,
            at: 0,
        },
    );
    let statement = Statement::read(&mut reader, bodies)?;
    let whole = [0, statement.until];
    let mut stretch = Stretch::new(&statement.motions, whole);
    let mut waiting = alloc::vec![Task {
        parts: [0; 2],
        times: whole
    }];
    while let Some(task) = waiting.pop() {
        match reader.unsigned(1)? {
            side @ 0..=1 => {
                let side = side as usize;
                let children = bodies[side].children(task.parts[side]);
                if children.is_empty() {
                    return reader.broken(Fault::Split);
                }
                for child in children {
                    let mut parts = task.parts;
                    parts[side] = child;
                    waiting.push(Task { parts, ..task });
                }
            }
            2 => {
                let [from, to] = task.times;
                let at = from + (((to - from) * reader.unsigned(2)?) >> 16);
                if at <= from || at >= to {
                    return reader.broken(Fault::Split);
                }
                waiting.extend([[at, to], [from, at]].map(|times| Task { times, ..task }));
            }
            step @ 3..=8 => {
                if stretch.times != task.times {
                    stretch = Stretch::new(&statement.motions, task.times);
                }
                let axis = read_axis(&mut reader, step >= 6)?;
                let frame = [None, Some(0), Some(1)][step as usize % 3];
                if !stretch.keeps_apart((&statement, bodies), task.parts, (axis, frame)) {
                    return reader.broken(Fault::NotApart);
                }
            }
            _ => return reader.broken(Fault::Format),
        }
    }
    reader.require_end()?;
    let contact = statement.contact.as_ref();
    if contact.is_none_or(|contact| contact.holds(&statement.motions, bodies)) {
        Ok(())
    } else {
        reader.broken(Fault::Witnesses)
    }
}

/// Reads an axis that is no longer than 1, in multiples of 2⁻¹⁴, or fine ones of 2⁻³⁰.
fn read_axis(reader: &mut Reader<'_>, is_fine: bool) -> Result<Vector, Stop> {
    let (bytes, bits) = if is_fine { (4, 30) } else { (2, 14) };
    let axis = reader.axis(bytes)?;
    if axis.iter().map(|x| x * x).sum::<i128>() > 1 << (2 * bits) {
        return reader.broken(Fault::Axis);
    }
    Ok(Vector::exact(axis.map(|x| x << (FRACTION - bits))))
}
