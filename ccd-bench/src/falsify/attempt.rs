//! An attempt: two meshes and a query in plain numbers, which a search can change.

use ccd_core::glam::{DQuat, DVec3};
use ccd_core::order::greater;
use ccd_core::{InputError, Motion, Pose};
use ccd_decomp::{MeshError, TriangleMesh};
use rigid_ccd::table::motions::Query;

/// Two moving bodies.
#[derive(Clone, Debug, PartialEq)]
pub struct Attempt {
    /// Body A and body B.
    pub bodies: [Body; 2],
    /// The tolerance of the query.
    pub tolerance: f64,
}

/// A mesh and its motion, over a duration of 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// The corners of the faces.
    pub vertices: Vec<DVec3>,
    /// The triangles.
    pub faces: Vec<[u32; 3]>,
    /// The motion.
    pub motion: Course,
}

/// A motion in plain numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Course {
    /// The place at the start.
    pub at: DVec3,
    /// The turn at the start: its axis times its angle.
    pub turned: DVec3,
    /// The travel of the centre.
    pub velocity: DVec3,
    /// The turn on the way: its axis times its angle.
    pub spin: DVec3,
    /// The centre of rotation, in the body's frame.
    pub centre: DVec3,
}

impl Attempt {
    /// Returns the meshes.
    ///
    /// # Errors
    /// If one is invalid.
    pub fn meshes(&self) -> Result<[TriangleMesh; 2], MeshError> {
        let [a, b] = self.bodies.each_ref().map(Body::mesh);
        Ok([a?, b?])
    }

    /// Returns the query.
    ///
    /// # Errors
    /// If a number is invalid.
    pub fn query(&self) -> Result<Query, InputError> {
        let [a, b] = self.bodies.each_ref().map(|body| body.motion.motion());
        Ok(Query {
            id: "0".to_owned(),
            a: a?,
            b: b?,
            duration: 1.0,
        })
    }

    /// Returns the number of triangles.
    pub fn triangles(&self) -> usize {
        self.bodies.iter().map(|body| body.faces.len()).sum()
    }

    /// Returns the number of triangles without an area, which a method may refuse.
    pub fn flat_faces(&self) -> usize {
        let is_flat = |body: &Body, face: &[u32; 3]| {
            let [a, b, c] = face.map(|corner| body.vertices[corner as usize]);
            // Written so that NaN is flat.
            !((b - a).cross(c - a).length() > 0.0)
        };
        let flat = |body: &Body| body.faces.iter().filter(|face| is_flat(body, face)).count();
        self.bodies.iter().map(flat).sum()
    }

    /// Returns all coordinates and all numbers of the motions.
    pub fn numbers(&mut self) -> Vec<&mut f64> {
        self.bodies.iter_mut().flat_map(Body::numbers).collect()
    }

    /// Returns how far from simple the numbers are, all in all.
    pub fn complexity(&self) -> usize {
        let mut same = self.clone();
        same.numbers().into_iter().map(|x| complexity(*x)).sum()
    }

    /// Returns the attempt as seen from body B: it starts at the origin, and its centre rests.
    #[must_use]
    pub fn seen_from_b(&self) -> Attempt {
        let mut seen = self.clone();
        let Course { at, velocity, .. } = self.bodies[1].motion;
        for body in &mut seen.bodies {
            body.motion.at -= at;
            body.motion.velocity -= velocity;
        }
        seen
    }

    /// Returns the attempt with meshes that are turned as the bodies are at the start.
    #[must_use]
    pub fn unturned(&self) -> Attempt {
        let mut unturned = self.clone();
        for body in &mut unturned.bodies {
            let turn = DQuat::from_scaled_axis(body.motion.turned);
            body.motion.turned = DVec3::ZERO;
            body.motion.centre = turn * body.motion.centre;
            for vertex in &mut body.vertices {
                *vertex = turn * *vertex;
            }
        }
        unturned
    }
}

/// Returns how far from simple a number is: none for 0, then 1 and −1, then by the characters that it takes.
pub(super) fn complexity(x: f64) -> usize {
    match x {
        0.0 => 0,
        1.0 => 1,
        -1.0 => 2,
        _ => format!("{x:e}").len(),
    }
}

impl Body {
    /// Returns a body at rest at the origin.
    pub fn new(mesh: &TriangleMesh) -> Self {
        Body {
            vertices: mesh.vertices().to_vec(),
            faces: mesh.faces().to_vec(),
            motion: Course::default(),
        }
    }

    /// Returns the mesh, without vertices that no face uses.
    ///
    /// # Errors
    /// If it is invalid.
    pub fn mesh(&self) -> Result<TriangleMesh, MeshError> {
        TriangleMesh::new(self.vertices.clone(), &self.faces)
    }

    fn numbers(&mut self) -> impl Iterator<Item = &mut f64> {
        let Course {
            at,
            turned,
            velocity,
            spin,
            centre,
        } = &mut self.motion;
        let motion = [at, turned, velocity, spin, centre];
        let vectors = motion.into_iter().chain(&mut self.vertices);
        vectors.flat_map(|v| [&mut v.x, &mut v.y, &mut v.z])
    }

    /// Drops the vertices that no face uses.
    pub(super) fn compact(&mut self) {
        let mut names = vec![None; self.vertices.len()];
        let mut kept = Vec::new();
        for corner in self.faces.iter_mut().flatten() {
            let old = *corner as usize;
            *corner = *names[old].get_or_insert_with(|| {
                kept.push(self.vertices[old]);
                kept.len() as u32 - 1
            });
        }
        self.vertices = kept;
    }

    /// Returns the largest coordinate of a vertex.
    pub(super) fn size(&self) -> f64 {
        let coordinates = self.vertices.iter().map(|v| v.abs().max_element());
        coordinates.fold(0.0, greater)
    }
}

impl Course {
    fn motion(&self) -> Result<Motion, InputError> {
        let start = Pose::new(self.at, DQuat::from_scaled_axis(self.turned))?;
        Motion::about(start, self.velocity, self.spin, self.centre)
    }
}
