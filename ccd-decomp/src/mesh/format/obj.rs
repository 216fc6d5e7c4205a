//! The reader of Wavefront OBJ.
//!
//! Without `tobj`: it numbers vertices by first use and object by object, does not say where an error is, and took
//! more code around it than the statements `v` and `f` take.

use crate::mesh::content::{Content, Geometry};
use crate::mesh::error::MeshFault;
use crate::mesh::polygons::Polygons;
use crate::mesh::remark::{DIVIDED_VERTICES, Remarks};
use ccd_core::glam::DVec3;
use std::borrow::Cow;
use std::collections::HashMap;

/// Reads the vertices, faces and groups of an OBJ.
pub(super) fn parse(bytes: &[u8]) -> Result<Content, MeshFault> {
    let text = String::from_utf8_lossy(bytes);
    let mut file = ObjReader::default();
    let mut lines = (1..).zip(text.lines());
    // Whether this line may continue one that was passed over.
    let mut continues = false;
    while let Some((number, line)) = lines.next() {
        let statement = strip_comment(line);
        let may_continue = std::mem::replace(&mut continues, statement.ends_with('\\'));
        match statement.split_whitespace().next().unwrap_or_default() {
            keyword @ ("v" | "f") => {
                continues = false;
                let statement =
                    join_continued_lines(statement, lines.by_ref().map(|(_, line)| line));
                if keyword == "v" {
                    file.add_vertex(&statement, number)?;
                } else {
                    file.add_face(&statement, number)?;
                }
            }
            "o" => file.objects.set_current_name(name_after_keyword(line)),
            "g" => file.groups.set_current_name(name_after_keyword(line)),
            "" => {}
            word if may_continue && word.parse::<f64>().is_ok() => {}
            other => remark_on_skipped_statement(other, number, &mut file.polygons.remarks)
                .map_err(|fault| fault.at_element(format!("line {number}")))?,
        }
    }
    file.into_content()
}

fn strip_comment(line: &str) -> &str {
    line.split('#').next().unwrap_or_default().trim()
}

/// Joins a statement with the lines that continue it. A line that ends in a backslash continues on the next one.
fn join_continued_lines<'a>(
    statement: &'a str,
    mut lines: impl Iterator<Item = &'a str>,
) -> Cow<'a, str> {
    let mut statement = Cow::from(statement);
    while statement.ends_with('\\') {
        let next = strip_comment(lines.next().unwrap_or_default());
        statement.to_mut().pop();
        statement.to_mut().extend([" ", next]);
    }
    statement
}

/// The state of a reader: the content of the file up to the current line.
#[derive(Default)]
struct ObjReader {
    polygons: Polygons,
    objects: NamedGroups,
    groups: NamedGroups,
    /// The first face corner whose vertex number is 0 or counts back beyond the first vertex: its face, and that
    /// number.
    first_invalid_vertex_reference: Option<(usize, i64)>,
}

impl ObjReader {
    /// Adds a vertex from a `v` statement. A fourth number divides the coordinates; three or more further numbers are
    /// a colour.
    fn add_vertex(&mut self, statement: &str, line: usize) -> Result<(), MeshFault> {
        let problem = |what| MeshFault::syntax(Some(line), format!("{statement:?} {what}"));
        let mut words = statement.split_whitespace().skip(1);
        let mut number = || words.next()?.parse::<f64>().ok();
        let mut point = DVec3::ZERO;
        for axis in 0..3 {
            let what = "does not hold the three coordinates of a vertex";
            point[axis] = number().ok_or_else(|| problem(what))?;
        }
        match (words.next(), words.count()) {
            (Some(weight), 0) => {
                let weight = weight.parse::<f64>().ok().filter(|&weight| weight != 0.0);
                let weight = weight.ok_or_else(|| problem("divides a position by no number"))?;
                if weight != 1.0 {
                    let remarks = &mut self.polygons.remarks;
                    remarks.add(DIVIDED_VERTICES, 1, Some(line));
                }
                point /= weight;
            }
            (Some(_), 1) => return Err(problem("has two numbers after a position")),
            (Some(_), 4..) => return Err(problem("has more numbers than a position and a colour")),
            _ => {}
        }
        self.polygons.vertices.push(point);
        self.polygons.vertex_line_numbers.push(line);
        Ok(())
    }

    /// Adds a face from an `f` statement. Negative numbers count back from the last vertex before it.
    fn add_face(&mut self, statement: &str, line: usize) -> Result<(), MeshFault> {
        let polygons = &mut self.polygons;
        for corner in statement.split_whitespace().skip(1) {
            let vertex = vertex_number(corner).ok_or_else(|| {
                let what = "instead of the number of a vertex in";
                MeshFault::syntax(Some(line), format!("{corner:?} {what} {statement:?}"))
            })?;
            let place = if vertex < 0 {
                polygons.vertices.len() as i64 + vertex
            } else {
                vertex - 1
            };
            if place < 0 {
                self.first_invalid_vertex_reference
                    .get_or_insert((polygons.corner_ends.len(), vertex));
            }
            polygons.corners.push(place);
        }
        polygons.corner_ends.push(polygons.corners.len());
        polygons.face_line_numbers.push(line);
        self.objects.add_face();
        self.groups.add_face();
        Ok(())
    }

