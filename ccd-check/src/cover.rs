//! The check of a certificate: a tree of splits, whose leaves cover all pairs of triangles at all times.

use crate::body::Part;
use crate::leaf::{Frame, Stretch, check_leaf};
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
    match check_all(Reader::new(certificate), [a, b]) {
        Ok(()) => Verdict::Holds,
        Err(verdict) => verdict,
    }
}

fn check_all(mut reader: Reader<'_>, bodies: [&Body; 2]) -> Result<(), Stop> {
    let statement = Statement::read(&mut reader, bodies)?;
    let mut waiting = Vec::new();
    waiting.push(Task {
        parts: bodies.map(Body::root),
        from: 0,
        to: statement.until,
    });
    let mut stretch = Stretch::new(&statement.motions, 0, statement.until);
    while let Some(task) = waiting.pop() {
        let step = reader.u8()?;
        let frame = match step {
            side @ 0..=1 => {
                split_body(&mut waiting, task, bodies, usize::from(side))
                    .or_else(|fault| reader.broken(fault))?;
                continue;
            }
            2 => {
                let share = i128::from(u16::from_le_bytes(reader.array()?));
                let at = task.from + (((task.to - task.from) * share) >> 16);
                if at <= task.from || at >= task.to {
                    return reader.broken(Fault::Split);
                }
                waiting.push(Task { from: at, ..task });
                waiting.push(Task { to: at, ..task });
                continue;
            }
            3 | 6 => Frame::World,
            4 | 7 => Frame::Body(0),
            5 | 8 => Frame::Body(1),
            _ => return reader.broken(Fault::Format),
        };
        if (stretch.from, stretch.to) != (task.from, task.to) {
            stretch = Stretch::new(&statement.motions, task.from, task.to);
        }
        let leaf = (task.parts, frame, step >= 6);
        check_leaf(&mut reader, (&statement, bodies), &stretch, leaf)?;
    }
    if !reader.is_at_end() {
        return reader.broken(Fault::Format);
    }
    match &statement.contact {
        Some(contact) if !statement.witnesses_hold(contact, bodies) => {
            reader.broken(Fault::Witnesses)
        }
        _ => Ok(()),
    }
}

fn split_body(
    waiting: &mut Vec<Task>,
    task: Task,
    bodies: [&Body; 2],
    side: usize,
) -> Result<(), Fault> {
    bodies[side].for_each_child(task.parts[side], |child| {
        let mut parts = task.parts;
        parts[side] = child;
        waiting.push(Task { parts, ..task });
    })
}
