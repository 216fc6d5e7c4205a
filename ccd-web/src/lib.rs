//! Throws parts at each other, to compare the certified first contact with discrete time steps.
//!
//! | to … | use |
//! |---|---|
//! | make a part | [`Part::from_name`] |
//! | throw it at another one | [`Throw`], then [`Throw::first_contact`] |
//! | look at some instants of the same throw | [`Throw::steps`] |
//!
//! The command `ccd-web` writes a self-contained page, which asks the same of the npm package `rigid-ccd` in the browser.
//!
//! # Example
//! ```
//! use ccd_web::{Part, Throw};
//! let (bullet, sheet) = (Part::from_name("bullet")?, Part::from_name("sheet")?);
//! let throw = Throw { place: [-1.02, 0.0, 0.0], velocity: [9.4, 0.0, 0.0], spin: [0.0; 3] };
//! let found = throw.first_contact(&bullet, &sheet)?;
//! assert!(found.time > 0.105 && found.time < 0.106);
//! // Sixty steps a second pass through the sheet.
//! assert!(!throw.steps(&bullet, &sheet, 60)?.contains(&1));
//! # Ok::<(), ccd_web::WebError>(())
//! ```

mod part;
mod shapes;
mod throw;

pub use part::{Part, WebError};
pub use throw::{Throw, ThrowResult};
