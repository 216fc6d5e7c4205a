//! The reader of COLLADA 1.4 and 1.5.
//!
//! The crate `dae-parser` is not used: it refuses every file of version 1.5, and files without a date, together a quarter of
//! the files that come with robots; and it reads numbers in f32.

mod geometry;
mod nodes;
mod transform;

use crate::mesh::content::allowance::ExpansionBudget;
use crate::mesh::content::assembly::Assembly;
use crate::mesh::content::{Content, Geometry};
use crate::mesh::error::MeshFault;
use crate::mesh::remark::Remarks;
use crate::mesh::unit::Unit;
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
    let version = root.attribute("version").unwrap_or("1.4");
    if !["1.4", "1.5"]
        .iter()
        .any(|known| version.starts_with(known))
    {
        let content = format!("COLLADA of version {version:?}");
        return Err(MeshFault::unsupported_content(
            content,
            "COLLADA 1.4 or 1.5",
        ));
    }
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
    let unit = read_unit(root)?;
    traversal.read_scene(root)?;
    Ok(Content {
        unit: Some(unit),
        part_names: traversal.part_names,
        geometry: Geometry::Assembly(traversal.assembly),
    })
}

/// Reads the unit of a document, which is the metre if none is stated. Programs store its length in f32, too.
fn read_unit(root: Node<'_, '_>) -> Result<Unit, MeshFault> {
    let asset = child_named(root, "asset");
    let units = root
        .descendants()
        .filter(|element| element.tag_name().name() == "unit");
    let unit = asset.and_then(|asset| child_named(asset, "unit"));
    let is_other = |element: &Node<'_, '_>| {
        element.parent() != asset
            && element
                .parent()
                .is_some_and(|parent| parent.tag_name().name() == "asset")
    };
    if let Some(other) = units.into_iter().find(is_other) {
        return Err(fault_at(
            other,
            "is of a single element; give the document one unit",
        ));
    }
    let Some(unit) = unit.filter(|unit| unit.has_attribute("meter")) else {
        return Ok(Unit::Metre);
    };
    let text = unit.attribute("meter").unwrap_or_default();
    let metres: f64 = text.trim().parse().unwrap_or(f64::NAN);
    let known = [
        (1.0, Unit::Metre),
        (0.01, Unit::Centimetre),
        (0.001, Unit::Millimetre),
        (1e-6, Unit::Micrometre),
        (0.0254, Unit::Inch),
        (0.3048, Unit::Foot),
    ];
    let is_same = |length: f64| (metres - length).abs() <= f64::from(f32::EPSILON) * length;
    let same = known.into_iter().find(|(length, _)| is_same(*length));
    same.map(|(_, unit)| unit).ok_or_else(|| {
        fault_at(
            unit,
            format!("is {text:?} metres, none of um, mm, cm, m, in and ft"),
        )
    })
}

/// The elements of a document by their ids; `None` for an id that several elements have.
type ElementsById<'a, 'd> = HashMap<&'a str, Option<Node<'a, 'd>>>;

fn elements_by_id<'a, 'd>(root: Node<'a, 'd>) -> ElementsById<'a, 'd> {
    let mut elements = HashMap::new();
    for element in root.descendants() {
        if let Some(id) = element.attribute("id") {
            let found = elements.entry(id).or_insert(Some(element));
            if *found != Some(element) {
                *found = None;
            }
        }
    }
    elements
}

/// Returns the element that an attribute of another one names as `#id`, which has to be of a kind.
fn referred_element<'a, 'd>(
    elements: &ElementsById<'a, 'd>,
    from: Node<'_, '_>,
    attribute: &str,
    kinds: &[&str],
) -> Result<Node<'a, 'd>, MeshFault> {
    let Some(name) = from.attribute(attribute) else {
        return Err(fault_at(from, format!("has no {attribute}")));
    };
    let Some(id) = name.strip_prefix('#') else {
        return Err(MeshFault::unsupported_content(
            format!("{name:?} in another file"),
            "a document with all that it shows",
        ));
    };
    let problem = match elements.get(id) {
        Some(Some(found)) if kinds.contains(&found.tag_name().name()) => return Ok(*found),
        Some(None) => format!("names {name:?}, which several elements are"),
        _ => format!("names {name:?}, which is no {}", kinds.join(" or ")),
    };
    Err(fault_at(from, problem))
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

/// Returns the line of an element in the text, by counting all lines before it.
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

/// Reads all numbers in the text of an element, on both sides of comments too. It has no elements in it.
fn numbers<T: FromStr>(element: Node<'_, '_>) -> Result<Vec<T>, MeshFault> {
    if element.first_element_child().is_some() {
        return Err(fault_at(element, "has elements among its numbers"));
    }
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
