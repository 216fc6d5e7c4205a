//! The check of a certificate: a tree of splits, whose leaves cover all pairs of triangles at all times.

use crate::body::Part;
use crate::leaf::Stretch;
use crate::number::{FRACTION, Vector};
use crate::reader::Reader;
use crate::statement::Statement;
use crate::{Body, Fault, Stop, Verdict};
use alloc::vec::Vec;

/// Two parts over a stretch of time, which are to be proven apart.
#[derive(Clone, Copy)]
struct Task {
    parts: [Part; 2],
    from: i128,
    to: i128,
}

/// Checks a certificate about two bodies.
///
/// It begins with both whole bodies over the whole time. Each step of the certificate splits what is to be proven, or proves it.
pub fn check(a: &Body, b: &Body, certificate: &[u8]) -> Verdict {
    match check_all(
        Reader {
            bytes: certificate,
            at: 0,
        },
        [a, b],
    ) {
        Ok(()) => Verdict::Holds,
        Err(verdict) => verdict,
    }
}

fn check_all(mut reader: Reader<'_>, bodies: [&Body; 2]) -> Result<(), Stop> {
    let statement = Statement::read(&mut reader, bodies)?;
    let mut stretch = Stretch::new(&statement.motions, 0, statement.until);
    let mut waiting = alloc::vec![Task {
        parts: [0; 2],
        from: 0,
        to: statement.until
    }];
    while let Some(task) = waiting.pop() {
        match reader.unsigned(1)? {
            side @ 0..=1 => split_body(&mut waiting, task, bodies, side as usize)
                .or_else(|fault| reader.broken(fault))?,
            2 => {
                let at = task.from + (((task.to - task.from) * reader.unsigned(2)?) >> 16);
                if at <= task.from || at >= task.to {
                    return reader.broken(Fault::Split);
                }
                waiting.extend([Task { from: at, ..task }, Task { to: at, ..task }]);
            }
            step @ 3..=8 => {
                if (stretch.from, stretch.to) != (task.from, task.to) {
                    stretch = Stretch::new(&statement.motions, task.from, task.to);
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

fn split_body(
    waiting: &mut Vec<Task>,
    task: Task,
    bodies: [&Body; 2],
    side: usize,
) -> Result<(), Fault> {
    let children = bodies[side].children(task.parts[side]);
    if children.is_empty() {
        return Err(Fault::Split);
    }
    waiting.extend(children.into_iter().map(|child| {
        let mut parts = task.parts;
        parts[side] = child;
        Task { parts, ..task }
    }));
    Ok(())
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
