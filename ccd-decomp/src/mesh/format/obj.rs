//! Wavefront OBJ.

use crate::mesh::content::groups::Groups;
use crate::mesh::content::{Content, Layout};
use crate::mesh::error::MeshFault;
use crate::mesh::polygons::Polygons;
use crate::mesh::remark::Remarks;
use ccd_core::glam::DVec3;
use std::borrow::Cow;
use std::collections::HashMap;
use std::fmt::Write as _;
use std::io::{BufRead, Read};
use tobj::{LoadError, LoadOptions, Mesh};

/// Reads the vertices, faces and groups of an OBJ.
///
/// `tobj` numbers vertices by first use and object by object, and does not report the place of an error. It is
/// therefore given the `v` and `f` statements alone, as one object, and before them one polygon over all
/// vertices in their order, which makes its numbers those of the file. The number of bytes that it has read
/// when it fails gives the line.
pub(super) fn parse(bytes: &[u8]) -> Result<Content, MeshFault> {
    let text = String::from_utf8_lossy(bytes);
    let statements = Statements::new(&text)?;
    let vertices = statements.vertex_lines.len();
    if vertices == 0 {
        return Err(MeshFault::NoVertices);
    }
    let mut pin = String::from("f");
    for vertex in 1..=vertices {
        let _ = write!(pin, " {vertex}");
    }
    pin.push('\n');
    let mut reader = pin.as_bytes().chain(statements.text.as_bytes());
    let mesh = load(&mut reader).map_err(|error| {
        let unread = reader.get_ref().1.len();
        statements.fault(error, statements.text.len() - unread)
    })?;
    let groups = if statements.objects.is_used() {
        statements.objects.groups()
    } else {
        statements.groups.groups()
    };
    let mut polygons = Polygons {
        vertices: mesh
            .positions
            .chunks_exact(3)
            .map(DVec3::from_slice)
            .collect(),
        corners: mesh.indices[vertices..].iter().map(|&v| v.into()).collect(),
        vertex_lines: statements.vertex_lines,
        face_lines: statements.face_lines,
        ..Polygons::default()
    };
    // The library leaves the list out when all polygons, the first included, are triangles.
    let mut end = 0;
    polygons
        .ends
        .extend((0..polygons.face_lines.len()).map(|k| {
            end += mesh.face_arities.get(k + 1).map_or(3, |&n| n as usize);
            end
        }));
    Ok(Content {
        unit: None,
        layout: Layout::List(polygons, groups),
        remarks: statements.remarks,
    })
}

fn load(reader: &mut impl BufRead) -> Result<Mesh, LoadError> {
    let no_materials = |_: &_| Err(LoadError::OpenFileFailed);
    let (mut models, _) = tobj::load_obj_buf(reader, &LoadOptions::default(), no_materials)?;
    models
        .pop()
        .map(|model| model.mesh)
        .ok_or(LoadError::GenericFailure)
}

/// The `v` and `f` statements of a file, one per line, with the lines of the file that they stood on.
#[derive(Default)]
struct Statements {
    text: String,
    vertex_lines: Vec<usize>,
    face_lines: Vec<usize>,
    objects: Labels,
    groups: Labels,
    remarks: Remarks,
}

/// The names that one keyword gives to faces.
#[derive(Default)]
struct Labels {
    /// The number of each name, from 1, in the order of the file; 0 is that of faces without a name.
    numbers: HashMap<String, u32>,
    now: u32,
    of_face: Vec<u32>,
}

impl Labels {
    fn set(&mut self, name: &str) {
        let next = self.numbers.len() as u32 + 1;
        self.now = match self.numbers.get(name) {
            _ if name.is_empty() => 0,
            Some(&number) => number,
            None => *self.numbers.entry(name.into()).or_insert(next),
        };
    }

    /// Returns whether a face has a name.
    fn is_used(&self) -> bool {
        self.of_face.iter().any(|&label| label > 0)
    }

