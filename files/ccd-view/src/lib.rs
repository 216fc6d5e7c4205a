//! Offline pages that show moving bodies, their contacts, and the proven gap between them.
//!
//! | to … | use |
//! |---|---|
//! | make a whole page | [`page_html`] |
//! | put the views on another page | [`VIEW_HTML`], [`VIEW_CSS`], [`view_scripts`] and [`views_json`] |
//! | describe the views | [`AnimationGroup`] of [`Animation`]s: [`ShownBody`], [`ShownContact`], [`GapCurve`] |
//!
//! A page is one file: it needs no network and no server, and draws with [three.js](https://threejs.org) by WebGL.
//! Meshes are drawn in single precision, relative to their centers. Texts and numbers are shown as given.
//!
//! # Example
//! ```
//! use ccd_core::Motion;
//! use ccd_view::{Animation, DrawnMesh, Meshes, ShownBody, page_html};
//! use ccd_core::glam::DVec3;
//!
//! let mut meshes = Meshes::default();
//! let corners = [DVec3::ZERO, DVec3::X, DVec3::Y];
//! let triangle = meshes.add(&DrawnMesh { vertices: corners.to_vec(), faces: vec![[0, 1, 2]] });
//! let slides = Motion::STILL;
//! let view = Animation {
//!     bodies: vec![ShownBody::new("A", triangle, "#3a9d6e", &slides)],
//!     ..Animation::new("at rest", "Nothing moves.", 1.0)
//! };
//! let html = page_html("A triangle", &meshes, vec![view])?;
//! assert!(html.contains("Nothing moves."));
//! # Ok::<(), serde_json::Error>(())
//! ```

mod mesh;
mod page;
mod shown_motion;
mod view;

pub use mesh::{DrawnMesh, Meshes};
pub use page::{
    VIEW_CSS, VIEW_HTML, drawing_scripts, escape, fill_template, json, page_html, script_elements,
    view_scripts, views_json,
};
pub use shown_motion::{Keyframe, ShownMotion};
pub use view::{
    Animation, AnimationGroup, FailingRange, GapCurve, GapSample, ShownBody, ShownContact,
};
