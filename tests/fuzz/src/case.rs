//! A query as plain numbers, and its form as files and a command line.

use crate::nearest::Triangle;
use crate::raw_motion::{MotionSpec, RawMotion, RawPose};
use crate::vector::Vector;
use ccd_core::{Settings, StartPolicy};
use std::fmt::Write;

#[derive(Clone, Debug)]
pub struct Case {
    pub shapes: [Shape; 2],
    pub motions: [RawMotion; 2],
    pub duration: f64,
    pub config: Settings,
    /// The expected result, as far as the generator knows it.
    pub expected: Expectation,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Expectation {
    Unknown,
    /// The bodies separate or keep their distance, so that there is no contact.
    Free,
    /// The bodies certainly come nearer than allowed before the given time.
    ContactBy(f64),
}

/// A mesh of vertices and faces, with its known properties.
#[derive(Clone, Debug, Default)]
pub struct Shape {
    pub vertices: Vec<[f64; 3]>,
    pub faces: Vec<[u32; 3]>,
    pub mesh_class: MeshClass,
}

/// The properties that a mesh is known to have.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum MeshClass {
    #[default]
    TriangleSoup,
    /// The mesh is closed, oriented outward and without flaws, so that patches can be made of it.
    Solid,
    /// The mesh bounds a convex solid.
    Convex,
    /// The shape is the hull of the vertices. The faces are its facets except for rounding.
    VertexHull,
}

impl Shape {
    /// Returns a box around the origin, given its half extents.
    pub fn cuboid(half: [f64; 3]) -> Self {
        let sign = |k: usize, bit: usize| if k >> bit & 1 == 1 { 1.0 } else { -1.0 };
        let corner = |k| [0, 1, 2].map(|bit| sign(k, bit) * half[bit]);
        let sides = [
            [0, 4, 6, 2],
            [1, 3, 7, 5],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 2, 3, 1],
            [4, 5, 7, 6],
        ];
        let faces = sides
            .iter()
            .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
        Shape {
            vertices: (0..8).map(corner).collect(),
            faces: faces.collect(),
            mesh_class: MeshClass::Convex,
        }
    }

    pub fn triangles(&self) -> Vec<Triangle<f64>> {
        let corner = |v: u32| Vector(self.vertices[v as usize]);
        self.faces.iter().map(|face| face.map(corner)).collect()
    }

    pub fn radius(&self) -> f64 {
        let lengths = self.vertices.iter().map(|&v| Vector(v).length());
        lengths.fold(0.0, crate::vector::larger)
    }

    /// Returns the shape with `change` applied to every vertex.
    pub fn map(mut self, change: impl Fn([f64; 3]) -> [f64; 3]) -> Self {
        self.vertices.iter_mut().for_each(|v| *v = change(*v));
        self
    }

    /// Returns two shapes as one mesh.
    pub fn joined_with(mut self, other: &Shape) -> Self {
        let base = self.vertices.len() as u32;
        self.vertices.extend(&other.vertices);
        self.faces
            .extend(other.faces.iter().map(|f| f.map(|v| v + base)));
        self.mesh_class = MeshClass::TriangleSoup;
        self
    }

    /// Returns the shape with all faces reversed.
    pub fn with_reversed_faces(mut self) -> Self {
        self.faces.iter_mut().for_each(|f| f.swap(1, 2));
        self.mesh_class = MeshClass::TriangleSoup;
        self
    }

    fn to_obj(&self) -> String {
        let mut out = String::new();
        for [x, y, z] in &self.vertices {
            let _ = writeln!(out, "v {x:e} {y:e} {z:e}");
        }
        for [a, b, c] in &self.faces {
            let _ = writeln!(out, "f {} {} {}", a + 1, b + 1, c + 1);
        }
        out
    }
}

impl Case {
    /// Returns the files and the command line that repeat the query.
    pub fn reproducer(&self) -> String {
        let mut header = vec!["id".to_owned(), "duration".to_owned()];
        let mut row = vec!["0".to_owned(), format!("{:e}", self.duration)];
        let mut put = |letter: char, names: &str, values: &[f64]| {
            for (name, value) in names.split(' ').zip(values) {
                header.push(format!("{letter}_{name}"));
                row.push(format!("{value:e}"));
            }
        };
        for (letter, course) in ['a', 'b'].into_iter().zip(&self.motions) {
            let RawPose {
                position,
                quaternion,
            } = course.start;
            put(letter, "px py pz", &position);
            put(letter, "qw qx qy qz", &quaternion);
            put(letter, "cx cy cz", &course.center);
            match course.spec {
                MotionSpec::Velocities { linear, spin } => {
                    put(letter, "vx vy vz", &linear);
                    put(letter, "wx wy wz", &spin);
                }
                MotionSpec::EndPose(RawPose {
                    position,
                    quaternion,
                }) => {
                    put(letter, "end_px end_py end_pz", &position);
                    put(letter, "end_qw end_qx end_qy end_qz", &quaternion);
                }
            }
        }
        let Settings {
            tolerance,
            margin,
            budget,
            start_policy: start,
            ..
        } = self.config;
        let start = match start {
            StartPolicy::Report => "report",
            StartPolicy::Leave => "leave",
        };
        format!(
            "--- a.obj\n{}--- b.obj\n{}--- m.csv\n{}\n{}\n--- ccd query --a a.obj --b b.obj --motions \
             m.csv --tolerance {tolerance:e} --margin {margin:e} --budget {budget} --start {start}\n",
            self.shapes[0].to_obj(),
            self.shapes[1].to_obj(),
            header.join(","),
            row.join(","),
        )
    }
}
