//! Decodes bytes as a query of two small bodies.

use super::QueryAndMethods;
use super::source::NumberReader;
use crate::case::{Case, Expectation, MeshClass, Shape};
use crate::engine::{Method, PieceKind};
use crate::raw_motion::{MotionSpec, RawMotion, RawPose};
use crate::vector::Vector;
use ccd_core::{Settings, StartPolicy};

/// The work budget of a query, small enough for thousands of queries in a minute.
const BUDGET: u64 = 20_000;
/// The largest rotation of a body, in radians. The referee takes time in proportion to it.
const MAX_ROTATION: f64 = 40.0;

/// The mask of the bits that give the kind of a shape, in the byte before the shape.
pub(super) const SHAPE_KIND_MASK: u8 = 7;
pub(super) const REVERSED_FACES_BIT: u8 = 64;
pub(super) const SCALED_BIT: u8 = 128;
/// The bit that marks a rotated start pose, in the byte before a motion.
pub(super) const ROTATED_BIT: u8 = 1;
pub(super) const VELOCITY_BIT: u8 = 2;
pub(super) const SPIN_BIT: u8 = 4;
pub(super) const CENTER_BIT: u8 = 8;
pub(super) const END_POSE_BIT: u8 = 16;
/// The bit that marks a margin, in the byte before the settings.
pub(super) const MARGIN_BIT: u8 = 1;
pub(super) const LEAVE_BIT: u8 = 2;
pub(super) const DURATION_BIT: u8 = 4;
pub(super) const BUDGET_BIT: u8 = 8;
pub(super) const TOLERANCE_BIT: u8 = 16;
pub(super) const AIMED_BIT: u8 = 32;
pub(super) const EXTRA_CHECKS_BIT: u8 = 64;

/// The value of the bits of [`SHAPE_KIND_MASK`] that stands for a mesh of arbitrary vertices and faces.
pub(super) const MESH_SHAPE_KIND: u8 = 0;

pub(super) fn decode_query_and_methods(bytes: &[u8]) -> QueryAndMethods {
    let mut source = NumberReader::new(bytes);
    let flags = source.read_byte();
    let config = config(&mut source, flags);
    let [duration] = source.read_numbers_if(flags & DURATION_BIT > 0, [1.0]);
    let asked = methods(&mut source);
    let shapes = [shape(&mut source), shape(&mut source)];
    let mut courses = [decode_motion(&mut source), decode_motion(&mut source)];
    let duration = duration.abs();
    courses.iter_mut().for_each(|c| limit_rotation(c, duration));
    let mut case = Case {
        shapes,
        motions: courses,
        duration,
        config,
        expected: Expectation::Unknown,
    };
    if flags & AIMED_BIT > 0 {
        aim_at_corner(&mut source, &mut case);
    }
    QueryAndMethods {
        case,
        kinds_and_methods: asked,
        has_extra_checks: flags & EXTRA_CHECKS_BIT > 0,
    }
}

fn config(source: &mut NumberReader<'_>, flags: u8) -> Settings {
    let tolerance = if flags & TOLERANCE_BIT > 0 {
        source.read_number().abs()
    } else {
        1e-3
    };
    let [margin] = source.read_numbers_if(flags & MARGIN_BIT > 0, [0.0]);
    let budget = if flags & BUDGET_BIT > 0 {
        u64::from(source.read_byte())
    } else {
        BUDGET
    };
    Settings {
        tolerance,
        margin: margin.abs(),
        budget,
        start_policy: if flags & LEAVE_BIT > 0 {
            StartPolicy::Leave
        } else {
            StartPolicy::Report
        },
        ..Settings::DEFAULT
    }
}

/// Returns the methods that answer the query: always the default, and in most cases another one.
fn methods(source: &mut NumberReader<'_>) -> Vec<(PieceKind, Method)> {
    const METHODS: [Method; 5] = [
        Method::Direct,
        Method::Gjk,
        Method::Vmarch,
        Method::Naive,
        Method::Fast,
    ];
    const PIECE_KINDS: [PieceKind; 3] = [PieceKind::Triangles, PieceKind::Patches, PieceKind::Hull];
    let other = usize::from(source.read_byte());
    let mut asked = vec![(PieceKind::Triangles, Method::Direct)];
    let one = (PIECE_KINDS[other / 5 % 3], METHODS[other % 5]);
    asked.extend((one != asked[0]).then_some(one));
    asked
}

fn shape(source: &mut NumberReader<'_>) -> Shape {
    let kind = source.read_byte();
    let mut shape = match kind & SHAPE_KIND_MASK {
        MESH_SHAPE_KIND => mesh(source),
        1 => soup(source, 1),
        2 => {
            let triangles = source.read_count(1, 5);
            soup(source, triangles)
        }
        3 => Shape::cuboid(source.read_numbers().map(f64::abs)),
        4 => {
            let inner = Shape::cuboid(source.read_numbers());
            let at = Vector(source.read_numbers());
            let outer = Shape::cuboid(source.read_numbers());
            outer.joined_with(&inner.map(|v| (Vector(v) + at).0))
        }
        5 => tetrahedron(source),
        6 => bipyramid(source),
        _ => height_field(source),
    };
    // The kinds of pieces to try; the decomposition finds out whether they are possible.
    shape.mesh_class = match kind >> 3 & 3 {
        0 => MeshClass::Convex,
        1 => MeshClass::Solid,
        _ => MeshClass::TriangleSoup,
    };
    if kind & REVERSED_FACES_BIT > 0 {
        shape = shape.with_reversed_faces();
    }
    if kind & SCALED_BIT > 0 {
        let scale = source.read_number();
        shape = shape.map(|v| (Vector(v) * scale).0);
    }
    shape
}

