//! Runs a method in a separate process, which is stopped if a query exceeds its time limit.

use super::Method;
use super::solver::{Reply, TimedReply};
use super::wire::{READY_LINE, REFUSAL_PREFIX, format_query};
use crate::scene::model::cuboid;
use ccd_decomp::{TriangleMesh, write_obj};
use ccd_tables::motions::Motions;
use clap::Args;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Write};
use std::path::PathBuf;
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;
use tempfile::TempDir;

/// A method that answers one query at a time in a separate process. The process is stopped and restarted when it hangs
/// or dies.
#[derive(Debug)]
pub struct GuardedMethod {
    program: PathBuf,
    settings: GuardedMethodSettings,
    /// The temporary folder with the mesh files of both bodies.
    mesh_folder: TempDir,
    /// The running process; `None` if none is running, so that the next query starts one.
    process: Option<MethodProcess>,
}

/// A method with its tolerance, its margin, and the time limit for its preparation.
#[derive(Clone, Copy, Debug)]
pub struct GuardedMethodSettings {
    /// The method that the process runs.
    pub method: Method,
    /// The tolerance, for methods that take one.
    pub tolerance: f64,
    /// The distance to keep between the bodies; a method without margins refuses any value except 0.
    pub margin: f64,
    /// The time limit for preparing the bodies.
    pub preparation_limit: Duration,
}

impl GuardedMethodSettings {
    /// Returns the default setting of a method at a tolerance: no margin, and two minutes of preparation.
    pub fn new(method: Method, tolerance: f64) -> Self {
        GuardedMethodSettings {
            method,
            tolerance,
            margin: 0.0,
            preparation_limit: Duration::from_secs(120),
        }
    }
}

/// How a query to a guarded process ended.
#[derive(Clone, Debug, PartialEq)]
pub enum QueryOutcome {
    /// The method answered the query.
    Answered(TimedReply),
    /// The query exceeded its time limit, so that the process was stopped.
    CutOff,
    /// The process gave no valid reply, for example because of a panic or a lack of memory.
    Crashed,
}

/// The programs that run the methods: this one, and a script for the methods of kind [`Method::Script`].
#[derive(Clone, Debug, Default, Args)]
pub struct MethodPrograms {
    /// The script that runs the methods of Coal and FCL: scripts/peers.py
    #[arg(long = "peers", value_name = "SCRIPT")]
    pub script: Option<PathBuf>,
}

impl MethodPrograms {
    /// Starts the script of a method, if a script runs it, to detect missing libraries.
    ///
    /// # Errors
    /// If it does not start.
    pub fn check_script_starts(&self, method: Method) -> io::Result<()> {
        if !matches!(method, Method::Script(_)) {
            return Ok(());
        }
        let mesh = cuboid(0.5, 0.5, 0.5).map_err(io::Error::other)?;
        let setting = GuardedMethodSettings::new(method, 1e-3);
        match GuardedMethod::start(self, setting, [&mesh, &mesh]) {
            Ok(_) => Ok(()),
            Err(error) => Err(io::Error::other(format!(
                "{method}: {error}; its script needs Python with coal, python-fcl and scipy"
            ))),
        }
    }

    /// Returns the path of the program that runs a method: this program, or the script.
    fn program_of(&self, method: Method) -> io::Result<PathBuf> {
        match (method, &self.script) {
            (Method::Script(_), Some(script)) => Ok(script.clone()),
            (Method::Script(_), None) => Err(io::Error::other(format!(
                "{method} is run by a script, which is not given"
            ))),
            _ => std::env::current_exe(),
        }
    }
}

impl QueryOutcome {
    /// Returns the method's reply to the query; `None` without an answer.
    pub fn reply(&self) -> Option<&Reply> {
        match self {
            QueryOutcome::Answered(timed) => Some(&timed.reply),
            QueryOutcome::CutOff | QueryOutcome::Crashed => None,
        }
    }
}

impl GuardedMethod {
    /// Starts a process that answers queries about two meshes with a method.
    ///
    /// # Errors
    /// If the meshes cannot be written, or the process does not start: of the kind
    /// [`Unsupported`](io::ErrorKind::Unsupported) if the method refuses the meshes or the setting, of the
    /// kind [`TimedOut`](io::ErrorKind::TimedOut) if it takes too long.
    pub fn start(
        programs: &MethodPrograms,
        setting: GuardedMethodSettings,
        meshes: [&TriangleMesh; 2],
    ) -> io::Result<Self> {
        let mut guarded = GuardedMethod::new(programs, setting, meshes)?;
        guarded.ensure_running_process()?;
        Ok(guarded)
    }

