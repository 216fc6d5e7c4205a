//! Makes the meshes of the scenes of the families, such as slabs, sheets, combs and threads.

pub(super) use crate::scene::model::cuboid;
use crate::scene::model::sphere::sphere;
use crate::scene::model::torus_mesh;
use ccd_core::glam::{DAffine3, DVec3, dvec3};
use ccd_decomp::{MeshError, TriangleMesh};
use std::f64::consts::TAU;

/// Returns a cube of side 1 about the origin.
pub(super) fn cube() -> Result<TriangleMesh, MeshError> {
    cuboid(0.5, 0.5, 0.5)
}

/// Returns a wide box with its top at z = 1, wider than the bodies that fall onto it.
pub(super) fn slab() -> Result<TriangleMesh, MeshError> {
    cuboid(9.0, 9.0, 1.0)
}

/// Returns a triangulated sphere about the origin, with a vertex at each pole.
pub(super) fn ball(radius: f64, vertices: usize) -> Result<TriangleMesh, MeshError> {
    let (points, faces) = sphere(vertices);
    TriangleMesh::new(points.into_iter().map(|p| radius * p).collect(), &faces)
}

/// Returns an open square of side 2 in the plane z = 0 about the origin, cut into `squares` by `squares` pairs of
/// triangles.
pub(super) fn sheet(squares: u32) -> Result<TriangleMesh, MeshError> {
    let step = 2.0 / f64::from(squares);
    let coordinate = |k: u32| f64::from(k) * step - 1.0;
    let row = squares + 1;
    let vertices = (0..row * row).map(|k| dvec3(coordinate(k / row), coordinate(k % row), 0.0));
    let faces = (0..squares * squares)
        .map(|k| k / squares * row + k % squares)
        .flat_map(|a| [[a, a + row, a + 1], [a + 1, a + row, a + row + 1]]);
    TriangleMesh::new(vertices.collect(), &faces.collect::<Vec<_>>())
}

/// Returns a torus about the z axis.
pub(super) fn torus(radius: f64, tube: f64) -> Result<TriangleMesh, MeshError> {
    torus_mesh([64, 24], radius, tube)
}

/// Returns a cone that stands on its tip at the origin, with its base at z = 1.
pub(super) fn cone(sides: u32, radius: f64) -> Result<TriangleMesh, MeshError> {
    let rim = |k: u32| {
        let (sin, cos) = (TAU * f64::from(k) / f64::from(sides)).sin_cos();
        dvec3(radius * cos, radius * sin, 1.0)
    };
    let mut vertices = vec![DVec3::ZERO, DVec3::Z];
    vertices.extend((0..sides).map(rim));
    let at = |k: u32| 2 + k % sides;
    let faces = (0..sides).flat_map(|k| [[0, at(k + 1), at(k)], [1, at(k), at(k + 1)]]);
    TriangleMesh::new(vertices, &faces.collect::<Vec<_>>())
}

/// The width of a comb's tooth, as a fraction of the distance from one tooth to the next.
pub(super) const TOOTH_WIDTH_SHARE: f64 = 0.4;

/// Returns a comb of depth 1 along y: a bar from z = 0 to 1 below teeth that reach to z = 2. The first tooth
/// begins at x = 0, and the steps from tooth to tooth add up to 1.
pub(super) fn comb(teeth: u32) -> Result<TriangleMesh, MeshError> {
    let border =
        |k: u32| (f64::from(k / 2) + TOOTH_WIDTH_SHARE * f64::from(k % 2)) / f64::from(teeth);
    let borders: Vec<f64> = (0..2 * teeth).map(border).collect();
    extrude_cells(&borders, &[0.0, 1.0, 2.0], 0.5, |column, level| {
        level == 0 || column % 2 == 0
    })
}

