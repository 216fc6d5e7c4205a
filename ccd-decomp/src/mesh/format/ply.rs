//! PLY, binary and text.

use crate::mesh::error::MeshFault;
use crate::mesh::polygons::Polygons;
use ccd_core::glam::DVec3;
use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{Encoding, Header, Property, PropertyAccess, PropertyAccessResult};
use std::io::ErrorKind;

/// Reads the vertices and faces of a PLY.
pub(super) fn parse(bytes: &[u8]) -> Result<Polygons, MeshFault> {
    if bytes.is_empty() {
        return Err(MeshFault::NoVertices);
    }
    let mut reader = Reader::new(bytes);
    let header = Parser::<Skipped>::new()
        .read_header(&mut reader)
        .map_err(|error| fault(&error, Encoding::Ascii))?;
    check_counts(&header, bytes.len())?;
    let fault = |error: ParseError| fault(&error, header.encoding);
    let mut polygons = Polygons::default();
    for element in header.elements.values() {
        match element.name.as_str() {
            "vertex" => {
                let vertices = Parser::<Vertex>::new()
                    .read_payload_for_element(&mut reader, element, &header)
                    .map_err(fault)?;
                polygons.vertices = vertices.into_iter().map(|v| v.0).collect();
            }
            "face" => {
                let faces = Parser::<Face>::new()
                    .read_payload_for_element(&mut reader, element, &header)
                    .map_err(fault)?;
                for Face(corners) in faces {
                    polygons.corners.extend(corners);
                    polygons.ends.push(polygons.corners.len());
                }
            }
            _ => {
                Parser::<Skipped>::new()
                    .read_payload_for_element(&mut reader, element, &header)
                    .map_err(fault)?;
            }
        }
    }
    Ok(polygons)
}

/// Checks that the header describes a mesh, and no more elements than the file has bytes: elements without
/// properties take no bytes, and would be read for ever.
fn check_counts(header: &Header, bytes: usize) -> Result<(), MeshFault> {
    for element in header.elements.values() {
        if element.count > bytes {
            let missing = format!("all {} elements {:?}", element.count, element.name);
            return Err(MeshFault::Truncated { missing });
        }
    }
    if header.elements.contains_key("tristrips") && !header.elements.contains_key("face") {
        return Err(MeshFault::Unsupported {
            what: "triangle strips".into(),
            instead: "faces",
        });
    }
    let properties = [
        ("vertex", ["x", "y", "z"].as_slice()),
        ("face", &["vertex_indices", "vertex_index"]),
    ];
    for (element, names) in properties {
        let Some(definition) = header.elements.get(element) else {
            return Err(match element {
                "vertex" => MeshFault::NoVertices,
                _ => MeshFault::NoFaces,
            });
        };
        let has = |name: &&&str| definition.properties.contains_key(**name);
        let wanted = if element == "vertex" { names.len() } else { 1 };
        if names.iter().filter(has).count() != wanted {
            let names = names.join(if wanted == 1 { " or " } else { ", " });
            let problem = format!("element {element:?} lacks the property {names}");
            return Err(MeshFault::syntax(None, problem));
        }
    }
    Ok(())
}

fn fault(error: &ParseError, encoding: Encoding) -> MeshFault {
    // The library's messages are several lines, and count elements where there are no lines.
    let mut problem = error.to_string().replace("\n\t", "; ").replace('\n', " ");
    if let Some(line) = error.line() {
        let prefix = format!("Line {line}: ");
        problem = problem.replace(&prefix, "");
    }
    match error.kind() {
        ErrorKind::UnexpectedEof => MeshFault::Truncated {
            missing: format!("what its header announces ({problem})"),
        },
        _ => {
            let line = error.line().filter(|_| encoding == Encoding::Ascii);
            MeshFault::syntax(line, problem)
        }
    }
}

/// An element that is passed over.
struct Skipped;

impl PropertyAccess for Skipped {
    fn new() -> Self {
        Skipped
    }
}

struct Vertex(DVec3);

impl PropertyAccess for Vertex {
    fn new() -> Self {
        Vertex(DVec3::NAN)
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        let coordinate = match name {
            "x" => &mut self.0.x,
            "y" => &mut self.0.y,
            "z" => &mut self.0.z,
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
            _ => return PropertyAccessResult::UnsupportedType,
        };
        PropertyAccessResult::Set
    }
}

struct Face(Vec<i64>);

impl PropertyAccess for Face {
    fn new() -> Self {
        Face(Vec::new())
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        if !matches!(name, "vertex_indices" | "vertex_index") {
            return PropertyAccessResult::Ignored;
        }
        self.0 = match property {
            Property::ListChar(list) => list.into_iter().map(i64::from).collect(),
            Property::ListUChar(list) => list.into_iter().map(i64::from).collect(),
            Property::ListShort(list) => list.into_iter().map(i64::from).collect(),
            Property::ListUShort(list) => list.into_iter().map(i64::from).collect(),
            Property::ListInt(list) => list.into_iter().map(i64::from).collect(),
            Property::ListUInt(list) => list.into_iter().map(i64::from).collect(),
            _ => return PropertyAccessResult::UnsupportedType,
        };
        PropertyAccessResult::Set
    }
}
