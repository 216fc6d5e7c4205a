//! Computes the proven least clearance between the teeth of two involute gears over a full turn.
//!
//! ```sh
//! cargo run --release -p rigid-ccd --example gears
//! ```
//! The clearance is bracketed for each degree, so that nothing in between is missed.

use rigid_ccd::glam::{DQuat, DVec3};
use rigid_ccd::mesh::{PieceChoice, TriangleMesh, body_from_mesh};
use rigid_ccd::{Body, Motion, Pose, Settings, Solver};
use std::f64::consts::PI;
use std::io::Write;

/// A spur gear in millimetres, with a pressure angle of 20 degrees.
struct Gear {
    teeth: u32,
    module: f64,
    /// The width of a gap minus the width of a tooth, at the pitch circle.
    backlash: f64,
}

const PRESSURE_ANGLE: f64 = PI / 9.0;
const FACE_WIDTH: f64 = 4.0;

impl Gear {
    fn pitch_radius(&self) -> f64 {
        0.5 * self.module * f64::from(self.teeth)
    }

    /// Returns the outline as points, counterclockwise, starting at the root of the tooth at angle 0.
    fn outline(&self) -> Vec<[f64; 2]> {
        let pitch = self.pitch_radius();
        let base = pitch * PRESSURE_ANGLE.cos();
        let (root, tip) = (pitch - 1.25 * self.module, pitch + self.module);
        // The angle by which an involute has turned at a pressure angle.
        let involute = |angle: f64| angle.tan() - angle;
        let half_at = |radius: f64| {
            let at_pitch = 0.25 * (2.0 * PI / f64::from(self.teeth) - self.backlash / pitch);
            at_pitch + involute(PRESSURE_ANGLE) - involute((base / radius).clamp(0.0, 1.0).acos())
        };
        let first = if base > root { base } else { root };
        let radii = (0..=STEPS).map(|k| first + (tip - first) * f64::from(k) / f64::from(STEPS));
        let flank: Vec<[f64; 2]> = [[root, half_at(first)]]
            .into_iter()
            .chain(radii.map(|radius| [radius, half_at(radius)]))
            .collect();
        let mut outline = Vec::new();
        for tooth in 0..self.teeth {
            let middle = 2.0 * PI * f64::from(tooth) / f64::from(self.teeth);
            let right = flank.iter().map(|&[radius, half]| [radius, middle - half]);
            let left = flank
                .iter()
                .rev()
                .map(|&[radius, half]| [radius, middle + half]);
            outline.extend(right.chain(left));
        }
        let flat = |[radius, angle]: [f64; 2]| [radius * angle.cos(), radius * angle.sin()];
        outline.into_iter().map(flat).collect()
    }

    /// Returns the solid: the outline, extruded along z.
    fn body(&self) -> Result<Body, Box<dyn std::error::Error>> {
        let outline = self.outline();
        let count = outline.len() as u32;
        let mut vertices = Vec::new();
        for z in [-0.5 * FACE_WIDTH, 0.5 * FACE_WIDTH] {
            vertices.extend(outline.iter().map(|&[x, y]| DVec3::new(x, y, z)));
        }
        // Every point of the outline is visible from the axis.
        vertices.extend([-0.5, 0.5].map(|side| side * FACE_WIDTH * DVec3::Z));
        let (bottom, top) = (2 * count, 2 * count + 1);
        let mut faces = Vec::new();
        for k in 0..count {
            let next = (k + 1) % count;
            faces.extend([[bottom, next, k], [top, count + k, count + next]]);
            faces.extend([[k, next, count + next], [k, count + next, count + k]]);
        }
        let mesh = TriangleMesh::new(vertices, &faces)?;
        Ok(body_from_mesh(&mesh, PieceChoice::Auto)?.body)
    }
}

/// The number of straight segments of a tooth's flank.
const STEPS: u32 = 8;

/// The angle of rotation, in degrees of the first gear, over which one clearance is computed.
const DEGREES_PER_INTERVAL: u32 = 1;

/// Returns a lower and an upper bound of the least clearance in each interval of a full turn of the first gear.
fn clearance_per_interval(a: &Gear, b: &Gear) -> Result<Vec<[f64; 2]>, Box<dyn std::error::Error>> {
    let bodies = [a.body()?, b.body()?];
    // The axes are a little farther apart than the pitch circles require.
    let distance = a.pitch_radius() + b.pitch_radius() + 0.02 * a.module;
    let ratio = f64::from(a.teeth) / f64::from(b.teeth);
    let mut solver = Solver::new().with_settings(Settings {
        tolerance: 1e-4,
        ..Settings::DEFAULT
    });
    let mut windows = Vec::new();
    for angle in (0..360).step_by(DEGREES_PER_INTERVAL as usize) {
        let [from, turn] =
            [angle, DEGREES_PER_INTERVAL].map(|degrees| f64::from(degrees).to_radians());
        // A tooth of the first gear points to a gap of the second one.
        let gap = PI + PI / f64::from(b.teeth);
        let turned = DQuat::from_rotation_z;
        let motion = |x: f64, at: f64, spin: f64| {
            let start = Pose::new([x, 0.0, 0.0], turned(at))?;
            Motion::new(start, [0.0; 3], [0.0, 0.0, spin])
        };
        let closest = solver.closest_approach(
            (&bodies[0], motion(0.0, from, turn)?),
            (
                &bodies[1],
                motion(distance, gap - ratio * from, -ratio * turn)?,
            ),
            1.0,
        )?;
        windows.push([closest.outcome.lower(), closest.outcome.upper()]);
    }
    Ok(windows)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let gear = |teeth| Gear {
        teeth,
        module: 1.0,
        backlash: 0.1,
    };
    let windows = clearance_per_interval(&gear(20), &gear(30))?;
    let mut print = std::io::stdout().lock();
    writeln!(print, "degrees  least clearance, mm")?;
    let angles = (0..360).step_by(DEGREES_PER_INTERVAL as usize);
    for (angle, [lower, upper]) in angles.zip(&windows).step_by(10) {
        writeln!(print, "{angle:>7}  {lower:.4} to {upper:.4}")?;
    }
    let least = windows.iter().map(|[lower, _]| *lower);
    let least = least.min_by(f64::total_cmp).unwrap_or_default();
    let most = windows.iter().map(|[_, upper]| *upper);
    let most = most.max_by(f64::total_cmp).unwrap_or_default();
    writeln!(
        print,
        "windows of a degree: the least bound is {least:.4}, the largest {most:.4}"
    )?;
    Ok(())
}
