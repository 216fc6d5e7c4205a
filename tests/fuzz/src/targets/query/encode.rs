//! Encodes a query as bytes, to turn cases into seeds.

use super::decode::{
    BUDGET_BIT, CENTER_BIT, DURATION_BIT, END_POSE_BIT, LEAVE_BIT, MARGIN_BIT, MESH_SHAPE_KIND,
    ROTATED_BIT, SPIN_BIT, TOLERANCE_BIT, VELOCITY_BIT,
};
use super::source::{FIXED_POINT_TAG_COUNT, RAW_NUMBER_TAG};
use crate::case::{Case, MeshClass, Shape};
use crate::raw_motion::{MotionSpec, RawMotion};
use ccd_core::StartPolicy;

/// Returns bytes that decode to the case and to the `method`, a number from 0 to 14. The budget is kept only if it is
/// small, and meshes must have fewer than 33 vertices and 49 faces.
pub fn encode(case: &Case, method: u8) -> Option<Vec<u8>> {
    let mut out = CaseWriter(Vec::new());
    let config = &case.config;
    let mut flags = MARGIN_BIT | DURATION_BIT | TOLERANCE_BIT;
    if config.start_policy == StartPolicy::Leave {
        flags |= LEAVE_BIT;
    }
    let budget = u8::try_from(config.budget).ok();
    if budget.is_some() {
        flags |= BUDGET_BIT;
    }
    out.0.push(flags);
    out.write_numbers(&[config.tolerance, config.margin]);
    out.0.extend(budget);
    out.write_numbers(&[case.duration]);
    out.0.push(method);
    for shape in &case.shapes {
        out.write_shape(shape)?;
    }
    for course in &case.motions {
        out.write_motion(course);
    }
    Some(out.0)
}

struct CaseWriter(Vec<u8>);

impl CaseWriter {
    fn write_numbers(&mut self, numbers: &[f64]) {
        for &x in numbers {
            let tag = 16.0 * x + 64.0;
            if tag >= 0.0
                && tag < f64::from(FIXED_POINT_TAG_COUNT)
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

    fn write_shape(&mut self, shape: &Shape) -> Option<()> {
        let form = match shape.mesh_class {
            MeshClass::Convex => 0,
            MeshClass::Solid => 1,
            MeshClass::TriangleSoup | MeshClass::VertexHull => 2,
        };
        self.0.push(MESH_SHAPE_KIND | form << 3);
        let (vertices, faces) = (shape.vertices.len(), shape.faces.len());
        if !((1..33).contains(&vertices) && (1..49).contains(&faces)) {
            return None;
        }
        self.0.extend([vertices as u8 - 1, faces as u8 - 1]);
        self.write_numbers(shape.vertices.as_flattened());
        self.0
            .extend(shape.faces.iter().flatten().map(|&v| v as u8));
        Some(())
    }

    fn write_motion(&mut self, course: &RawMotion) {
        let goal = match course.spec {
            MotionSpec::Velocities { .. } => VELOCITY_BIT | SPIN_BIT,
            MotionSpec::EndPose(_) => END_POSE_BIT | SPIN_BIT,
        };
        self.0.push(ROTATED_BIT | CENTER_BIT | goal);
        self.write_numbers(&course.start.position);
        self.write_numbers(&course.start.quaternion);
        self.write_numbers(&course.center);
        match course.spec {
            MotionSpec::Velocities { linear, spin } => {
                self.write_numbers(&linear);
                self.write_numbers(&spin);
            }
            MotionSpec::EndPose(end) => {
                self.write_numbers(&end.position);
                self.write_numbers(&end.quaternion);
            }
        }
    }
}