fn mesh(source: &mut NumberReader<'_>) -> Shape {
    let (vertices, faces) = (source.read_count(1, 33), source.read_count(1, 49));
    Shape {
        vertices: (0..vertices).map(|_| source.read_numbers()).collect(),
        faces: (0..faces)
            .map(|_| [(); 3].map(|()| u32::from(source.read_count(0, vertices))))
            .collect(),
        mesh_class: MeshClass::TriangleSoup,
    }
}

fn soup(source: &mut NumberReader<'_>, triangles: u8) -> Shape {
    let triangles = u32::from(triangles);
    Shape {
        vertices: (0..3 * triangles).map(|_| source.read_numbers()).collect(),
        faces: (0..triangles)
            .map(|k| [3 * k, 3 * k + 1, 3 * k + 2])
            .collect(),
        mesh_class: MeshClass::TriangleSoup,
    }
}

fn tetrahedron(source: &mut NumberReader<'_>) -> Shape {
    Shape {
        vertices: (0..4).map(|_| source.read_numbers()).collect(),
        faces: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]],
        mesh_class: MeshClass::TriangleSoup,
    }
}

/// Returns a bipyramid: corners around an axis, alternately on two circles, and two poles.
fn bipyramid(source: &mut NumberReader<'_>) -> Shape {
    let corners = u32::from(source.read_count(3, 9));
    let [top, bottom, even, odd] = source.read_numbers();
    let mut vertices = vec![[0.0, 0.0, top], [0.0, 0.0, bottom]];
    let mut faces = Vec::new();
    for k in 0..corners {
        let (s, c) = (std::f64::consts::TAU * f64::from(k) / f64::from(corners)).sin_cos();
        let r = if k % 2 == 1 { odd } else { even };
        vertices.push([r * c, r * s, 0.0]);
        let (here, next) = (2 + k, 2 + (k + 1) % corners);
        faces.extend([[0, here, next], [1, next, here]]);
    }
    Shape {
        vertices,
        faces,
        mesh_class: MeshClass::TriangleSoup,
    }
}

/// Returns a height field of triangles over a grid of squares.
fn height_field(source: &mut NumberReader<'_>) -> Shape {
    let side = u32::from(source.read_count(1, 5));
    let at = |i: u32, j: u32| i * (side + 1) + j;
    let mut shape = Shape::default();
    for i in 0..=side {
        for j in 0..=side {
            let height = source.read_number();
            shape.vertices.push([f64::from(i), f64::from(j), height]);
        }
    }
    for i in 0..side {
        for j in 0..side {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            shape.faces.extend([[a, b, c], [a, c, d]]);
        }
    }
    shape
}

fn decode_motion(source: &mut NumberReader<'_>) -> RawMotion {
    let flags = source.read_byte();
    let has = |bit: u8| flags & bit > 0;
    let none = [0.0; 3];
    let start = RawPose {
        position: source.read_numbers(),
        quaternion: source.read_numbers_if(has(ROTATED_BIT), RawPose::at(none).quaternion),
    };
    let center = source.read_numbers_if(has(CENTER_BIT), none);
    let goal = if has(END_POSE_BIT) {
        MotionSpec::EndPose(RawPose {
            position: source.read_numbers(),
            quaternion: source.read_numbers_if(has(SPIN_BIT), start.quaternion),
        })
    } else {
        MotionSpec::Velocities {
            linear: source.read_numbers_if(has(VELOCITY_BIT), none),
            spin: source.read_numbers_if(has(SPIN_BIT), none),
        }
    };
    RawMotion {
        start,
        spec: goal,
        center,
    }
}

fn limit_rotation(course: &mut RawMotion, duration: f64) {
    if let MotionSpec::Velocities { spin, .. } = &mut course.spec {
        let turn = Vector(*spin).length() * duration;
        if turn > MAX_ROTATION {
            *spin = (Vector(*spin) * (MAX_ROTATION / turn)).0;
        }
    }
}

/// Moves A so that a corner of A meets a corner of B at some time, up to an offset. Bodies at random places rarely
/// meet.
fn aim_at_corner(source: &mut NumberReader<'_>, case: &mut Case) {
    let fraction = f64::from(source.read_byte()) / 255.0;
    let time = fraction * case.duration;
    let mut corner = |k: usize| {
        let vertices = &case.shapes[k].vertices;
        let corner = vertices[usize::from(source.read_byte()) % vertices.len()];
        let track = case.motions[k].exact_motion(case.duration);
        let placed = track.snapshot_at(time);
        let arm = placed.world_arm(Vector::from_array(corner) - track.center);
        arm + placed.center
    };
    let [from, to] = [corner(0), corner(1)];
    let way = (to - from).to_f64() + Vector(source.read_numbers());
    let course = &mut case.motions[0];
    let shifted = |pose: RawPose| RawPose {
        position: (Vector(pose.position) + way).0,
        ..pose
    };
    course.start = shifted(course.start);
    if let MotionSpec::EndPose(end) = course.spec {
        course.spec = MotionSpec::EndPose(shifted(end));
    }
}
