//! Mesh files with several parts and a unit.

use super::TriangleMesh;
use super::content::Content;
use super::error::{MeshError, MeshFault, element_name};
use super::format::{Format, LinkedFiles};
use super::polygons::Polygons;
use super::unit::{Unit, UnitConversion};
use std::fs::{self, File};
use std::io::Read;
use std::path::{Component, Path, PathBuf};

/// The content of a mesh file: a unit, and parts that are found by name or number.
///
/// The parts of a glTF are its nodes with meshes, those of an OBJ its objects or groups: [`Format`] says more. Any other
/// file is one part. Parts are numbered from 0; parts without faces are omitted.
///
/// ```
/// use ccd_decomp::{Format, MeshFile};
/// let text = "o base\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\no lid\nv 0 0 1\nf 1 2 4\nf 2 3 4\n";
/// let file = MeshFile::from_reader(Format::Obj, text.as_bytes())?;
/// assert_eq!(file.part("lid")?.faces().len(), 2);
/// let error = file.part("top").unwrap_err();
/// assert_eq!(error.to_string(), r#"has no part "top"; its parts are 0 "base", 1 "lid""#);
/// assert_eq!(file.into_mesh()?.faces().len(), 3);
/// # Ok::<(), ccd_decomp::MeshError>(())
/// ```
#[derive(Debug)]
pub struct MeshFile {
    content: Content,
    /// The unit to which the coordinates are converted; `None` if they stay as they are.
    target_unit: Option<Unit>,
    path: Option<PathBuf>,
}

/// The mesh of one part of a file, with the part's name.
#[derive(Clone, Debug)]
pub struct NamedMesh {
    /// The name of the part, if it has one. Several parts of a file may have the same name.
    pub name: Option<String>,
    /// The triangles of the part. Vertices and faces are numbered from 0 in each part.
    pub mesh: TriangleMesh,
}

