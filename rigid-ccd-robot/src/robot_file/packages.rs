//! Finds the files that a URDF refers to by `package://NAME/…`, `file://…` or a path.

use super::error::RobotFileError;
use std::env;
use std::path::{Path, PathBuf};

/// The folders to search for packages and files.
#[derive(Clone, Debug)]
pub(super) struct SearchFolders {
    /// The folder of the URDF file, to which relative paths refer.
    urdf_folder: PathBuf,
    /// Folders that are packages or contain packages, in search order.
    package_folders: Vec<PathBuf>,
    /// The number of folders from the caller, at the start of `package_folders`.
    caller_folder_count: usize,
}

impl SearchFolders {
    /// Lists the folders to search: those of `ROS_PACKAGE_PATH` and `AMENT_PREFIX_PATH`, then all folders above the
    /// URDF file.
    pub(super) fn for_urdf(urdf: &Path) -> Self {
        let package_folders = folders_in("ROS_PACKAGE_PATH");
        SearchFolders::new(urdf, package_folders, &folders_in("AMENT_PREFIX_PATH"))
    }

    /// Lists the folders to search. An installed package of ROS 2 is below `share` in a prefix.
    fn new(urdf: &Path, package_folders: Vec<PathBuf>, ament_prefixes: &[PathBuf]) -> Self {
        let urdf_folder = urdf.parent().unwrap_or(Path::new("")).to_owned();
        let mut folders = package_folders;
        folders.extend(ament_prefixes.iter().map(|prefix| prefix.join("share")));
        // A URDF is usually a few folders below the root of its package.
        let absolute = urdf_folder
            .canonicalize()
            .unwrap_or_else(|_| urdf_folder.clone());
        folders.extend(absolute.ancestors().map(Path::to_owned));
        SearchFolders {
            urdf_folder,
            package_folders: folders,
            caller_folder_count: 0,
        }
    }

    pub(super) fn prepend_folder(&mut self, folder: PathBuf) {
        self.package_folders.insert(0, folder);
        self.caller_folder_count += 1;
    }

    /// Checks that the folders from the caller exist. A missing one is probably misspelt.
    pub(super) fn check_caller_folders(&self) -> Result<(), RobotFileError> {
        let from_caller = &self.package_folders[..self.caller_folder_count];
        match from_caller.iter().find(|folder| !folder.is_dir()) {
            None => Ok(()),
            Some(folder) => Err(RobotFileError::NoFolder {
                folder: folder.clone(),
            }),
        }
    }

    /// Returns the path of an existing file that a name in the URDF refers to.
    pub(super) fn find_file(&self, uri: &str) -> Result<PathBuf, RobotFileError> {
        let mut searched_paths = self.possible_paths(uri);
        if let Some(decoded) = percent_decoded(uri) {
            searched_paths.extend(self.possible_paths(&decoded));
        }
        match searched_paths.iter().find(|path| path.is_file()) {
            Some(path) => Ok(path.clone()),
            None => Err(RobotFileError::MeshNotFound {
                uri: uri.to_owned(),
                searched_paths,
            }),
        }
    }

    /// Returns the paths that a name in the URDF may refer to, in search order.
    fn possible_paths(&self, uri: &str) -> Vec<PathBuf> {
        let path_in_package = uri
            .strip_prefix("package://")
            .or_else(|| uri.strip_prefix("model://"));
        let Some(path) = path_in_package else {
            let path = uri.strip_prefix("file://").unwrap_or(uri);
            return vec![self.urdf_folder.join(path)];
        };
        let (package, rest) = path.split_once('/').unwrap_or((path, ""));
        let in_folder = |folder: &PathBuf| {
            let is_package = folder.file_name().is_some_and(|name| name == package);
            let path_in_folder = is_package.then(|| folder.join(rest));
            // If the folder is the package, it comes before a package of the same name inside it.
            [path_in_folder, Some(folder.join(package).join(rest))]
                .into_iter()
                .flatten()
        };
        self.package_folders.iter().flat_map(in_folder).collect()
    }
}

/// Decodes escapes such as `%20`; `None` if there are none, or if the result is not UTF-8.
fn percent_decoded(uri: &str) -> Option<String> {
    let mut parts = uri.split('%');
    let mut bytes = parts.next()?.as_bytes().to_vec();
    let mut has_escape = false;
    for part in parts {
        let digits = part.get(..2)?;
        bytes.push(u8::from_str_radix(digits, 16).ok()?);
        bytes.extend(part[2..].bytes());
        has_escape = true;
    }
    String::from_utf8(bytes).ok().filter(|_| has_escape)
}

/// Returns the folders listed in an environment variable; none if it is not set. Targets without environment variables
/// cannot split such lists.
fn folders_in(variable: &str) -> Vec<PathBuf> {
    let list = env::var_os(variable);
    list.map_or_else(Vec::new, |list| env::split_paths(&list).collect())
}

#[cfg(test)]
mod tests;
