//! Times small queries, such as other libraries' test suites ask, beside parry's nonlinear cast of the
//! same shapes: balls, boxes, capsules, segments, triangles and small meshes.
//!
//! `cargo run --release -p ccd-bench --example suites -- SUITES.json [ROUNDS]`. The file has `meshes`,
//! each with vertices `v` and faces `f`, and `cases`, each with the name of its `suite`, two bodies `a`
//! and `b`, a `motion` by the names of the columns of `ccd query`, a `duration`, a `tolerance` and a
//! `start`. Cases with a margin are left out: the peer has none.
//!
//! Each row is answered once a round by either, suite by suite; a row's time is its median over the
//! rounds. Both include what depends on the motion, and neither what depends on the bodies alone.
//! Reading the clock takes some 20 to 40 ns of each.

use anyhow::{Context, Result, anyhow, bail};
use ccd_bench::method::peer::parry::double::shapes::{rigid_motion, vector};
use ccd_core::glam::DVec3;
use ccd_core::{Body, Config, StartPolicy};
use ccd_decomp::{Detail, TriangleMesh, body_from_mesh, parse_body};
use parry3d_f64::query::{NonlinearRigidMotion, cast_shapes_nonlinear};
use parry3d_f64::shape::SharedShape;
use rigid_ccd::Solver;
use rigid_ccd::batch::median;
use rigid_ccd::table::motions::{MotionTable, Query};
use serde_json::Value;
use std::collections::{BTreeMap, HashMap, HashSet};
use std::hint::black_box;
use std::io::Write;
use std::process::Command;
use std::sync::mpsc::channel;
use std::time::{Duration, Instant};

fn main() -> Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let (path, rounds) = match &arguments[..] {
        [path] => (path, "9"),
        [path, rounds] => (path, rounds.as_str()),
        _ => bail!("usage: suites SUITES.json [ROUNDS]"),
    };
    let file: Value = serde_json::from_str(&std::fs::read_to_string(path)?)?;
    let (bodies, mut suites) = read(&file)?;
    if rounds == SEARCH {
        write!(
            std::io::stdout(),
            "{}",
            find_hung(&bodies, &suites).join(",")
        )?;
        return Ok(());
    }
    // A thread that never returns ends with its process only.
    let search = Command::new(std::env::current_exe()?)
        .args([path, SEARCH])
        .output()?;
    let hung = String::from_utf8(search.stdout)?;
    let hung: HashSet<&str> = hung.split(',').collect();
    let rounds = rounds.parse()?;
    let mut out = std::io::stdout().lock();
    writeln!(
        out,
        "suite,rows,peer_hung,median_us,mean_us,peer_median_us,peer_mean_us,median_ratio,mean_ratio"
    )?;
    for (name, rows) in &mut suites {
        let before = rows.len();
        rows.retain(|row| !hung.contains(&*row.number.to_string()));
        let [ours, peers] = time(rows, &bodies, rounds)?;
        let [m, n] = [ours, peers].map(|mut micros| (median(&mut micros), mean(&micros)));
        writeln!(
            out,
            "{name},{},{},{:.3},{:.3},{:.3},{:.3},{:.2},{:.2}",
            rows.len(),
            before - rows.len(),
            m.0,
            m.1,
            n.0,
            n.1,
            m.0 / n.0,
            m.1 / n.1
        )?;
    }
    Ok(())
}

/// In place of the rounds: prints the rows for which the peer does not return.
const SEARCH: &str = "search";

/// Reads all bodies, and the rows of each suite.
fn read(file: &Value) -> Result<(Bodies, BTreeMap<String, Vec<Row>>)> {
    let mut bodies = Bodies::default();
    let mut suites: BTreeMap<String, Vec<Row>> = BTreeMap::new();
    for (number, case) in list(&file["cases"])?.iter().enumerate() {
        if let Some(row) = Row::read(number, case, file, &mut bodies)? {
            let suite = text(&case["suite"])?.to_owned();
            suites.entry(suite).or_default().push(row);
        }
    }
    Ok((bodies, suites))
}

