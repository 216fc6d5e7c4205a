//! The legend, placed below the data.

use super::sheet::{DrawError, MARGIN, Sheet, Spot, TEXT, TextFormat, WIDTH, text_width};
use super::style::{Fill, MethodStyle};
use super::{Family, MethodFacts};
use ccd_core::order::greater;
use plotters::style::FontStyle;

/// The height of a line of the legend.
const LINE: f64 = 18.0;
/// The length of the sample of a line.
const SAMPLE: f64 = 30.0;
/// The gap between a sample and its text, and between two columns.
const GAP: f64 = 6.0;

/// The names and styles of methods, by family.
pub(super) struct Legend<'a> {
    groups: Vec<(&'static str, Vec<(String, &'a MethodStyle)>)>,
    column: f64,
    columns: usize,
}

impl<'a> Legend<'a> {
    /// Returns the legend of methods, on a sheet of the usual width.
    pub(super) fn of_methods(shown: &'a [(&MethodFacts<'_>, MethodStyle)]) -> Self {
        let entries = shown.iter().map(|(method, style)| {
            let text = match style.fill {
                Fill::Solid => method.label.to_owned(),
                Fill::Hollow => format!("{} (unsafe)", method.label),
            };
            (method.family, text, style)
        });
        Legend::new(entries, WIDTH - 2.0 * MARGIN)
    }

    /// Returns a legend of entries in their order, of the given width.
    fn new(entries: impl Iterator<Item = (Family, String, &'a MethodStyle)>, width: f64) -> Self {
        let mut groups: Vec<(&'static str, Vec<(String, &'a MethodStyle)>)> = Vec::new();
        for (family, text, style) in entries {
            let title = family.title();
            match groups.iter_mut().find(|(group, _)| *group == title) {
                Some((_, group)) => group.push((text, style)),
                None => groups.push((title, vec![(text, style)])),
            }
        }
        let widest = groups
            .iter()
            .flat_map(|(_, group)| group)
            .map(|(text, _)| text_width(text, TEXT))
            .fold(0.0, greater);
        let column = widest + SAMPLE + 3.0 * GAP;
        // At least one, and at most as many as are readable.
        let columns = ((width - head_width(&groups)) / column).clamp(1.0, 6.0) as usize;
        Legend {
            groups,
            column,
            columns,
        }
    }

    /// Returns the height.
    pub(super) fn height(&self) -> f64 {
        let lines = |(_, group): &(_, Vec<_>)| group.len().div_ceil(self.columns);
        LINE * self.groups.iter().map(lines).sum::<usize>() as f64
    }

    /// Draws the legend with its upper left corner at the given position, in pixels.
    pub(super) fn draw(&self, sheet: &Sheet<'_>, (left, mut top): Spot) -> Result<(), DrawError> {
        let head = head_width(&self.groups);
        for (title, group) in &self.groups {
            let bold = TextFormat {
                weight: FontStyle::Bold,
                ..TextFormat::default()
            };
            sheet.text(title, (left, top + 0.5 * LINE), bold)?;
            for (index, (text, style)) in group.iter().enumerate() {
                let (row, column) = (index / self.columns, index % self.columns);
                let left = left + head + self.column * column as f64;
                let middle = top + LINE * (row as f64 + 0.5);
                sheet.line(&[(left, middle), (left + SAMPLE, middle)], style.pen(1.5))?;
                sheet.marker((left + 0.5 * SAMPLE, middle), style)?;
                sheet.text(text, (left + SAMPLE + GAP, middle), TextFormat::default())?;
            }
            top += LINE * group.len().div_ceil(self.columns) as f64;
        }
        Ok(())
    }
}

fn head_width(groups: &[(&'static str, Vec<(String, &MethodStyle)>)]) -> f64 {
    let widest = groups.iter().map(|(title, _)| text_width(title, TEXT));
    widest.fold(0.0, greater) + 3.0 * GAP
}
