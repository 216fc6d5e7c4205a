//! The reader of PLY, binary and text. It uses the crate `ply-rs-bw`, and checks what that crate ignores.

use super::text;
use crate::mesh::error::MeshFault;
use crate::mesh::polygons::Polygons;
use ccd_core::glam::DVec3;
use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{
    ElementDef, Encoding, Header, Property, PropertyAccess, PropertyAccessResult, PropertyType,
    ScalarType,
};
use std::borrow::Cow;
use std::collections::HashSet;
use std::io::ErrorKind;

/// Reads the vertices, faces and strips of a PLY.
pub(super) fn parse(bytes: &[u8]) -> Result<Polygons, MeshFault> {
    if bytes.is_empty() {
        return Err(MeshFault::NoVertices);
    }
    let bytes = &text_cr_to_lf(bytes);
    check_unique_names(bytes)?;
    let mut reader = Reader::new(&bytes[..]);
    let header = Parser::<PlyVertexOrFace>::new()
        .read_header(&mut reader)
        .map_err(|error| fault(&error, Encoding::Ascii))?;
    check_header(&header, bytes.len())?;
    let fault = |error: ParseError| fault(&error, header.encoding);
    let (payload, first_line) = (*reader.get_ref(), reader.line());
    let mut polygons = Polygons::default();
    for element in header.elements.values() {
        let read: Vec<PlyVertexOrFace> = Parser::new()
            .read_payload_for_element(&mut reader, element, &header)
            .map_err(fault)?;
        match element.name.as_str() {
            "vertex" => polygons.vertices = read.into_iter().map(|vertex| vertex.point).collect(),
            FACE_ELEMENT_NAME => {
                read.into_iter()
                    .for_each(|face| polygons.push_face(face.corners));
            }
            STRIPS_ELEMENT_NAME => {
                let strips = read
                    .iter()
                    .flat_map(|strip| strip_triangles(&strip.corners));
                strips.for_each(|triangle| polygons.push_face(triangle));
            }
            other => {
                let remarks = &mut polygons.remarks;
                remarks.add_skipped("elements", other, element.count, None);
            }
        }
    }
    check_no_trailing_bytes(reader.get_ref())?;
    if header.encoding == Encoding::Ascii {
        check_values_per_line(payload, first_line, &header)?;
    }
    Ok(polygons)
}

/// The name of the element that holds polygons.
const FACE_ELEMENT_NAME: &str = "face";
/// The name of the element that holds triangle strips, as scanners write them.
const STRIPS_ELEMENT_NAME: &str = "tristrips";

/// Returns the triangles of a strip in a common orientation: every second triangle is reversed. An index of −1 begins
/// another strip.
fn strip_triangles(strip: &[i64]) -> impl Iterator<Item = [i64; 3]> {
    let runs = strip.split(|&corner| corner == -1);
    let triangles = runs.flat_map(|run| run.array_windows().enumerate());
    triangles.map(|(k, &[a, b, c])| if k % 2 == 0 { [a, b, c] } else { [b, a, c] })
}

/// Converts lone carriage returns to line feeds, except in a binary payload.
fn text_cr_to_lf(bytes: &[u8]) -> Cow<'_, [u8]> {
    const END_HEADER: &[u8] = b"end_header\r";
    let end = bytes
        .windows(END_HEADER.len())
        .position(|window| window == END_HEADER);
    match (bytes, end.map(|end| end + END_HEADER.len())) {
        ([b'p', b'l', b'y', b'\r', next, ..], Some(end)) if *next != b'\n' => {
            let mut header = text::lone_cr_to_lf(bytes[..end].into()).into_owned();
            let is_text = header.windows(12).any(|window| window == b"format ascii");
            if is_text {
                header.extend_from_slice(&text::lone_cr_to_lf(bytes[end..].into()));
            } else {
                header.extend_from_slice(&bytes[end..]);
            }
            header.into()
        }
        _ => bytes.into(),
    }
}