    /// Prepares a method for queries about two meshes. The first query starts it.
    ///
    /// # Errors
    /// If the meshes cannot be written, or the method has no program.
    pub fn new(
        programs: &MethodPrograms,
        setting: GuardedMethodSettings,
        meshes: [&TriangleMesh; 2],
    ) -> io::Result<Self> {
        let program = programs.program_of(setting.method)?;
        GuardedMethod::with_program(program, setting, meshes)
    }

    /// Prepares a method whose process is the given program, run with the command `answer`. The first query starts it.
    ///
    /// # Errors
    /// If the meshes cannot be written.
    pub fn with_program(
        program: PathBuf,
        setting: GuardedMethodSettings,
        meshes: [&TriangleMesh; 2],
    ) -> io::Result<Self> {
        let folder = TempDir::with_prefix("ccd-bench-")?;
        for (mesh, name) in meshes.into_iter().zip(MESH_FILE_NAMES) {
            write_obj(mesh, File::create(folder.path().join(name))?)?;
        }
        Ok(GuardedMethod {
            program,
            settings: setting,
            mesh_folder: folder,
            process: None,
        })
    }

    /// Sets the tolerance; if it changes, the next query restarts the process.
    pub fn set_tolerance(&mut self, tolerance: f64) {
        if self.settings.tolerance != tolerance {
            self.settings.tolerance = tolerance;
            self.process = None;
        }
    }

    /// Runs one query, and stops the process if it exceeds the time limit `patience`. A process that was stopped or has
    /// died is restarted first; that is not timed.
    ///
    /// # Errors
    /// Those of [`GuardedMethod::start`].
    pub fn run_query(&mut self, query: &Motions, patience: Duration) -> io::Result<QueryOutcome> {
        let outcome = self
            .ensure_running_process()?
            .query_and_await_reply(query, patience);
        if !matches!(outcome, QueryOutcome::Answered(_)) {
            self.process = None;
        }
        Ok(outcome)
    }

    fn ensure_running_process(&mut self) -> io::Result<&mut MethodProcess> {
        let process = match self.process.take() {
            Some(process) => process,
            None => self.spawn()?,
        };
        Ok(self.process.insert(process))
    }

    fn spawn(&self) -> io::Result<MethodProcess> {
        let mut command = Command::new(&self.program);
        command
            .args(["answer", "--method", &self.settings.method.to_string()])
            .arg(format!("--tolerance={}", self.settings.tolerance))
            .arg(format!("--margin={}", self.settings.margin))
            .arg("--a")
            .arg(self.mesh_folder.path().join(MESH_FILE_NAMES[0]))
            .arg("--b")
            .arg(self.mesh_folder.path().join(MESH_FILE_NAMES[1]));
        MethodProcess::start(&mut command, self.settings.preparation_limit)
    }
}

/// The names of the mesh files of body A and body B.
const MESH_FILE_NAMES: [&str; 2] = ["a.obj", "b.obj"];

/// A running process that answers each line of input with one line. It ends when this is dropped.
#[derive(Debug)]
struct MethodProcess {
    child: Child,
    input: ChildStdin,
    output_lines: Receiver<String>,
}

impl MethodProcess {
    fn start(command: &mut Command, preparation: Duration) -> io::Result<Self> {
        let mut child = command
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()?;
        let (Some(input), Some(output)) = (child.stdin.take(), child.stdout.take()) else {
            return Err(io::Error::other("no streams of the method"));
        };
        // From here on, dropping `self` stops the process.
        let (sender, lines) = channel();
        let process = MethodProcess {
            child,
            input,
            output_lines: lines,
        };
        // This thread ends with the output, which ends with the process.
        thread::spawn(move || {
            for line in BufReader::new(output).lines().map_while(Result::ok) {
                if sender.send(line).is_err() {
                    break;
                }
            }
        });
        match process.output_lines.recv_timeout(preparation) {
            Ok(line) if line == READY_LINE => Ok(process),
            Ok(line) if line.starts_with(REFUSAL_PREFIX) => {
                let why = &line[REFUSAL_PREFIX.len()..];
                Err(io::Error::new(io::ErrorKind::Unsupported, why))
            }
            Err(RecvTimeoutError::Timeout) => Err(io::ErrorKind::TimedOut.into()),
            _ => Err(io::Error::other("the method does not start")),
        }
    }

    fn query_and_await_reply(&mut self, query: &Motions, patience: Duration) -> QueryOutcome {
        if writeln!(self.input, "{}", format_query(query)).is_err() {
            return QueryOutcome::Crashed;
        }
        match self.output_lines.recv_timeout(patience) {
            Ok(line) => {
                serde_json::from_str(&line).map_or(QueryOutcome::Crashed, QueryOutcome::Answered)
            }
            Err(RecvTimeoutError::Timeout) => QueryOutcome::CutOff,
            Err(RecvTimeoutError::Disconnected) => QueryOutcome::Crashed,
        }
    }
}

impl Drop for MethodProcess {
    fn drop(&mut self) {
        // It is no error if the process has ended already.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
