//! Writes seeds of the target `stored`, in the format in which this build stores bodies: `cargo run -p ccd-fuzz
//! --example seeds -- FOLDER`.
#![allow(clippy::print_stderr, reason = "a program, not a library")]

use ccd_decomp::{Format, PieceChoice, StoredBodyContent, TriangleMesh, prepare};
use std::error::Error;
use std::path::PathBuf;
use std::process::ExitCode;

const TETRAHEDRON: &str =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
/// An OBJ of a cube of quadrilaterals, so that patches have more than one triangle.
const CUBE_OBJ: &str = "v -1 -1 -1\nv 1 -1 -1\nv -1 1 -1\nv 1 1 -1\nv -1 -1 1\nv 1 -1 1\nv -1 1 1\nv 1 1 1\n\
     f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
/// An OBJ of a dented tetrahedron with an unused vertex and a duplicate face, so that the report mentions repairs.
const DENTED_TETRAHEDRON_OBJ: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv .2 .2 .2\nv 9 9 9\n\
     f 1 3 2\nf 1 2 4\nf 3 1 4\nf 2 3 5\nf 3 4 5\nf 4 2 5\nf 4 2 5\n";
/// An OBJ of an open sheet with a face without area.
const OPEN_SHEET_OBJ: &str = "v 0 0 0\nv 2 0 0\nv 1 0 0\nv 0 1 .5\nf 1 2 3\nf 1 3 4\nf 3 2 4\n";

fn main() -> ExitCode {
    match write() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn write() -> Result<(), Box<dyn Error>> {
    let folder = PathBuf::from(std::env::args().nth(1).ok_or("name a folder")?);
    let patches = PieceChoice::Patches(Default::default());
    let all = [
        ("sheet-triangles", OPEN_SHEET_OBJ, PieceChoice::Triangles),
        ("tetrahedron-triangles", TETRAHEDRON, PieceChoice::Triangles),
        ("tetrahedron-hull", TETRAHEDRON, PieceChoice::Hull),
        ("cube-hull", CUBE_OBJ, PieceChoice::Hull),
        ("cube-patches", CUBE_OBJ, patches),
        (
            "dented-triangles",
            DENTED_TETRAHEDRON_OBJ,
            PieceChoice::Triangles,
        ),
        ("dented-patches", DENTED_TETRAHEDRON_OBJ, patches),
        (
            "dented-outer-hull",
            DENTED_TETRAHEDRON_OBJ,
            PieceChoice::OuterHull,
        ),
    ];
    for (name, file, choice) in all {
        let model = prepare(
            &TriangleMesh::from_reader(Format::Obj, file.as_bytes())?,
            choice,
        )?;
        model.save(folder.join(format!("{name}.ccd")))?;
        let with_tree = |model: StoredBodyContent| model.with_hull_tree();
        with_tree(model)?.save(folder.join(format!("{name}-tree.ccd")))?;
    }
    Ok(())
}
