//! Reads a robot from a URDF or MJCF file, and from the mesh files that it names.

mod body_elements;
mod error;
mod meshes;
mod mjcf;
mod mjcf_error;
mod packages;
mod urdf;
mod urdf_error;

pub use body_elements::BodyElements;
pub use error::RobotFileError;
pub use meshes::MeshConversion;
pub use mjcf_error::MjcfError;
pub use urdf_error::UrdfError;

use crate::pairs::LinkPairs;
use crate::remark::CellRemark;
use crate::robot::Robot;
use crate::srdf::Srdf;
use ccd_decomp::{HTML_ADVICE, is_html};
use meshes::{MeshBodies, MeshRules};
use mjcf::MjcfModel;
use packages::SearchFolders;
use roxmltree::Document;
use std::borrow::Cow;
use std::path::{Path, PathBuf};
use urdf::UrdfReader;

/// A URDF or MJCF file of a robot, and how its shapes become bodies.
///
/// A file whose root element is `mujoco` is an MJCF; any other is a URDF. The bodies of an MJCF become links, and its
/// world becomes the link `world`.
///
/// ```
/// use rigid_ccd_robot::{MeshConversion, RobotFile};
/// # let text = "<robot name='door'><link name='frame'/><link name='leaf'><collision>
/// #     <geometry><box size='0.8 0.04 2'/></geometry></collision></link>
/// #     <joint name='hinge' type='revolute'><parent link='frame'/><child link='leaf'/>
/// #     <axis xyz='0 0 1'/><limit lower='0' upper='1.5' effort='1' velocity='1'/></joint></robot>";
/// # let folder = tempfile::tempdir()?;
/// # std::fs::write(folder.path().join("door.urdf"), text)?;
/// # std::env::set_current_dir(&folder)?;
/// let file = RobotFile::from_path("door.urdf").with_mesh_conversion(MeshConversion::OuterHull);
/// let robot = file.read()?;
/// let pairs = file.link_pairs(&robot, None)?;
/// assert_eq!(robot.limits().collect::<Vec<_>>(), [[0.0, 1.5]]);
/// assert_eq!(pairs.checked_pairs().count(), 0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct RobotFile {
    path: PathBuf,
    /// The text of the file; `None` to read it from the path.
    text: Option<String>,
    search_folders: SearchFolders,
    body_elements: BodyElements,
    mesh_conversion: MeshConversion,
}

impl RobotFile {
    /// Creates the description of a file to read. By default its collision shapes become exact bodies. Packages are
    /// searched in the folders of `ROS_PACKAGE_PATH` and `AMENT_PREFIX_PATH`, then in the folders above the file.
    pub fn from_path(path: impl Into<PathBuf>) -> Self {
        let path = path.into();
        RobotFile {
            search_folders: SearchFolders::for_urdf(&path),
            path,
            text: None,
            body_elements: BodyElements::default(),
            mesh_conversion: MeshConversion::default(),
        }
    }

    /// Creates the description of a file from its text. `path` is the assumed path of the file: it is used to find
    /// meshes, and in messages.
    ///
    /// ```
    /// use rigid_ccd_robot::RobotFile;
    /// let robot = RobotFile::from_text("<robot name='stone'><link name='base'/></robot>", "stone.urdf").read()?;
    /// assert_eq!(robot.links().len(), 1);
    /// # Ok::<(), rigid_ccd_robot::RobotFileError>(())
    /// ```
    pub fn from_text(text: impl Into<String>, path: impl Into<PathBuf>) -> Self {
        RobotFile {
            text: Some(text.into()),
            ..RobotFile::from_path(path)
        }
    }

    /// Adds a folder that is searched first for `package://` names. It is a package or contains packages.
    #[must_use]
    pub fn with_package_folder(mut self, folder: impl Into<PathBuf>) -> Self {
        self.search_folders.prepend_folder(folder.into());
        self
    }

    /// Sets whether collision shapes or visual shapes become bodies.
    #[must_use]
    pub fn with_body_element_kind(self, elements: BodyElements) -> Self {
        RobotFile {
            body_elements: elements,
            ..self
        }
    }

    /// Sets whether a mesh becomes exact convex pieces or its convex hull.
    #[must_use]
    pub fn with_mesh_conversion(self, meshes: MeshConversion) -> Self {
        RobotFile {
            mesh_conversion: meshes,
            ..self
        }
    }