    /// The labels that faces have, numbered by their first face.
    fn groups(self) -> Groups {
        let mut labels = vec![None; self.numbers.len() + 1];
        for (name, number) in self.numbers {
            labels[number as usize] = Some(name);
        }
        let mut numbers = vec![None; labels.len()];
        let (mut names, mut of_face) = (Vec::new(), self.of_face);
        for label in &mut of_face {
            let known = *label as usize;
            *label = *numbers[known].get_or_insert_with(|| {
                names.push(labels[known].take());
                names.len() as u32 - 1
            });
        }
        Groups { names, of_face }
    }
}

impl Statements {
    fn new(text: &str) -> Result<Self, MeshFault> {
        let mut out = Statements::default();
        out.text.reserve(text.len());
        let mut lines = (1..).zip(text.lines());
        // Whether the line before is one of numbers that goes on.
        let mut goes_on = false;
        while let Some((number, whole)) = lines.next() {
            let mut line = Cow::from(whole.split('#').next().unwrap_or_default().trim());
            let continues = std::mem::replace(&mut goes_on, line.ends_with('\\'));
            let keyword = line.split_whitespace().next().unwrap_or_default();
            match keyword {
                "v" | "f" => goes_on = false,
                "o" => out.objects.set(name(whole)),
                "g" => out.groups.set(name(whole)),
                "" => {}
                number if continues && number.parse::<f64>().is_ok() => {}
                other => {
                    let passed = pass_over(other, number, &mut out.remarks);
                    passed.map_err(|fault| fault.at(format!("line {number}")))?;
                }
            }
            let is_vertex = keyword == "v";
            if !is_vertex && keyword != "f" {
                continue;
            }
            // A backslash at its end continues a line.
            while line.ends_with('\\') {
                let (_, next) = lines.next().unwrap_or_default();
                let next = next.split('#').next().unwrap_or_default().trim();
                line.to_mut().pop();
                line.to_mut().extend([" ", next]);
            }
            if is_vertex {
                out.text.push_str(position(&line, number, &mut out.remarks));
                out.vertex_lines.push(number);
            } else {
                out.text.push_str(&line);
                out.face_lines.push(number);
                for labels in [&mut out.objects, &mut out.groups] {
                    labels.of_face.push(labels.now);
                }
            }
            out.text.push('\n');
        }
        Ok(out)
    }

    /// Translates the library's error, after it has read `read` bytes of the statements.
    fn fault(&self, error: LoadError, read: usize) -> MeshFault {
        if error == LoadError::FaceVertexOutOfBounds
            && let Some(fault) = self.missing_vertex()
        {
            return fault;
        }
        let statement = self.text[..read].lines().count().saturating_sub(1);
        // Statements of both kinds are in the order of their lines.
        let mut lines = [self.vertex_lines.as_slice(), &self.face_lines].concat();
        lines.sort_unstable();
        let problem = match self.text.lines().nth(statement) {
            Some(text) => match no_vertex_number(text) {
                Some(word) => format!("{word:?} instead of the number of a vertex in {text:?}"),
                None => format!("{error} in {text:?}"),
            },
            None => error.to_string(),
        };
        MeshFault::syntax(lines.get(statement).copied(), problem)
    }

    /// Finds the first corner that names no vertex; the library only reports that there is one.
    fn missing_vertex(&self) -> Option<MeshFault> {
        let vertices = self.vertex_lines.len();
        let (mut above, mut face) = (0, 0);
        for statement in self.text.lines() {
            let mut words = statement.split_whitespace();
            if words.next() == Some("v") {
                above += 1;
                continue;
            }
            for word in words {
                // A corner may leave its vertex out, as in `/1/2`; that names none either.
                let number = word.split('/').next().unwrap_or_default();
                let vertex: i64 = number.parse().unwrap_or(0);
                let good = if vertex < 0 {
                    -above..=-1
                } else {
                    1..=vertices as i64
                };
                if !good.contains(&vertex) {
                    return Some(MeshFault::NoSuchVertex {
                        face,
                        line: self.face_lines.get(face).copied(),
                        vertex,
                        vertices,
                        base: 1,
                    });
                }
            }
            face += 1;
        }
        None
    }
}

