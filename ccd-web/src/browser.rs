//! The functions that the page calls.
#![allow(unreachable_pub, reason = "JavaScript reaches it")]

use crate::{Part, Throw, Thrown};
use wasm_bindgen::prelude::{JsError, wasm_bindgen};

/// A part that the page can throw, as JavaScript sees it.
#[wasm_bindgen(js_name = Part)]
#[derive(Debug)]
pub struct BrowserPart(Part);

/// The certified result of a throw, as JavaScript sees it.
#[wasm_bindgen(js_name = Thrown)]
#[derive(Debug)]
pub struct BrowserOutcome(Thrown);

#[wasm_bindgen(js_class = Part)]
impl BrowserPart {
    /// Creates the built-in part with the given name.
    pub fn named(name: &str) -> Result<Self, JsError> {
        Ok(BrowserPart(Part::named(name)?))
    }

    /// Reads a mesh file, and scales it to `size` metres.
    pub fn from_file(name: &str, bytes: &[u8], size: f64) -> Result<Self, JsError> {
        Ok(BrowserPart(Part::from_file(name, bytes, size)?))
    }

    /// Returns the drawn vertices, three coordinates each.
    pub fn vertices(&self) -> Vec<f32> {
        self.0.vertices()
    }

    /// Returns the drawn faces, three vertex numbers each.
    pub fn faces(&self) -> Vec<u32> {
        self.0.faces()
    }

    /// Returns the greatest distance of the drawing from the part's origin, in metres.
    pub fn reach(&self) -> f64 {
        self.0.reach()
    }
}

#[wasm_bindgen(js_class = Thrown)]
impl BrowserOutcome {
    /// Returns the name of the result's kind.
    #[wasm_bindgen(getter)]
    pub fn verdict(&self) -> String {
        self.0.verdict.name().to_owned()
    }

    /// Returns the time in seconds before which nothing touches.
    #[wasm_bindgen(getter)]
    pub fn time(&self) -> f64 {
        self.0.time
    }

    /// Returns the nearest points of both parts and the normal, nine numbers; empty without a contact.
    pub fn points(&self) -> Vec<f64> {
        let Some(hit) = self.0.hit else {
            return Vec::new();
        };
        let mut points = [hit.witness_a(), hit.witness_b()]
            .map(|p| p.to_array())
            .concat();
        points.extend(
            hit.contact()
                .iter()
                .flat_map(|contact| contact.separation.normal.to_array()),
        );
        points
    }
}

/// Finds the first contact of a throw, given by nine numbers: position, velocity and angular velocity.
#[wasm_bindgen]
pub fn first_contact(
    part: &BrowserPart,
    target: &BrowserPart,
    throw: &[f64],
) -> Result<BrowserOutcome, JsError> {
    Ok(BrowserOutcome(
        thrown(throw)?.first_contact(&part.0, &target.0)?,
    ))
}

/// Tests evenly spaced instants of a throw, given by nine numbers: 1 if the parts touch.
#[wasm_bindgen]
pub fn steps(
    part: &BrowserPart,
    target: &BrowserPart,
    throw: &[f64],
    count: u32,
) -> Result<Vec<u8>, JsError> {
    let touches = thrown(throw)?.steps(&part.0, &target.0, count)?;
    Ok(touches.into_iter().map(u8::from).collect())
}

fn thrown(numbers: &[f64]) -> Result<Throw, JsError> {
    let &[px, py, pz, vx, vy, vz, wx, wy, wz] = numbers else {
        return Err(JsError::new("a throw is nine numbers"));
    };
    Ok(Throw {
        place: [px, py, pz],
        velocity: [vx, vy, vz],
        spin: [wx, wy, wz],
    })
}
