//! Encodes a query as bytes, to turn cases into seeds.

use super::decode::{
    BUDGET_BIT, CENTRE_BIT, DURATION_BIT, END_POSE_BIT, LEAVE_BIT, MARGIN_BIT, MESH_KIND,
    ROTATED_BIT, SPIN_BIT, TOLERANCE, VELOCITY_BIT,
};
use super::source::{RAW_NUMBER_TAG, SIXTEENTH_TAGS};
use crate::case::{Case, Form, Shape};
use crate::raw_motion::{Goal, RawMotion};
use ccd_core::StartPolicy;

/// Returns bytes that decode to the case and to the `method`, a number from 0 to 14. The budget is kept only if it is
/// small, and meshes must have fewer than 33 vertices and 49 faces.
pub fn encode(case: &Case, method: u8) -> Option<Vec<u8>> {
    let mut out = Writer(Vec::new());
    let config = &case.config;
    let mut flags = MARGIN_BIT | DURATION_BIT | TOLERANCE;
    if config.start == StartPolicy::Leave {
        flags |= LEAVE_BIT;
    }
    let budget = u8::try_from(config.budget).ok();
    if budget.is_some() {
        flags |= BUDGET_BIT;
    }
    out.0.push(flags);
    out.numbers(&[config.tolerance, config.margin]);
    out.0.extend(budget);
    out.numbers(&[case.duration]);
    out.0.push(method);
    for shape in &case.shapes {
        out.shape(shape)?;
    }
    for course in &case.courses {
        out.course(course);
    }
    Some(out.0)
}

struct Writer(Vec<u8>);

impl Writer {
    fn numbers(&mut self, numbers: &[f64]) {
        for &x in numbers {
            let tag = 16.0 * x + 64.0;
            if tag >= 0.0
                && tag < f64::from(SIXTEENTH_TAGS)
                && tag.fract() == 0.0
                && x.to_bits() != (-0.0f64).to_bits()
            {
                self.0.push(tag as u8);
            } else {
                self.0.push(RAW_NUMBER_TAG);
                self.0.extend(x.to_le_bytes());
            }
        }
    }

    fn shape(&mut self, shape: &Shape) -> Option<()> {
        let form = match shape.form {
            Form::Convex => 0,
            Form::Solid => 1,
            Form::TriangleSoup | Form::Points => 2,
        };
        self.0.push(MESH_KIND | form << 3);
        let (vertices, faces) = (shape.vertices.len(), shape.faces.len());
        if !((1..33).contains(&vertices) && (1..49).contains(&faces)) {
            return None;
        }
        self.0.extend([vertices as u8 - 1, faces as u8 - 1]);
        self.numbers(shape.vertices.as_flattened());
        self.0
            .extend(shape.faces.iter().flatten().map(|&v| v as u8));
        Some(())
    }

    fn course(&mut self, course: &RawMotion) {
        let goal = match course.goal {
            Goal::Velocities { .. } => VELOCITY_BIT | SPIN_BIT,
            Goal::End(_) => END_POSE_BIT | SPIN_BIT,
        };
        self.0.push(ROTATED_BIT | CENTRE_BIT | goal);
        self.numbers(&course.start.position);
        self.numbers(&course.start.quaternion);
        self.numbers(&course.centre);
        match course.goal {
            Goal::Velocities { linear, spin } => {
                self.numbers(&linear);
                self.numbers(&spin);
            }
            Goal::End(end) => {
                self.numbers(&end.position);
                self.numbers(&end.quaternion);
            }
        }
    }
}
