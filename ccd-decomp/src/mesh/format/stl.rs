//! STL, binary and text.

use super::text;
use crate::mesh::error::MeshFault;
use crate::mesh::polygons::Polygons;
use ccd_core::glam::{DVec3, Vec3};
use std::borrow::Cow;
use std::collections::HashMap;
use std::fmt::Write as _;
use std::io::{self, Cursor, ErrorKind};
use stl_io::Triangle;

const HEADER_BYTES: usize = 80;
const COUNT_BYTES: usize = 4;
const FACET_BYTES: usize = 50;

/// Reads the facets of an STL and welds their corners.
pub(super) fn parse(bytes: &[u8]) -> Result<Polygons, MeshFault> {
    if bytes.is_empty() {
        return Err(MeshFault::NoVertices);
    }
    if is_whole(bytes) {
        return parse_binary(bytes);
    }
    let plain = text::plain(bytes);
    if is_text(&plain) {
        parse_text(&String::from_utf8_lossy(&plain))
    } else {
        parse_binary(bytes)
    }
}

/// Returns whether a file has the length of a binary one with the number of facets that it announces.
fn is_whole(bytes: &[u8]) -> bool {
    announced(bytes).is_some_and(|facets| {
        (bytes.len() - HEADER_BYTES - COUNT_BYTES) as u64 == facets as u64 * FACET_BYTES as u64
    })
}

/// Returns whether a file is a text. Many programs begin a binary file with `solid`, too; only a text has no
/// zero byte.
fn is_text(plain: &[u8]) -> bool {
    let first = plain.trim_ascii_start();
    let solid = first.len() >= 5 && first[..5].eq_ignore_ascii_case(b"solid");
    solid && !plain.contains(&0)
}

/// Reads the number of facets that a binary file announces.
fn announced(bytes: &[u8]) -> Option<u32> {
    let count = bytes.get(HEADER_BYTES..HEADER_BYTES + COUNT_BYTES)?;
    Some(u32::from_le_bytes(count.try_into().ok()?))
}

fn parse_binary(bytes: &[u8]) -> Result<Polygons, MeshFault> {
    let Some(facets) = announced(bytes) else {
        let missing = "the header of 84 bytes".into();
        return Err(MeshFault::Truncated { missing });
    };
    let room = (bytes.len() - HEADER_BYTES - COUNT_BYTES) / FACET_BYTES;
    if room < facets as usize {
        let missing = format!("facet {room} of the {facets} that it announces");
        return Err(MeshFault::Truncated { missing });
    }
    if room > facets as usize {
        let problem = format!("announces {facets} facets, but has room for {room}");
        return Err(MeshFault::syntax(None, problem));
    }
    // The header may hold anything; a blank one keeps the library from taking the file for text.
    let mut blank = bytes.to_vec();
    blank[..HEADER_BYTES].fill(0);
    collect(blank, |facet, error| {
        MeshFault::syntax(None, format!("facet {facet}: {error}"))
    })
}

/// Reads a text of one or more solids.
///
/// `stl_io` stops at the end of the first solid, and needs a name after `solid` and finite normals. It is
/// therefore given all facets as one solid with blank normals.
fn parse_text(text: &str) -> Result<Polygons, MeshFault> {
    let mut one_solid = String::with_capacity(text.len() + 32);
    one_solid.push_str("solid all\n");
    let (mut facet_lines, mut last) = (Vec::new(), "");
    for (number, line) in (1..).zip(text.lines()) {
        let lower: Cow<'_, str> = if line.bytes().any(|b| b.is_ascii_uppercase()) {
            line.to_ascii_lowercase().into()
        } else {
            line.into()
        };
        let mut words = lower.split_whitespace();
        let Some(first) = words.next() else { continue };
        match (first, words.next()) {
            ("solid" | "endsolid", _) => {}
            ("facet", Some("normal")) => {
                facet_lines.push(number);
                one_solid.push_str("facet normal 0 0 0\n");
            }
            ("vertex", _) if let Some(word) = not_finite(&lower) => {
                let facet = facet_lines.len().saturating_sub(1);
                let problem = format!("facet {facet}: {word:?} instead of a finite coordinate");
                return Err(MeshFault::syntax(Some(number), problem));
            }
            _ => {
                let _ = writeln!(one_solid, "{lower}");
            }
        }
        last = if first == "endsolid" {
            "endsolid\n"
        } else {
            ""
        };
    }
    one_solid.push_str(last);
    let facets = facet_lines.len();
    let mut polygons = collect(one_solid.into_bytes(), |facet, error| {
        if error.kind() == ErrorKind::UnexpectedEof {
            let missing = if facet < facets {
                format!("facet {facet}")
            } else {
                "the last solid".into()
            };
            return MeshFault::Truncated { missing };
        }
        let line = facet_lines.get(facet).copied();
        MeshFault::syntax(line, format!("facet {facet}: {error}"))
    })?;
    polygons.face_lines = facet_lines;
    Ok(polygons)
}

/// Finds the first number of a line that is NaN or infinite.
fn not_finite(line: &str) -> Option<&str> {
    let infinite = |word: &&str| word.parse::<f32>().is_ok_and(|x| !x.is_finite());
    line.split_whitespace().find(infinite)
}

/// Runs the library; `fault` translates an error at a facet.
fn collect(
    bytes: Vec<u8>,
    fault: impl Fn(usize, io::Error) -> MeshFault,
) -> Result<Polygons, MeshFault> {
    let mut cursor = Cursor::new(bytes);
    let facets = stl_io::create_stl_reader(&mut cursor).map_err(|error| fault(0, error))?;
    let mut polygons = Polygons::default();
    let mut numbers = HashMap::new();
    for (k, facet) in facets.enumerate() {
        let Triangle { vertices, .. } = facet.map_err(|error| fault(k, error))?;
        for corner in vertices {
            // Adding 0 makes −0 the same point as 0.
            let key = corner.0.map(|x| (x + 0.0).to_bits());
            let next = polygons.vertices.len();
            let number = *numbers.entry(key).or_insert(next);
            if number == next {
                let point: DVec3 = Vec3::from_array(corner.0).as_dvec3();
                polygons.vertices.push(point);
            }
            polygons.corners.push(number as i64);
        }
        polygons.ends.push(polygons.corners.len());
    }
    Ok(polygons)
}
