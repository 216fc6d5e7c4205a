//! The protocol between this program and a process that runs a method: one line of JSON for each query, and one for
//! each reply.

use super::solver::{Solver, answer_timed};
use ccd_core::glam::{DQuat, DVec3};
use ccd_core::{Motion, Pose};
use ccd_tables::motions::Motions;
use serde_json::json;
use std::io::{self, BufRead, Write};

/// The first line that the process writes after it has prepared its bodies.
pub const READY_LINE: &str = "ready";

/// The prefix of the first line if the process refuses the bodies or the setting; the reason follows.
pub const REFUSAL_PREFIX: &str = "refused: ";

/// Answers each line of the input by one line of the output, until the input ends.
///
/// # Errors
/// If a line is no query, or if the reader of the replies is gone.
pub fn serve_queries(
    solver: &mut dyn Solver,
    tolerance: f64,
    input: impl BufRead,
    mut output: impl Write,
) -> io::Result<()> {
    writeln!(output, "{READY_LINE}")?;
    output.flush()?;
    for line in input.lines() {
        let line = line?;
        let Some(query) = parse_query(&line) else {
            return Err(io::Error::new(io::ErrorKind::InvalidData, line));
        };
        let reply = serde_json::to_string(&answer_timed(solver, &query, tolerance))?;
        writeln!(output, "{reply}")?;
        output.flush()?;
    }
    Ok(())
}

/// Formats a query as one line without its name: the 16 numbers of each motion, and the duration, in JSON. Parsing gives
/// the same bits.
pub fn format_query(query: &Motions) -> String {
    let numbers = |motion: Motion| {
        let start = motion.start();
        [
            start.translation().to_array().as_slice(),
            &start.rotation().to_array(),
            &motion.velocity().to_array(),
            &motion.angular_velocity().to_array(),
            &motion.center().to_array(),
        ]
        .concat()
    };
    json!([numbers(query.a), numbers(query.b), query.duration]).to_string()
}

/// Parses a line as a query; returns `None` if it is invalid.
pub fn parse_query(line: &str) -> Option<Motions> {
    let (a, b, duration): ([f64; 16], [f64; 16], f64) = serde_json::from_str(line).ok()?;
    Some(Motions {
        id: String::new(),
        a: decode_motion(&a)?,
        b: decode_motion(&b)?,
        duration,
    })
}

fn decode_motion(numbers: &[f64; 16]) -> Option<Motion> {
    let vector = |k: usize| DVec3::from_slice(&numbers[k..k + 3]);
    let rotation = DQuat::from_slice(&numbers[3..7]);
    let start = Pose::new(vector(0), rotation).ok()?;
    Motion::about(start, vector(7), vector(10), vector(13)).ok()
}
