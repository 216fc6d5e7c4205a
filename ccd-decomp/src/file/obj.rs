//! Writes meshes and pieces as Wavefront OBJ.

use crate::mesh::TriangleMesh;
use ccd_core::{Piece, Pieces};
use std::io::{self, BufWriter, Write};

/// Writes the vertices and triangles of a mesh as Wavefront OBJ; reading it back gives the same coordinates to the last
/// bit.
///
/// # Errors
/// The writer's errors.
pub fn write_obj(mesh: &TriangleMesh, writer: impl Write) -> io::Result<()> {
    let mut writer = BufWriter::new(writer);
    for v in mesh.vertices() {
        writeln!(writer, "v {} {} {}", v.x, v.y, v.z)?;
    }
    for [a, b, c] in mesh.faces() {
        writeln!(writer, "f {} {} {}", a + 1, b + 1, c + 1)?;
    }
    writer.flush()
}

/// Writes every piece as a separate OBJ group, `g piece_0` and so on, for viewing. A group has the facets of its
/// piece or, if none are known, its triangle, segment or points.
///
/// Vertices read back to the same bits. Shared vertices are written once for each piece. Rounding radii are omitted.
///
/// # Errors
/// The writer's errors.
pub fn write_obj_pieces(pieces: &Pieces, writer: impl Write) -> io::Result<()> {
    let mut writer = BufWriter::new(writer);
    let mut written = 0;
    for (k, piece) in pieces.iter().enumerate() {
        writeln!(writer, "g piece_{k}")?;
        for v in piece.points {
            writeln!(writer, "v {} {} {}", v.x, v.y, v.z)?;
        }
        write_elements(&piece, written + 1, &mut writer)?;
        written += piece.points.len();
    }
    writer.flush()
}

/// Writes the OBJ elements of one piece: its facets or, if none are known, its segment or points. `first` is the OBJ
/// number of its first vertex.
fn write_elements(piece: &Piece<'_>, first: usize, writer: &mut impl Write) -> io::Result<()> {
    let every = first..first + piece.points.len();
    if !piece.facets.is_empty() {
        for corners in piece.facets.iter() {
            write_element("f", corners.iter().map(|&c| first + c as usize), writer)?;
        }
        return Ok(());
    }
    match piece.points.len() {
        3 => write_element("f", every, writer),
        2 => write_element("l", every, writer),
        _ => write_element("p", every, writer),
    }
}

fn write_element(
    keyword: &str,
    vertices: impl Iterator<Item = usize>,
    writer: &mut impl Write,
) -> io::Result<()> {
    write!(writer, "{keyword}")?;
    for vertex in vertices {
        write!(writer, " {vertex}")?;
    }
    writeln!(writer)
}

#[cfg(test)]
mod tests;