/// Returns a solid made of the filled cells of a grid in the plane of x and z, extruded from y = −`half` to `half`.
pub(super) fn extrude_cells(
    x: &[f64],
    z: &[f64],
    half: f64,
    filled: impl Fn(usize, usize) -> bool,
) -> Result<TriangleMesh, MeshError> {
    // In front and behind of each corner of the grid.
    let corner = |i: usize, j: usize, back: usize| (2 * (i * z.len() + j) + back) as u32;
    let vertices: Vec<DVec3> = x
        .iter()
        .flat_map(|&x| z.iter().map(move |&z| (x, z)))
        .flat_map(|(x, z)| [dvec3(x, -half, z), dvec3(x, half, z)])
        .collect();
    let (columns, levels) = (x.len() - 1, z.len() - 1);
    let is = |i: usize, j: usize| i < columns && j < levels && filled(i, j);
    let mut faces = Vec::new();
    let mut quad = |[a, b, c, d]: [u32; 4]| faces.extend([[a, b, c], [a, c, d]]);
    for (i, j) in (0..columns).flat_map(|i| (0..levels).map(move |j| (i, j))) {
        if !is(i, j) {
            continue;
        }
        let at = |right: usize, up: usize, back: usize| corner(i + right, j + up, back);
        quad([at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0)]);
        quad([at(1, 0, 1), at(0, 0, 1), at(0, 1, 1), at(1, 1, 1)]);
        // Sides without a neighbour; before the first cell, the index wraps to a cell that is not filled.
        if !is(i.wrapping_sub(1), j) {
            quad([at(0, 0, 1), at(0, 0, 0), at(0, 1, 0), at(0, 1, 1)]);
        }
        if !is(i + 1, j) {
            quad([at(1, 0, 0), at(1, 0, 1), at(1, 1, 1), at(1, 1, 0)]);
        }
        if !is(i, j.wrapping_sub(1)) {
            quad([at(0, 0, 1), at(1, 0, 1), at(1, 0, 0), at(0, 0, 0)]);
        }
        if !is(i, j + 1) {
            quad([at(0, 1, 0), at(1, 1, 0), at(1, 1, 1), at(0, 1, 1)]);
        }
    }
    mesh_of_used_vertices(&vertices, faces)
}

/// Creates a mesh of the faces, without the vertices that no face uses.
fn mesh_of_used_vertices(
    vertices: &[DVec3],
    faces: Vec<[u32; 3]>,
) -> Result<TriangleMesh, MeshError> {
    let mut numbers = vec![None; vertices.len()];
    let mut kept = Vec::new();
    let mut number = |v: u32| {
        let v = v as usize;
        *numbers[v].get_or_insert_with(|| {
            kept.push(vertices[v]);
            kept.len() as u32 - 1
        })
    };
    let faces: Vec<[u32; 3]> = faces.into_iter().map(|f| f.map(&mut number)).collect();
    TriangleMesh::new(kept, &faces)
}

/// Returns a plate of half sides 0.1, 3 and 3 that a horizontal slit cuts in two; the slit is open from z = −`slit` to
/// `slit`.
pub(super) fn slit_plate(slit: f64) -> Result<TriangleMesh, MeshError> {
    let levels = [-3.0, -slit, slit, 3.0];
    extrude_cells(&[-0.1, 0.1], &levels, 3.0, |_, level| level != 1)
}

/// Returns one flank of a screw thread about the z axis: an open ribbon between two radii that rises by the pitch per
/// turn.
pub(super) fn helicoid(
    radii: [f64; 2],
    pitch: f64,
    sides: u32,
    turns: u32,
) -> Result<TriangleMesh, MeshError> {
    let steps = sides * turns;
    let vertices = (0..=steps).flat_map(|k| {
        let (sin, cos) = (TAU * f64::from(k % sides) / f64::from(sides)).sin_cos();
        let height = pitch * f64::from(k) / f64::from(sides);
        radii.map(|r| dvec3(r * cos, r * sin, height))
    });
    let faces = (0..steps).flat_map(|k| {
        let [a, b, c, d] = [2 * k, 2 * k + 1, 2 * k + 3, 2 * k + 2];
        [[a, b, c], [a, c, d]]
    });
    TriangleMesh::new(vertices.collect(), &faces.collect::<Vec<_>>())
}

/// Returns one mesh of copies of an open horizontal square, one copy at each of the given heights.
pub(super) fn stacked_squares(
    sheet: &TriangleMesh,
    heights: impl Iterator<Item = f64>,
) -> Result<TriangleMesh, MeshError> {
    let sheets = heights.map(|z| sheet.transformed(DAffine3::from_translation(z * DVec3::Z)));
    TriangleMesh::merge(&sheets.collect::<Result<Vec<_>, _>>()?)
}