/// Checks that the names of elements are unique, and the names of properties within each element. The library keeps
/// only the last of equal names.
fn check_unique_names(bytes: &[u8]) -> Result<(), MeshFault> {
    let (mut elements, mut properties) = (HashSet::new(), HashSet::new());
    for (number, line) in (1..).zip(bytes.split(|&byte| byte == b'\n')) {
        let line = String::from_utf8_lossy(line);
        let mut words = line.split_whitespace();
        let (kind, name, names) = match words.next() {
            Some("end_header") => break,
            Some("element") => {
                properties.clear();
                ("element", words.next(), &mut elements)
            }
            Some("property") => ("property", words.next_back(), &mut properties),
            Some("format") if words.clone().nth(1) != Some("1.0") => {
                return Err(MeshFault::unsupported_content(
                    format!("{line:?}"),
                    "PLY 1.0",
                ));
            }
            _ => continue,
        };
        if let Some(name) = name
            && !names.insert(name.to_owned())
        {
            let problem = format!("a second {kind} {name:?}; give each a name of its own");
            return Err(MeshFault::syntax(Some(number), problem));
        }
    }
    Ok(())
}

/// Checks that the file has no bytes after the last element.
fn check_no_trailing_bytes(rest: &[u8]) -> Result<(), MeshFault> {
    if rest.trim_ascii().is_empty() {
        Ok(())
    } else {
        let more = rest.len();
        let problem = format!("has {more} bytes more than its header announces");
        Err(MeshFault::malformed_content(problem))
    }
}

/// Checks that no text line has more numbers than properties, because the library skips further numbers.
fn check_values_per_line(payload: &[u8], first: usize, header: &Header) -> Result<(), MeshFault> {
    let mut lines = (first..).zip(payload.split(|&byte| byte == b'\n'));
    for element in header.elements.values() {
        for (number, line) in lines.by_ref().take(element.count) {
            let line = String::from_utf8_lossy(line);
            let mut words = line.split_whitespace();
            for property in element.properties.values() {
                let listed = match property.data_type {
                    PropertyType::Scalar(_) => {
                        words.next();
                        continue;
                    }
                    PropertyType::List(..) => words.next().and_then(|count| count.parse().ok()),
                };
                words.by_ref().take(listed.unwrap_or(0)).for_each(drop);
            }
            if let Some(word) = words.next() {
                let problem = format!("{word:?} follows the last property of {:?}", element.name);
                return Err(MeshFault::syntax(Some(number), problem));
            }
        }
    }
    Ok(())
}

/// Checks that the header describes points and polygons, and announces no more elements than the file has bytes.
/// Elements without properties take no bytes.
fn check_header(header: &Header, bytes: usize) -> Result<(), MeshFault> {
    for element in header.elements.values() {
        if element.count > bytes {
            let missing = format!("all {} elements {:?}", element.count, element.name);
            return Err(MeshFault::truncated_file(missing));
        }
    }
    let Some(vertex) = header.elements.get("vertex") else {
        return Err(MeshFault::NoVertices);
    };
    for coordinate in ["x", "y", "z"] {
        check_has_property(vertex, &[coordinate], "a number", |kind| {
            matches!(kind, PropertyType::Scalar(_))
        })?;
    }
    let names = [FACE_ELEMENT_NAME, STRIPS_ELEMENT_NAME];
    let mut faces = names
        .iter()
        .filter_map(|&name| header.elements.get(name))
        .peekable();
    if faces.peek().is_none() {
        return Err(MeshFault::NoFaces);
    }
    let is_integers = |kind: &PropertyType| match kind {
        PropertyType::List(_, number) => !matches!(number, ScalarType::Float | ScalarType::Double),
        PropertyType::Scalar(_) => false,
    };
    faces.try_for_each(|element| {
        let names = &CORNER_PROPERTY_NAMES;
        check_has_property(element, names, "a list of integers", is_integers)
    })
}

