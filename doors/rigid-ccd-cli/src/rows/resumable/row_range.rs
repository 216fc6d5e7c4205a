//! A range of rows of a table, as `--rows` gives it.

use std::fmt;
use std::str::FromStr;

/// A range of rows of a table, numbered from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct RowRange {
    /// The number of the first row of the range.
    pub(crate) start: usize,
    /// The number of the row after the range; `None` for a range without an end.
    pub(crate) end_row: Option<usize>,
}

impl RowRange {
    pub(crate) fn contains(self, row: usize) -> bool {
        self.start <= row && self.end_row.is_none_or(|end| row < end)
    }

    pub(crate) fn includes_all_rows(self) -> bool {
        self.start == 0 && self.end_row.is_none()
    }
}

impl FromStr for RowRange {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let bound = |text: &str, absent| match text {
            "" => Ok(absent),
            number => number.parse().map(Some).map_err(|_| ()),
        };
        let range = text.split_once("..").and_then(|(start, end)| {
            let start = bound(start, Some(0)).ok()??;
            let end = bound(end, None).ok()?;
            Some(RowRange {
                start,
                end_row: end,
            })
        });
        range
            .filter(|range| range.end_row.is_none_or(|end| range.start < end))
            .ok_or_else(|| {
                "give the first row and the one after the last, such as 1000..2000".into()
            })
    }
}

impl fmt::Display for RowRange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let RowRange {
            start,
            end_row: end,
        } = self;
        match end {
            Some(end) => write!(f, "{start}..{end}"),
            None => write!(f, "{start}.."),
        }
    }
}