/// The name after a keyword. A comment begins at a mark after a blank: names such as `lid#2` are common.
fn name(statement: &str) -> &str {
    let statement = statement.trim_start();
    let name = statement.get(1..).unwrap_or_default();
    let comment = name.match_indices('#').find(|(at, _)| {
        let before = &name[..*at];
        before.is_empty() || before.ends_with(char::is_whitespace)
    });
    name[..comment.map_or(name.len(), |(at, _)| at)].trim()
}

/// Finds the first corner of a face that does not begin with a whole number.
fn no_vertex_number(statement: &str) -> Option<&str> {
    let corners = statement.strip_prefix('f')?.split_whitespace();
    let number = |corner: &str| corner.split('/').next().map(str::parse::<i64>);
    corners
        .into_iter()
        .find(|corner| !matches!(number(corner), Some(Ok(_))))
}

/// Statements that change no shape: normals, texture coordinates, materials, settings of curves and of displays.
const HARMLESS: [&str; 30] = [
    "vn",
    "vt",
    "vp",
    "s",
    "mg",
    "usemtl",
    "mtllib",
    "usemap",
    "maplib",
    "bevel",
    "c_interp",
    "d_interp",
    "lod",
    "shadow_obj",
    "trace_obj",
    "ctech",
    "stech",
    "cstype",
    "deg",
    "bmat",
    "step",
    "parm",
    "trim",
    "hole",
    "scrv",
    "curv2",
    "sp",
    "end",
    "con",
    "res",
];

/// Passes over a statement, and remarks upon it unless it is harmless.
///
/// # Errors
/// It would have made faces.
fn pass_over(keyword: &str, line: usize, remarks: &mut Remarks) -> Result<(), MeshFault> {
    let unsupported = |what: &str, instead| {
        Err(MeshFault::Unsupported {
            what: what.to_owned(),
            instead,
        })
    };
    match keyword {
        "surf" | "bsp" | "bzp" | "cdp" => {
            return unsupported("a free-form surface", "polygons");
        }
        "call" | "csh" => return unsupported("a call of another file", "one file"),
        "l" => remarks.add("lines passed over", 1, Some(line)),
        "p" => remarks.add("points passed over", 1, Some(line)),
        "curv" | "cdc" => remarks.add("curves passed over", 1, Some(line)),
        other if HARMLESS.contains(&other) => {}
        other
            if ["v", "f"]
                .iter()
                .any(|known| other.eq_ignore_ascii_case(known)) =>
        {
            let known = other.to_ascii_lowercase();
            let problem = format!("{other:?} instead of {known:?}");
            return Err(MeshFault::syntax(None, problem));
        }
        other => remarks.add_named("statements", other, 1, Some(line)),
    }
    Ok(())
}

/// The position that a statement of a vertex has, with its weight, if any, but without the three or more numbers of a
/// colour that some programs put there.
fn position<'a>(line: &'a str, number: usize, remarks: &mut Remarks) -> &'a str {
    const KEYWORD_AND_POSITION: usize = 4;
    let mut words = line.split_whitespace().skip(KEYWORD_AND_POSITION);
    match (words.next(), words.count()) {
        (Some(weight), 0) => {
            if weight.parse() != Ok(1.0) {
                remarks.add("vertices divided by their fourth number", 1, Some(number));
            }
            line
        }
        // Both are slices of one line, so that their distance is the length to keep.
        (Some(colour), 2..) => &line[..colour.as_ptr().addr() - line.as_ptr().addr()],
        _ => line,
    }
}
