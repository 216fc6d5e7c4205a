//! Exports scenes as files that other programs can read.

use crate::scene::{ModelBodyCache, SceneDescription};
use anyhow::{Context, Result};
use ccd_decomp::write_obj;
use ccd_tables::motions;
use std::path::{Path, PathBuf};
use std::{fs, io};

/// Writes each scene into a folder with its name: `a.obj`, `b.obj`, `motions.csv`.
///
/// # Errors
/// If a scene cannot be made or a file cannot be written.
pub fn export_scenes(
    listings: &[SceneDescription],
    models: Option<PathBuf>,
    folder: &Path,
) -> Result<()> {
    let mut models = ModelBodyCache::new(models);
    for listing in listings {
        let scene = listing.make_scene(&mut models)?;
        let directory = folder.join(&scene.name);
        let place = || directory.display().to_string();
        fs::create_dir_all(&directory).with_context(place)?;
        for (body, name) in [(&scene.a, "a.obj"), (&scene.b, "b.obj")] {
            let write = |out: &mut dyn io::Write| write_obj(body.mesh(), out);
            ccd_file::write(directory.join(name), write).with_context(place)?;
        }
        let write =
            |out: &mut dyn io::Write| motions::write(out, &scene.queries).map_err(io::Error::other);
        ccd_file::write(directory.join("motions.csv"), write).with_context(place)?;
    }
    Ok(())
}
