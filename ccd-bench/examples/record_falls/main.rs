//! Records the paper's two scenes of rigid body dynamics \[FAST06 §6.2\]: bunnies and rings tumble
//! onto one that lies on the ground, simulated by rapier.
//!
//! A row is one step of the simulation, 1/60 s: the motions of both bodies from one pose to the
//! next, with the step as unit of time. The simulation keeps bodies apart. As in the paper, the end
//! pose of steps close to a contact is therefore pushed into the other body. Rows that begin in
//! contact are left out, and so are most rows that a broad phase would reject. This holds for the
//! recorded models only: other models may begin in contact in the same rows.
//!
//! Writes `falling-bunnies.csv` and `falling-rings.csv`, the same on every run. With a directory of
//! models it uses the `bunny26k.obj` and `ring.obj` found there: `cargo run --release -p ccd-bench
//! --example record_falls -- [--models DIR] [--out DIR]`.

mod simulation;

use anyhow::{Context, Result, bail};
use ccd_bench::scene::model::Model;
use ccd_core::glam::{DQuat, DVec3};
use ccd_core::{Body, Config, Instructions, Motion, Outcome, Pose};
use ccd_decomp::{Detail, TriangleMesh, body_from_mesh};
use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rapier3d_f64::parry::bounding_volume::BoundingVolume;
use rapier3d_f64::parry::query::{ClosestPoints, closest_points};
use rapier3d_f64::prelude::{Pose as At, SharedShape, Vector};
use rigid_ccd::batch::{Bodies, solve};
use rigid_ccd::batch::{Solve, SolverKind};
use rigid_ccd::table::motions::Query;
use simulation::{convex_parts, sectors, simulate};
use std::io::Write;
use std::path::{Path, PathBuf};

/// A scene to record.
struct Recording {
    file: &'static str,
    model: Model,
    /// The convex parts of the model that the simulation works with.
    parts: fn(&TriangleMesh) -> Result<SharedShape>,
    drops: usize,
    seed: u64,
}

const RECORDINGS: [Recording; 2] = [
    Recording {
        file: "falling-bunnies.csv",
        model: Model::Bunny26k,
        parts: convex_parts,
        drops: 11,
        seed: 4,
    },
    Recording {
        file: "falling-rings.csv",
        model: Model::Ring,
        parts: sectors,
        drops: 12,
        seed: 5,
    },
];

/// Steps that end with parts closer than this are pushed into contact.
const NEAR: f64 = 0.08;
/// The depth by which parts are pushed into each other; up to three times that until the meshes
/// intersect too.
const DEPTH: std::ops::Range<f64> = 0.02..0.12;
/// The largest number of rows per fall that are far from a contact (the last ones before it), and
/// of pushed rows.
const FREE_ROWS: usize = 8;
const PUSHED_ROWS: usize = 7;
/// Steps close to a contact are alike, so only every third one is taken.
const PUSHED_EVERY: usize = 3;
/// Poses are rounded to multiples of 1/`GRAINS`, so that they are short to write.
const GRAINS: f64 = 1e9;

fn main() -> Result<()> {
    let options = Options::from_arguments(std::env::args().skip(1))?;
    for recording in &RECORDINGS {
        let table = record(recording, options.models.as_deref())?;
        let path = options.out.join(recording.file);
        std::fs::write(&path, &table.text).with_context(|| path.display().to_string())?;
        writeln!(
            std::io::stdout(),
            "{}: {} rows, {} with a contact",
            recording.file,
            table.rows,
            table.contacts
        )?;
    }
    Ok(())
}

struct Options {
    models: Option<PathBuf>,
    out: PathBuf,
}

impl Options {
    fn from_arguments(mut arguments: impl Iterator<Item = String>) -> Result<Self> {
        let out = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
        let mut options = Options { models: None, out };
        while let Some(name) = arguments.next() {
            let value = arguments.next().context("give a directory after it")?;
            match name.as_str() {
                "--models" => options.models = Some(value.into()),
                "--out" => options.out = value.into(),
                _ => bail!("{name} is not known; --models DIR and --out DIR are"),
            }
        }
        Ok(options)
    }
}

