//! Polygons that repeat a corner or have a spike cover what they cover without it, in every format that has polygons.

use super::Format;
use crate::exact::predicates::has_zero_area;
use crate::{PieceChoice, TriangleMesh, body_from_mesh};
use ccd_core::Solidity;
use ccd_core::glam::DVec3;

/// The corners of a U, counterclockwise, and points on its outline or in its notch, to which spikes go.
const U: [[f64; 2]; 8] = [
    [0.0, 0.0],
    [3.0, 0.0],
    [3.0, 3.0],
    [2.0, 3.0],
    [2.0, 1.0],
    [1.0, 1.0],
    [1.0, 3.0],
    [0.0, 3.0],
];

/// A prism with given outlines at the bottom and at the top, as vertices and faces; the sides belong to the U.
struct Prism {
    vertices: Vec<[f64; 3]>,
    faces: Vec<Vec<usize>>,
}

/// Returns a prism over the U. Its outline is first changed by `change`, which gets the number of each corner of the U and may
/// add vertices.
fn prism(change: impl Fn(&mut Vec<[f64; 2]>, &mut Vec<usize>)) -> Prism {
    let mut points = U.to_vec();
    let mut outline: Vec<usize> = (0..8).collect();
    change(&mut points, &mut outline);
    let count = points.len();
    let heights = [0.0, 1.0];
    let at_height = |z: f64| points.iter().map(move |&[x, y]| [x, y, z]);
    let mut faces = vec![
        outline.iter().rev().copied().collect(),
        outline.iter().map(|&k| k + count).collect(),
    ];
    faces.extend((0..8).map(|k| {
        let next = (k + 1) % 8;
        vec![k, next, next + count, k + count]
    }));
    Prism {
        vertices: heights.into_iter().flat_map(at_height).collect(),
        faces,
    }
}

impl Prism {
    fn in_format(&self, format: Format) -> String {
        let numbers = |first: usize, face: &Vec<usize>| {
            let words: Vec<String> = face.iter().map(|k| (k + first).to_string()).collect();
            words.join(" ")
        };
        let points: Vec<String> = self
            .vertices
            .iter()
            .map(|[x, y, z]| format!("{x} {y} {z}"))
            .collect();
        let counted = |face: &Vec<usize>| format!("{} {}\n", face.len(), numbers(0, face));
        let (vertices, faces) = (self.vertices.len(), self.faces.len());
        let points_and_faces = || {
            let lines: String = self.faces.iter().map(counted).collect();
            format!("{}\n{lines}", points.join("\n"))
        };
        match format {
            Format::Obj => {
                let faces = self
                    .faces
                    .iter()
                    .map(|face| format!("f {}\n", numbers(1, face)));
                let points = points.iter().map(|point| format!("v {point}\n"));
                points.chain(faces).collect()
            }
            Format::Off => format!("OFF\n{vertices} {faces} 0\n{}", points_and_faces()),
            Format::Ply => format!(
                "ply\nformat ascii 1.0\nelement vertex {vertices}\nproperty double x\nproperty double y\nproperty double z\n\
                 element face {faces}\nproperty list uchar int vertex_indices\nend_header\n{}",
                points_and_faces()
            ),
            Format::Collada => {
                let counts: Vec<String> = self
                    .faces
                    .iter()
                    .map(|face| face.len().to_string())
                    .collect();
                let corners: Vec<String> = self.faces.iter().map(|face| numbers(0, face)).collect();
                format!(
                    r##"<COLLADA version="1.5.0"><library_geometries><geometry><mesh><source id="s"><float_array id="a">{}</float_array>
<technique_common><accessor source="#a" count="{vertices}" stride="3"/></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#s"/></vertices><polylist count="{faces}"><input semantic="VERTEX" source="#v"
offset="0"/><vcount>{}</vcount><p>{}</p></polylist></mesh></geometry></library_geometries></COLLADA>"##,
                    points.join(" "),
                    counts.join(" "),
                    corners.join(" ")
                )
            }
            Format::Stl | Format::Gltf => unreachable!("these have triangles only"),
        }
    }
}

