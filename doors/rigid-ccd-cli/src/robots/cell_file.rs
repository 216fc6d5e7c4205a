//! Reads the cell of a robot: a TOML file of obstacles, other robots, held objects, paddings and clearances; or a glTF whose
//! parts are obstacles.

mod pairs;
mod values;

use anyhow::{Context, Result, anyhow, bail};
use ccd_decomp::{BodySource, PieceChoice, Unit};
use pairs::{AllowedContact, Clearance, PairsWithClearance};
use rigid_ccd::{Body, Pose, Remark, load_parts};
use rigid_ccd_robot::{
    Cell, CellRemark, CompoundKind, Link, LinkPairs, PlacedRobot, Robot, RobotFile,
};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::Path;
use values::pose;

/// The content of the TOML file.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CellFile {
    /// Bodies in the frame of the robot's base.
    #[serde(default)]
    obstacle: Vec<Obstacle>,
    /// Half-spaces in the frame of the robot's base.
    #[serde(default)]
    plane: Vec<Plane>,
    /// Other robots.
    #[serde(default)]
    robot: Vec<OtherRobot>,
    /// Bodies that links hold.
    #[serde(default)]
    attached: Vec<AttachedBody>,
    /// The distances that obstacles have to keep from links, in addition to the clearance of all pairs.
    #[serde(default)]
    padding: BTreeMap<String, f64>,
    /// The distances that single pairs have to keep, instead of the clearance of all pairs and the padding.
    #[serde(default)]
    clearance: Vec<Clearance>,
    /// The pairs that may touch.
    #[serde(default)]
    allowed: Vec<AllowedContact>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Obstacle {
    name: String,
    body: String,
    position: Option<Vec<f64>>,
    rpy: Option<Vec<f64>>,
    quaternion_xyzw: Option<Vec<f64>>,
    /// How the obstacle moves; `None` if it rests.
    moves: Option<BaseMotion>,
}

/// The half-space below the plane z = 0 of a frame.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Plane {
    name: String,
    position: Option<Vec<f64>>,
    rpy: Option<Vec<f64>>,
    quaternion_xyzw: Option<Vec<f64>>,
}

/// A robot in addition to the one that the command names.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct OtherRobot {
    name: String,
    urdf: String,
    srdf: Option<String>,
    /// The link to which the base is attached; `None` for the world.
    on: Option<String>,
    position: Option<Vec<f64>>,
    rpy: Option<Vec<f64>>,
    quaternion_xyzw: Option<Vec<f64>>,
    /// How the base moves; `None` if it rests.
    base: Option<BaseMotion>,
}

/// How an obstacle, or the base of a robot, moves.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "lowercase")]
enum BaseMotion {
    Planar,
    Floating,
}

