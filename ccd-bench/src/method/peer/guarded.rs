//! Runs a peer in a process of its own, which is stopped when it takes too long.

use super::PeerKind;
use super::wire::{READY, format_query, parse_reply};
use crate::method::solver::{Reply, TimedReply};
use ccd_decomp::{TriangleMesh, write_obj};
use rigid_ccd::table::motions::Query;
use std::fs::{self, File};
use std::io::{self, BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

/// Asks a peer one query at a time. Stops and restarts it when it hangs or dies.
#[derive(Debug)]
pub struct Guarded {
    kind: PeerKind,
    program: PathBuf,
    tolerance: f64,
    meshes: Meshes,
    /// `None` after the last process was stopped, until the next one starts.
    process: Option<Process>,
}

/// The outcome of a query.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Asked {
    /// The peer answered.
    Answered {
        /// The peer's reply.
        reply: Reply,
        /// The time of the peer's call alone, in microseconds.
        micros: f64,
    },
    /// The call exceeded the time limit, and the process was stopped.
    CutOff,
    /// The process ended: a panic, or out of memory.
    Died,
}

/// The time that a process may take to load its meshes.
const PATIENCE_AT_START: Duration = Duration::from_secs(120);

impl Guarded {
    /// Starts a peer on two meshes, with this program's own command.
    ///
    /// # Errors
    /// If the meshes cannot be written, or the process does not start.
    pub fn start(
        kind: PeerKind,
        a: &TriangleMesh,
        b: &TriangleMesh,
        tolerance: f64,
    ) -> io::Result<Self> {
        let mut guarded = Guarded::with_program(std::env::current_exe()?, kind, [a, b])?;
        guarded.restart_with(tolerance)?;
        Ok(guarded)
    }

    /// Prepares a peer that runs another program with the command `peer`. The first query starts
    /// it, at a tolerance of [`ccd_core::limits::DEFAULT_TOLERANCE`] unless [another one is
    /// set](Self::restart_with).
    ///
    /// # Errors
    /// If the meshes cannot be written.
    pub fn with_program(
        program: PathBuf,
        kind: PeerKind,
        meshes: [&TriangleMesh; 2],
    ) -> io::Result<Self> {
        Ok(Guarded {
            kind,
            program,
            tolerance: ccd_core::limits::DEFAULT_TOLERANCE,
            meshes: Meshes::write(meshes)?,
            process: None,
        })
    }

    /// Restarts the peer at another tolerance, with the same meshes.
    ///
    /// # Errors
    /// If the process does not start.
    pub fn restart_with(&mut self, tolerance: f64) -> io::Result<()> {
        self.tolerance = tolerance;
        self.process = None;
        self.running().map(|_| ())
    }

    /// Asks one query. A process that was stopped or has died is restarted first; that is not timed.
    ///
    /// # Errors
    /// If the process does not start.
    pub fn ask(&mut self, query: &Query, patience: Duration) -> io::Result<Asked> {
        let asked = self.running()?.ask(query, patience);
        if !matches!(asked, Asked::Answered { .. }) {
            self.process = None;
        }
        Ok(asked)
    }

    fn running(&mut self) -> io::Result<&mut Process> {
        let process = match self.process.take() {
            Some(process) => process,
            None => self.spawn()?,
        };
        Ok(self.process.insert(process))
    }

    fn spawn(&self) -> io::Result<Process> {
        let mut command = Command::new(&self.program);
        command
            .args(["peer", "--kind", self.kind.name()])
            .arg(format!("--tolerance={}", self.tolerance))
            .arg("--a")
            .arg(self.meshes.path(0))
            .arg("--b")
            .arg(self.meshes.path(1));
        Process::start(&mut command)
    }
}

/// A process that answers lines with lines. It ends when this is dropped.
#[derive(Debug)]
struct Process {
    child: Child,
    input: Option<ChildStdin>,
    lines: Receiver<String>,
}

impl Process {
    fn start(command: &mut Command) -> io::Result<Self> {
        let mut child = command
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()?;
        let input = child.stdin.take();
        let output = child.stdout.take();
        // From here on, dropping `self` stops the process.
        let (sender, lines) = channel();
        let process = Process {
            child,
            input,
            lines,
        };
        let output = output.ok_or_else(|| io::Error::other("no output of the peer"))?;
        // This thread ends with the output, which ends with the process.
        thread::spawn(move || {
            for line in BufReader::new(output).lines().map_while(Result::ok) {
                if sender.send(line).is_err() {
                    break;
                }
            }
        });
        match process.lines.recv_timeout(PATIENCE_AT_START) {
            Ok(line) if line == READY => Ok(process),
            _ => Err(io::Error::other("the peer does not start")),
        }
    }

    fn ask(&mut self, query: &Query, patience: Duration) -> Asked {
        let Some(input) = &mut self.input else {
            return Asked::Died;
        };
        if writeln!(input, "{}", format_query(query)).is_err() {
            return Asked::Died;
        }
        match self.lines.recv_timeout(patience) {
            Ok(line) => match parse_reply(&line) {
                Some(TimedReply { reply, micros }) => Asked::Answered { reply, micros },
                None => Asked::Died,
            },
            Err(RecvTimeoutError::Timeout) => Asked::CutOff,
            Err(RecvTimeoutError::Disconnected) => Asked::Died,
        }
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        // It is no error if the process has ended already.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Two meshes as files, which are removed when this is dropped.
#[derive(Debug)]
struct Meshes {
    directory: PathBuf,
}

impl Meshes {
    fn write(meshes: [&TriangleMesh; 2]) -> io::Result<Self> {
        static COUNT: AtomicU64 = AtomicU64::new(0);
        let count = COUNT.fetch_add(1, Ordering::Relaxed);
        let name = format!("ccd-peer-{}-{count}", std::process::id());
        let directory = std::env::temp_dir().join(name);
        fs::create_dir_all(&directory)?;
        let written = Meshes { directory };
        for (k, mesh) in meshes.into_iter().enumerate() {
            write_obj(mesh, File::create(written.path(k))?)?;
        }
        Ok(written)
    }

    fn path(&self, k: usize) -> PathBuf {
        let name = ["a.obj", "b.obj"][k];
        Path::new(&self.directory).join(name)
    }
}

impl Drop for Meshes {
    fn drop(&mut self) {
        // A folder left behind does no harm.
        let _ = fs::remove_dir_all(&self.directory);
    }
}
