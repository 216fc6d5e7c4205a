//! parry's own answers, from a process that can be ended.

use crate::judge::Reply;
use crate::rows::Row;
use crate::{Call, Precision, double, is_for, single};
use anyhow::{Context, Result, bail};
use std::io::{BufRead, BufReader, Write};
use std::process::{Command, Stdio};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

/// The time after which the library is taken not to return.
const PATIENCE: Duration = Duration::from_secs(1);

/// Asks for parry's answers.
pub(crate) struct Theirs;

impl Theirs {
    /// Returns the answer to each row that the function is asked about.
    pub(crate) fn ask(
        path: &str,
        suites: &[&str],
        rows: &[Row],
        call: Call,
        precision: Precision,
    ) -> Result<Vec<Option<Reply>>> {
        let mut replies: Vec<Option<Reply>> = Vec::new();
        while replies.len() < rows.len() {
            let job = format!("{call:?},{precision:?},{}", replies.len());
            let mut child = Command::new(std::env::current_exe()?)
                .args([path, &job, "--suites", &suites.join(",")])
                .stdout(Stdio::piped())
                .stderr(Stdio::null())
                .spawn()?;
            let before = replies.len();
            let lines = child.stdout.take().context("no output")?;
            for line in BufReader::new(lines).lines() {
                let line = line?;
                replies.push(match line.as_str() {
                    "-" => None,
                    reply => Some(reply.parse()?),
                });
            }
            child.wait()?;
            if replies.len() == before {
                bail!("the process that asks parry ended without an answer");
            }
        }
        Ok(replies)
    }
}

/// Prints parry's answers from a row on: a line each, until one hangs.
pub(crate) fn work(rows: &[Row], job: &str) -> Result<()> {
    let parts: Vec<&str> = job.split(',').collect();
    let [call, precision, first] = parts[..] else {
        bail!("`{job}` is no job");
    };
    let call = match call {
        "Linear" => Call::Linear,
        _ => Call::Nonlinear,
    };
    let first: usize = first.parse()?;
    let mut out = std::io::stdout();
    for row in rows.iter().skip(first) {
        if !is_for(row, call) {
            writeln!(out, "-")?;
            continue;
        }
        let reply = match precision {
            "Single" => {
                let question = single::answers::Question::new(row)?;
                patiently(move || question.theirs(call))
            }
            _ => {
                let question = double::answers::Question::new(row)?;
                patiently(move || question.theirs(call))
            }
        };
        writeln!(out, "{reply}")?;
        out.flush()?;
        if reply == Reply::Hung {
            // A thread that never returns ends with its process only.
            return Ok(());
        }
    }
    Ok(())
}

fn patiently(ask: impl FnOnce() -> Reply + Send + 'static) -> Reply {
    let (sender, receiver) = channel();
    std::thread::spawn(move || sender.send(ask()));
    match receiver.recv_timeout(PATIENCE) {
        Ok(reply) => reply,
        Err(RecvTimeoutError::Timeout) => Reply::Hung,
        Err(RecvTimeoutError::Disconnected) => Reply::Panicked,
    }
}
