//! The reader of STL, binary and text.
//!
//! Without `stl_io`: it stops at the end of the first solid, and refuses solids without a name and normals that
//! are not finite.

use super::text;
use crate::mesh::error::MeshFault;
use crate::mesh::polygons::Polygons;
use ccd_core::glam::Vec3;
use std::borrow::Cow;
use std::collections::HashMap;

const HEADER_BYTES: usize = 80;
const COUNT_BYTES: usize = 4;
const FACET_BYTES: usize = 50;
/// The size of a facet's normal in bytes. It precedes the corners.
const NORMAL_BYTES: usize = 12;

/// Reads the facets of an STL and welds their corners.
pub(super) fn parse(bytes: &[u8]) -> Result<Polygons, MeshFault> {
    if bytes.is_empty() {
        return Err(MeshFault::NoVertices);
    }
    if has_announced_length(bytes) {
        return parse_binary(bytes);
    }
    let plain = text::to_utf8_with_lf(bytes);
    if is_text(&plain) {
        parse_text(&String::from_utf8_lossy(&plain).to_ascii_lowercase())
    } else {
        parse_binary(bytes)
    }
}

/// Returns whether a binary file has the length that its number of facets requires.
fn has_announced_length(bytes: &[u8]) -> bool {
    facet_count(bytes).is_some_and(|facets| {
        (bytes.len() - HEADER_BYTES - COUNT_BYTES) as u64 == facets as u64 * FACET_BYTES as u64
    })
}

/// Returns whether a file is text: it begins with `solid` and has no zero byte. Many programs begin a binary file
/// with `solid`, too.
fn is_text(plain: &[u8]) -> bool {
    let first = plain.trim_ascii_start();
    let solid = first.len() >= 5 && first[..5].eq_ignore_ascii_case(b"solid");
    solid && !plain.contains(&0)
}

/// Reads the number of facets from the header of a binary file.
fn facet_count(bytes: &[u8]) -> Option<u32> {
    let count = bytes.get(HEADER_BYTES..HEADER_BYTES + COUNT_BYTES)?;
    Some(u32::from_le_bytes(count.try_into().ok()?))
}

fn parse_binary(bytes: &[u8]) -> Result<Polygons, MeshFault> {
    let Some(facets) = facet_count(bytes) else {
        return Err(MeshFault::truncated_file("the header of 84 bytes"));
    };
    let content = &bytes[HEADER_BYTES + COUNT_BYTES..];
    let room = content.len() / FACET_BYTES;
    if room < facets as usize {
        let missing = format!("facet {room} of the {facets} that it announces");
        return Err(MeshFault::truncated_file(missing));
    }
    if room > facets as usize {
        let problem = format!("announces {facets} facets, but has room for {room}");
        return Err(MeshFault::malformed_content(problem));
    }
    let mut facets = Facets::default();
    for facet in content.as_chunks::<FACET_BYTES>().0 {
        let coordinates = facet[NORMAL_BYTES..].as_chunks().0;
        for corner in coordinates.as_chunks::<3>().0 {
            facets.add_corner(corner.map(f32::from_le_bytes));
        }
    }
    Ok(facets.polygons)
}

/// The keywords of the seven lines that describe a facet in a text STL, in order.
const FACET_KEYWORDS: [&[&str]; 7] = [
    &["facet", "normal"],
    &["outer", "loop"],
    &["vertex"],
    &["vertex"],
    &["vertex"],
    &["endloop"],
    &["endfacet"],
];

/// Reads the facets of a text STL, which may hold several solids. The text is in lower case. `end solid`, `end facet` and
/// `end loop` are read as one word.
fn parse_text(text: &str) -> Result<Polygons, MeshFault> {
    let mut facets = Facets::default();
    // The number of statements of the current facet that were read.
    let mut done = 0;
    let mut is_closed = false;
    for (number, line) in (1..).zip(text.lines()) {
        let line = joined_end(line);
        let mut words = line.split_whitespace();
        let Some(first) = words.clone().next() else {
            continue;
        };
        is_closed = first == "endsolid";
        if done == 0 && (is_closed || first == "solid") {
            continue;
        }
        let facet = facets.polygons.corner_ends.len();
        let problem =
            |problem| MeshFault::syntax(Some(number), format!("facet {facet}: {problem}"));
        let is_expected = FACET_KEYWORDS[done]
            .iter()
            .all(|&word| words.next() == Some(word));
        let numbers: Vec<&str> = words.collect();
        let is_vertex = FACET_KEYWORDS[done] == ["vertex"];
        if !is_expected || done > 0 && numbers.len() != if is_vertex { 3 } else { 0 } {
            let expected = FACET_KEYWORDS[done].join(" ");
            return Err(problem(format!(
                "{:?} instead of {expected:?}",
                line.trim()
            )));
        }
        if is_vertex {
            let mut corner = [0.0; 3];
            for (coordinate, word) in corner.iter_mut().zip(numbers) {
                let number = word.parse().ok().filter(|x: &f32| x.is_finite());
                *coordinate = number
                    .ok_or_else(|| problem(format!("{word:?} instead of a finite coordinate")))?;
            }
            facets.add_corner(corner);
        } else if done == 0 {
            facets.polygons.face_line_numbers.push(number);
        }
        done = (done + 1) % FACET_KEYWORDS.len();
    }
    let missing = match (done, is_closed) {
        (0, true) => return Ok(facets.polygons),
        (0, false) => String::from("the last solid"),
        _ => format!("facet {}", facets.polygons.face_line_numbers.len() - 1),
    };
    Err(MeshFault::truncated_file(missing))
}

/// Returns a line that begins with `end` and another word with both as one word.
fn joined_end(line: &str) -> Cow<'_, str> {
    match line.trim_start().strip_prefix("end") {
        Some(rest) if rest.starts_with([' ', '\t']) => format!("end{}", rest.trim_start()).into(),
        _ => line.into(),
    }
}

/// The facets read so far, as triangles over welded vertices. Corners at exactly the same point become one vertex.
#[derive(Default)]
struct Facets {
    polygons: Polygons,
    numbers: HashMap<[u32; 3], usize>,
}

impl Facets {
    fn add_corner(&mut self, corner: [f32; 3]) {
        let polygons = &mut self.polygons;
        // Adding 0 makes −0 the same point as 0.
        let key = corner.map(|x| (x + 0.0).to_bits());
        let next = polygons.vertices.len();
        let number = *self.numbers.entry(key).or_insert(next);
        if number == next {
            polygons.vertices.push(Vec3::from_array(corner).as_dvec3());
        }
        polygons.corners.push(number as i64);
        if polygons.corners.len().is_multiple_of(3) {
            polygons.corner_ends.push(polygons.corners.len());
        }
    }
}
