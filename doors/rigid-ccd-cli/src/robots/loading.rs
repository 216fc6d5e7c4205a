//! Loads a robot from URDF or MJCF and from SRDF, and the cell around it.

use super::cell_file::CellSource;
use crate::console::progress::Progress;
use crate::console::{print_escaped_to_stderr, print_remarks};
use crate::options::named::{Named, named_value_parser};
use anyhow::{Context, Result, bail};
use clap::Args;
use rigid_ccd_robot::{
    BodyElements, Cell, CellRemark, CheckSummary, LeftOutPairs, LinkPairs, MeshConversion, Robot,
    RobotFile, SkipReason,
};
use std::path::{Path, PathBuf};

/// The options that name a robot, and say how its links become bodies.
#[derive(Clone, Debug, Args)]
pub(crate) struct RobotArgs {
    /// Robot to read, URDF or MJCF; packages are found by ROS_PACKAGE_PATH, AMENT_PREFIX_PATH and around the file
    #[arg(value_name = "ROBOT")]
    urdf: Option<PathBuf>,
    /// Folder of packages for `package://`, searched before all others; may be given several times
    #[arg(long, value_name = "FOLDER")]
    packages: Vec<PathBuf>,
    /// Shapes of the robot that become bodies
    #[arg(long, value_parser = named_value_parser(GEOMETRIES), default_value = "collision")]
    geometry: BodyElements,
    /// Bodies that the meshes of links become
    #[arg(long, value_parser = named_value_parser(MESH_CONVERSIONS), default_value = "exact")]
    meshes: MeshConversion,
}

/// The options that name a robot and its cell.
#[derive(Clone, Debug, Args)]
pub(crate) struct CellArgs {
    #[command(flatten)]
    pub(crate) robot: RobotArgs,
    /// Pairs of links to leave out (disable_collisions) or to check anyway (enable_collisions), SRDF
    #[arg(long, value_name = "SRDF")]
    srdf: Option<PathBuf>,
    /// Obstacles, other robots, held objects, paddings and clearances, TOML; or obstacles alone, the parts of a glTF
    #[arg(long, value_name = "TOML|GLTF")]
    pub(crate) cell: Option<PathBuf>,
}

/// The values of `--geometry`.
const GEOMETRIES: Named<BodyElements, 2> = [
    (
        "collision",
        BodyElements::Collision,
        "Shapes for collision checks: elements `collision`, or geoms that can collide",
    ),
    (
        "visual",
        BodyElements::Visual,
        "Shapes for drawing: elements `visual`, or geoms of the groups 0 to 2",
    ),
];

/// The values of `--meshes`.
const MESH_CONVERSIONS: Named<MeshConversion, 2> = [
    (
        "exact",
        MeshConversion::Exact,
        "Convex pieces that are exact",
    ),
    (
        "hull",
        MeshConversion::OuterHull,
        "The convex hull of the mesh: contacts may be early, by an excess that is printed",
    ),
];

impl RobotArgs {
    /// Returns whether a robot is given.
    pub(crate) fn is_given(&self) -> bool {
        self.urdf.is_some()
    }

    /// Returns the path of the robot's file; empty if no robot is given. Commands that need a robot refuse that.
    pub(crate) fn path(&self) -> &Path {
        self.urdf.as_deref().unwrap_or(Path::new(""))
    }

    fn file(&self) -> RobotFile {
        self.with_options(RobotFile::from_path(self.path()))
    }

    /// Sets the options for the reading of a robot's file.
    fn with_options(&self, file: RobotFile) -> RobotFile {
        let file = file
            .with_body_element_kind(self.geometry)
            .with_mesh_conversion(self.meshes);
        // The last folder that is added is searched first.
        let folders = self.packages.iter().rev();
        folders.fold(file, |file, folder| file.with_package_folder(folder))
    }

    /// Returns the robot's file with its name in messages, without the files of meshes.
    pub(crate) fn files(&self) -> impl Iterator<Item = (&'static str, &Path)> {
        std::iter::once(("ROBOT", self.path()))
    }

    /// Reads the robot, and prints its links and joints unless `quiet`.
    pub(crate) fn load(&self, quiet: bool) -> Result<Robot> {
        let progress = Progress::start_single_step("reading the robot's meshes", quiet);
        let name = || self.path().display().to_string();
        let robot = self.file().read().map_err(|error| self.explain(error))?;
        drop(progress);
        if !quiet {
            let joints: Vec<&str> = robot.independent_joint_names().collect();
            print_escaped_to_stderr(&format!(
                "{}: {} links, {} joints: {}",
                name(),
                robot.links().len(),
                joints.len(),
                joints.join(", ")
            ));
            for link in robot.links() {
                let excess = link.bodies.iter().map(|attached| attached.body.excess());
                let excess = excess.fold(0.0, ccd_core::order::greater);
                if excess > 0.0 {
                    print_escaped_to_stderr(&format!(
                        "link {}: its bodies enclose its shapes, and exceed them by up to {excess:.3e}",
                        link.name
                    ));
                }
            }
        }
        Ok(robot)
    }

