//! A sheet to draw on, measured in pixels from its upper left corner.

use plotters::coord::Shift;
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::io;

/// The width of every chart, for the text width of a README.
pub(super) const WIDTH: f64 = 840.0;
/// The margin around everything.
pub(super) const MARGIN: f64 = 10.0;

/// An error of the drawing library.
pub(super) type DrawError = DrawingAreaErrorKind<io::Error>;

/// The units of the drawing in a pixel; the library rounds positions to whole units.
const UNITS: f64 = 10.0;
/// The factor by which the library divides font sizes in its output.
const FONT_RATIO: f64 = 1.24;
/// The average width of a character relative to the font size, with some reserve.
const CHARACTER: f64 = 0.58;
/// The colour of text.
pub(super) const INK: RGBColor = RGBColor(0x22, 0x22, 0x22);
/// The colour of frames of panels.
pub(super) const FRAME: RGBColor = RGBColor(0x88, 0x88, 0x88);
/// The colour of lines under the data.
pub(super) const RULE: RGBColor = RGBColor(0xe4, 0xe4, 0xe4);
/// The default size of text, in pixels.
pub(super) const TEXT: f64 = 12.0;

/// A position in pixels, from the upper left corner.
pub(super) type Spot = (f64, f64);

/// A rectangle in pixels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rect {
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) width: f64,
    pub(super) height: f64,
}

impl Rect {
    pub(super) fn right(&self) -> f64 {
        self.left + self.width
    }

    pub(super) fn bottom(&self) -> f64 {
        self.top + self.height
    }
}

/// The style of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pen {
    pub(super) colour: RGBColor,
    pub(super) width: f64,
    pub(super) opacity: f64,
    /// The lengths of a dash and of a gap, in pixels; `None` for a solid line.
    pub(super) dash: Option<(f64, f64)>,
}

impl Pen {
    pub(super) fn solid(colour: RGBColor, width: f64) -> Self {
        Pen {
            colour,
            width,
            opacity: 1.0,
            dash: None,
        }
    }

    fn style(&self) -> ShapeStyle {
        ShapeStyle {
            color: self.colour.mix(self.opacity),
            filled: false,
            stroke_width: units(self.width).unsigned_abs(),
        }
    }
}

/// The style of a text.
#[derive(Clone, Copy)]
pub(super) struct TextFormat {
    pub(super) size: f64,
    pub(super) colour: RGBColor,
    pub(super) weight: FontStyle,
    pub(super) across: HPos,
    pub(super) down: VPos,
    pub(super) turn: Turn,
}

/// The direction of a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Turn {
    Across,
    Upwards,
}

impl Default for TextFormat {
    fn default() -> Self {
        TextFormat {
            size: TEXT,
            colour: INK,
            weight: FontStyle::Normal,
            across: HPos::Left,
            down: VPos::Center,
            turn: Turn::Across,
        }
    }
}

/// The drawing surface.
pub(super) struct Sheet<'s> {
    area: DrawingArea<SVGBackend<'s>, Shift>,
}

impl Sheet<'_> {
    /// Returns the SVG file that `body` draws on a white sheet of the given size in pixels.
    pub(super) fn draw(
        title: &str,
        size: Spot,
        body: impl FnOnce(&Sheet<'_>) -> Result<(), DrawError>,
    ) -> Result<String, DrawError> {
        let (width, height) = (units(size.0).unsigned_abs(), units(size.1).unsigned_abs());
        let mut text = String::new();
        {
            let area = SVGBackend::with_string(&mut text, (width, height)).into_drawing_area();
            area.fill(&WHITE)?;
            let sheet = Sheet { area };
            body(&sheet)?;
            sheet.area.present()?;
        }
        let inside = text.split_once('>').map_or("", |(_, inside)| inside);
        let title = ccd_view::escape(title);
        Ok(format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}\" height=\"{}\" \
             viewBox=\"0 0 {width} {height}\" role=\"img\" aria-label=\"{title}\">\
             <title>{title}</title>{inside}",
            size.0.round(),
            size.1.round(),
        ))
    }

    pub(super) fn line(&self, spots: &[Spot], pen: Pen) -> Result<(), DrawError> {
        let path: Vec<_> = spots.iter().map(|&spot| to_units(spot)).collect();
        match pen.dash {
            None => self.area.draw(&PathElement::new(path, pen.style())),
            Some((dash, gap)) => self.area.draw(&DashedPathElement::new(
                path,
                units(dash),
                units(gap),
                pen.style(),
            )),
        }
    }

    pub(super) fn polygon(&self, spots: &[Spot], fill: RGBAColor) -> Result<(), DrawError> {
        let corners: Vec<_> = spots.iter().map(|&spot| to_units(spot)).collect();
        self.area.draw(&Polygon::new(corners, fill.filled()))
    }

    pub(super) fn rect(&self, rect: Rect, style: ShapeStyle) -> Result<(), DrawError> {
        let corners = [
            to_units((rect.left, rect.top)),
            to_units((rect.right(), rect.bottom())),
        ];
        self.area.draw(&Rectangle::new(corners, style))
    }

    pub(super) fn frame(&self, rect: Rect, colour: RGBColor) -> Result<(), DrawError> {
        let around = [
            (rect.left, rect.top),
            (rect.right(), rect.top),
            (rect.right(), rect.bottom()),
            (rect.left, rect.bottom()),
            (rect.left, rect.top),
        ];
        self.line(&around, Pen::solid(colour, 1.0))
    }

    pub(super) fn disc(
        &self,
        centre: Spot,
        radius: f64,
        style: ShapeStyle,
    ) -> Result<(), DrawError> {
        self.area
            .draw(&Circle::new(to_units(centre), units(radius), style))
    }

    pub(super) fn text(&self, text: &str, spot: Spot, format: TextFormat) -> Result<(), DrawError> {
        let font = FontDesc::new(
            FontFamily::SansSerif,
            format.size * UNITS * FONT_RATIO,
            format.weight,
        );
        let turn = match format.turn {
            Turn::Across => FontTransform::None,
            Turn::Upwards => FontTransform::Rotate270,
        };
        let style = font
            .transform(turn)
            .color(&format.colour)
            .pos(Pos::new(format.across, format.down));
        self.area.draw(&Text::new(text, to_units(spot), style))
    }
}

/// Returns the approximate width of a text, in pixels.
pub(super) fn text_width(text: &str, size: f64) -> f64 {
    text.chars().map(|_| CHARACTER * size).sum()
}

/// Returns a style with a width in units, for shapes of several parts.
pub(super) fn stroke(colour: RGBColor, width: f64) -> ShapeStyle {
    Pen::solid(colour, width).style()
}

fn to_units(spot: Spot) -> (i32, i32) {
    (units(spot.0), units(spot.1))
}

/// Converts pixels to units of the drawing; NaN becomes 0.
// The cast saturates, and a sheet is some thousand pixels wide.
fn units(pixels: f64) -> i32 {
    (pixels * UNITS).round() as i32
}
