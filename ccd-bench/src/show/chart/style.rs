//! The style of a method, the same in every chart.

use super::sheet::{DrawError, Pen, Sheet, Spot, stroke};
use super::{Family, MethodFacts};
use plotters::style::{Color, RGBColor, ShapeStyle, WHITE};
use std::f64::consts::{FRAC_PI_2, TAU};

/// Okabe and Ito's colours, which colour-blind people can distinguish, without the yellow, which is invisible on white.
pub(super) const COLOURS: [RGBColor; 7] = [
    RGBColor(0x00, 0x72, 0xb2),
    RGBColor(0xd5, 0x5e, 0x00),
    RGBColor(0x00, 0x9e, 0x73),
    RGBColor(0xcc, 0x79, 0xa7),
    RGBColor(0xe6, 0x9f, 0x00),
    RGBColor(0x56, 0xb4, 0xe9),
    RGBColor(0x00, 0x00, 0x00),
];
/// The colour of unsafe results.
pub(super) const WARNING: RGBColor = COLOURS[1];
/// Half the size of a marker, in pixels.
pub(super) const MARKER: f64 = 4.0;

/// The colour, marker and dash of a method.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct MethodStyle {
    pub(super) colour: RGBColor,
    pub(super) marker: Marker,
    pub(super) dash: Option<(f64, f64)>,
    pub(super) fill: Fill,
}

/// The interior of a marker.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Fill {
    /// A solid marker, for a method that was never late.
    Solid,
    /// A hollow marker, for an unsafe method.
    Hollow,
}

/// The shape of a marker.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Marker {
    Circle,
    Square,
    Triangle,
    Diamond,
    Wedge,
    Pentagon,
    Star,
    Bar,
}

const MARKERS: [Marker; 8] = [
    Marker::Circle,
    Marker::Square,
    Marker::Triangle,
    Marker::Diamond,
    Marker::Wedge,
    Marker::Pentagon,
    Marker::Star,
    Marker::Bar,
];

/// Returns a style for each method, in their order. Styles within a family differ; families differ by the dash.
pub(super) fn styles(methods: &[MethodFacts<'_>], fill: impl Fn(&str) -> Fill) -> Vec<MethodStyle> {
    let mut taken = [0; 4];
    let style = |method: &MethodFacts<'_>| {
        let (family, dash, shift) = match method.family {
            Family::Ours => (0, None, 0),
            Family::Rival => (1, Some((7.0, 4.0)), 1),
            Family::Peer => (2, Some((2.0, 3.0)), 2),
            Family::Model => (3, None, 0),
        };
        let number = taken[family];
        taken[family] += 1;
        MethodStyle {
            colour: COLOURS[(number + shift) % COLOURS.len()],
            marker: MARKERS[(number + 3 * shift) % MARKERS.len()],
            dash,
            fill: fill(method.name),
        }
    };
    methods.iter().map(style).collect()
}

impl MethodStyle {
    pub(super) fn pen(&self, width: f64) -> Pen {
        Pen {
            dash: self.dash,
            ..Pen::solid(self.colour, width)
        }
    }
}

impl Sheet<'_> {
    /// Draws a marker centred at a position.
    pub(super) fn marker(&self, at: Spot, style: &MethodStyle) -> Result<(), DrawError> {
        let inside = match style.fill {
            Fill::Solid => style.colour,
            Fill::Hollow => WHITE,
        };
        if style.marker == Marker::Circle {
            self.disc(at, MARKER, inside.filled())?;
            return self.disc(at, MARKER, outline(style.colour));
        }
        let mut corners = corners(style.marker, at);
        self.polygon(&corners, inside.to_rgba())?;
        corners.push(corners[0]);
        self.line(&corners, Pen::solid(style.colour, OUTLINE))
    }
}

/// The width of a marker's edge.
const OUTLINE: f64 = 1.3;

fn outline(colour: RGBColor) -> ShapeStyle {
    stroke(colour, OUTLINE)
}

/// Returns the corners of a marker around its centre, at least three.
fn corners(marker: Marker, (x, y): Spot) -> Vec<Spot> {
    let around = |count: u32, first: f64, radius: fn(u32) -> f64| {
        (0..count)
            .map(|corner| {
                let angle = first + TAU * f64::from(corner) / f64::from(count);
                let radius = MARKER * radius(corner);
                (x + radius * angle.cos(), y + radius * angle.sin())
            })
            .collect()
    };
    match marker {
        Marker::Circle => around(16, 0.0, |_| 1.0),
        Marker::Square => around(4, TAU / 8.0, |_| 1.25),
        Marker::Triangle => around(3, -FRAC_PI_2, |_| 1.3),
        Marker::Diamond => around(4, 0.0, |_| 1.3),
        Marker::Wedge => around(3, FRAC_PI_2, |_| 1.3),
        Marker::Pentagon => around(5, -FRAC_PI_2, |_| 1.15),
        Marker::Star => around(
            10,
            -FRAC_PI_2,
            |corner| if corner % 2 == 0 { 1.5 } else { 0.65 },
        ),
        Marker::Bar => [(-1.3, -0.5), (1.3, -0.5), (1.3, 0.5), (-1.3, 0.5)]
            .map(|(u, v)| (x + MARKER * u, y + MARKER * v))
            .to_vec(),
    }
}