    /// Reads the file and its meshes, and builds the robot.
    ///
    /// A cylinder becomes an enclosing polytope; see [`Body::excess`](rigid_ccd::Body::excess). A floating, planar or
    /// spherical joint becomes a chain of joints; see [`CompoundKind`](crate::CompoundKind).
    ///
    /// For an MJCF:
    ///
    /// - A joint follows another joint if an `equality` makes its position a linear function of the other position.
    ///   Other constraints, for example constraints that close loops, are ignored: paths have to satisfy them.
    /// - The positions of a free joint or a `mocap` body are relative to the world's origin.
    /// - Limits of ball joints and margins of geoms are ignored.
    /// - An ellipsoid becomes an enclosing polytope.
    /// - MuJoCo uses the convex hull of a mesh, and so does [`MeshConversion::OuterHull`]. The default uses the exact
    ///   mesh, so a body in a hollow of the mesh touches nothing.
    /// - Shapes fitted to meshes, height fields from images, built-in meshes and planes on moving bodies are errors.
    ///
    /// Unknown elements and attributes are errors, unless they are known to be unrelated to shapes, joints and pairs.
    /// [`Robot::file_remarks`] lists probable mistakes.
    ///
    /// # Errors
    /// [`RobotFileError`] with the name of the link, joint or mesh file.
    pub fn read(&self) -> Result<Robot, RobotFileError> {
        let text = self.text()?;
        self.search_folders.check_caller_folders()?;
        let model = self.mjcf(&text)?;
        let rules = match model {
            Some(_) => MeshRules::Mjcf,
            None => MeshRules::Urdf,
        };
        let meshes = MeshBodies::new(self.mesh_conversion, rules);
        let robot = match model {
            Some(model) => model.robot(self.body_elements, &meshes)?,
            None => {
                let folders = &self.search_folders;
                let reader = UrdfReader::new(self.body_elements, &meshes, folders);
                reader
                    .read(&text)
                    .map_err(|error| self.syntax_error(error))??
            }
        };
        let empty = match robot.links() {
            [link] if !link.has_shapes() => Some(CellRemark::EmptyRobot {
                link: link.name.clone(),
            }),
            _ => None,
        };
        let remarks = meshes.into_remarks().into_iter().chain(empty);
        let name = robot_name(&text);
        Ok(robot.with_name(name).with_file_remarks(remarks))
    }

    /// Returns the pairs of links that are checked. Adjacent links, links that do not move relative to each other, and
    /// pairs that the SRDF disables are not checked. The SRDF can enable pairs again.
    ///
    /// For an MJCF, MuJoCo's rules apply: `contype`, `conaffinity`, `exclude` and `pair` have an effect, and children of
    /// the world are checked against it.
    ///
    /// Unknown links in the SRDF give a remark. `disable_default_collisions` disables all pairs of a link with other
    /// links, but no pairs with obstacles.
    ///
    /// # Errors
    /// [`RobotFileError`] if a file cannot be read, or if the robot has none of the SRDF's links.
    pub fn link_pairs(
        &self,
        robot: &Robot,
        srdf: Option<&Path>,
    ) -> Result<LinkPairs, RobotFileError> {
        let text = self.text()?;
        let mut pairs = match self.mjcf(&text)? {
            Some(model) => model.link_pairs(robot, self.body_elements)?,
            None => LinkPairs::from_robot(robot),
        };
        if let Some(file) = srdf {
            Srdf::from_text(&read(file)?)
                .and_then(|srdf| srdf.apply(robot, &mut pairs))
                .map_err(|error| RobotFileError::Srdf {
                    file: file.to_owned(),
                    error,
                })?;
        }
        Ok(pairs)
    }

    fn text(&self) -> Result<Cow<'_, str>, RobotFileError> {
        let text = match &self.text {
            Some(text) => Cow::Borrowed(&**text),
            None => Cow::Owned(read(&self.path)?),
        };
        if is_html(text.as_bytes()) {
            return Err(self.syntax_error(HTML_ADVICE.to_owned()));
        }
        Ok(text)
    }

    /// Parses the text if it is an MJCF.
    fn mjcf(&self, text: &str) -> Result<Option<MjcfModel>, RobotFileError> {
        if root_element(text).as_deref() != Some(mjcf::ROOT_ELEMENT) {
            return Ok(None);
        }
        let folder = self.path.parent().unwrap_or(Path::new(""));
        let model = MjcfModel::from_text(text, folder).map_err(|error| match error {
            RobotFileError::Mjcf(MjcfError::Syntax { error }) => self.syntax_error(error),
            other => other,
        })?;
        Ok(Some(model))
    }

    fn syntax_error(&self, error: String) -> RobotFileError {
        RobotFileError::Syntax {
            file: self.path.clone(),
            error,
        }
    }
}

/// Returns the name of the root element of an XML text; `None` if it is not XML.
fn root_element(text: &str) -> Option<String> {
    let document = Document::parse(text).ok()?;
    Some(document.root_element().tag_name().name().to_owned())
}

/// Returns the robot's name in a URDF or MJCF; empty if there is none.
fn robot_name(text: &str) -> String {
    let name = Document::parse(text).ok().and_then(|document| {
        let root = document.root_element();
        let name = root.attribute("name").or(root.attribute("model"))?;
        Some(name.to_owned())
    });
    name.unwrap_or_default()
}

/// Parses an XML text. A document type definition is an error.
fn parse_xml(text: &str) -> Result<Document<'_>, String> {
    Document::parse(text).map_err(|error| error.to_string())
}

/// Reads a text file.
fn read(file: &Path) -> Result<String, RobotFileError> {
    ccd_file::read_to_string(file).map_err(|error| RobotFileError::Unreadable {
        file: file.to_owned(),
        error: error.to_string(),
    })
}

#[cfg(test)]
mod tests;