/// The rows, with counts of their outcomes.
struct Table {
    text: String,
    rows: usize,
    contacts: usize,
}

fn record(recording: &Recording, models: Option<&Path>) -> Result<Table> {
    let mesh = recording.model.load(models)?.mesh;
    let body = body_from_mesh(&mesh, Detail::Auto)?.body;
    let shape = (recording.parts)(&mesh)?;
    let mut rng = Pcg64::seed_from_u64(recording.seed);
    let mut subject = Subject {
        body: &body,
        centre: DVec3::ZERO,
        solver: SolverKind::default().solver(Instructions::Best),
    };
    let mut table = Table {
        text: HEADER.to_owned(),
        rows: 0,
        contacts: 0,
    };
    for drop in 0..recording.drops {
        let fall = simulate(&shape, &mut rng);
        subject.centre = fall.centre;
        for step in chosen(&fall.poses, &shape, &mut rng) {
            let id = format!("{drop}.{}", step.index);
            if let Some((ends, hit)) = step.row(&id, &mut subject)? {
                table.text += &row(&id, &ends, fall.centre);
                table.rows += 1;
                table.contacts += usize::from(hit == Hit::Contact);
            }
        }
    }
    Ok(table)
}

/// The bodies that rows are tried on.
struct Subject<'a> {
    body: &'a Body,
    /// The centre of rotation.
    centre: DVec3,
    solver: Box<dyn Solve>,
}

/// The outcome of a row.
#[derive(Clone, Copy, PartialEq)]
enum Hit {
    Contact,
    Free,
}

impl Subject<'_> {
    /// Returns the outcome of a row, or `None` if it begins in contact and is of no use.
    fn ask(&mut self, query: &Query) -> Result<Option<Hit>> {
        let bodies = Bodies {
            a: self.body,
            b: self.body,
        };
        let answer = solve(bodies, query, &Config::default(), self.solver.as_mut())?;
        Ok(match answer.outcome {
            Outcome::Contact { .. } => Some(Hit::Contact),
            Outcome::Free { .. } => Some(Hit::Free),
            _ => None,
        })
    }
}

/// A step of a fall that makes a row.
struct Step {
    index: usize,
    start: [At; 2],
    end: [At; 2],
    /// The displacement of A at the end; `None` leaves the step unchanged.
    push: Option<Vector>,
}

impl Step {
    /// Returns the row of this step: unchanged, or pushed until there is a contact, sometimes a
    /// little deeper. Returns `None` if it begins in contact, or if pushing leads to no contact.
    fn row(&self, id: &str, subject: &mut Subject<'_>) -> Result<Option<(Ends, Hit)>> {
        let pushes = match self.push {
            None => vec![Vector::ZERO],
            Some(push) => [1.0, 2.0, 3.0].map(|times| push * times).to_vec(),
        };
        for push in pushes {
            let [mut a, b] = self.end;
            a.translation += push;
            let ends = Ends::new(self.start, [a, b]);
            let hit = subject.ask(&ends.query(id.to_owned(), subject.centre)?)?;
            match (hit, self.push) {
                (None, _) => return Ok(None),
                (Some(Hit::Free), Some(_)) => {}
                (Some(hit), _) => return Ok(Some((ends, hit))),
            }
        }
        Ok(None)
    }
}