/// Returns the box of [`slab`] with an extra vertex on its top near a diagonal, so that one triangle there is a sliver
/// of about the given width.
pub(super) fn sliver_slab(width: f64) -> Result<TriangleMesh, MeshError> {
    let slab = slab()?;
    let place = |v: u32| slab.vertices()[v as usize];
    let is_top = |face: &[u32; 3]| face.iter().all(|&v| place(v).z == 1.0);
    let mut faces = slab.faces().to_vec();
    let at = faces.iter().position(is_top).unwrap_or_default();
    let [a, b, c] = faces.swap_remove(at);
    // The corner across from the diagonal shares a coordinate with both others.
    let across = [a, b, c].map(place).into_iter().find(|p| {
        let shares = |v: &u32| place(*v).x == p.x || place(*v).y == p.y;
        [a, b, c].iter().all(shares)
    });
    let mut vertices = slab.vertices().to_vec();
    let tip = vertices.len() as u32;
    let towards = across.unwrap_or_default().signum();
    vertices.push(dvec3(width * towards.x, width * towards.y, 1.0));
    faces.extend([[a, b, tip], [b, c, tip], [c, a, tip]]);
    TriangleMesh::new(vertices, &faces)
}

/// Returns cubes of side 1/4 in a horizontal square grid with their tops at z = 0, every other cube inside out.
pub(super) fn cube_grid_half_inside_out(count: u32) -> Result<TriangleMesh, MeshError> {
    let cube = cuboid(0.125, 0.125, 0.125)?;
    let faces: Vec<[u32; 3]> = cube.faces().iter().map(|&[a, b, c]| [a, c, b]).collect();
    let inside_out = TriangleMesh::new(cube.vertices().to_vec(), &faces)?;
    let wide = f64::from(count).sqrt().ceil() as u32;
    let middle = 0.5 * f64::from(wide - 1);
    let cubes: Result<Vec<TriangleMesh>, MeshError> = (0..count)
        .map(|k| {
            let place = |at: u32| 0.5 * (f64::from(at) - middle);
            let cube = if k % 2 == 0 { &cube } else { &inside_out };
            let place = dvec3(place(k % wide), place(k / wide), -0.125);
            cube.transformed(DAffine3::from_translation(place))
        })
        .collect();
    TriangleMesh::merge(&cubes?)
}

/// Returns a plate from z = −0.1 to 0.1 with half side 3, and with a square hole about the origin.
pub(super) fn holed_plate(hole: f64) -> Result<TriangleMesh, MeshError> {
    let corners = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
    // Four rings of four: the hole below and above, the rim below and above.
    let rings = [(hole, -0.1), (hole, 0.1), (3.0, -0.1), (3.0, 0.1)];
    let ring = |(half, z): (f64, f64)| corners.map(|(x, y)| dvec3(half * x, half * y, z));
    let vertices = rings.map(ring).concat();
    let mut faces = Vec::new();
    for k in 0..4 {
        let at = |ring: u32, next: u32| 4 * ring + (k + next) % 4;
        for [from, to] in [[0, 1], [1, 3], [3, 2], [2, 0]] {
            let [a, b, c, d] = [at(from, 0), at(to, 0), at(to, 1), at(from, 1)];
            faces.extend([[a, b, c], [a, c, d]]);
        }
    }
    TriangleMesh::new(vertices, &faces)
}

/// Returns `count` open horizontal squares at even steps in height, the highest at z = 0 and all above z = −0.5.
pub(super) fn evenly_stacked_squares(count: u32) -> Result<TriangleMesh, MeshError> {
    let step = 0.5 / f64::from(count);
    stacked_squares(&sheet(1)?, (0..count).map(|k| -step * f64::from(k)))
}

/// Returns the mesh with `count` repeated faces, every other one reversed, and `count` degenerate faces added.
pub(super) fn with_bad_faces(mesh: &TriangleMesh, count: usize) -> Result<TriangleMesh, MeshError> {
    let mut faces = mesh.faces().to_vec();
    let repeated: Vec<[u32; 3]> = faces.iter().copied().cycle().take(count).collect();
    for (k, [a, b, c]) in repeated.into_iter().enumerate() {
        faces.extend([if k % 2 == 0 { [a, b, c] } else { [a, c, b] }, [a, b, a]]);
    }
    TriangleMesh::new(mesh.vertices().to_vec(), &faces)
}

#[cfg(test)]
mod tests;
