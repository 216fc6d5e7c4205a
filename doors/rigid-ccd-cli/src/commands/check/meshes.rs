//! The meshes of a folder, which proofs name by their digests.

use anyhow::{Context, Result, bail};
use ccd_check::{Body, Stop};
use ccd_file::folder_to_open;
use std::path::{Path, PathBuf};
use std::{fs, io};

/// The meshes of a folder as bytes, each with the certificate of its tree.
pub(super) struct Meshes(Vec<(Vec<u8>, Vec<u8>)>);

impl Meshes {
    /// Reads all files NAME.mesh of a folder, each with its file NAME.body.
    pub(super) fn read(folder: &Path) -> Result<Self> {
        let paths = files_ending_in("mesh", folder)?;
        let read = |path: &Path| ccd_file::read(path).with_context(|| path.display().to_string());
        let read_with_tree =
            |mesh: PathBuf| Ok((read(&mesh)?, read(&mesh.with_extension("body"))?));
        let meshes: Vec<_> = paths
            .into_iter()
            .map(read_with_tree)
            .collect::<Result<_>>()?;
        if meshes.is_empty() {
            let folder = folder_to_open(folder).display();
            bail!("{folder}: has no file NAME.mesh; give --bodies FOLDER");
        }
        Ok(Meshes(meshes))
    }

    /// Reads the meshes in the unit of length of a proof. Returns the valid meshes, and the problem of an invalid one,
    /// which the proof may not need.
    pub(super) fn bodies(&self, proof: &[u8]) -> (Vec<Body>, Option<Stop>) {
        let (mut bodies, mut left_out) = (Vec::new(), None);
        for (mesh, tree) in &self.0 {
            match Body::new(mesh, tree, proof) {
                Ok(body) => bodies.push(body),
                Err(stop) => left_out = Some(stop),
            }
        }
        (bodies, left_out)
    }
}

/// Returns the files of a folder that have an extension, in the order of their names.
pub(super) fn files_ending_in(extension: &str, folder: &Path) -> Result<Vec<PathBuf>> {
    let folder = folder_to_open(folder);
    let entries = fs::read_dir(folder).and_then(|entries| {
        let paths = entries.map(|entry| Ok(entry?.path()));
        paths.collect::<io::Result<Vec<_>>>()
    });
    let mut paths = entries.with_context(|| folder.display().to_string())?;
    paths.retain(|path| path.extension().is_some_and(|end| end == extension));
    paths.sort();
    Ok(paths)
}
