//! Reads the height fields of an MJCF.

use super::attributes::Attributes;
use crate::robot_file::error::RobotFileError;
use crate::robot_file::mjcf_error::MjcfError;
use ccd_core::order::{greater, lesser};
use ccd_decomp::TriangleMesh;
use rigid_ccd::glam::DVec3;
use std::fs;
use std::path::Path;

/// The largest number of heights. The mesh has at most eight times as many triangles.
const MAX_HEIGHTS: usize = 1 << 22;

/// Reads a height field from its element or its file, and returns the surface of the solid between the heights and
/// the bottom of the base.
pub(super) fn height_field_mesh(
    attributes: &Attributes,
    file: Option<&Path>,
) -> Result<TriangleMesh, RobotFileError> {
    let invalid_size = || attributes.invalid("size");
    let size: [f64; 4] = attributes.array("size")?.ok_or_else(invalid_size)?;
    if !size.iter().all(|&length| length > 0.0) {
        return Err(invalid_size().into());
    }
    let (counts, mut heights) = match file {
        Some(file) => heights_from_file(attributes, file)?,
        None => heights_from_element(attributes)?,
    };
    let all = || heights.iter().map(|&height| f64::from(height));
    let low = all().fold(f64::INFINITY, lesser) as f32;
    let high = all().fold(f64::NEG_INFINITY, greater) as f32;
    // Normalises the heights as MuJoCo does, in the same precision.
    for height in &mut heights {
        *height -= low;
        if f64::from(high - low) > 1e-14 {
            *height /= high - low;
        }
    }
    mesh(size, counts, &heights)
}

/// Returns the surface of the solid between heights and the bottom of the base. `size` is half the extents along x and
/// y, the largest height, and the thickness of the base. The heights are from 0 to 1, row by row, with increasing y.
/// Each grid cell has two triangles, split along the diagonal from its lowest to its highest x and y.
fn mesh(
    [half_x, half_y, max_height, base]: [f64; 4],
    [rows, columns]: [usize; 2],
    heights: &[f32],
) -> Result<TriangleMesh, RobotFileError> {
    let coordinate =
        |half: f64, k: usize, count: usize| 2.0 * half / (count - 1) as f64 * k as f64 - half;
    let grid = || (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column)));
    let point = |(row, column), z| {
        let [x, y] = [(half_x, column, columns), (half_y, row, rows)]
            .map(|(half, k, count)| coordinate(half, k, count));
        DVec3::new(x, y, z)
    };
    let top = grid().zip(heights);
    let top = top.map(|(cell, &height)| point(cell, f64::from(height) * max_height));
    let vertices: Vec<DVec3> = top.chain(grid().map(|cell| point(cell, -base))).collect();
    let vertex = |row: usize, column: usize| (row * columns + column) as u32;
    let below = (rows * columns) as u32;
    let mut faces = Vec::new();
    for row in 0..rows - 1 {
        for column in 0..columns - 1 {
            let [a, b] = [vertex(row, column), vertex(row, column + 1)];
            let [c, d] = [vertex(row + 1, column), vertex(row + 1, column + 1)];
            faces.extend([[a, b, d], [a, d, c]]);
            faces.extend([[a, d, b], [a, c, d]].map(|face| face.map(|v| below + v)));
        }
    }
    let mut wall = |from: u32, to: u32| {
        faces.extend([[from, below + from, below + to], [from, below + to, to]]);
    };
    for column in 0..columns - 1 {
        wall(vertex(0, column), vertex(0, column + 1));
        wall(vertex(rows - 1, column + 1), vertex(rows - 1, column));
    }
    for row in 0..rows - 1 {
        wall(vertex(row + 1, 0), vertex(row, 0));
        wall(vertex(row, columns - 1), vertex(row + 1, columns - 1));
    }
    Ok(TriangleMesh::new(vertices, &faces)?)
}

/// Reads the heights from the element; all are 0 if there are none. The element lists the row with the largest y
/// first.
fn heights_from_element(attributes: &Attributes) -> Result<([usize; 2], Vec<f32>), MjcfError> {
    let count = |name: &str| {
        let count = usize::try_from(attributes.integer_or(name, 0)?);
        count.map_err(|_| attributes.invalid(name))
    };
    let counts = [count("nrow")?, count("ncol")?];
    let height_count = check_counts(counts).ok_or_else(|| attributes.invalid("nrow"))?;
    let Some(elevations) = attributes.numbers("elevation")? else {
        return Ok((counts, vec![0.0; height_count]));
    };
    if elevations.len() != height_count {
        return Err(attributes.invalid("elevation"));
    }
    let rows = elevations.chunks(counts[1]).rev();
    let heights = rows.flatten().map(|&height| height as f32).collect();
    Ok((counts, heights))
}

/// Reads a file in MuJoCo's binary format: the numbers of rows and columns, then all heights.
fn heights_from_file(
    attributes: &Attributes,
    file: &Path,
) -> Result<([usize; 2], Vec<f32>), RobotFileError> {
    let is_picture = file
        .extension()
        .is_some_and(|extension| extension.eq_ignore_ascii_case("png"));
    if is_picture || attributes.get("content_type") == Some("image/png") {
        let shape = "a height field in a picture";
        return Err(MjcfError::UnsupportedShape { shape }.into());
    }
    let bytes = fs::read(file).map_err(|error| RobotFileError::Unreadable {
        file: file.to_owned(),
        error: error.to_string(),
    })?;
    let read = || {
        let (words, rest) = bytes.as_chunks::<4>();
        let (&[rows, columns], heights) = words.split_first_chunk::<2>()?;
        let counts = [rows, columns].map(|count| i32::from_le_bytes(count).try_into().unwrap_or(0));
        let fits = check_counts(counts) == Some(heights.len()) && rest.is_empty();
        let heights: Vec<f32> = heights
            .iter()
            .map(|bytes| f32::from_le_bytes(*bytes))
            .collect();
        (fits && heights.iter().all(|height| height.is_finite())).then_some((counts, heights))
    };
    read().ok_or_else(|| attributes.invalid("file").into())
}

/// Returns the number of heights; `None` if there are fewer than two rows or columns, or too many heights.
fn check_counts([rows, columns]: [usize; 2]) -> Option<usize> {
    let heights = rows.checked_mul(columns)?;
    (rows > 1 && columns > 1 && heights <= MAX_HEIGHTS).then_some(heights)
}
