//! Axes: the range of a quantity, and the positions of values and grid lines.

use ccd_core::order::{greater, lesser};
use indicatif::HumanCount;

/// The maximum number of labelled decades of an axis.
const LABELS: i32 = 5;
/// The maximum number of decades of a logarithmic axis with lines between them.
const FINE: i32 = 2;
/// The margin of a fitted axis on either side, in decades.
const FRINGE: f64 = 0.06;
/// The least and the largest exponent of ten on an axis.
const EXPONENTS: (i32, i32) = (-30, 30);

/// A logarithmic axis of a panel.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Axis {
    label: String,
    low: f64,
    high: f64,
    ticks: Vec<Tick>,
}

/// A grid line across the panel.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tick {
    /// The position along the axis, from 0 to 1.
    pub(super) share: f64,
    /// The label; `None` for the finer lines.
    pub(super) text: Option<String>,
}

impl Axis {
    /// Returns an axis of whole decades around positive values, or `None` if there are none.
    pub(super) fn logarithmic(label: &str, values: impl Iterator<Item = f64>) -> Option<Self> {
        let (low, high) = extent(values.filter(|v| *v > 0.0).map(f64::log10))?;
        let low = exponent(low.floor());
        // The axis has at least one decade.
        let high = exponent(high.ceil()).max(low + 1);
        let span = f64::from(high - low);
        let step = (high - low + LABELS - 1) / LABELS;
        let mut ticks: Vec<_> = (low..=high)
            .map(|decade| Tick {
                share: f64::from(decade - low) / span,
                text: (decade.rem_euclid(step.max(1)) == 0).then(|| power_of_ten(decade)),
            })
            .collect();
        if high - low <= FINE {
            ticks.extend((low..high).flat_map(|decade| {
                (2..10).map(move |digit| Tick {
                    share: (f64::from(decade - low) + f64::from(digit).log10()) / span,
                    text: None,
                })
            }));
        }
        Some(Axis {
            label: label.to_owned(),
            low: f64::from(low),
            high: f64::from(high),
            ticks,
        })
    }

    /// Returns an axis slightly longer than the range of positive counts, with a line at 1, 2 and 5
    /// of every decade, or `None` if there are no counts.
    pub(super) fn fitted(label: &str, values: impl Iterator<Item = f64>) -> Option<Self> {
        let (low, high) = extent(values.filter(|v| *v > 0.0).map(f64::log10))?;
        let (low, high) = (low - FRINGE, high + FRINGE);
        let decades = exponent(low.floor())..=exponent(high.ceil());
        let ticks = decades
            .flat_map(|decade| [1.0, 2.0, 5.0].map(|digit| digit * 10f64.powi(decade)))
            .map(|value| (value, (value.log10() - low) / (high - low)))
            .filter(|(value, share)| *value >= 1.0 && (0.0..=1.0).contains(share))
            .map(|(value, share)| Tick {
                share,
                text: Some(HumanCount(value as u64).to_string()),
            });
        Some(Axis {
            label: label.to_owned(),
            low,
            high,
            ticks: ticks.collect(),
        })
    }

    /// Returns the label, with the unit.
    pub(super) fn label(&self) -> &str {
        &self.label
    }

    /// Returns the grid lines.
    pub(super) fn ticks(&self) -> &[Tick] {
        &self.ticks
    }

    /// Returns the position of a value along the axis, from 0 to 1. Values beyond are at the edge;
    /// NaN has no position.
    pub(super) fn share(&self, value: f64) -> Option<f64> {
        // The value 0 is beyond the lower edge, and still drawn.
        let share = (value.log10() - self.low) / (self.high - self.low);
        (!share.is_nan()).then(|| share.clamp(0.0, 1.0))
    }
}

/// Returns a text such as `10⁻³`.
pub(super) fn power_of_ten(exponent: i32) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let plain = exponent.to_string();
    let raised = plain.chars().map(|digit| match digit.to_digit(10) {
        Some(digit) => DIGITS[digit as usize],
        None => '⁻',
    });
    let mut text = "10".to_owned();
    text.extend(raised);
    text
}

fn extent(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    values
        .filter(|value| value.is_finite())
        .fold(None, |extent, value| match extent {
            None => Some((value, value)),
            Some((low, high)) => Some((lesser(low, value), greater(high, value))),
        })
}

// Within the exponents of a double.
fn exponent(value: f64) -> i32 {
    (value as i32).clamp(EXPONENTS.0, EXPONENTS.1)
}
