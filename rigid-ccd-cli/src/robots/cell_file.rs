//! Reads what is around a robot: a TOML file of obstacles, held objects, paddings and clearances; or the parts of a glTF.

use anyhow::{Context, Result, anyhow, bail};
use ccd_decomp::{BodySource, Detail, Unit};
use rigid_ccd::glam::{DQuat, EulerRot};
use rigid_ccd::{Body, Pose, load_parts};
use rigid_ccd_robot::Cell;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// The content of the TOML file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct CellFile {
    /// Bodies at rest in the frame of the robot's base.
    #[serde(default)]
    obstacle: Vec<Obstacle>,
    /// Bodies that links hold.
    #[serde(default)]
    attached: Vec<AttachedBody>,
    /// The distances that obstacles have to keep from links, in addition to that of all pairs.
    #[serde(default)]
    padding: BTreeMap<String, f64>,
    /// The distances that single pairs have to keep, instead of that of all pairs and the padding.
    #[serde(default)]
    clearance: Vec<Clearance>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Obstacle {
    name: String,
    body: String,
    #[serde(default)]
    position: [f64; 3],
    rpy: Option<[f64; 3]>,
    quaternion: Option<[f64; 4]>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct AttachedBody {
    name: String,
    body: String,
    link: String,
    #[serde(default)]
    position: [f64; 3],
    rpy: Option<[f64; 3]>,
    quaternion: Option<[f64; 4]>,
    #[serde(default)]
    may_touch: Vec<String>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Clearance {
    between: [String; 2],
    distance: f64,
}

/// Adds the content of a cell file to a cell. Bodies are named as in `--a` of `ccd query`; their files are looked for next to
/// the cell file.
///
/// # Errors
/// If the file cannot be read, or names something that there is not.
pub(super) fn add_to(cell: &mut Cell, path: &Path) -> Result<()> {
    let extension = path.extension().and_then(|extension| extension.to_str());
    if matches!(extension, Some("glb" | "gltf")) {
        for (name, body) in load_parts(path)? {
            cell.add_obstacle(name, body, Pose::IDENTITY)?;
        }
        return Ok(());
    }
    let text = fs::read_to_string(path)?;
    let file: CellFile = toml::from_str(&text).map_err(|error| {
        let start = error.span().map_or(0, |span| span.start);
        let line = 1 + text[..start].matches('\n').count();
        anyhow!("line {line}: {}", error.message())
    })?;
    let folder = path.parent().unwrap_or(Path::new(""));
    for obstacle in file.obstacle {
        let name = obstacle.name.clone();
        add_obstacle(cell, folder, obstacle).with_context(|| format!("obstacle {name}"))?;
    }
    for attached in file.attached {
        let name = attached.name.clone();
        attach(cell, folder, attached).with_context(|| format!("attached body {name}"))?;
    }
    for (link, distance) in &file.padding {
        cell.set_padding(link, *distance)?;
    }
    for Clearance { between, distance } in &file.clearance {
        let [a, b] = between;
        let pair = [cell.item_named(a)?, cell.item_named(b)?];
        cell.set_clearance(pair, *distance)?;
    }
    Ok(())
}

fn add_obstacle(cell: &mut Cell, folder: &Path, given: Obstacle) -> Result<()> {
    let body = body_beside(folder, &given.body)?;
    let pose = pose(given.position, given.rpy, given.quaternion)?;
    Ok(cell.add_obstacle(given.name, body, pose)?)
}

fn attach(cell: &mut Cell, folder: &Path, given: AttachedBody) -> Result<()> {
    let body = body_beside(folder, &given.body)?;
    let pose = pose(given.position, given.rpy, given.quaternion)?;
    let may_touch: Vec<&str> = given.may_touch.iter().map(String::as_str).collect();
    Ok(cell.attach(given.name, body, (&given.link, pose), &may_touch)?)
}

/// Makes the body that a text names, in metres. A file is looked for in a folder, unless its path is absolute.
fn body_beside(folder: &Path, text: &str) -> Result<Body> {
    let mut source: BodySource = text.parse()?;
    match &mut source {
        BodySource::Mesh(mesh) => mesh.file = folder.join(&mesh.file),
        BodySource::StoredBody(file) => *file = folder.join(&*file),
        _ => {}
    }
    Ok(source.load_in_unit(Unit::Metre, Detail::Auto)?.body)
}

/// Returns a pose whose rotation is roll, pitch and yaw as in a URDF, a quaternion (w, x, y, z), or none.
fn pose(position: [f64; 3], rpy: Option<[f64; 3]>, quaternion: Option<[f64; 4]>) -> Result<Pose> {
    let rotation = match (rpy, quaternion) {
        (Some(_), Some(_)) => bail!("give either rpy or quaternion"),
        (Some([roll, pitch, yaw]), None) => DQuat::from_euler(EulerRot::ZYX, yaw, pitch, roll),
        (None, Some([w, x, y, z])) => DQuat::from_xyzw(x, y, z, w),
        (None, None) => DQuat::IDENTITY,
    };
    Ok(Pose::new(position, rotation)?)
}

#[cfg(test)]
mod tests;
