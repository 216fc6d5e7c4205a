//! Chooses the colour and the marker of each method, the same in every chart.

use super::sheet::to_drawing_position;
use super::{ChartedMethod, MethodFamily};
use plotters::style::{Color, RGBColor, ShapeStyle};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, TAU};

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
/// The colour of the strip for methods that are late or miss a contact.
pub(super) const WARNING_COLOUR: RGBColor = COLOURS[1];
/// The distance of a marker's corners from its center, in pixels.
pub(super) const MARKER_RADIUS: f64 = 4.5;

/// The colour, the marker and the dash pattern of a method.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct MethodStyle {
    pub(super) colour: RGBColor,
    marker: Marker,
    /// The lengths of a dash and of a gap, in drawing units; `None` for a solid line.
    pub(super) dash_and_gap: Option<(u32, u32)>,
    /// Whether the method was late or missed a contact. Its markers are hollow.
    pub(super) is_unsafe: bool,
}

/// A regular polygon: its number of corners, and the direction of the first one as an angle.
type Marker = (u32, f64);

const MARKERS: [Marker; 5] = [
    (16, 0.0),
    (4, FRAC_PI_4),
    (3, -FRAC_PI_2),
    (4, 0.0),
    (3, FRAC_PI_2),
];

/// Returns a style for each method, in the order of the methods. Styles within a family differ; families differ by the
/// dash.
pub(super) fn method_styles(
    methods: &[ChartedMethod<'_>],
    is_unsafe: impl Fn(&str) -> bool,
) -> Vec<MethodStyle> {
    let mut taken = [0; 3];
    let style = |method: &ChartedMethod<'_>| {
        let (family, dash) = match method.method_family {
            MethodFamily::ThisProject => (0, None),
            MethodFamily::Rival => (1, Some((70, 40))),
            MethodFamily::Peer => (2, Some((20, 30))),
        };
        let number = taken[family] + family;
        taken[family] += 1;
        MethodStyle {
            colour: COLOURS[number % COLOURS.len()],
            marker: MARKERS[number % MARKERS.len()],
            dash_and_gap: dash,
            is_unsafe: is_unsafe(method.name),
        }
    };
    methods.iter().map(style).collect()
}

impl MethodStyle {
    /// Returns the style of the method's lines, with a width in tenths of a pixel.
    pub(super) fn line_style(&self, width: u32) -> ShapeStyle {
        self.colour.stroke_width(width)
    }

    /// Returns the corners of the marker relative to its center, in drawing units.
    pub(super) fn corners(&self) -> Vec<(i32, i32)> {
        let (count, first) = self.marker;
        let corner = |corner: u32| {
            let angle = first + TAU * f64::from(corner) / f64::from(count);
            to_drawing_position((MARKER_RADIUS * angle.cos(), MARKER_RADIUS * angle.sin()))
        };
        (0..count).map(corner).collect()
    }
}