/// Returns the steps of a fall that make rows: the last free ones before an approach, and some
/// close to it.
fn chosen(fall: &[[At; 2]], shape: &SharedShape, rng: &mut impl Rng) -> Vec<Step> {
    let mut rows = Vec::new();
    let (mut free, mut frees, mut pushed, mut near) = (Vec::new(), 0, 0, 0);
    for (index, poses) in fall.windows(2).enumerate() {
        let (start, end) = (poses[0], poses[1]);
        if !boxes_meet(shape, start, end) {
            continue;
        }
        let (gap, towards) = nearest(shape, end);
        let mut step = Step {
            index,
            start,
            end,
            push: None,
        };
        if gap > NEAR {
            free.push(step);
            continue;
        }
        let kept = free.len().min(FREE_ROWS - frees);
        rows.extend(free.drain(..).rev().take(kept).rev());
        frees += kept;
        if near % PUSHED_EVERY == 0 && pushed < PUSHED_ROWS {
            step.push = Some(towards * (gap + rng.random_range(DEPTH)));
            rows.push(step);
            pushed += 1;
        }
        near += 1;
    }
    rows.extend(free.into_iter().take(FREE_ROWS - frees));
    rows
}

/// Returns true if the boxes around the motions meet, so that a broad phase would pass the pair on.
fn boxes_meet(shape: &SharedShape, start: [At; 2], end: [At; 2]) -> bool {
    let swept = |k: usize| shape.compute_swept_aabb(&start[k], &end[k]);
    swept(0).intersects(&swept(1))
}

/// Returns the distance of the parts, and the direction from A to B.
fn nearest(shape: &SharedShape, [a, b]: [At; 2]) -> (f64, Vector) {
    let points = closest_points(&a, &**shape, &b, &**shape, f64::MAX);
    let between = match points {
        Ok(ClosestPoints::WithinMargin(p, q)) => q - p,
        _ => Vector::ZERO,
    };
    match between.try_normalize() {
        Some(towards) => (between.length(), towards),
        None => (
            0.0,
            (b.translation - a.translation).normalize_or(Vector::NEG_Z),
        ),
    }
}

/// Both bodies at the start and the end of a step, rounded as they are written.
struct Ends {
    start: [(DVec3, DQuat); 2],
    end: [(DVec3, DQuat); 2],
}

impl Ends {
    fn new(start: [At; 2], end: [At; 2]) -> Self {
        Ends {
            start: start.map(written),
            end: end.map(written),
        }
    }

    /// Returns the query that the written row is read back as.
    fn query(&self, id: String, centre: DVec3) -> Result<Query> {
        let motion = |k: usize| -> Result<Motion> {
            let [start, end] =
                [self.start[k], self.end[k]].map(|(at, turned)| Pose::new(at, turned));
            Ok(Motion::between(start?, end?, centre, 1.0)?)
        };
        Ok(Query {
            id,
            a: motion(0)?,
            b: motion(1)?,
            duration: 1.0,
        })
    }
}

const HEADER: &str = "id,\
    a_px,a_py,a_pz,a_qw,a_qx,a_qy,a_qz,a_end_px,a_end_py,a_end_pz,a_end_qw,a_end_qx,a_end_qy,a_end_qz,\
    b_px,b_py,b_pz,b_qw,b_qx,b_qy,b_qz,b_end_px,b_end_py,b_end_pz,b_end_qw,b_end_qx,b_end_qy,b_end_qz,\
    a_cx,a_cy,a_cz,b_cx,b_cy,b_cz\n";

fn row(id: &str, ends: &Ends, centre: DVec3) -> String {
    let pose = |(at, turned): (DVec3, DQuat)| {
        let q = turned;
        [at.x, at.y, at.z, q.w, q.x, q.y, q.z]
    };
    let poses = [0, 1].map(|k| [pose(ends.start[k]), pose(ends.end[k])].concat());
    let numbers = [poses.concat(), centre.to_array().repeat(2)].concat();
    let texts: Vec<String> = numbers.iter().map(f64::to_string).collect();
    format!("{id},{}\n", texts.join(","))
}

fn written(pose: At) -> (DVec3, DQuat) {
    let turned = pose
        .rotation
        .to_array()
        .map(|x| (x * GRAINS).round() / GRAINS);
    let at = DVec3::from_array(pose.translation.to_array());
    (rounded(at), DQuat::from_array(turned))
}

fn rounded(v: DVec3) -> DVec3 {
    (v * GRAINS).round() / GRAINS
}