fn area(mesh: &TriangleMesh) -> f64 {
    let areas = (0..mesh.faces().len() as u32).map(|face| {
        let [a, b, c] = mesh.triangle(face);
        (b - a).cross(c - a).length() / 2.0
    });
    areas.sum()
}

#[test]
fn a_corner_without_length_bounds_no_area() {
    type Change = fn(&mut Vec<[f64; 2]>, &mut Vec<usize>);
    let mut changes: Vec<(&str, Change)> = vec![
        ("first corner at the end", |_, outline| outline.push(0)),
        ("first corner twice at the end", |_, outline| {
            outline.extend([0, 0]);
        }),
        ("first corner twice", |_, outline| outline.insert(0, 0)),
        ("a corner of the notch three times", |_, outline| {
            outline.splice(4..4, [4, 4]);
        }),
        ("all corners twice", |_, outline| {
            *outline = outline.iter().flat_map(|&k| [k, k]).collect();
        }),
        ("the same point by another number", |points, outline| {
            points.extend([U[5], [-0.0, 0.0]]);
            outline.insert(6, 8);
            outline.push(9);
        }),
        ("back along a side", |_, outline| {
            outline.splice(2..2, [1, 0, 1]);
        }),
        ("back along the first side at the end", |_, outline| {
            outline.extend([0, 7]);
        }),
        ("beyond a corner and back", |points, outline| {
            points.push([3.0, 2.0]);
            // Past the point on the side, to the corner, back to the point, and on to the corner.
            outline.splice(2..3, [2, 8, 2]);
        }),
    ];
    changes.push(("a spike on a spike", |points, outline| {
        points.extend([[2.0, 2.0], [2.0, 1.5]]);
        // Back to the corner that it leaves: a point that stayed on the side would be none of the face beside it.
        outline.splice(4..4, [8, 9, 8, 9, 8, 3]);
    }));
    let mut formats = vec![Format::Obj, Format::Off, Format::Ply];
    formats.extend(cfg!(feature = "collada").then_some(Format::Collada));
    for &format in &formats {
        let read = |prism: &Prism| {
            let text = prism.in_format(format);
            TriangleMesh::from_reader(format, text.as_bytes()).unwrap()
        };
        let twin = read(&prism(|_, _| {}));
        assert_eq!(area(&twin), 2.0 * 7.0 + 16.0, "{format:?}");
        for (what, change) in &changes {
            let mesh = read(&prism(change));
            assert_eq!(area(&mesh), area(&twin), "{format:?}: {what}");
            assert!(
                mesh.repairs().overhanging_fans.is_empty(),
                "{format:?}: {what}: {}",
                mesh.repairs()
            );
            let body = body_from_mesh(&mesh, PieceChoice::Auto).unwrap().body;
            assert_eq!(body.solidity(), Solidity::Solid, "{format:?}: {what}");
        }
    }
}

/// Tests that a needle that leaves the outline stays, as a segment without area: it can be touched.
#[test]
fn a_needle_beyond_the_outline_is_kept() {
    let needle = prism(|points, outline| {
        points.push([3.0, 5.0]);
        outline.splice(3..3, [8, 2]);
    });
    let text = needle.in_format(Format::Obj);
    let mesh = TriangleMesh::from_reader(Format::Obj, text.as_bytes()).unwrap();
    assert_eq!(area(&mesh), 30.0);
    let tip = DVec3::new(3.0, 5.0, 1.0);
    let holds = |face: &u32| mesh.triangle(*face).contains(&tip);
    let held: Vec<u32> = (0..mesh.faces().len() as u32).filter(holds).collect();
    assert!(!held.is_empty(), "the tip is gone");
    assert!(held.iter().all(|&face| has_zero_area(mesh.triangle(face))));
    let body = body_from_mesh(&mesh, PieceChoice::Auto).unwrap().body;
    assert_eq!(body.solidity(), Solidity::Solid);
}
