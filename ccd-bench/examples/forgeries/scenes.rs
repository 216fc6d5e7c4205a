//! Proofs of small scenes: two freely moving bodies, and arms on a turning column.

use crate::files::{Files, Random};
use anyhow::{Context, Result};
use ccd_core::glam::DVec3;
use ccd_core::{Motion, Pose};
use ccd_prove::{AxisKind, Body, Joint, Link, Pair, Proof, ProvenPair, Scene, SceneBody, prove};
use rigid_ccd::mesh::{PieceChoice, TriangleMesh, body_from_mesh};
use rigid_ccd::{Settings, Solver};
use std::f64::consts::TAU;

/// The number of proofs of each kind of scene: two bodies without a contact, two bodies with one, and arms.
const PROOFS: usize = 6;

/// The vertices of a mesh, and the indices of the corners of its triangles.
type Mesh = (Vec<[f64; 3]>, Vec<[u32; 3]>);

/// Returns the proofs of all scenes.
pub(crate) fn all(random: &mut Random) -> Result<Vec<Files>> {
    let rings = [torus(4, 0.3), torus(3, 0.25)];
    let mut scenes = Vec::new();
    let [mut free, mut contacts] = [0, 0];
    while free.min(contacts) < PROOFS {
        let margin = [0.0, 0.02][random.below(2)];
        let Some(files) = two(&rings, margin, [flight(random)?, flight(random)?])? else {
            continue;
        };
        let is_contact = files.positions().witness.is_some();
        let count = if is_contact { &mut contacts } else { &mut free };
        *count += 1;
        if *count <= PROOFS {
            scenes.push(files);
        }
    }
    for _ in 0..PROOFS {
        scenes.push(arms(&rings, random)?);
    }
    Ok(scenes)
}

/// Returns the mesh of a torus about z.
fn torus(count: usize, radius: f64) -> Mesh {
    let (mut vertices, mut faces) = (Vec::new(), Vec::new());
    let number = |i: usize, j: usize| ((i % count) * count + j % count) as u32;
    for i in 0..count {
        for j in 0..count {
            let [a, b] = [i, j].map(|k| k as f64 / count as f64 * TAU);
            let out = 1.0 + radius * b.cos();
            vertices.push([out * a.cos(), out * a.sin(), radius * b.sin()]);
            faces.push([number(i, j), number(i + 1, j), number(i + 1, j + 1)]);
            faces.push([number(i, j), number(i + 1, j + 1), number(i, j + 1)]);
        }
    }
    (vertices, faces)
}

/// Returns a random free motion.
fn flight(random: &mut Random) -> Result<Motion> {
    let turn = [(); 4].map(|()| random.number());
    let start = Pose::new(random.vector(2.0), turn)?;
    let [velocity, spin, center] = [3.0, 2.0, 0.3].map(|size| random.vector(size));
    Ok(Motion::about(start, velocity, spin, center)?)
}

/// Computes the first contact of two rings, and proves the answer. Returns `None` for a contact at the start.
fn two(rings: &[Mesh; 2], margin: f64, motions: [Motion; 2]) -> Result<Option<Files>> {
    let engine = |(vertices, faces): &Mesh| -> Result<_> {
        let mesh = TriangleMesh::new(vertices.clone(), faces)?;
        Ok(body_from_mesh(&mesh, PieceChoice::Surface)?.body)
    };
    let [a, b] = [engine(&rings[0])?, engine(&rings[1])?];
    let settings = Settings {
        margin,
        ..Settings::DEFAULT
    };
    let mut solver = Solver::new().with_settings(settings.clone());
    let answer = solver.first_contact((&a, motions[0]), (&b, motions[1]), 1.0)?;
    let pair = ProvenPair::new(&a, &b)
        .ok()
        .context("rings have triangles")?;
    let proof = pair.prove(motions, 1.0, &settings, &answer).transpose()?;
    Ok(proof.map(|proof| files(proof, pair.meshes())))
}

/// Proves a scene of two arms on one turning column and a static body. Each arm has a revolute and a prismatic joint.
fn arms(rings: &[Mesh; 2], random: &mut Random) -> Result<Files> {
    let [flat, round] = rings;
    let balls = round.0.iter().enumerate();
    let balls: Vec<[f64; 4]> = balls
        .map(|(k, &[x, y, z])| [x, y, z, [0.0, 0.01, 0.02][k % 3]])
        .collect();
    let meshes = [Body::new(&flat.0, &flat.1), Body::rounded(&balls, &round.1)];
    let turn = [(); 3].map(|()| 0.2 * random.number());
    let pose = |x| Pose::new([x, 0.0, 0.5], [turn[0], turn[1], turn[2], 1.0]);
    let joint = |parent, kind, x, axis: DVec3, [start, rate]: [f64; 2]| -> Result<Link> {
        let joint = Joint::Axis {
            kind,
            pose: pose(x)?,
            axis,
            start,
            rate,
        };
        Ok(Link { parent, joint })
    };
    let (revolute, prismatic) = (AxisKind::Revolute, AxisKind::Prismatic);
    let links = vec![
        joint(0, revolute, 0.0, DVec3::Z, [0.3, 2.0 * random.number()])?,
        joint(1, revolute, 3.0, DVec3::Y, [0.2, 0.7])?,
        joint(2, prismatic, 0.5, DVec3::X, [0.0, 0.4])?,
        joint(1, revolute, -3.0, DVec3::Y, [0.1, -0.9])?,
        joint(4, prismatic, -0.5, DVec3::X, [-0.1, -0.3])?,
    ];
    let on_link = |k: usize, link| SceneBody {
        body: &meshes[k],
        link,
    };
    let pair = |bodies| Pair {
        bodies,
        margin: 0.01,
    };
    let scene = Scene {
        links,
        bodies: vec![on_link(0, 3), on_link(1, 5), on_link(1, 0)],
        pairs: vec![pair([0, 1]), pair([2, 0]), pair([1, 2])],
    };
    Ok(files(prove(&scene, 1.0, None)?, [&meshes[0], &meshes[1]]))
}

fn files(proof: Proof, meshes: [&Body; 2]) -> Files {
    Files {
        proof: proof.bytes,
        meshes: meshes.map(|mesh| mesh.mesh().to_vec()),
        trees: meshes.map(|mesh| mesh.certificate().to_vec()),
    }
}