impl MeshFile {
    /// Reads a mesh file in the format that its extension names, including the buffer files of a glTF.
    ///
    /// # Errors
    /// [`MeshError`], which names the file and the element. No bytes panic, and few bytes take little memory.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, MeshError> {
        let path = path.as_ref();
        let read = || {
            let (format, bytes) = read_format_and_bytes(path)?;
            let folder = path.parent().unwrap_or(Path::new(""));
            let mut linked = LinkedFiles::new();
            for (name, needed_bytes) in format.file_references(&bytes)? {
                let content = read_linked_file(folder, &name, needed_bytes)?;
                linked.insert(name, content);
            }
            format.parse(&bytes, &linked)
        };
        let content = read().map_err(|fault| MeshError::new(path, fault))?;
        Ok(MeshFile::new(content, Some(path.into())))
    }

    /// Reads a self-contained file in a given format from any reader.
    ///
    /// # Errors
    /// [`MeshError`], which names the element. No bytes panic, and few bytes take little memory.
    pub fn from_reader(format: Format, mut reader: impl Read) -> Result<Self, MeshError> {
        let mut bytes = Vec::new();
        reader
            .read_to_end(&mut bytes)
            .map_err(MeshFault::Unreadable)?;
        Ok(MeshFile::new(
            format.parse(&bytes, &LinkedFiles::new())?,
            None,
        ))
    }

    fn new(content: Content, path: Option<PathBuf>) -> Self {
        MeshFile {
            content,
            target_unit: None,
            path,
        }
    }

    /// Returns the unit of the coordinates; `None` if it is unknown. It is the unit of the last call of
    /// [`MeshFile::converted_to_unit`] or [`MeshFile::with_stated_unit`], else that of the file. A COLLADA states it, by
    /// default the metre; a glTF is in metres; the other formats have no unit.
    ///
    /// Coordinates keep the unit of the file unless they are converted. All doors have this rule: the command prints the
    /// unit, and warns of two files in different ones; the packages for Python and JavaScript remark on a unit that is not
    /// the metre, if none is asked for. Meshes of a robot are converted to metres.
    pub fn unit(&self) -> Option<Unit> {
        self.target_unit.or(self.content.unit)
    }

    /// States the unit in which the file's coordinates are written, without converting them. It takes precedence over
    /// that of the format.
    ///
    /// ```
    /// use ccd_decomp::{Format, MeshFile, Unit};
    /// let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    /// let file = MeshFile::from_reader(Format::Obj, text.as_bytes())?;
    /// let mesh = file.with_stated_unit(Unit::Inch).converted_to_unit(Unit::Millimetre).into_mesh()?;
    /// assert_eq!(mesh.vertices()[1].x, 25.4);
    /// # Ok::<(), ccd_decomp::MeshError>(())
    /// ```
    #[must_use]
    pub fn with_stated_unit(mut self, unit: Unit) -> Self {
        self.content.unit = Some(unit);
        self.target_unit = None;
        self
    }

    /// Converts the coordinates to a unit. Coordinates of a file without a unit are assumed to be in that unit already.
    ///
    /// # Guarantee
    /// Between metric units a coordinate is the exact product or quotient by a power of ten, rounded to nearest. It is
    /// exact for a glTF converted to centimetres, millimetres or micrometres, if no node transforms the mesh. From and
    /// to inches and feet it is rounded up to twice.
    ///
    /// ```
    /// use ccd_decomp::{Format, MeshFile, Unit};
    /// let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    /// let file = MeshFile::from_reader(Format::Obj, text.as_bytes())?.converted_to_unit(Unit::Inch);
    /// assert_eq!(file.unit(), Some(Unit::Inch));
    /// assert_eq!(file.into_mesh()?.vertices()[1].x, 1.0);
    /// # Ok::<(), ccd_decomp::MeshError>(())
    /// ```
    #[must_use]
    pub fn converted_to_unit(mut self, unit: Unit) -> Self {
        self.target_unit = Some(unit);
        self
    }

    /// Returns the names of the parts in the order of their numbers; `None` for a part without a name.
    pub fn part_names(&self) -> impl ExactSizeIterator<Item = Option<&str>> {
        self.content.part_names.iter().map(Option::as_deref)
    }

    /// Returns the mesh of the part with the given name or, if no part has that name, with the given number.
    ///
    /// # Errors
    /// [`MeshFault::NoSuchPart`] with all names, [`MeshFault::AmbiguousPart`] if several parts have the name, and
    /// faults of the part.
    pub fn part(&self, name_or_number: &str) -> Result<TriangleMesh, MeshError> {
        let made = || {
            let part = self.find_part(name_or_number)?;
            let separate = self.content.separate_parts(part..part + 1);
            let mesh = separate
                .and_then(|mut one| mesh_from_polygons(one.swap_remove(0), self.unit_conversion()));
            mesh.map_err(|fault| fault.at_element(self.part_label(part)))
        };
        made().map_err(|fault| error(fault, &self.path))
    }

    /// Returns the meshes of all parts, each with its name.
    ///
    /// # Errors
    /// [`MeshFault::AtElement`] with the number and name of a part, and its fault.
    pub fn into_parts(self) -> Result<Vec<NamedMesh>, MeshError> {
        let parts = self
            .content
            .separate_parts(0..self.content.part_names.len());
        let parts = parts.map_err(|fault| error(fault, &self.path))?.into_iter();
        let named = parts.enumerate().map(|(part, polygons)| {
            let mesh = mesh_from_polygons(polygons, self.unit_conversion())
                .map_err(|fault| error(fault.at_element(self.part_label(part)), &self.path))?;
            let name = self.content.part_names[part].clone();
            Ok(NamedMesh { name, mesh })
        });
        named.collect()
    }

    /// Returns all parts as one mesh, one part after the other. Elements of an OBJ keep the numbers of the file.
    ///
    /// A solid wholly inside another one counts as its cavity. [`MeshFile::into_parts`] keeps them as two solids.
    ///
    /// # Errors
    /// The faults of the mesh.
    pub fn into_mesh(self) -> Result<TriangleMesh, MeshError> {
        let conversion = self.unit_conversion();
        let whole = self.content.all_faces();
        let mesh = whole.and_then(|polygons| mesh_from_polygons(polygons, conversion));
        mesh.map_err(|fault| error(fault, &self.path))
    }

    fn unit_conversion(&self) -> Option<UnitConversion> {
        let units = self.content.unit.zip(self.target_unit);
        units.map(|(from, to)| UnitConversion::new(from, to))
    }

    fn find_part(&self, name_or_number: &str) -> Result<usize, MeshFault> {
        let names = &self.content.part_names;
        let has_name = |&part: &usize| names[part].as_deref() == Some(name_or_number);
        let named: Vec<usize> = (0..names.len()).filter(has_name).collect();
        let number = || name_or_number.parse().ok();
        match named[..] {
            [part] => Ok(part),
            [] => number()
                .filter(|&number| number < names.len())
                .ok_or_else(|| MeshFault::NoSuchPart {
                    part: name_or_number.into(),
                    part_names: names.clone(),
                }),
            _ => Err(MeshFault::AmbiguousPart {
                part: name_or_number.into(),
                part_numbers: named,
            }),
        }
    }

    /// Returns the number and the name of a part for messages.
    fn part_label(&self, part: usize) -> String {
        element_name("part", part, self.content.part_names[part].as_deref())
    }
}

