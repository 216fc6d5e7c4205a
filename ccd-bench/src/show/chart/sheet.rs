//! A sheet to draw on in tenths of a pixel, because the drawing library rounds positions to whole units.

use anyhow::Result;
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// The width of every chart, in pixels, which fits the text of a README.
pub(super) const CHART_WIDTH: f64 = 840.0;
/// The width of the empty margin around a chart, in pixels.
pub(super) const CHART_MARGIN: f64 = 10.0;
/// The number of drawing units in a pixel.
const UNITS_PER_PIXEL: f64 = 10.0;
/// The factor by which the library divides font sizes in its output.
const FONT_SIZE_DIVISOR: f64 = 1.24;
/// The average width of a character relative to the font size, rounded up.
const RELATIVE_CHARACTER_WIDTH: f64 = 0.58;
/// The colour of text and axes.
pub(super) const TEXT_COLOUR: RGBColor = RGBColor(0x22, 0x22, 0x22);
/// The default font size, in pixels.
pub(super) const DEFAULT_FONT_SIZE: f64 = 12.0;

/// An area of the SVG file to draw in.
pub(super) type Sheet<'s> = DrawingArea<SVGBackend<'s>, Shift>;

/// A position in pixels: right of and below the upper left corner.
pub(super) type PixelPosition = (f64, f64);

/// Returns the style of a text whose left end has the middle of its height at the text's position.
pub(super) fn text_style(size: f64) -> TextStyle<'static> {
    let left = Pos::new(HPos::Left, VPos::Center);
    font(size, FontStyle::Normal).color(&TEXT_COLOUR).pos(left)
}

/// Returns the SVG file that `body` draws on a white sheet of the given size in pixels.
pub(super) fn draw_svg(
    title: &str,
    size: PixelPosition,
    body: impl FnOnce(&Sheet<'_>) -> Result<()>,
) -> Result<String> {
    let (width, height) = to_drawing_position(size);
    let (width, height) = (width.unsigned_abs(), height.unsigned_abs());
    let mut text = String::new();
    {
        let sheet = SVGBackend::with_string(&mut text, (width, height)).into_drawing_area();
        sheet.fill(&WHITE)?;
        body(&sheet)?;
        sheet.present()?;
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

/// Draws a text whose vertical middle is at the given position.
pub(super) fn draw_text(
    sheet: &Sheet<'_>,
    text: &str,
    at: PixelPosition,
    style: &TextStyle<'_>,
) -> Result<()> {
    Ok(sheet.draw(&Text::new(text, to_drawing_position(at), style.clone()))?)
}

/// Fills a rectangle that is given by its upper left corner and its size.
pub(super) fn fill_rect(
    sheet: &Sheet<'_>,
    (x, y): PixelPosition,
    size: PixelPosition,
    colour: RGBColor,
) -> Result<()> {
    let corners = [(x, y), (x + size.0, y + size.1)].map(to_drawing_position);
    Ok(sheet.draw(&Rectangle::new(corners, colour.filled()))?)
}

/// Returns the drawing library's font for a size in pixels.
pub(super) fn font(size: f64, weight: FontStyle) -> FontDesc<'static> {
    FontDesc::new(
        FontFamily::SansSerif,
        size * UNITS_PER_PIXEL * FONT_SIZE_DIVISOR,
        weight,
    )
}

/// Returns the approximate width of a text, in pixels.
pub(super) fn text_width(text: &str, size: f64) -> f64 {
    text.chars().count() as f64 * RELATIVE_CHARACTER_WIDTH * size
}

/// Converts a position in pixels to drawing units.
pub(super) fn to_drawing_position((x, y): PixelPosition) -> (i32, i32) {
    (to_drawing_units(x), to_drawing_units(y))
}

/// Converts pixels to drawing units; NaN becomes 0.
// The cast saturates, and a sheet is some thousand pixels wide.
pub(super) fn to_drawing_units(pixels: f64) -> i32 {
    (pixels * UNITS_PER_PIXEL).round() as i32
}
