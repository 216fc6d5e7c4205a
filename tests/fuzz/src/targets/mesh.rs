//! Reads mesh files, and makes triangles, pieces and bodies of them.

use super::bodies;
use crate::memory;
use ccd_decomp::{Format, MeshFile, PieceChoice, TriangleMesh, Unit, prepare, write_obj};

/// The maximum size of a file, in bytes. Faults of readers need few bytes, and short files are read fast.
const MAX_FILE_BYTES: usize = 1 << 14;

/// The constant part of a reader's memory limit, in bytes. The limit grows with the file's size.
const BASE_MEMORY_LIMIT: usize = 1 << 20;
const MEMORY_LIMIT_PER_INPUT_BYTE: usize = 1 << 10;
/// The memory limit of a reader of scenes, in bytes. It is high because a few bytes may use the same mesh many times.
const SCENE_MEMORY_LIMIT: usize = 1 << 28;
/// The memory limit of making bodies, in bytes. The bound of an outer hull's excess uses up to half a million boxes.
const BODY_MEMORY_LIMIT: usize = 1 << 28;

/// The largest number of triangles of a mesh from which patches and hulls are made. `Auto` has a budget of its own.
const MAX_COSTLY_DETAIL_TRIANGLES: usize = 48;
/// The largest number of triangles of a mesh from which bodies of any kind are made. Scenes of few bytes may have many.
const MAX_BODY_TRIANGLES: usize = 1 << 11;
/// One file in this many is made into an outer hull, which takes a hundred times as long as the other bodies.
const FILES_PER_OUTER_HULL: usize = 56;

pub(super) fn run(format: Format, bytes: &[u8]) {
    read(format, bytes, BASE_MEMORY_LIMIT);
}

/// Reads a scene file and checks its parts and bodies.
pub(super) fn run_scene(format: Format, bytes: &[u8]) {
    read(format, bytes, SCENE_MEMORY_LIMIT);
    if bytes.len() <= MAX_FILE_BYTES {
        memory::with_memory_limit(SCENE_MEMORY_LIMIT, || check_parts(format, bytes));
    }
}

fn read(format: Format, bytes: &[u8], memory: usize) {
    if bytes.len() > MAX_FILE_BYTES {
        return;
    }
    let memory = memory + MEMORY_LIMIT_PER_INPUT_BYTE * bytes.len();
    let read = memory::with_memory_limit(memory, || TriangleMesh::from_reader(format, bytes));
    match read {
        Ok(mesh) if mesh.faces().len() > MAX_BODY_TRIANGLES => check(&mesh),
        Ok(mesh) => memory::with_memory_limit(BODY_MEMORY_LIMIT, || {
            check(&mesh);
            let mut details = affordable_details(mesh.faces().len());
            if bytes.len().is_multiple_of(FILES_PER_OUTER_HULL)
                && mesh.faces().len() <= MAX_COSTLY_DETAIL_TRIANGLES
            {
                details.push(PieceChoice::OuterHull);
            }
            details
                .into_iter()
                .for_each(|choice| check_prepared_body(&mesh, choice));
        }),
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}

/// Checks that the parts of a file together have the faces of the whole file.
fn check_parts(format: Format, bytes: &[u8]) {
    let read = || MeshFile::from_reader(format, bytes);
    let (Ok(file), Ok(again), Ok(third)) = (read(), read(), read()) else {
        return;
    };
    let names = file.part_names().len();
    let (Ok(whole), Ok(parts)) = (file.into_mesh(), again.into_parts()) else {
        return;
    };
    assert_eq!(parts.len(), names);
    let merged = TriangleMesh::merge(parts.iter().map(|part| &part.mesh));
    let merged = merged.expect("parts of a mesh that is not too large");
    assert_eq!(merged.vertices(), whole.vertices());
    assert_eq!(merged.faces(), whole.faces());
    assert_eq!(merged.face_ids(), whole.face_ids());
    let third = third.converted_to_unit(Unit::Micrometre);
    if let Some(Ok(one)) = parts.first().map(|_| third.part("0")) {
        check(&one);
    }
}

fn check_prepared_body(mesh: &TriangleMesh, choice: PieceChoice) {
    match prepare(mesh, choice) {
        Ok(model) => bodies::check_storing(&model),
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}

fn check(mesh: &TriangleMesh) {
    let (vertices, faces) = (mesh.vertices(), mesh.faces());
    assert!(!faces.is_empty() && faces.len() == mesh.face_ids().len());
    assert!(vertices.iter().all(|v| v.is_finite()));
    let count = vertices.len() as u32;
    assert!(faces.iter().flatten().all(|&v| v < count));
    let _ = mesh.repairs().to_string();
    check_round_trip(mesh);
}

/// Checks that a mesh written as OBJ reads back to the same bits.
fn check_round_trip(mesh: &TriangleMesh) {
    let mut obj = Vec::new();
    write_obj(mesh, &mut obj).expect("memory takes all bytes");
    let again = TriangleMesh::from_reader(Format::Obj, &obj[..]).expect("an OBJ that was written");
    let bits = |mesh: &TriangleMesh| -> Vec<[u64; 3]> {
        let points = mesh.vertices().iter();
        points.map(|v| v.to_array().map(f64::to_bits)).collect()
    };
    assert_eq!(bits(&again), bits(mesh));
    assert_eq!(again.faces(), mesh.faces());
}

fn affordable_details(triangles: usize) -> Vec<PieceChoice> {
    let mut details = vec![PieceChoice::Auto, PieceChoice::Triangles];
    if triangles <= MAX_COSTLY_DETAIL_TRIANGLES {
        details.extend([PieceChoice::Patches(Default::default()), PieceChoice::Hull]);
    }
    details
}