    /// Adds a hint to an error if the robot's file has the extension of another kind of file.
    fn explain(&self, error: impl Into<anyhow::Error>) -> anyhow::Error {
        let extension = self
            .path()
            .extension()
            .and_then(|extension| extension.to_str());
        let error = error.into();
        match extension {
            Some("toml" | "csv" | "parquet" | "srdf" | "glb" | "gltf" | "obj" | "stl") => {
                error.context("ROBOT is a URDF or MJCF file; --cell takes its surroundings")
            }
            _ => error,
        }
    }

    /// Returns the pairs of links that are checked according to the robot's file alone. Prints a summary of these
    /// pairs, and the remarks on the robot.
    ///
    /// # Errors
    /// If the file cannot be read again.
    pub(crate) fn link_pairs_printed(&self, robot: &Robot, quiet: bool) -> Result<LinkPairs> {
        let pairs = self.file().link_pairs(robot, None)?;
        print_check_summary(&pairs.check_summary(robot), &pairs.remarks(robot), quiet);
        Ok(pairs)
    }
}

impl CellArgs {
    /// Reads the robot and the cell around it.
    pub(crate) fn load(&self, quiet: bool) -> Result<Cell> {
        let robot = self.robot.load(quiet)?;
        let srdf = self.srdf.as_deref();
        let pairs = self.robot.file().link_pairs(&robot, srdf)?;
        let cell = match &self.cell {
            Some(file) => self
                .load_cell_file(file, (robot, pairs), quiet)
                .with_context(|| file.display().to_string())?,
            None => Cell::new(robot, pairs),
        };
        let remarks = cell.remarks();
        if let Err(nothing) = cell.check_any_compared() {
            let remarks = remarks.iter().map(|remark| format!("; {remark}"));
            bail!(
                "{nothing}; --geometry visual takes the other shapes of the robot{}",
                remarks.collect::<String>()
            );
        }
        print_check_summary(&cell.check_summary(), &remarks, quiet);
        if !quiet {
            print_escaped_to_stderr(&format!("sizes in metres: {}", cell.sizes_text()));
        }
        Ok(cell)
    }

    /// Makes the cell of a robot and of the objects in a cell file.
    fn load_cell_file(
        &self,
        file: &Path,
        robot_and_pairs: (Robot, LinkPairs),
        quiet: bool,
    ) -> Result<Cell> {
        let source = CellSource::read(file)?;
        let robot_joint_count = robot_and_pairs.0.independent_joint_names().len();
        let (robot, pairs) =
            source.combine(robot_and_pairs, |file| self.robot.with_options(file))?;
        let mut cell = Cell::new(robot, pairs);
        source.add_to(&mut cell)?;
        print_remarks(source.remarks());
        if !quiet {
            let obstacles: Vec<&str> = cell.obstacle_names().collect();
            let others: Vec<&str> = cell.robot().independent_joint_names().collect();
            let others = &others[robot_joint_count..];
            let mut text = format!(
                "{}: {} obstacles: {}",
                file.display(),
                obstacles.len(),
                obstacles.join(", ")
            );
            if !others.is_empty() {
                text += &format!("; {} joints of others: {}", others.len(), others.join(", "));
            }
            print_escaped_to_stderr(&text);
        }
        Ok(cell)
    }

    /// Returns the files that are read, except meshes, each with the option that names it.
    pub(crate) fn files(&self) -> impl Iterator<Item = (&'static str, &Path)> {
        let srdf = self.srdf.iter().map(|path| ("--srdf", path.as_path()));
        let cell = self.cell.iter().map(|path| ("--cell", path.as_path()));
        self.robot.files().chain(srdf).chain(cell)
    }
}

/// Prints a summary of the pairs that are checked, and the remarks on them; if `quiet`, only the warnings.
fn print_check_summary(summary: &CheckSummary, remarks: &[CellRemark], quiet: bool) {
    if !quiet {
        print_escaped_to_stderr(&summary.to_string());
    }
    for remark in remarks {
        let advice = match remark {
            CellRemark::MostLinksWithoutBodies { .. } | CellRemark::EmptyRobot { .. } => {
                " (--geometry visual)"
            }
            _ => "",
        };
        if remark.is_warning() {
            print_escaped_to_stderr(&format!("warning: {remark}{advice}"));
        } else if !quiet {
            print_escaped_to_stderr(&remark.to_string());
        }
    }
    let moves = |group: &LeftOutPairs| group.reason != SkipReason::NoMotion;
    if !quiet && summary.left_out_pairs.iter().any(moves) {
        print_escaped_to_stderr(
            "to check a pair anyway, give it a [[clearance]] in the --cell, or enable_collisions in the --srdf",
        );
    }
}