impl From<BaseMotion> for CompoundKind {
    fn from(motion: BaseMotion) -> CompoundKind {
        match motion {
            BaseMotion::Planar => CompoundKind::Planar {
                normal: [0.0, 0.0, 1.0],
            },
            BaseMotion::Floating => CompoundKind::Floating,
        }
    }
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct AttachedBody {
    name: String,
    body: String,
    link: String,
    position: Option<Vec<f64>>,
    rpy: Option<Vec<f64>>,
    quaternion_xyzw: Option<Vec<f64>>,
    #[serde(default)]
    may_touch: Vec<String>,
}

/// A parsed cell file: TOML with its folder, or the path of a glTF.
pub(super) enum CellSource<'p> {
    Toml(CellFile, &'p Path),
    Gltf(&'p Path),
}

impl<'p> CellSource<'p> {
    /// Reads a cell file. The files that it names are searched next to it, and are read later.
    ///
    /// # Errors
    /// If the file cannot be read.
    pub(super) fn read(path: &'p Path) -> Result<Self> {
        let extension = path.extension().and_then(|extension| extension.to_str());
        if matches!(extension, Some("glb" | "gltf")) {
            return Ok(CellSource::Gltf(path));
        }
        let text = ccd_file::read_to_string(path)?;
        let file = toml::from_str(&text).map_err(|error| {
            let start = error.span().map_or(0, |span| span.start);
            anyhow!("{}: {}", place_in(&text, start), error.message())
        })?;
        Ok(CellSource::Toml(
            file,
            path.parent().unwrap_or(Path::new("")),
        ))
    }

    /// Returns the remarks on the numbers of the file.
    pub(super) fn remarks(&self) -> Vec<CellRemark> {
        match self {
            CellSource::Toml(file, _) => file.remarks(),
            CellSource::Gltf(_) => Vec::new(),
        }
    }

    /// Combines a robot with the other robots and the moving obstacles of the file. The links and joints of the robot keep
    /// their names, and its base is the origin. `options` sets how the file of a robot is read.
    ///
    /// # Errors
    /// If a robot or a body cannot be read, or names are not unique.
    pub(super) fn combine(
        &self,
        robot: (Robot, LinkPairs),
        options: impl Fn(RobotFile) -> RobotFile,
    ) -> Result<(Robot, LinkPairs)> {
        let CellSource::Toml(file, folder) = self else {
            return Ok(robot);
        };
        let mut others: Vec<OwnedRobot> = Vec::new();
        for other in &file.robot {
            let read = || other.read(folder, &options);
            others.push(read().with_context(|| format!("robot {}", other.name))?);
        }
        for obstacle in &file.obstacle {
            let Some(moves) = obstacle.moves else {
                continue;
            };
            let read = || obstacle.moving_robot(folder, moves);
            others.push(read().with_context(|| format!("obstacle {}", obstacle.name))?);
        }
        if others.is_empty() {
            return Ok(robot);
        }
        let (first_robot, pairs) = &robot;
        let first_robot = PlacedRobot {
            name: "",
            robot: first_robot,
            pairs,
            carrier: None,
            pose: Pose::IDENTITY,
            base_motion: None,
        };
        let others = others.iter().map(OwnedRobot::placed);
        let robots: Vec<PlacedRobot<'_>> = std::iter::once(first_robot).chain(others).collect();
        Ok(Robot::combine(&robots)?)
    }

    /// Adds obstacles at rest, attached bodies, paddings and clearances to a cell. Bodies are named as in `--a` of
    /// `ccd query`.
    ///
    /// # Errors
    /// If a file cannot be read, or a name is unknown.
    pub(super) fn add_to(&self, cell: &mut Cell) -> Result<()> {
        let (file, folder) = match self {
            CellSource::Toml(file, folder) => (file, folder),
            CellSource::Gltf(path) => {
                for (name, body) in load_parts(path)? {
                    cell.add_obstacle(name, body, Pose::IDENTITY)?;
                }
                return Ok(());
            }
        };
        for obstacle in &file.obstacle {
            if obstacle.moves.is_none() {
                add_obstacle(cell, folder, obstacle)
                    .with_context(|| format!("obstacle {}", obstacle.name))?;
            }
        }
        for plane in &file.plane {
            let mut add = || {
                anyhow::Ok(cell.add_plane(
                    &plane.name,
                    pose(&plane.position, &plane.rpy, &plane.quaternion_xyzw)?,
                )?)
            };
            add().with_context(|| format!("plane {}", plane.name))?;
        }
        for attached in &file.attached {
            attach(cell, folder, attached)
                .with_context(|| format!("attached body {}", attached.name))?;
        }
        let moves = file
            .obstacle
            .iter()
            .find(|obstacle| obstacle.moves.is_some());
        if let (Some(obstacle), false) = (moves, file.padding.is_empty()) {
            bail!(
                "obstacle {} moves, and [padding] is for obstacles at rest; give it a [[clearance]]",
                obstacle.name
            );
        }
        for (link, distance) in &file.padding {
            cell.set_padding(link, *distance)?;
        }
        let pairs = PairsWithClearance::set(cell, &file.clearance)?;
        for attached in &file.attached {
            for item in &attached.may_touch {
                pairs.refuse([&attached.name, item]).with_context(|| {
                    format!("may_touch {item} of attached body {}", attached.name)
                })?;
            }
        }
        pairs.allow(cell, &file.allowed)
    }
}

/// Returns the number and the text of the line of a byte in a TOML text, with the header of the line's table.
fn place_in(text: &str, byte: usize) -> String {
    let number = 1 + text[..byte].matches('\n').count();
    let lines = || text.lines().take(number).map(str::trim);
    let line = lines().last().unwrap_or_default();
    let header = lines().filter(|line| line.starts_with('[')).last();
    match header {
        Some(header) if header != line => format!("line {number}, `{line}` of {header}"),
        _ => format!("line {number}, `{line}`"),
    }
}

impl CellFile {
    /// Returns the remarks on the rotations of the file.
    fn remarks(&self) -> Vec<CellRemark> {
        type Angles = Option<Vec<f64>>;
        let remark_on = |kind: &str, name: &str, rpy: &Angles, quaternion: &Angles| {
            let rpy = rpy.as_deref().and_then(|rpy| rpy.try_into().ok());
            let quaternion = quaternion
                .as_deref()
                .and_then(|quaternion| quaternion.try_into().ok());
            let remark = rpy
                .and_then(Remark::remark_on_roll_pitch_yaw)
                .or(quaternion.and_then(Remark::remark_on_quaternion))?;
            Some(CellRemark::on(format!("{kind} {name}"), remark))
        };
        let obstacles = self.obstacle.iter();
        let obstacles = obstacles
            .map(|entry| remark_on("obstacle", &entry.name, &entry.rpy, &entry.quaternion_xyzw));
        let planes = self.plane.iter();
        let planes =
            planes.map(|entry| remark_on("plane", &entry.name, &entry.rpy, &entry.quaternion_xyzw));
        let robots = self.robot.iter();
        let robots =
            robots.map(|entry| remark_on("robot", &entry.name, &entry.rpy, &entry.quaternion_xyzw));
        let attached = self.attached.iter();
        let attached = attached.map(|entry| {
            remark_on(
                "attached body",
                &entry.name,
                &entry.rpy,
                &entry.quaternion_xyzw,
            )
        });
        let remarks = obstacles.chain(planes).chain(robots).chain(attached);
        remarks.flatten().collect()
    }
}

/// A robot of the file with its placement.
struct OwnedRobot {
    name: String,
    robot: Robot,
    pairs: LinkPairs,
    carrier: Option<String>,
    pose: Pose,
    base_motion: Option<CompoundKind>,
}

impl OwnedRobot {
    fn placed(&self) -> PlacedRobot<'_> {
        PlacedRobot {
            name: &self.name,
            robot: &self.robot,
            pairs: &self.pairs,
            carrier: self.carrier.as_deref(),
            pose: self.pose,
            base_motion: self.base_motion,
        }
    }
}

impl OtherRobot {
    fn read(&self, folder: &Path, options: impl Fn(RobotFile) -> RobotFile) -> Result<OwnedRobot> {
        let file = options(RobotFile::from_path(folder.join(&self.urdf)));
        let robot = file.read()?;
        let srdf = self.srdf.as_ref().map(|srdf| folder.join(srdf));
        Ok(OwnedRobot {
            pairs: file.link_pairs(&robot, srdf.as_deref())?,
            name: self.name.clone(),
            robot,
            carrier: self.on.clone(),
            pose: pose(&self.position, &self.rpy, &self.quaternion_xyzw)?,
            base_motion: self.base.map(CompoundKind::from),
        })
    }
}

impl Obstacle {
    /// Returns the obstacle as a robot of one link with a base that moves.
    fn moving_robot(&self, folder: &Path, moves: BaseMotion) -> Result<OwnedRobot> {
        let body = body_beside(folder, &self.body)?;
        let link = Link::named("body").with_body(body, Pose::IDENTITY);
        let robot = Robot::new(vec![link], Vec::new())?;
        Ok(OwnedRobot {
            name: self.name.clone(),
            pairs: LinkPairs::from_robot(&robot),
            robot,
            carrier: None,
            pose: pose(&self.position, &self.rpy, &self.quaternion_xyzw)?,
            base_motion: Some(moves.into()),
        })
    }
}

fn add_obstacle(cell: &mut Cell, folder: &Path, entry: &Obstacle) -> Result<()> {
    let body = body_beside(folder, &entry.body)?;
    let pose = pose(&entry.position, &entry.rpy, &entry.quaternion_xyzw)?;
    Ok(cell.add_obstacle(&entry.name, body, pose)?)
}

fn attach(cell: &mut Cell, folder: &Path, entry: &AttachedBody) -> Result<()> {
    let body = body_beside(folder, &entry.body)?;
    let pose = pose(&entry.position, &entry.rpy, &entry.quaternion_xyzw)?;
    let may_touch: Vec<&str> = entry.may_touch.iter().map(String::as_str).collect();
    Ok(cell.attach(&entry.name, body, (&entry.link, pose), &may_touch)?)
}

/// Loads the body that a text describes, in metres. A relative path of a file starts at `folder`.
fn body_beside(folder: &Path, text: &str) -> Result<Body> {
    let mut source: BodySource = text.parse()?;
    match &mut source {
        BodySource::Mesh(mesh) => mesh.file = folder.join(&mesh.file),
        BodySource::StoredBody(file) => *file = folder.join(&*file),
        _ => {}
    }
    Ok(source.load_in_unit(Unit::Metre, PieceChoice::Auto)?.body)
}

#[cfg(test)]
mod tests;
