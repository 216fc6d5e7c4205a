//! Axes: what is shown of a quantity, and where.

use ccd_core::order::{greater, lesser};
use indicatif::HumanCount;

/// The decades an axis has a label for, at most.
const LABELS: i32 = 5;
/// A logarithmic axis of no more decades than this has lines between them.
const FINE: i32 = 2;
/// What a fitted axis has on either side, in decades.
const FRINGE: f64 = 0.06;
/// The least and the largest exponent of ten that an axis reaches.
const EXPONENTS: (i32, i32) = (-30, 30);

/// An axis of a panel.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Axis {
    label: String,
    low: f64,
    high: f64,
    scale: Scale,
    ticks: Vec<Tick>,
}

/// How values are laid out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Scale {
    Logarithmic,
    Linear,
}

/// A line across the panel.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tick {
    /// How far along the axis, from 0 to 1.
    pub(super) share: f64,
    /// What it says; nothing for the finer ones.
    pub(super) text: Option<String>,
}

impl Axis {
    /// Whole decades around positive values; none where there are none.
    pub(super) fn logarithmic(label: &str, values: impl Iterator<Item = f64>) -> Option<Self> {
        let (low, high) = extent(values.filter(|v| *v > 0.0).map(f64::log10))?;
        let low = exponent(low.floor());
        // At least one decade.
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
            scale: Scale::Logarithmic,
            ticks,
        })
    }

    /// Little more than what positive counts take, with a line at 1, 2 and 5 of every decade; none
    /// where there are none.
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
            scale: Scale::Logarithmic,
            ticks: ticks.collect(),
        })
    }

    /// From 0 to a number of things, with a line every so many.
    pub(super) fn counting(label: &str, count: usize, every: usize) -> Self {
        let high = count.max(1) as f64;
        let ticks = (0..=count).step_by(every.max(1)).map(|number| Tick {
            share: number as f64 / high,
            text: Some(number.to_string()),
        });
        Axis {
            label: label.to_owned(),
            low: 0.0,
            high,
            scale: Scale::Linear,
            ticks: ticks.collect(),
        }
    }

    /// What it shows, with the unit.
    pub(super) fn label(&self) -> &str {
        &self.label
    }

    /// The lines across.
    pub(super) fn ticks(&self) -> &[Tick] {
        &self.ticks
    }

    /// How far along the axis a value is: from 0 to 1, those beyond at the edge; none for NaN.
    pub(super) fn share(&self, value: f64) -> Option<f64> {
        let value = match self.scale {
            Scale::Linear => value,
            // What is 0 is beyond the lower edge, not lost.
            Scale::Logarithmic => value.log10(),
        };
        let share = (value - self.low) / (self.high - self.low);
        (!share.is_nan()).then(|| share.clamp(0.0, 1.0))
    }
}

/// `10⁻³`.
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
