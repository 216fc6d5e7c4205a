//! How large bodies are, to see units that do not go together.

use super::complain;
use crate::text::Number;
use ccd_core::Body;
use ccd_core::glam::DVec3;
use ccd_core::order::{greater, lesser};
use std::fmt;

/// The sides of the box along the axes that just holds a body, in the scene's unit of length.
#[derive(Clone, Copy, Debug)]
pub struct Size(DVec3);

/// How many times as large as the other one a body may be without a word: a part in millimetres beside
/// one in metres is a thousand times.
const RATIO: f64 = 100.0;

impl Size {
    /// Measures a body.
    pub fn of(body: &Body) -> Self {
        let pieces = body.pieces().iter();
        Size::of_points(pieces.flat_map(|piece| {
            let radius = DVec3::splat(piece.radius);
            let both = move |&point: &DVec3| [point - radius, point + radius];
            piece.points.iter().flat_map(both)
        }))
    }

    /// Measures points.
    pub fn of_points(points: impl IntoIterator<Item = DVec3>) -> Self {
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for point in points {
            for (axis, x) in point.to_array().into_iter().enumerate() {
                low[axis] = lesser(low[axis], x);
                high[axis] = greater(high[axis], x);
            }
        }
        Size(DVec3::from(high) - DVec3::from(low))
    }

    fn largest(self) -> f64 {
        self.0.to_array().into_iter().fold(0.0, greater)
    }

    /// Says so when two bodies may be measured in different units.
    pub fn compare(a: Size, b: Size) {
        let (of_a, of_b) = (a.largest(), b.largest());
        let (large, small, ratio) = match of_a > of_b {
            true => ("--a", "--b", of_a / of_b),
            false => ("--b", "--a", of_b / of_a),
        };
        if ratio > RATIO && ratio.is_finite() {
            complain(&format!(
                "{large} is {} times as large as {small} ({a} and {b}): are both in one unit of length?",
                Figure(ratio)
            ));
        }
    }
}

impl fmt::Display for Size {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y, z] = self.0.to_array().map(Figure);
        write!(f, "{x} × {y} × {z}")
    }
}

/// A number to four figures.
struct Figure(f64);

impl fmt::Display for Figure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let rounded: f64 = format!("{:.3e}", self.0).parse().unwrap_or(self.0);
        write!(f, "{}", Number(rounded))
    }
}
