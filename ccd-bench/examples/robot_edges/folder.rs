//! Reads a robot, a cell around it, edges, and whether they touch, from a folder.

use anyhow::{Context, Result, bail, ensure};
use rigid_ccd::{Body, Pose, load};
use rigid_ccd_robot::{Cell, RobotFile};
use std::fs;
use std::num::ParseFloatError;
use std::path::{Path, PathBuf};

/// Reads the robot of a folder and the obstacles of a cell.
pub(crate) fn read_cell(folder: &Path, meshes: &Path, name: &str) -> Result<Cell> {
    let file = RobotFile::from_path(&file_with(folder, "urdf")?);
    let robot = file.read()?;
    let pairs = file.link_pairs(&robot, Some(&file_with(folder, "srdf")?))?;
    let mut cell = Cell::new(robot, pairs);
    let lines = read_text(&folder.join(format!("{name}.txt")))?;
    for (number, line) in lines.lines().enumerate() {
        add_obstacle(&mut cell, meshes, number, line).with_context(|| line.to_owned())?;
    }
    Ok(cell)
}

/// Returns the first file of a folder, by name, with an extension.
fn file_with(folder: &Path, extension: &str) -> Result<PathBuf> {
    let entries = fs::read_dir(folder).with_context(|| folder.display().to_string())?;
    let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
    let found = paths.filter(|path| path.extension().is_some_and(|other| other == extension));
    found
        .min()
        .with_context(|| format!("{} has no .{extension}", folder.display()))
}

/// Adds an obstacle from a line of text: its shape, the sizes of the shape or the name of its mesh, and its pose.
fn add_obstacle(cell: &mut Cell, meshes: &Path, number: usize, line: &str) -> Result<()> {
    let words: Vec<&str> = line.split_whitespace().collect();
    ensure!(
        words.len() > 8,
        "a shape, its sizes or mesh, and a pose of seven numbers"
    );
    let (shape, pose) = words.split_at(words.len() - 7);
    let (pose, sizes) = (parse_numbers(pose)?, parse_numbers(&shape[1..]));
    let body = match (shape[0], sizes.as_deref()) {
        ("box", Ok(&[x, y, z])) => Body::cuboid([x, y, z])?,
        ("sphere", Ok(&[radius])) => Body::sphere(radius)?,
        ("capsule", Ok(&[radius, half])) => Body::capsule(radius, half)?,
        ("mesh", _) => load(meshes.join(format!("{}.obj", shape[1])))?,
        _ => bail!("an unknown shape, or a wrong number of sizes"),
    };
    let pose = Pose::new(
        [pose[0], pose[1], pose[2]],
        [pose[4], pose[5], pose[6], pose[3]],
    )?;
    Ok(cell.add_obstacle(format!("{}{number}", shape[0]), body, pose)?)
}

fn parse_numbers(words: &[&str]) -> Result<Vec<f64>, ParseFloatError> {
    words.iter().map(|word| word.parse()).collect()
}

/// Reads numbers of a file of float64: the start and the end of each edge.
pub(crate) fn read_numbers(path: &Path) -> Result<Vec<f64>> {
    let bytes = fs::read(path).with_context(|| path.display().to_string())?;
    let (numbers, rest) = bytes.as_chunks();
    ensure!(
        rest.is_empty(),
        "{} is not a file of float64",
        path.display()
    );
    Ok(numbers
        .iter()
        .map(|bytes| f64::from_le_bytes(*bytes))
        .collect())
}

/// Reads which edges touch: their lines begin with 1, those of the others with 0.
pub(crate) fn read_truth(path: &Path) -> Result<Vec<bool>> {
    let text = read_text(path)?;
    let lines = text.lines().map(|line| match line.as_bytes().first() {
        Some(b'0') => Ok(false),
        Some(b'1') => Ok(true),
        _ => bail!("{}: a line begins with 0 or 1", path.display()),
    });
    lines.collect()
}

fn read_text(path: &Path) -> Result<String> {
    fs::read_to_string(path).with_context(|| path.display().to_string())
}