/// Returns the numbers of the rows for which the peer does not return.
fn find_hung(bodies: &Bodies, suites: &BTreeMap<String, Vec<Row>>) -> Vec<String> {
    let hangs = |row: &&Row| {
        let (sender, receiver) = channel();
        let (row, shapes) = (
            (*row).clone(),
            [row.a, row.b].map(|k| bodies.all[k].1.clone()),
        );
        std::thread::spawn(move || {
            cast(&row, [&shapes[0], &shapes[1]]);
            sender.send(())
        });
        receiver.recv_timeout(PATIENCE).is_err()
    };
    let rows = suites.values().flatten();
    rows.filter(hangs)
        .map(|row| row.number.to_string())
        .collect()
}

/// The time after which the peer is taken not to return.
const PATIENCE: Duration = Duration::from_secs(1);

/// A query, and what it asks about.
#[derive(Clone)]
struct Row {
    /// Among all cases.
    number: usize,
    /// Numbers of [`Bodies`].
    a: usize,
    b: usize,
    query: Query,
    /// The motions in the peer's types.
    motions: [NonlinearRigidMotion; 2],
    config: Config,
}

/// Each body once, as ours and as the peer's.
#[derive(Default)]
struct Bodies {
    all: Vec<(Body, SharedShape)>,
    numbers: HashMap<String, usize>,
}

impl Row {
    /// Returns none for a case that is left out.
    fn read(
        number: usize,
        case: &Value,
        file: &Value,
        bodies: &mut Bodies,
    ) -> Result<Option<Self>> {
        if as_number(&case["margin"]).is_ok_and(|margin| margin > 0.0) {
            return Ok(None);
        }
        let Some(query) = motion(case)? else {
            return Ok(None);
        };
        let config = Config {
            tolerance: as_number(&case["tolerance"])?,
            start: match text(&case["start"])? {
                "leave" => StartPolicy::Leave,
                _ => StartPolicy::Report,
            },
            ..Config::default()
        };
        Ok(Some(Row {
            number,
            a: bodies.number_of(&case["a"], file)?,
            b: bodies.number_of(&case["b"], file)?,
            motions: [rigid_motion(&query.a), rigid_motion(&query.b)],
            query,
            config,
        }))
    }
}

impl Bodies {
    fn number_of(&mut self, value: &Value, file: &Value) -> Result<usize> {
        let key = value.to_string();
        if let Some(&number) = self.numbers.get(&key) {
            return Ok(number);
        }
        let body = match value.as_str() {
            Some(name) if name.starts_with("mesh:") => mesh(&file["meshes"][&name[5..]])?,
            Some(text) => (parse_body(text, Detail::default())?.body, primitive(text)?),
            None => mesh(value)?,
        };
        self.all.push(body);
        self.numbers.insert(key, self.all.len() - 1);
        Ok(self.all.len() - 1)
    }
}

/// Returns the microseconds of each row, ours and the peer's.
fn time(rows: &[Row], bodies: &Bodies, rounds: usize) -> Result<[Vec<f64>; 2]> {
    let mut solver = Solver::new();
    let mut micros = vec![[vec![], vec![]]; rows.len()];
    for _ in 0..rounds {
        for (row, micros) in rows.iter().zip(&mut micros) {
            solver = solver.with_config(row.config);
            let (a, b) = (&bodies.all[row.a].0, &bodies.all[row.b].0);
            let start = Instant::now();
            let answer = solver.answer((a, row.query.a), (b, row.query.b), row.query.duration)?;
            black_box(answer);
            micros[0].push(start.elapsed().as_secs_f64() * 1e6);
        }
        for (row, micros) in rows.iter().zip(&mut micros) {
            let (a, b) = (&bodies.all[row.a].1, &bodies.all[row.b].1);
            let start = Instant::now();
            cast(row, [a, b]);
            micros[1].push(start.elapsed().as_secs_f64() * 1e6);
        }
    }
    Ok([0, 1].map(|k| micros.iter_mut().map(|both| median(&mut both[k])).collect()))
}

