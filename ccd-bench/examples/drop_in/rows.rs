//! Rows of other libraries' suites: the shapes, the motions, and what is expected.

use anyhow::{Context, Result, anyhow, bail};
use ccd_core::glam::DVec3;
use rigid_ccd::table::motions::{MotionTable, Query};
use serde_json::Value;

/// A query of a suite.
pub(crate) struct Row {
    pub(crate) suite: String,
    pub(crate) test: String,
    pub(crate) shapes: [Outline; 2],
    pub(crate) query: Query,
    pub(crate) margin: f64,
    /// Whether bodies in contact at the start are to be let go unless they approach.
    pub(crate) leave: bool,
    pub(crate) expected: Expected,
    /// The tolerance that the expected times are for.
    pub(crate) tolerance: f64,
    /// How near the bodies come, of those that stay apart; none if it is not known.
    pub(crate) least_distance: Option<f64>,
}

/// A shape, in numbers.
pub(crate) enum Outline {
    Ball(f64),
    Box([f64; 3]),
    /// Along z.
    Capsule {
        radius: f64,
        half_height: f64,
    },
    Mesh {
        vertices: Vec<DVec3>,
        faces: Vec<[u32; 3]>,
    },
    /// The convex hull of points.
    Hull(Vec<DVec3>),
}

/// What the suite expects.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Expected {
    /// A contact, reported not before the time at which they come within the tolerance.
    Contact {
        earliest: Option<f64>,
        time: f64,
    },
    /// In contact at the start.
    Start,
    Free,
    /// Within the tolerance, but never in contact: either answer is right.
    Near,
}

/// Reads the rows of some suites.
pub(crate) fn read(file: &Value, suites: &[&str]) -> Result<Vec<Row>> {
    let mut rows = Vec::new();
    for (number, case) in list(&file["cases"])?.iter().enumerate() {
        if suites.contains(&text(&case["suite"])?) {
            let row = Row::read(case, file).with_context(|| format!("case {number}"))?;
            rows.extend(row);
        }
    }
    Ok(rows)
}

impl Row {
    /// Returns none for a case that is to be refused.
    fn read(case: &Value, file: &Value) -> Result<Option<Self>> {
        let time = number(&case["expected_time"]);
        let leave = text(&case["start"])? == "leave";
        let let_go = leave && case["peer"]["hit"] == Value::Bool(false);
        let expected = match text(&case["expected_status"])? {
            // What bodies are let go is the library's own rule.
            "start" if let_go => Expected::Free,
            "contact" => Expected::Contact {
                earliest: number(&case["earliest_time"]).ok(),
                time: time?,
            },
            "start" => Expected::Start,
            "free" => Expected::Free,
            "near" | "near-start" => Expected::Near,
            "refused" => return Ok(None),
            other => bail!("what is expected is `{other}`"),
        };
        Ok(Some(Row {
            suite: text(&case["suite"])?.to_owned(),
            test: text(&case["test"])?.to_owned(),
            shapes: [
                Outline::read(&case["a"], file)?,
                Outline::read(&case["b"], file)?,
            ],
            query: motion(case)?,
            margin: number(&case["margin"]).unwrap_or(0.0),
            leave,
            expected,
            tolerance: number(&case["tolerance"])?,
            least_distance: number(&case["least_distance"]).ok(),
        }))
    }

    /// Returns whether a body turns.
    pub(crate) fn turns(&self) -> bool {
        [self.query.a, self.query.b]
            .iter()
            .any(|motion| motion.spin() != DVec3::ZERO)
    }
}

impl Outline {
    fn read(value: &Value, file: &Value) -> Result<Self> {
        match value.as_str() {
            Some(name) if name.starts_with("mesh:") => Outline::mesh(&file["meshes"][&name[5..]]),
            Some(text) => Outline::primitive(text),
            None => Outline::mesh(value),
        }
    }

    fn primitive(text: &str) -> Result<Self> {
        let (name, sizes) = text.split_once(':').context("no size")?;
        let sizes: Vec<f64> = sizes.split(',').map(str::parse).collect::<Result<_, _>>()?;
        match (name, &sizes[..]) {
            ("sphere", &[radius]) => Ok(Outline::Ball(radius)),
            ("capsule", &[radius, half_height]) => Ok(Outline::Capsule {
                radius,
                half_height,
            }),
            ("box", &[x, y, z]) => Ok(Outline::Box([x, y, z])),
            _ => Err(anyhow!("not a primitive: {text}")),
        }
    }

    fn mesh(value: &Value) -> Result<Self> {
        let triples = |value: &Value| -> Result<Vec<Vec<f64>>> {
            let triple = |v: &Value| list(v)?.iter().map(number).collect();
            list(value)?.iter().map(triple).collect()
        };
        let vertices = triples(&value["v"])?;
        let vertices = vertices
            .iter()
            .map(|v| DVec3::new(v[0], v[1], v[2]))
            .collect();
        if value["hull"] == Value::Bool(true) {
            return Ok(Outline::Hull(vertices));
        }
        let faces = triples(&value["f"])?;
        let faces = faces
            .iter()
            .map(|f| [f[0] as u32, f[1] as u32, f[2] as u32]);
        Ok(Outline::Mesh {
            vertices,
            faces: faces.collect(),
        })
    }

    /// The largest coordinate, or size.
    pub(crate) fn size(&self) -> f64 {
        let largest = |p: DVec3| p.abs().max_element();
        match self {
            Outline::Ball(radius) => *radius,
            Outline::Box(half) => largest(DVec3::from_array(*half)),
            Outline::Capsule {
                radius,
                half_height,
            } => radius + half_height,
            Outline::Mesh { vertices, .. } | Outline::Hull(vertices) => vertices
                .iter()
                .map(|v| largest(*v))
                .fold(0.0, ccd_core::order::greater),
        }
    }
}

/// Reads a motion as a table of one row.
fn motion(case: &Value) -> Result<Query> {
    let columns = case["motion"].as_object().context("no motion")?;
    let (mut names, mut values) = (
        String::from("duration"),
        number(&case["duration"])?.to_string(),
    );
    for (name, value) in columns {
        names += &format!(",{name}");
        values += &format!(",{}", number(value)?);
    }
    let table = format!("{names}\n{values}\n");
    let rows = MotionTable::read(table.as_bytes())?.rows;
    let row = rows.into_iter().next().context("no row")?;
    Ok(row.1)
}

fn list(value: &Value) -> Result<&Vec<Value>> {
    value.as_array().context("not a list")
}

fn number(value: &Value) -> Result<f64> {
    value.as_f64().context("not a number")
}

fn text(value: &Value) -> Result<&str> {
    value.as_str().context("not a text")
}