    /// Checks that all face corners name existing vertices, and returns the content.
    fn into_content(self) -> Result<Content, MeshFault> {
        let polygons = &self.polygons;
        let vertices = polygons.vertices.len();
        let beyond = polygons.corners.iter().position(|&v| v >= vertices as i64);
        let beyond = beyond.map(|at| {
            let face = polygons.corner_ends.partition_point(|&end| end <= at);
            (face, polygons.corners[at] + 1)
        });
        let missing = self
            .first_invalid_vertex_reference
            .into_iter()
            .chain(beyond);
        match missing.min_by_key(|&(face, _)| face) {
            _ if vertices == 0 => return Err(MeshFault::NoVertices),
            None => {}
            Some((face, vertex)) => {
                return Err(MeshFault::NoSuchVertex {
                    face,
                    line: polygons.face_line_numbers.get(face).copied(),
                    vertex,
                    vertices,
                    first_vertex_number: 1,
                });
            }
        }
        let labels = if self.objects.has_names() {
            self.objects
        } else {
            self.groups
        };
        Ok(Content {
            unit: None,
            part_names: labels.names,
            geometry: Geometry::FaceList(self.polygons, labels.group_of_face),
        })
    }
}

/// Returns the vertex number of a face corner such as `1/2/3`. It is 0 if the corner has no vertex, as in `/1/2`;
/// `None` if the text is no corner.
fn vertex_number(corner: &str) -> Option<i64> {
    let mut numbers = corner.split('/').map(|number| match number {
        "" => Some(0),
        number => number.parse().ok(),
    });
    let vertex = numbers.next()??;
    let rest_is_valid = numbers.by_ref().take(2).all(|number| number.is_some());
    (rest_is_valid && numbers.next().is_none()).then_some(vertex)
}

/// The groups of faces that one keyword defines: the objects (`o`) or the groups (`g`). They are numbered by their
/// first face.
#[derive(Default)]
struct NamedGroups {
    names: Vec<Option<String>>,
    /// For each face, the number of its group.
    group_of_face: Vec<u32>,
    /// The number of each group, by its name.
    number_by_name: HashMap<Option<String>, u32>,
    current_name: Option<String>,
}

impl NamedGroups {
    fn set_current_name(&mut self, name: &str) {
        self.current_name = (!name.is_empty()).then(|| name.to_owned());
    }

    fn add_face(&mut self) {
        let number = match self.number_by_name.get(&self.current_name) {
            Some(&number) => number,
            None => {
                let number = self.names.len() as u32;
                self.names.push(self.current_name.clone());
                self.number_by_name
                    .insert(self.current_name.clone(), number);
                number
            }
        };
        self.group_of_face.push(number);
    }

    /// Returns whether any face is in a group with a name.
    fn has_names(&self) -> bool {
        self.names.iter().any(Option::is_some)
    }
}

/// Returns the name after a keyword, without a comment. A comment begins at a `#` after a space, because names such
/// as `lid#2` are common.
fn name_after_keyword(statement: &str) -> &str {
    let statement = statement.trim_start();
    let name = statement.get(1..).unwrap_or_default();
    let comment = name.match_indices('#').find(|(at, _)| {
        let before = &name[..*at];
        before.is_empty() || before.ends_with(char::is_whitespace)
    });
    name[..comment.map_or(name.len(), |(at, _)| at)].trim()
}

/// The keywords of statements that are skipped without a remark, because they do not affect the shape: normals, texture
/// coordinates, materials, curve and display settings.
const HARMLESS_KEYWORDS: &str = "vn vt vp s mg usemtl mtllib usemap maplib bevel c_interp d_interp lod shadow_obj trace_obj \
                        ctech stech cstype deg bmat step parm trim hole scrv curv2 sp end con res";

/// Skips a statement, and adds a remark unless its keyword is harmless.
///
/// # Errors
/// The statement may define faces.
fn remark_on_skipped_statement(
    keyword: &str,
    line: usize,
    remarks: &mut Remarks,
) -> Result<(), MeshFault> {
    match keyword {
        "surf" | "bsp" | "bzp" | "cdp" => {
            return Err(MeshFault::unsupported_content(
                "a free-form surface",
                "polygons",
            ));
        }
        "call" | "csh" => {
            return Err(MeshFault::unsupported_content(
                "a call of another file",
                "one file",
            ));
        }
        "l" => remarks.add("lines passed over", 1, Some(line)),
        "p" => remarks.add("points passed over", 1, Some(line)),
        "curv" | "cdc" => remarks.add("curves passed over", 1, Some(line)),
        _ if HARMLESS_KEYWORDS.split(' ').any(|word| word == keyword) => {}
        "V" | "F" => {
            let known = keyword.to_ascii_lowercase();
            let problem = format!("{keyword:?} instead of {known:?}");
            return Err(MeshFault::malformed_content(problem));
        }
        other => remarks.add_skipped("statements", other, 1, Some(line)),
    }
    Ok(())
}
