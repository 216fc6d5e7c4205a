//! PLY, binary and text.

use crate::mesh::error::MeshFault;
use crate::mesh::polygons::Polygons;
use ccd_core::glam::DVec3;
use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{
    ElementDef, Encoding, Header, Property, PropertyAccess, PropertyAccessResult, PropertyType,
    ScalarType,
};
use std::io::ErrorKind;

/// Reads the vertices and faces of a PLY.
pub(super) fn parse(bytes: &[u8]) -> Result<Polygons, MeshFault> {
    if bytes.is_empty() {
        return Err(MeshFault::NoVertices);
    }
    let mut reader = Reader::new(bytes);
    let header = Parser::<Element>::new()
        .read_header(&mut reader)
        .map_err(|error| fault(&error, Encoding::Ascii))?;
    check_header(&header, bytes.len())?;
    let fault = |error: ParseError| fault(&error, header.encoding);
    let mut polygons = Polygons::default();
    for element in header.elements.values() {
        let read: Vec<Element> = Parser::new()
            .read_payload_for_element(&mut reader, element, &header)
            .map_err(fault)?;
        match element.name.as_str() {
            "vertex" => polygons.vertices = read.into_iter().map(|vertex| vertex.point).collect(),
            "face" => {
                for face in read {
                    polygons.corners.extend(face.corners);
                    polygons.ends.push(polygons.corners.len());
                }
            }
            _ => {}
        }
    }
    Ok(polygons)
}

/// Checks that the header describes a mesh of points and polygons, and no more elements than the file has bytes: elements without
/// properties take no bytes, and would be read for ever.
fn check_header(header: &Header, bytes: usize) -> Result<(), MeshFault> {
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
    let Some(vertex) = header.elements.get("vertex") else {
        return Err(MeshFault::NoVertices);
    };
    let Some(face) = header.elements.get("face") else {
        return Err(MeshFault::NoFaces);
    };
    for coordinate in ["x", "y", "z"] {
        check_property(vertex, &[coordinate], "a number", |kind| {
            matches!(kind, PropertyType::Scalar(_))
        })?;
    }
    check_property(face, &CORNERS, "a list of integers", |kind| match kind {
        PropertyType::List(_, number) => !matches!(number, ScalarType::Float | ScalarType::Double),
        PropertyType::Scalar(_) => false,
    })
}

/// Checks that an element has a property of one of some names, and of a kind.
fn check_property(
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
    Err(MeshFault::syntax(None, problem))
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

/// An element of a PLY: a vertex, a face, or one that is passed over. A single type, because the library compiles
/// its readers of all kinds of properties anew for each.
struct Element {
    point: DVec3,
    corners: Vec<i64>,
}

/// The names of the property of a face that lists its corners.
const CORNERS: [&str; 2] = ["vertex_indices", "vertex_index"];

impl PropertyAccess for Element {
    fn new() -> Self {
        Element {
            point: DVec3::NAN,
            corners: Vec::new(),
        }
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        let coordinate = match name {
            "x" => &mut self.point.x,
            "y" => &mut self.point.y,
            "z" => &mut self.point.z,
            _ if CORNERS.contains(&name) => return self.set_corners(property),
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

impl Element {
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
