//! The compiler settings and options of an MJCF that affect geometry, joints and names.

use super::attributes::Attributes;
use super::document::{Element, children_of_sections};
use crate::robot_file::mjcf_error::MjcfError;
use std::path::{Path, PathBuf};

/// The settings from the `compiler` sections and from the flags of the `option` sections.
pub(super) struct Settings {
    has_degrees: bool,
    /// The axes of Euler angles. Lower-case axes rotate with the body.
    pub(super) euler_axes: [char; 3],
    /// Whether a joint with a range is limited by default.
    pub(super) limits_follow_ranges: bool,
    /// Whether the frame of a free body without children is moved to its center of mass.
    pub(super) aligns_free_bodies: bool,
    /// Whether a body is not checked against its parent.
    pub(super) skips_parents: bool,
    pub(super) has_limits: bool,
    pub(super) has_equalities: bool,
    /// Whether the margin of the options replaces the margins of geoms and pairs.
    overrides_margins: bool,
    margin: f64,
    mesh_folder: PathBuf,
    /// Whether folders in mesh file names are ignored.
    strips_paths: bool,
}

impl Settings {
    pub(super) fn read(root: &Element, folder: &Path) -> Result<Self, MjcfError> {
        let mut settings = Settings {
            has_degrees: true,
            euler_axes: ['x', 'y', 'z'],
            limits_follow_ranges: true,
            aligns_free_bodies: false,
            skips_parents: true,
            has_limits: true,
            has_equalities: true,
            overrides_margins: false,
            margin: 0.0,
            mesh_folder: folder.to_owned(),
            strips_paths: false,
        };
        let compilers = root
            .children
            .iter()
            .filter(|section| section.name == "compiler");
        let compilers: Vec<&Attributes> = compilers.map(|section| &section.attributes).collect();
        for compiler in &compilers {
            settings.set_compiler(compiler)?;
        }
        // The last folder counts, even if empty. Within one element, `meshdir` takes precedence over `assetdir`.
        let mut folders = compilers
            .iter()
            .filter_map(|compiler| compiler.get("meshdir").or(compiler.get("assetdir")));
        if let Some(mesh_folder) = folders.next_back() {
            settings.mesh_folder = folder.join(mesh_folder);
        }
        settings.set_options(root)?;
        Ok(settings)
    }

    /// Reads the options and their flags. The last value of a name counts.
    fn set_options(&mut self, root: &Element) -> Result<(), MjcfError> {
        let mut has_constraints = true;
        for flag in children_of_sections(root, "option").filter(|element| element.name == "flag") {
            let flag = &flag.attributes;
            for (name, value) in [
                ("filterparent", &mut self.skips_parents),
                ("limit", &mut self.has_limits),
                ("equality", &mut self.has_equalities),
                ("override", &mut self.overrides_margins),
                ("constraint", &mut has_constraints),
            ] {
                match flag.get(name) {
                    Some("disable") => *value = false,
                    Some("enable") => *value = true,
                    None => {}
                    Some(_) => return Err(flag.invalid(name)),
                }
            }
        }
        for option in root
            .children
            .iter()
            .filter(|section| section.name == "option")
        {
            [self.margin] = option
                .attributes
                .array("o_margin")?
                .unwrap_or([self.margin]);
        }
        self.has_limits &= has_constraints;
        self.has_equalities &= has_constraints;
        Ok(())
    }

    fn set_compiler(&mut self, compiler: &Attributes) -> Result<(), MjcfError> {
        match compiler.get("angle") {
            Some("radian") => self.has_degrees = false,
            Some("degree") => self.has_degrees = true,
            None => {}
            Some(_) => return Err(compiler.invalid("angle")),
        }
        if compiler
            .get("coordinate")
            .is_some_and(|coordinate| coordinate != "local")
        {
            return Err(compiler.invalid("coordinate"));
        }
        if let Some(text) = compiler.get("eulerseq") {
            let axes: Vec<char> = text.chars().collect();
            let is_axis = |axis: &char| "xyzXYZ".contains(*axis);
            let [a, b, c] = axes[..] else {
                return Err(compiler.invalid("eulerseq"));
            };
            self.euler_axes = [a, b, c];
            if !self.euler_axes.iter().all(is_axis) {
                return Err(compiler.invalid("eulerseq"));
            }
        }
        self.limits_follow_ranges = compiler.truth_or("autolimits", self.limits_follow_ranges)?;
        self.strips_paths = compiler.truth_or("strippath", self.strips_paths)?;
        self.aligns_free_bodies = compiler.truth_or("alignfree", self.aligns_free_bodies)?;
        Ok(())
    }

    /// Returns the margin that replaces the margins of geoms and pairs; `None` if these are not replaced.
    pub(super) fn margin(&self) -> Option<f64> {
        self.overrides_margins.then_some(self.margin)
    }

    /// Converts an angle of the file to radians.
    pub(super) fn radians(&self, angle: f64) -> f64 {
        if self.has_degrees {
            angle.to_radians()
        } else {
            angle
        }
    }

    /// Returns the path of a mesh or height field file.
    pub(super) fn mesh_file(&self, file: &str) -> PathBuf {
        let path = Path::new(file);
        match path.file_name().filter(|_| self.strips_paths) {
            Some(name) => self.mesh_folder.join(name),
            None => self.mesh_folder.join(path),
        }
    }
}