/// Checks that an element has a property with one of the given names and a given type.
fn check_has_property(
    element: &ElementDef,
    names: &[&str],
    kind: &str,
    is_kind: impl Fn(&PropertyType) -> bool,
) -> Result<(), MeshFault> {
    let mut found = names
        .iter()
        .filter_map(|&name| element.properties.get(name));
    let element = &element.name;
    let problem = match found.next() {
        None => {
            let names = names.join(" or ");
            format!("element {element:?} lacks the property {names}")
        }
        Some(property) if !is_kind(&property.data_type) => {
            let name = &property.name;
            format!("property {name:?} of element {element:?} is not {kind}")
        }
        Some(_) => return Ok(()),
    };
    Err(MeshFault::malformed_content(problem))
}

fn fault(error: &ParseError, encoding: Encoding) -> MeshFault {
    let text = error.to_string();
    let line = error.line().filter(|_| encoding == Encoding::Ascii);
    if error.kind() == ErrorKind::UnexpectedEof {
        let prefix = error.line().map(|line| format!("Line {line}: "));
        let problem = text.strip_prefix(prefix.as_deref().unwrap_or_default());
        let problem = problem.unwrap_or(&text).trim_end_matches('.');

        return MeshFault::truncated_file(format!("what its header announces ({problem})"));
    }
    // The library quotes the line; the rest of its message names its own types.
    let quoted = text
        .split("String: '")
        .nth(1)
        .and_then(|rest| rest.split('\'').next());
    let problem = match quoted.map(str::trim) {
        Some(line) if text.contains("element line") => {
            format!("{line:?} does not hold the numbers that the header announces")
        }
        Some(line) => format!("{line:?} is no line of a header"),
        None => text
            .lines()
            .next()
            .unwrap_or_default()
            .trim_end_matches('.')
            .to_owned(),
    };
    MeshFault::syntax(line, problem)
}

/// An element of a PLY: a vertex, a face, a triangle strip, or an element that is skipped. One type stands for all,
/// because the library compiles its readers anew for each type.
struct PlyVertexOrFace {
    point: DVec3,
    corners: Vec<i64>,
}

/// The two usual names of the property that lists the vertex indices of a face or strip.
const CORNER_PROPERTY_NAMES: [&str; 2] = ["vertex_indices", "vertex_index"];

impl PropertyAccess for PlyVertexOrFace {
    fn new() -> Self {
        PlyVertexOrFace {
            point: DVec3::NAN,
            corners: Vec::new(),
        }
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        let coordinate = match name {
            "x" => &mut self.point.x,
            "y" => &mut self.point.y,
            "z" => &mut self.point.z,
            _ if CORNER_PROPERTY_NAMES.contains(&name) => return self.set_corners(property),
            _ => return PropertyAccessResult::Ignored,
        };
        *coordinate = match property {
            Property::Char(v) => v.into(),
            Property::UChar(v) => v.into(),
            Property::Short(v) => v.into(),
            Property::UShort(v) => v.into(),
            Property::Int(v) => v.into(),
            Property::UInt(v) => v.into(),
            Property::Float(v) => v.into(),
            Property::Double(v) => v,
            _ => return PropertyAccessResult::Ignored,
        };
        PropertyAccessResult::Set
    }
}

impl PlyVertexOrFace {
    fn set_corners(&mut self, property: Property) -> PropertyAccessResult {
        self.corners = match property {
            Property::ListChar(list) => list.into_iter().map(i64::from).collect(),
            Property::ListUChar(list) => list.into_iter().map(i64::from).collect(),
            Property::ListShort(list) => list.into_iter().map(i64::from).collect(),
            Property::ListUShort(list) => list.into_iter().map(i64::from).collect(),
            Property::ListInt(list) => list.into_iter().map(i64::from).collect(),
            Property::ListUInt(list) => list.into_iter().map(i64::from).collect(),
            _ => return PropertyAccessResult::Ignored,
        };
        PropertyAccessResult::Set
    }
}
