//! Mesh files: bytes to polygons, triangles, pieces and bodies.

use super::bodies;
use crate::memory;
use ccd_decomp::{Detail, Format, TriangleMesh, prepare, write_obj};

/// The most bytes of a file that is tried. Faults of readers need few, and short files are read fast.
const MOST_BYTES: usize = 1 << 14;

/// The memory that a reader may take, and some for each byte of the file.
const MEMORY: usize = 1 << 20;
const MEMORY_PER_BYTE: usize = 1 << 10;
/// The memory that bodies may take: approximate hulls are made of up to two million voxels.
const MEMORY_OF_BODIES: usize = 1 << 28;

/// The most triangles that are made into patches and hulls of all kinds. `Auto` has a budget of its own.
const MOST_TRIANGLES: usize = 48;
/// Approximate hulls take a hundred times as long as all else, and are made of one file in so many.
const APPROXIMATED: usize = 16;

pub(super) fn run(format: Format, bytes: &[u8]) {
    if bytes.len() > MOST_BYTES {
        return;
    }
    let memory = MEMORY + MEMORY_PER_BYTE * bytes.len();
    let read = memory::within(memory, || TriangleMesh::from_reader(format, bytes));
    match read {
        Ok(mesh) => memory::within(MEMORY_OF_BODIES, || {
            check(&mesh);
            let mut details = details(mesh.faces().len());
            if bytes.len().is_multiple_of(APPROXIMATED) && mesh.faces().len() <= MOST_TRIANGLES {
                details.push(Detail::Vhacd { hulls: 2 });
            }
            details
                .into_iter()
                .for_each(|detail| prepared(&mesh, detail));
        }),
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}

fn prepared(mesh: &TriangleMesh, detail: Detail) {
    match prepare(mesh, detail) {
        Ok(model) => bodies::stored_and_read(&model),
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
    reads_back(mesh);
}

/// Checks that a mesh that is written reads back to the same bits.
fn reads_back(mesh: &TriangleMesh) {
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

fn details(triangles: usize) -> Vec<Detail> {
    let mut details = vec![Detail::Auto, Detail::Triangles];
    if triangles <= MOST_TRIANGLES {
        details.extend([Detail::Patches(Default::default()), Detail::Hull]);
    }
    details
}