fn cast(row: &Row, [a, b]: [&SharedShape; 2]) {
    let [of_a, of_b] = &row.motions;
    let stop = row.config.start == StartPolicy::Report;
    let hit = cast_shapes_nonlinear(of_a, &**a, of_b, &**b, 0.0, row.query.duration, stop);
    let _ = black_box(hit);
}

/// Reads a motion as a table of one row; none if it is to be refused.
fn motion(case: &Value) -> Result<Option<Query>> {
    let columns = case["motion"].as_object().context("no motion")?;
    let duration = as_number(&case["duration"])?;
    let (mut names, mut values) = (String::from("duration"), duration.to_string());
    for (name, value) in columns {
        names += &format!(",{name}");
        values += &format!(",{}", as_number(value)?);
    }
    let table = format!("{names}\n{values}\n");
    let rows = MotionTable::read(table.as_bytes())?.rows;
    let query = rows.into_iter().next().map(|(_, query)| query);
    let moving = |motion| Body::ball(1.0).map(|ball| (ball, motion));
    Ok(match query {
        Some(query) => {
            let (a, b) = (moving(query.a)?, moving(query.b)?);
            let answer = Solver::new().answer((&a.0, a.1), (&b.0, b.1), query.duration);
            answer.is_ok().then_some(query)
        }
        None => None,
    })
}

fn mesh(value: &Value) -> Result<(Body, SharedShape)> {
    let triple = |v: &Value| list(v)?.iter().map(as_number).collect::<Result<Vec<f64>>>();
    let vertices: Vec<Vec<f64>> = list(&value["v"])?
        .iter()
        .map(triple)
        .collect::<Result<_>>()?;
    let faces: Vec<Vec<f64>> = list(&value["f"])?
        .iter()
        .map(triple)
        .collect::<Result<_>>()?;
    let faces: Vec<[u32; 3]> = faces
        .iter()
        .map(|f| [f[0] as u32, f[1] as u32, f[2] as u32])
        .collect();
    let points: Vec<DVec3> = vertices
        .iter()
        .map(|v| DVec3::new(v[0], v[1], v[2]))
        .collect();
    let corner = |k: u32| vector(points[k as usize]);
    let shape = match faces[..] {
        [[a, b, c]] if a == b || b == c || a == c => {
            SharedShape::segment(corner(a), corner(if a == b { c } else { b }))
        }
        [[a, b, c]] => SharedShape::triangle(corner(a), corner(b), corner(c)),
        _ => SharedShape::trimesh(points.iter().map(|&p| vector(p)).collect(), faces.clone())?,
    };
    let body = body_from_mesh(
        &TriangleMesh::new(points.clone(), &faces)?,
        Detail::default(),
    )?
    .body;
    Ok((body, shape))
}

fn primitive(text: &str) -> Result<SharedShape> {
    let (name, sizes) = text.split_once(':').context("no size")?;
    let sizes: Vec<f64> = sizes.split(',').map(str::parse).collect::<Result<_, _>>()?;
    match (name, &sizes[..]) {
        ("sphere", &[r]) => Ok(SharedShape::ball(r)),
        ("capsule", &[r, half]) => Ok(SharedShape::capsule_z(half, r)),
        ("box", &[x, y, z]) => Ok(SharedShape::cuboid(x, y, z)),
        _ => Err(anyhow!("not a primitive: {text}")),
    }
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

fn list(value: &Value) -> Result<&Vec<Value>> {
    value.as_array().context("not a list")
}

fn as_number(value: &Value) -> Result<f64> {
    value.as_f64().context("not a number")
}

fn text(value: &Value) -> Result<&str> {
    value.as_str().context("not a text")
}
