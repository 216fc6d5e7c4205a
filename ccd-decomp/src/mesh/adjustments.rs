//! Adjustments that a caller makes to a mesh that is read from a file: unit, scale, mirroring, hollowness.

use super::affine::AffineMap;
use super::unit::Unit;
use ccd_core::glam::{DAffine3, DVec3};
use ccd_core::{InputError, check};
use std::fmt;

/// The adjustments of a mesh that is read from a file: unit, scale, mirroring, and whether it is hollow.
///
/// ```
/// use ccd_decomp::{Adjustments, Axis, Unit};
/// // The left part, of a right one that was drawn in millimetres; lengths are to be in metres.
/// let left = Adjustments::default()
///     .with_stated_unit(Unit::Millimetre)
///     .with_target_unit(Unit::Metre)
///     .mirrored(Axis::Y);
/// assert_eq!(left.to_string(), "@mm@mirror=y");
/// assert!(left.scaled(-1.0).is_err());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Adjustments {
    /// The unit of the coordinates in the file; `None` uses the unit that the file states, if any.
    pub(crate) stated_unit: Option<Unit>,
    /// The unit to convert the coordinates to; `None` leaves them in the file's unit.
    pub(crate) target_unit: Option<Unit>,
    /// The factors by which the coordinates along each axis are multiplied; negative along mirrored axes, never 0 or
    /// infinite.
    scale_by_axis: DVec3,
    /// Whether a closed mesh is treated as a hollow surface.
    pub(crate) is_hollow: bool,
}

/// A coordinate axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// The first axis, x.
    X,
    /// The second axis, y.
    Y,
    /// The third axis, z.
    Z,
}

impl Adjustments {
    /// The adjustments that change nothing.
    pub const NONE: Adjustments = Adjustments {
        stated_unit: None,
        target_unit: None,
        scale_by_axis: DVec3::ONE,
        is_hollow: false,
    };

    /// Sets the unit of the numbers in the file. It takes precedence over a unit that the file states.
    #[must_use]
    pub fn with_stated_unit(mut self, unit: Unit) -> Self {
        self.stated_unit = Some(unit);
        self
    }

    /// [Converts](crate::MeshFile::converted_to_unit) the coordinates to a unit. The coordinates of a file without a known unit
    /// stay as they are.
    #[must_use]
    pub fn with_target_unit(mut self, unit: Unit) -> Self {
        self.target_unit = Some(unit);
        self
    }

    /// Multiplies all coordinates by a factor. Each is rounded once.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] unless the factor is positive and finite.
    pub fn scaled(mut self, factor: f64) -> Result<Self, InputError> {
        self.scale_by_axis *= factor;
        let factors = self.scale_by_axis;
        // Written so that NaN is refused; several factors may leave the range together.
        let is_allowed = factor > 0.0 && factors.abs().min_element() > 0.0 && factors.is_finite();
        check("scale", factor, is_allowed, "positive and finite")?;
        Ok(self)
    }

    /// Mirrors the mesh along a coordinate axis, across the plane through the origin. The triangles are reversed, so
    /// that a solid stays one. Exact.
    #[must_use]
    pub fn mirrored(mut self, axis: Axis) -> Self {
        self.scale_by_axis[axis as usize] *= -1.0;
        self
    }

    /// Treats a closed mesh as a hollow [surface](crate::PieceChoice::Surface), whatever the kind of pieces.
    #[must_use]
    pub fn treated_as_hollow(mut self) -> Self {
        self.is_hollow = true;
        self
    }

    /// Returns the adjustments that apply both `self` and `other`. The units of `other` take precedence.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] if the product of the factors is 0 or not finite.
    pub fn combined_with(self, other: &Adjustments) -> Result<Self, InputError> {
        let mirrored = other.mirrored_axes().fold(self, Adjustments::mirrored);
        let both = match other.scale() {
            1.0 => mirrored,
            scale => mirrored.scaled(scale)?,
        };
        Ok(Adjustments {
            stated_unit: other.stated_unit.or(self.stated_unit),
            target_unit: other.target_unit.or(self.target_unit),
            is_hollow: self.is_hollow || other.is_hollow,
            ..both
        })
    }

    /// Returns the affine map that scales and mirrors the file's coordinates; `None` if it is the identity.
    pub(crate) fn affine_map(&self) -> Option<AffineMap> {
        let map = || DAffine3::from_scale(self.scale_by_axis).into();
        (self.scale_by_axis != DVec3::ONE).then(map)
    }

    /// Returns whether any adjustment is of a kind that applies to meshes only, and not to prepared bodies.
    pub(crate) fn has_mesh_only_adjustment(&self) -> bool {
        let others = Adjustments {
            target_unit: None,
            ..*self
        };
        others != Adjustments::NONE
    }

    fn scale(&self) -> f64 {
        self.scale_by_axis.x.abs()
    }

    /// Iterates over the axes along which the mesh is mirrored.
    fn mirrored_axes(&self) -> impl Iterator<Item = Axis> {
        let factors = self.scale_by_axis;
        let axes = [Axis::X, Axis::Y, Axis::Z].into_iter();
        axes.filter(move |&axis| factors[axis as usize] < 0.0)
    }

    /// Returns the adjustments with another one added, which a word after a file name describes, such as `scale=0.5`.
    ///
    /// # Errors
    /// The word is no adjustment.
    pub(crate) fn with_parsed_adjustment(self, word: &str) -> Result<Self, UnknownAdjustment> {
        let unknown = || UnknownAdjustment { word: word.into() };
        if let Some(factor) = word.strip_prefix("scale=") {
            let factor: f64 = factor.parse().map_err(|_| unknown())?;
            return self.scaled(factor).map_err(|_| unknown());
        }
        match word {
            "surface" => Ok(self.treated_as_hollow()),
            "mirror=x" => Ok(self.mirrored(Axis::X)),
            "mirror=y" => Ok(self.mirrored(Axis::Y)),
            "mirror=z" => Ok(self.mirrored(Axis::Z)),
            unit => Ok(self.with_stated_unit(unit.parse().map_err(|_| unknown())?)),
        }
    }
}

/// The error for a word after a file name that describes no adjustment.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("@{word}{}", unknown_adjustment_message(.word))]
pub struct UnknownAdjustment {
    /// The word that was not recognised.
    pub word: String,
}

/// Returns the message for a word that describes no adjustment: what is wrong, and which words are accepted.
fn unknown_adjustment_message(word: &str) -> String {
    match word.strip_prefix("scale=") {
        Some(factor) => format!(
            ": {factor} is no factor, which is a positive number; to mirror, use @mirror=x (or y, z)"
        ),
        None => " means nothing after a file; use @mm (the unit of its numbers: um, mm, cm, m, in or ft), \
                 @scale=0.001, @mirror=x (or y, z) or @surface"
            .into(),
    }
}

impl Default for Adjustments {
    fn default() -> Self {
        Adjustments::NONE
    }
}

/// Formats the adjustments as words that follow a file name. The unit of conversion is omitted.
impl fmt::Display for Adjustments {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(unit) = self.stated_unit {
            write!(f, "@{unit}")?;
        }
        if self.scale() != 1.0 {
            write!(f, "@scale={}", self.scale())?;
        }
        for axis in self.mirrored_axes() {
            write!(f, "@mirror={axis}")?;
        }
        if self.is_hollow {
            write!(f, "@surface")?;
        }
        Ok(())
    }
}

impl fmt::Display for Axis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Axis::X => "x",
            Axis::Y => "y",
            Axis::Z => "z",
        })
    }
}

#[cfg(test)]
mod tests;