/// Returns the paths of all files that a mesh is read from, including the files that it refers to.
pub(crate) fn source_paths(path: &Path) -> Result<Vec<PathBuf>, MeshError> {
    let found = || {
        if !Format::from_path(path).is_ok_and(Format::may_refer_to_files) {
            return Ok(vec![path.to_owned()]);
        }
        let (format, bytes) = read_format_and_bytes(path)?;
        let folder = path.parent().unwrap_or(Path::new(""));
        let mut files = vec![path.to_owned()];
        for name in format.file_references(&bytes)?.keys() {
            files.push(folder.join(checked_relative_path(name)?));
        }
        Ok(files)
    };
    found().map_err(|fault| MeshError::new(path, fault))
}

fn error(fault: MeshFault, path: &Option<PathBuf>) -> MeshError {
    MeshError {
        file: path.clone(),
        fault,
    }
}

/// Creates a mesh from polygons, after converting their coordinates to another unit.
fn mesh_from_polygons(
    mut polygons: Polygons,
    conversion: Option<UnitConversion>,
) -> Result<TriangleMesh, MeshFault> {
    if let Some(conversion) = conversion {
        for vertex in &mut polygons.vertices {
            *vertex = conversion.apply(*vertex);
        }
    }
    TriangleMesh::from_polygons(polygons)
}

fn read_format_and_bytes(path: &Path) -> Result<(Format, Vec<u8>), MeshFault> {
    if path.is_dir() {
        return Err(MeshFault::Folder);
    }
    let format = Format::from_path(path)?;
    let bytes = ccd_file::read(path).map_err(MeshFault::Unreadable)?;
    Ok((format, bytes))
}

/// Reads a file that a mesh refers to, up to the needed length. Only regular files are read: a pipe might never end.
fn read_linked_file(folder: &Path, name: &str, bytes: u64) -> Result<Vec<u8>, MeshFault> {
    let path = folder.join(checked_relative_path(name)?);
    let read = || {
        if !fs::metadata(&path)?.is_file() {
            return Err(std::io::Error::other("it is no file"));
        }
        let mut content = Vec::new();
        File::open(&path)?.take(bytes).read_to_end(&mut content)?;
        Ok(content)
    };
    read().map_err(|error| MeshFault::UnreadableLinkedFile {
        referenced_file_name: name.into(),
        reason: format!("{error}; put it where the mesh is"),
    })
}

/// Converts a reference to a path, and checks that it stays in the mesh's folder or below it.
fn checked_relative_path(name: &str) -> Result<PathBuf, MeshFault> {
    let path = PathBuf::from(name);
    let stays = |part| matches!(part, Component::Normal(_) | Component::CurDir);
    if path.components().all(stays) && path.file_name().is_some() {
        Ok(path)
    } else {
        Err(MeshFault::UnreadableLinkedFile {
            referenced_file_name: name.into(),
            reason: "it is not in the folder of the mesh; put it there".into(),
        })
    }
}

#[cfg(test)]
mod tests;
