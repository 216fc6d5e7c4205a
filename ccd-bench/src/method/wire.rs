//! The protocol between this program and a process that runs a method: one line for each query, and one for each reply.

use super::solver::{Claim, Reply, Solver, TimedReply, answer_timed};
use ccd_core::glam::{DQuat, DVec3};
use ccd_core::{Motion, Pose};
use rigid_ccd::table::motions::Motions;
use std::io::{self, BufRead, Write};

/// The first line that the process writes after it has prepared its bodies.
pub const READY: &str = "ready";

/// The prefix of the first line if the process refuses the bodies or the setting; the reason follows.
pub const REFUSED: &str = "refused: ";

/// Answers queries from the input until it ends.
///
/// # Errors
/// If a line is no query, or if the reader of the replies is gone.
pub fn serve(
    solver: &mut dyn Solver,
    tolerance: f64,
    input: impl BufRead,
    mut output: impl Write,
) -> io::Result<()> {
    writeln!(output, "{READY}")?;
    output.flush()?;
    for line in input.lines() {
        let line = line?;
        let Some(query) = parse_query(&line) else {
            return Err(io::Error::new(io::ErrorKind::InvalidData, line));
        };
        writeln!(
            output,
            "{}",
            format_reply(&answer_timed(solver, &query, tolerance))
        )?;
        output.flush()?;
    }
    Ok(())
}

/// Formats a query as one line without its name; parsing gives the same bits.
pub fn format_query(query: &Motions) -> String {
    let motion = |motion: &Motion| {
        let start = motion.start();
        [
            start.translation().to_array().as_slice(),
            &start.rotation().to_array(),
            &motion.velocity().to_array(),
            &motion.spin().to_array(),
            &motion.centre().to_array(),
        ]
        .concat()
    };
    let numbers = [motion(&query.a), motion(&query.b), vec![query.duration]].concat();
    let texts: Vec<String> = numbers.iter().map(f64::to_string).collect();
    texts.join(" ")
}

/// The number of values by which a line gives one motion.
const VALUES_PER_MOTION: usize = 16;

/// Parses a line as a query; returns `None` if it is invalid.
pub fn parse_query(line: &str) -> Option<Motions> {
    let numbers: Vec<f64> = line
        .split(' ')
        .map(|text| text.parse().ok())
        .collect::<Option<_>>()?;
    let (a, rest) = numbers.split_at_checked(VALUES_PER_MOTION)?;
    let (b, rest) = rest.split_at_checked(VALUES_PER_MOTION)?;
    let &[duration] = rest else {
        return None;
    };
    Some(Motions {
        id: String::new(),
        a: motion(a)?,
        b: motion(b)?,
        duration,
    })
}

fn motion(numbers: &[f64]) -> Option<Motion> {
    let vector = |k: usize| DVec3::from_slice(&numbers[k..k + 3]);
    let rotation = DQuat::from_slice(&numbers[3..7]);
    let start = Pose::new(vector(0), rotation).ok()?;
    Motion::about(start, vector(7), vector(10), vector(13)).ok()
}

/// Formats a reply as one line: `time,status,steps,micros,tolerance,reason`, where the last two may be empty.
pub fn format_reply(timed: &TimedReply) -> String {
    let Reply {
        claim,
        steps,
        tolerance,
        reason,
    } = &timed.reply;
    let (time, status) = (claim.time().unwrap_or(0.0), claim.status());
    let tolerance = tolerance.map_or(String::new(), |tolerance| tolerance.to_string());
    let reason = reason.as_deref().unwrap_or_default().replace('\n', " ");
    format!(
        "{time},{status},{steps},{},{tolerance},{reason}",
        timed.micros
    )
}

/// Parses a line as a reply; returns `None` if it is invalid.
pub fn parse_reply(line: &str) -> Option<TimedReply> {
    // The reason may have commas of its own.
    let mut cells = line.splitn(6, ',');
    let time: f64 = cells.next()?.parse().ok()?;
    let claim = match cells.next()? {
        "contact" => Claim::Contact { time },
        "free" => Claim::Free,
        "unresolved" => Claim::Unresolved { safe_until: time },
        "refused" => Claim::Refused,
        "static" => Claim::NoClaim,
        _ => return None,
    };
    let steps = cells.next()?.parse().ok()?;
    let micros = cells.next()?.parse().ok()?;
    let tolerance = match cells.next()? {
        "" => None,
        text => Some(text.parse().ok()?),
    };
    let reason = Some(cells.next()?.to_owned()).filter(|text| !text.is_empty());
    let reply = Reply {
        claim,
        steps,
        tolerance,
        reason,
    };
    Some(TimedReply { reply, micros })
}
