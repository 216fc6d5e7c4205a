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

/// A height field: a grid of heights above a base.
pub(super) struct HeightField {
    /// Half the extents along x and y, the largest height, and the thickness of the base.
    size: [f64; 4],
    rows: usize,
    columns: usize,
    /// The heights from 0 to 1, row by row, with increasing y.
    heights: Vec<f32>,
}

impl HeightField {
    /// Reads a height field from its element or its file.
    pub(super) fn read(own: &Attributes, file: Option<&Path>) -> Result<Self, RobotFileError> {
        let size: [f64; 4] = own.array("size")?.ok_or_else(|| own.invalid("size"))?;
        if !size.iter().all(|&length| length > 0.0) {
            return Err(own.invalid("size").into());
        }
        let ([rows, columns], mut heights) = match file {
            Some(file) => read_file(own, file)?,
            None => given_heights(own)?,
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
        Ok(HeightField {
            size,
            rows,
            columns,
            heights,
        })
    }

    /// Returns the surface of the solid between the heights and the bottom of the base. Each grid cell has two
    /// triangles, split along the diagonal from its lowest to its highest x and y.
    pub(super) fn mesh(&self) -> Result<TriangleMesh, RobotFileError> {
        let (rows, columns) = (self.rows, self.columns);
        let [x, y, most, base] = self.size;
        let at =
            |half: f64, k: usize, count: usize| 2.0 * half / (count - 1) as f64 * k as f64 - half;
        let grid = || (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column)));
        let point = |(row, column), z| DVec3::new(at(x, column, columns), at(y, row, rows), z);
        let top = grid().zip(&self.heights);
        let top = top.map(|(place, &height)| point(place, f64::from(height) * most));
        let vertices: Vec<DVec3> = top.chain(grid().map(|place| point(place, -base))).collect();
        let number = |row: usize, column: usize| (row * columns + column) as u32;
        let below = (rows * columns) as u32;
        let mut faces = Vec::new();
        for row in 0..rows - 1 {
            for column in 0..columns - 1 {
                let [a, b] = [number(row, column), number(row, column + 1)];
                let [c, d] = [number(row + 1, column), number(row + 1, column + 1)];
                faces.extend([[a, b, d], [a, d, c]]);
                faces.extend([[a, d, b], [a, c, d]].map(|face| face.map(|v| below + v)));
            }
        }
        let mut wall = |from: u32, to: u32| {
            faces.extend([[from, below + from, below + to], [from, below + to, to]]);
        };
        for column in 0..columns - 1 {
            wall(number(0, column), number(0, column + 1));
            wall(number(rows - 1, column + 1), number(rows - 1, column));
        }
        for row in 0..rows - 1 {
            wall(number(row + 1, 0), number(row, 0));
            wall(number(row, columns - 1), number(row + 1, columns - 1));
        }
        Ok(TriangleMesh::new(vertices, &faces)?)
    }
}

/// Reads the heights from the element; all are 0 if there are none. The element lists the row with the largest y
/// first.
fn given_heights(own: &Attributes) -> Result<([usize; 2], Vec<f32>), MjcfError> {
    let count =
        |name: &str| usize::try_from(own.integer_or(name, 0)?).map_err(|_| own.invalid(name));
    let counts = [count("nrow")?, count("ncol")?];
    let heights = check_counts(counts).ok_or_else(|| own.invalid("nrow"))?;
    let Some(given) = own.numbers("elevation")? else {
        return Ok((counts, vec![0.0; heights]));
    };
    if given.len() != heights {
        return Err(own.invalid("elevation"));
    }
    let rows = given.chunks(counts[1]).rev();
    Ok((
        counts,
        rows.flatten().map(|&height| height as f32).collect(),
    ))
}

/// Reads a file in MuJoCo's binary format: the numbers of rows and columns, then all heights.
fn read_file(own: &Attributes, file: &Path) -> Result<([usize; 2], Vec<f32>), RobotFileError> {
    let is_picture = file
        .extension()
        .is_some_and(|own| own.eq_ignore_ascii_case("png"));
    if is_picture || own.get("content_type") == Some("image/png") {
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
        let heights: Vec<f32> = heights.iter().map(|own| f32::from_le_bytes(*own)).collect();
        (fits && heights.iter().all(|height| height.is_finite())).then_some((counts, heights))
    };
    read().ok_or_else(|| own.invalid("file").into())
}

/// Returns the number of heights; `None` if there are fewer than two rows or columns, or too many heights.
fn check_counts([rows, columns]: [usize; 2]) -> Option<usize> {
    let heights = rows.checked_mul(columns)?;
    (rows > 1 && columns > 1 && heights <= MAX_HEIGHTS).then_some(heights)
}
