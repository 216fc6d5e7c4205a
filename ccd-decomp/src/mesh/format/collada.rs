//! The reader of COLLADA 1.4 and 1.5.
//!
//! The crate `dae-parser` is not used: it refuses every file of version 1.5, and files without a date, together a quarter of
//! the files that come with robots; and it reads numbers in f32.

mod geometry;
mod nodes;
mod transform;

use crate::mesh::affine::AffineMap;
use crate::mesh::content::allowance::ExpansionBudget;
use crate::mesh::content::assembly::Assembly;
use crate::mesh::content::{Content, Geometry};
use crate::mesh::error::MeshFault;
use crate::mesh::remark::Remarks;
use crate::mesh::unit::Unit;
use ccd_core::glam::{DAffine3, DVec3};
use nodes::SceneTraversal;
use roxmltree::{Document, Node};
use std::collections::HashMap;
use std::str::FromStr;

/// Parses a COLLADA document into an assembly of parts.
pub(super) fn parse(bytes: &[u8]) -> Result<Content, MeshFault> {
    if bytes.is_empty() {
        return Err(MeshFault::NoVertices);
    }
    let text = String::from_utf8_lossy(bytes);
    let document = Document::parse(&text).map_err(|error| {
        let line = error.pos().row as usize;
        MeshFault::syntax(Some(line), format!("is no XML: {error}"))
    })?;
    let root = document.root_element();
    if root.tag_name().name() != "COLLADA" {
        return Err(MeshFault::malformed_content("is no COLLADA document"));
    }
    let unit = read_unit(root)?;
    let mut traversal = SceneTraversal {
        elements_by_id: elements_by_id(root),
        shape_index_by_geometry: HashMap::new(),
        part_names: Vec::new(),
        assembly: Assembly {
            shapes: Vec::new(),
            parts: Vec::new(),
            budget: ExpansionBudget::for_file(bytes.len() as u64),
            remarks: Remarks::default(),
        },
    };
    let (unit, scale) = match unit {
        FileUnit::Known(unit) => (unit, AffineMap::IDENTITY),
        FileUnit::Metres(metres) => {
            let scale = DAffine3::from_scale(DVec3::splat(metres));
            (Unit::Metre, AffineMap::from(scale))
        }
    };
    traversal.read_scene(root, scale)?;
    Ok(Content {
        unit: Some(unit),
        part_names: traversal.part_names,
        geometry: Geometry::Assembly(traversal.assembly),
    })
}

/// The unit that a document states.
enum FileUnit {
    Known(Unit),
    /// Any other length, in metres.
    Metres(f64),
}

fn read_unit(root: Node<'_, '_>) -> Result<FileUnit, MeshFault> {
    let asset = child_named(root, "asset");
    let unit = asset.and_then(|asset| child_named(asset, "unit"));
    let Some(metres) = unit.and_then(|unit| unit.attribute("meter")) else {
        return Ok(FileUnit::Known(Unit::Metre));
    };
    let metres: f64 = match metres.trim().parse() {
        Ok(metres) if metres > 0.0 && metres < f64::INFINITY => metres,
        _ => {
            return Err(MeshFault::malformed_content(format!(
                "has a unit of {metres:?} metres"
            )));
        }
    };
    let known = [
        (1.0, Unit::Metre),
        (0.01, Unit::Centimetre),
        (0.001, Unit::Millimetre),
        (1e-6, Unit::Micrometre),
        (0.0254, Unit::Inch),
        (0.3048, Unit::Foot),
    ];
    let same = known.into_iter().find(|(length, _)| *length == metres);
    Ok(same.map_or(FileUnit::Metres(metres), |(_, unit)| FileUnit::Known(unit)))
}

/// Finds all elements with an id.
fn elements_by_id<'a, 'd>(root: Node<'a, 'd>) -> HashMap<&'a str, Node<'a, 'd>> {
    let elements = root.descendants();
    elements
        .filter_map(|element| Some((element.attribute("id")?, element)))
        .collect()
}

fn child_named<'a, 'd>(element: Node<'a, 'd>, name: &str) -> Option<Node<'a, 'd>> {
    children_named(element, name).next()
}

fn children_named<'a, 'd, 'n>(
    element: Node<'a, 'd>,
    name: &'n str,
) -> impl Iterator<Item = Node<'a, 'd>> + use<'a, 'd, 'n> {
    let children = element.children();
    children.filter(move |child| child.is_element() && child.tag_name().name() == name)
}

/// Returns the line of an element in the text.
fn line_of(element: Node<'_, '_>) -> usize {
    element.document().text_pos_at(element.range().start).row as usize
}

/// Returns a fault of an element, with its line.
fn fault_at(element: Node<'_, '_>, problem: impl Into<String>) -> MeshFault {
    let name = element.tag_name().name();
    MeshFault::syntax(
        Some(line_of(element)),
        format!("<{name}> {}", problem.into()),
    )
}

/// Reads all numbers in the text of an element, on both sides of comments too.
fn numbers<T: FromStr>(element: Node<'_, '_>) -> Result<Vec<T>, MeshFault> {
    let texts = element.children().filter(Node::is_text);
    let words = texts.flat_map(|text| text.text().unwrap_or_default().split_ascii_whitespace());
    let numbers = words.map(|word| {
        let number = word.parse();
        number.map_err(|_| fault_at(element, format!("has {word:?} instead of a number")))
    });
    numbers.collect()
}

/// Reads an attribute that is a whole number.
fn count_attribute(element: Node<'_, '_>, name: &str) -> Result<Option<usize>, MeshFault> {
    let Some(text) = element.attribute(name) else {
        return Ok(None);
    };
    let number = text.trim().parse();
    number
        .map(Some)
        .map_err(|_| fault_at(element, format!("has {name}={text:?}")))
}

#[cfg(test)]
mod tests;
