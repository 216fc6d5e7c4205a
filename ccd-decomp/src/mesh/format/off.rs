//! The reader of the text Object File Format (OFF, Geomview).

use crate::mesh::error::MeshFault;
use crate::mesh::polygons::Polygons;
use ccd_core::glam::DVec3;
use std::str::FromStr;

/// Reads the vertices and faces of an OFF.
pub(super) fn parse(bytes: &[u8]) -> Result<Polygons, MeshFault> {
    let text = String::from_utf8_lossy(bytes);
    let mut lines = (1..).zip(text.lines()).filter_map(|(line_number, line)| {
        let text = line.split('#').next().unwrap_or_default();
        let words = text.split_whitespace();
        (!text.trim().is_empty()).then_some(Line { words, line_number })
    });
    let Some(first) = lines.next() else {
        return Err(MeshFault::NoVertices);
    };
    let (vertices, faces) = read_counts(first, &mut lines)?;
    let mut polygons = Polygons::default();
    for vertex in 0..vertices {
        let mut line = next_line(&mut lines, || format!("vertex {vertex} of {vertices}"))?;
        let what = "the three coordinates of a vertex";
        let mut coordinate = || line.next_number::<f64>(what);
        let point = DVec3::new(coordinate()?, coordinate()?, coordinate()?);
        // A colour or a normal has three numbers at least, and a texture coordinate two.
        if line.words.clone().count() == 1 {
            return Err(line.problem("has one number after a position"));
        }
        polygons.vertices.push(point);
        polygons.vertex_line_numbers.push(line.line_number);
    }
    for face in 0..faces {
        let mut line = next_line(&mut lines, || format!("face {face} of {faces}"))?;
        let corners: u32 = line.next_number("the number of corners of a face")?;
        for _ in 0..corners {
            let corner = line.next_number("the number of a vertex for each corner of a face")?;
            polygons.corners.push(corner);
        }
        polygons.corner_ends.push(polygons.corners.len());
        polygons.face_line_numbers.push(line.line_number);
    }
    match lines.next() {
        None => Ok(polygons),
        Some(line) => Err(line.problem(&format!(
            "goes on after the {vertices} vertices and {faces} faces that it announces"
        ))),
    }
}

/// Reads the counts of vertices and faces, which follow the keyword on the first line or stand on the next line.
fn read_counts<'a>(
    mut line: Line<'a>,
    lines: &mut impl Iterator<Item = Line<'a>>,
) -> Result<(u64, u64), MeshFault> {
    let keyword = line.words.clone().next().unwrap_or_default();
    if keyword.parse::<u64>().is_err() {
        let Some(prefix) = keyword.strip_suffix("OFF") else {
            return Err(line.problem(&format!("{keyword:?} instead of OFF")));
        };
        // Texture coordinates, colours and normals follow the position and are skipped; a fourth coordinate
        // (4) or a dimension (n) would change the meaning of the position.
        let known = ["", "ST", "C", "N", "STC", "STN", "CN", "STCN", "NC"];
        if !known.contains(&prefix) {
            return Err(MeshFault::unsupported_content(
                format!("{keyword:?}"),
                "OFF in three dimensions",
            ));
        }
        line.words.next();
        match line.words.clone().next() {
            Some(word) if word.eq_ignore_ascii_case("binary") => {
                return Err(MeshFault::unsupported_content("binary OFF", "text"));
            }
            Some(_) => {}
            None => line = next_line(lines, || "the numbers of vertices and faces".into())?,
        }
    }
    let what = "the numbers of vertices and faces";
    let counts = (line.next_number(what)?, line.next_number(what)?);
    // The number of edges may be left out.
    match line.words.clone().nth(1) {
        None => Ok(counts),
        Some(word) => Err(line.problem(&format!(
            "{word:?} after the numbers of vertices, faces and edges"
        ))),
    }
}

fn next_line<'a>(
    lines: &mut impl Iterator<Item = Line<'a>>,
    missing: impl Fn() -> String,
) -> Result<Line<'a>, MeshFault> {
    let line = lines.next();
    line.ok_or_else(|| MeshFault::truncated_file(missing()))
}

/// A line of a text that is not blank, without its comment.
struct Line<'a> {
    words: std::str::SplitWhitespace<'a>,
    line_number: usize,
}

impl Line<'_> {
    fn next_number<T: FromStr>(&mut self, expected: &str) -> Result<T, MeshFault> {
        let word = self.words.next();
        word.and_then(|word| word.parse().ok())
            .ok_or_else(|| match word {
                Some(word) => self.problem(&format!("{word:?} instead of {expected}")),
                None => self.problem(&format!("ends before {expected}")),
            })
    }

    fn problem(&self, problem: &str) -> MeshFault {
        MeshFault::syntax(Some(self.line_number), problem.into())
    }
}
